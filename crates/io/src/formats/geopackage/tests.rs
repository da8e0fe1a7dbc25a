//! Databases that others make: several layers, all types of values, systems; and those that are broken or mean harm.

use std::io::{Cursor, Read};

use rusqlite::{Connection, MAIN_DB};

use super::database::{Database, MOST_IN_MEMORY};
use crate::{Edges, Error, Format, Graph, ReadOptions, write_edges};

/// The tables that all layers need.
const HEAD: &str = "CREATE TABLE gpkg_geometry_columns (table_name, column_name, geometry_type_name, srs_id, z, m);
 CREATE TABLE gpkg_spatial_ref_sys (srs_name, srs_id, organization, organization_coordsys_id, definition, description);
 INSERT INTO gpkg_spatial_ref_sys VALUES ('', 7, 'EPSG', 25832, 'undefined', NULL), ('', 8, 'EPSG', 25833, 'undefined', NULL),
 ('Undefined SRS', 99999, 'GDAL', 99999, 'LOCAL_CS[\"Undefined SRS\"]', NULL);";

/// A point (1 2) with a box, and one in the other order of bytes.
const POINT: &str = "X'4750000307000000000000000000F03F000000000000F03F000000000000004000000000000000400101000000000000000000F03F0000000000000040'";
const BIG: &str = "X'47500000000000070000000001400800000000000040100000000000000000'";

/// The bytes of a database that is made so.
fn database(script: &str) -> Vec<u8> {
    let mut connection = Connection::open_in_memory().expect("memory");
    connection.execute_batch(HEAD).expect("tables");
    connection.execute_batch(script).expect(script);
    connection.serialize(MAIN_DB).expect("bytes").to_vec()
}

fn read(bytes: Vec<u8>) -> Result<Graph, Error> {
    let options = ReadOptions { attributes: true, ..ReadOptions::default() };
    super::read(Box::new(Cursor::new(bytes)), &options)?.graph()
}

fn layer(name: &str, system: u32) -> String {
    format!("INSERT INTO gpkg_geometry_columns VALUES ('{name}', 'geom', 'GEOMETRY', {system}, 0, 0);")
}

#[test]
fn values_have_their_types() {
    let table = "CREATE TABLE \"a \"\"b\"\"\" (fid INTEGER PRIMARY KEY, \"GEOM\" POINT, t TEXT, yes BOOLEAN, i MEDIUMINT, r DOUBLE, b BLOB, n TEXT);";
    let row = format!(
        "INSERT INTO \"a \"\"b\"\"\" VALUES (5, {POINT}, 'x\"', 1, -9223372036854775808, 0.5, X'00ff', NULL), (6, NULL, '', 0, 2, 9e999, NULL, 3);"
    );
    let graph = read(database(&[table, &row, &layer("a \"b\"", 7)].concat())).expect("a layer");
    let cells = |row| graph.cloud.features.table.row(row).map(|cell| cell.1.to_owned()).collect::<Vec<_>>();
    assert_eq!(cells(0), ["\"x\\\"\"", "true", "-9223372036854775808", "0.5", "\"00ff\""]);
    assert_eq!(cells(1), ["\"\"", "false", "2", "1e999", "\"3\""]);
    assert_eq!(graph.cloud.features.table.names(), ["t", "yes", "i", "r", "b", "n"]);
    assert_eq!(graph.cloud.xy, [[1.0, 2.0]]);
    assert_eq!(graph.cloud.crs.and_then(|crs| crs.epsg), Some(25_832));
}

#[test]
fn layers_are_told_apart() {
    let tables = format!(
        "CREATE TABLE one (fid INTEGER PRIMARY KEY, geom, layer); INSERT INTO one VALUES (1, {POINT}, 'own');
         CREATE TABLE two (geom); INSERT INTO two VALUES (NULL), ({BIG});
         CREATE VIEW three AS SELECT geom, 'v' AS kind FROM one;"
    );
    let registered = [layer("one", 7), layer("two", 99_999), layer("three", 7)].concat();
    let graph = read(database(&[tables.clone(), registered].concat())).expect("three layers");
    let rows: Vec<Vec<&str>> =
        (0..4).map(|row| graph.cloud.features.table.row(row).map(|cell| cell.1).collect()).collect();
    assert_eq!(rows[0], ["\"one\"", "\"own\""]);
    assert_eq!(
        (&rows[1], &rows[2], &rows[3]),
        (&vec!["\"two\""], &vec!["\"two\""], &vec!["\"three\"", "\"v\""])
    );
    assert_eq!(graph.cloud.features.table.names()[..2], ["layer", "layer_2"]);
    assert_eq!(graph.cloud.xy, [[1.0, 2.0], [3.0, 4.0], [1.0, 2.0]]);
    assert!(graph.cloud.remarks[0].ends_with("the attribute layer_2 names: one, two, three"));
    let apart =
        read(database(&[tables, layer("one", 7), layer("three", 8)].concat())).expect_err("two systems");
    assert!(apart.to_string().contains("layer three are EPSG:25833"), "{apart}");
}

/// Whose journal is a write-ahead log, of which nothing is in the file.
#[test]
fn databases_with_a_log_are_read() {
    let table = format!("CREATE TABLE one (geom); INSERT INTO one VALUES ({POINT});");
    let mut bytes = database(&[table, layer("one", 7)].concat());
    bytes[18..20].fill(2);
    assert_eq!(read(bytes.clone()).expect("a point").cloud.xy, [[1.0, 2.0]]);
    // The same of a database that is too large for memory.
    let copied = Database::open(Box::new(Cursor::new(bytes)), 0).expect("a copy");
    let count: i64 =
        copied.connection.query_row("SELECT count(*) FROM one", [], |row| row.get(0)).expect("rows");
    assert_eq!((count, copied.connection.is_readonly(MAIN_DB).expect("a database")), (1, true));
}

#[test]
fn what_means_harm_ends() {
    let views = [
        (
            "WITH RECURSIVE c(n) AS (SELECT 1 UNION ALL SELECT n + 1 FROM c WHERE n < 1e12) SELECT NULL AS geom FROM c WHERE n < 0",
            "no end",
        ),
        ("SELECT zeroblob(1000000000) AS geom", "too big"),
        ("SELECT load_extension('x') AS geom", "load_extension"),
        ("SELECT \"nothing\" AS geom", "nothing"),
        ("SELECT 'text' AS geom", "its geometry is none"),
        ("SELECT X'4751' AS geom", "does not begin"),
        ("SELECT X'4750000b000000000101' AS geom", "box of no kind"),
        ("SELECT X'475000210000000001' AS geom", "extension"),
        ("SELECT X'47500003000000000101' AS geom", "inside of its box"),
        ("SELECT X'4750000100000000010100000000' AS geom", "ends inside of it"),
    ];
    for (view, what) in views {
        let error = read(database(&format!("CREATE VIEW v AS {view}; {}", layer("v", 7)))).expect_err(view);
        assert!(error.to_string().contains(what), "{view}: {error}");
    }
    // Rows without end that are small.
    let many = "WITH RECURSIVE c(n) AS (SELECT 1 UNION ALL SELECT n + 1 FROM c) SELECT zeroblob(100000) AS b, NULL AS geom FROM c";
    let error = read(database(&format!("CREATE VIEW v AS {many}; {}", layer("v", 7)))).expect_err("endless");
    assert!(matches!(error, Error::Expands), "{error}");
}

#[test]
fn what_is_no_geopackage_is_named() {
    let broken = |bytes: Vec<u8>| read(bytes).expect_err("broken").to_string();
    assert!(broken(b"GP, but no database".repeat(99)).contains("no database of SQLite"));
    assert!(broken(Vec::new()).contains("the file is empty"));
    assert!(broken(database("")).contains("no layer of features"));
    assert!(broken(database(&layer("gone", 7))).contains("gone"));
    let table = format!("CREATE TABLE one (geom); INSERT INTO one VALUES ({POINT});");
    let whole = database(&[table, layer("one", 7)].concat());
    let mut beginning = Vec::new();
    Cursor::new(&whole).take(whole.len() as u64 / 2).read_to_end(&mut beginning).expect("memory");
    assert!(read(beginning).is_err());
    assert!(MOST_IN_MEMORY > whole.len() as u64);
}

/// Lines from a curve that is dense in places: what the index finds is what a look at each finds, and SQLite finds its nodes right.
#[test]
fn layers_are_written_with_an_index() {
    // One node, a full one, two, and three levels of them.
    for count in [0_usize, 1, 51, 52, 103, 6000] {
        let points: Vec<[f64; 2]> = (0..=count)
            .map(|i| [(i as f64).sin().powi(5) * 1e3, (i as f64 * 0.7).cos() * 1e-3 + 5e6])
            .collect();
        let pairs: Vec<[usize; 2]> = (0..count).map(|i| [i, i + 1]).collect();
        let mut bytes = Vec::new();
        let edges = Edges { points: &points, pairs: &pairs, widths: None, crs: None };
        write_edges(&mut bytes, Format::GeoPackage, &edges).expect("memory");
        let mut written = Connection::open_in_memory().expect("memory");
        written.deserialize_read_exact(MAIN_DB, &bytes[..], bytes.len(), true).expect("a database");
        let verdict: String = written
            .query_row("SELECT rtreecheck('rtree_edges_geom')", [], |row| row.get(0))
            .expect("an index");
        assert_eq!(verdict, "ok", "{count}");
        let within = "SELECT id FROM rtree_edges_geom WHERE minx <= ? AND maxx >= ? AND miny <= ? AND maxy >= ? ORDER BY id";
        let mut within = written.prepare(within).expect("a table");
        for [x, y, side] in
            [[0.0, 5e6, 1e9], [0.0, 5e6, 0.1], [500.0, 5e6, 1.0], [-999.0, 5e6, 100.0], [0.0, 0.0, 1.0]]
        {
            let window = [x + side, x - side, y + side, y - side];
            let ids = within.query_map(window, |row| row.get::<_, i64>(0)).expect("rows");
            let ids: Vec<i64> = ids.map(|id| id.expect("a number")).collect();
            let [east, west, north, south] = window;
            // Boxes are of single precision, rounded outwards: near five millions their sides are halves.
            let (inner, outer) = (|low: f64, high: f64| low <= high, |low: f64, high: f64| low <= high + 0.5);
            let found = |meets: fn(f64, f64) -> bool| -> Vec<i64> {
                let meets = |pair: &[usize; 2]| {
                    let [p, q] = pair.map(|i| points[i]);
                    let [low, high] = [f64::min, f64::max].map(|pick| [0, 1].map(|k| pick(p[k], q[k])));
                    meets(low[0], east)
                        && meets(west, high[0])
                        && meets(low[1], north)
                        && meets(south, high[1])
                };
                (0..count).filter(|&i| meets(&pairs[i])).map(|i| i as i64 + 1).collect()
            };
            let (needed, allowed) = (found(inner), found(outer));
            assert!(needed.iter().all(|id| ids.binary_search(id).is_ok()), "{count}, {window:?}");
            assert!(ids.iter().all(|id| allowed.binary_search(id).is_ok()), "{count}, {window:?}");
        }
        let extension: String = written
            .query_row("SELECT extension_name FROM gpkg_extensions WHERE table_name = 'edges'", [], |row| {
                row.get(0)
            })
            .expect("a row");
        assert_eq!(extension, "gpkg_rtree_index");
        let triggers: i64 = written
            .query_row(
                "SELECT count(*) FROM sqlite_master WHERE type = 'trigger' AND tbl_name = 'edges'",
                [],
                |row| row.get(0),
            )
            .expect("a number");
        assert_eq!(triggers, 6);
    }
}
