//! Layers as GeoPackage: in a database on the disk, which is copied to the output in the end.

use std::fs::File;
use std::io::{self, Write};

use rusqlite::{Connection, params};

use super::database::failed;
use super::index::Index;
use super::read::quoted;
use crate::features::numbered;
use crate::formats::vector::{self, Column, Form, Geometry, Kind, Layer};
use crate::formats::wkb;
use crate::{ColumnType, Crs, Error, Value};

/// The columns of the rows' numbers and of the geometries.
const OURS: [&str; 2] = ["fid", "geom"];

/// The tables that all files have. The date is the same in all, so that the same input gives the same bytes.
const TABLES: &str = r#"
PRAGMA application_id = 0x47504B47;
PRAGMA user_version = 10300;
CREATE TABLE gpkg_spatial_ref_sys (srs_name TEXT NOT NULL, srs_id INTEGER NOT NULL PRIMARY KEY, organization TEXT NOT NULL,
 organization_coordsys_id INTEGER NOT NULL, definition TEXT NOT NULL, description TEXT);
CREATE TABLE gpkg_contents (table_name TEXT NOT NULL PRIMARY KEY, data_type TEXT NOT NULL, identifier TEXT UNIQUE,
 description TEXT DEFAULT '', last_change DATETIME NOT NULL DEFAULT (strftime('%Y-%m-%dT%H:%M:%fZ','now')),
 min_x DOUBLE, min_y DOUBLE, max_x DOUBLE, max_y DOUBLE, srs_id INTEGER,
 CONSTRAINT fk_gc_r_srs_id FOREIGN KEY (srs_id) REFERENCES gpkg_spatial_ref_sys(srs_id));
CREATE TABLE gpkg_geometry_columns (table_name TEXT NOT NULL, column_name TEXT NOT NULL, geometry_type_name TEXT NOT NULL,
 srs_id INTEGER NOT NULL, z TINYINT NOT NULL, m TINYINT NOT NULL,
 CONSTRAINT pk_geom_cols PRIMARY KEY (table_name, column_name), CONSTRAINT uk_gc_table_name UNIQUE (table_name),
 CONSTRAINT fk_gc_tn FOREIGN KEY (table_name) REFERENCES gpkg_contents(table_name),
 CONSTRAINT fk_gc_srs FOREIGN KEY (srs_id) REFERENCES gpkg_spatial_ref_sys (srs_id));
CREATE TABLE gpkg_extensions (table_name TEXT, column_name TEXT, extension_name TEXT NOT NULL, definition TEXT NOT NULL,
 scope TEXT NOT NULL, CONSTRAINT ge_tce UNIQUE (table_name, column_name, extension_name));
INSERT INTO gpkg_spatial_ref_sys VALUES ('Undefined Cartesian SRS', -1, 'NONE', -1, 'undefined', NULL),
 ('Undefined geographic SRS', 0, 'NONE', 0, 'undefined', NULL),
 ('WGS 84 geodetic', 4326, 'EPSG', 4326, 'GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563,AUTHORITY["EPSG","7030"]],AUTHORITY["EPSG","6326"]],PRIMEM["Greenwich",0,AUTHORITY["EPSG","8901"]],UNIT["degree",0.0174532925199433,AUTHORITY["EPSG","9122"]],AXIS["Latitude",NORTH],AXIS["Longitude",EAST],AUTHORITY["EPSG","4326"]]', NULL);
"#;

/// The system of a file that knows none: `GDAL` calls it so, and takes it for none.
const NO_SYSTEM: &str = r#"INSERT INTO gpkg_spatial_ref_sys VALUES ('Undefined SRS', 99999, 'GDAL', 99999,
 'LOCAL_CS["Undefined SRS",LOCAL_DATUM["unknown",32767],UNIT["unknown",0],AXIS["Easting",EAST],AXIS["Northing",NORTH]]', NULL)"#;

/// Writes layers, which are all in the system of the first.
pub(crate) fn write(out: &mut dyn Write, layers: &[&dyn Layer]) -> Result<(), Error> {
    let file = tempfile::NamedTempFile::new()?;
    let connection = Connection::open(file.path()).map_err(failed)?;
    fill(&connection, layers)?;
    connection.close().map_err(|(_, error)| failed(error))?;
    io::copy(&mut File::open(file.path())?, out)?;
    Ok(())
}

fn fill(connection: &Connection, layers: &[&dyn Layer]) -> Result<(), Error> {
    const FAST: &str =
        "PRAGMA journal_mode = OFF; PRAGMA synchronous = OFF; PRAGMA locking_mode = EXCLUSIVE; BEGIN;";
    connection.execute_batch(FAST).map_err(failed)?;
    connection.execute_batch(TABLES).map_err(failed)?;
    let crs = layers.first().and_then(|layer| layer.crs());
    let system = write_system(connection, crs).map_err(failed)?;
    layers.iter().try_for_each(|layer| add(connection, *layer, system))?;
    connection.execute_batch("COMMIT").map_err(failed)
}

/// Writes a layer as a table in the system of so many.
fn add(connection: &Connection, layer: &dyn Layer, system: u32) -> Result<(), Error> {
    let (columns, form, is_high) = (layer.columns(), layer.form(), layer.is_high());
    let table = quoted(layer.name());
    let [key, geometry] = OURS;
    let declared: Vec<String> = names(&columns)
        .iter()
        .zip(&columns)
        .map(|(name, column)| format!(", {} {}", quoted(name), kind_of(column.kind)))
        .collect();
    let declared = format!(
        "CREATE TABLE {table} ({key} INTEGER PRIMARY KEY AUTOINCREMENT NOT NULL, {geometry} {}{})",
        name_of(form),
        declared.concat()
    );
    connection.execute_batch(&declared).map_err(failed)?;
    let places = ", ?".repeat(columns.len());
    let mut insert =
        connection.prepare(&format!("INSERT INTO {table} VALUES (NULL, ?{places})")).map_err(failed)?;
    let mut bounds: Option<[[f64; 2]; 2]> = None;
    let mut index = Index::default();
    let mut blob = Vec::new();
    layer.each(&mut |geometry, values| {
        insert.clear_bindings();
        let own = geometry.positions.iter().fold(None, |known, &[x, y, _]| Some(widened(known, [x, y])));
        if geometry.count() > 0 {
            blob.clear();
            write_geometry(&mut blob, geometry, Form::of(geometry, form), is_high, system, own)?;
            insert.raw_bind_parameter(1, &blob[..]).map_err(failed)?;
        }
        for (place, value) in values {
            bind(&mut insert, place + 2, columns[place].kind, &value).map_err(failed)?;
        }
        insert.raw_execute().map_err(failed)?;
        if let Some(own) = own {
            index.add(connection.last_insert_rowid(), own);
            bounds = own.iter().fold(bounds, |known, &corner| Some(widened(known, corner)));
        }
        Ok(())
    })?;
    let [low, high] = bounds.map_or([[None; 2]; 2], |bounds| bounds.map(|corner| corner.map(Some)));
    let name = layer.name();
    connection
        .execute(
            "INSERT INTO gpkg_contents VALUES (?, 'features', ?, '', '1970-01-01T00:00:00.000Z', ?, ?, ?, ?, ?)",
            params![name, name, low[0], low[1], high[0], high[1], system],
        )
        .map_err(failed)?;
    // Where geometries of several kinds have heights, readers expect that some may have none.
    let heights = if !is_high {
        0
    } else if form.is_some() {
        1
    } else {
        2
    };
    connection
        .execute(
            "INSERT INTO gpkg_geometry_columns VALUES (?, ?, ?, ?, ?, 0)",
            params![name, geometry, name_of(form), system, heights],
        )
        .map_err(failed)?;
    index.write(connection, name, OURS).map_err(failed)
}

/// The names of the columns: SQLite does not tell capital letters from small ones.
fn names(columns: &[Column]) -> Vec<String> {
    let mut taken: Vec<String> = OURS.map(str::to_owned).to_vec();
    let mut names = Vec::new();
    for column in columns {
        let is_taken = |name: &str| taken.iter().any(|known| known.eq_ignore_ascii_case(name));
        let name =
            if is_taken(&column.name) { numbered(&column.name, is_taken) } else { column.name.clone() };
        taken.push(name.clone());
        names.push(name);
    }
    names
}

fn kind_of(column: ColumnType) -> &'static str {
    match column {
        ColumnType::Bool => "BOOLEAN",
        ColumnType::Integer => "INTEGER",
        ColumnType::Number => "DOUBLE",
        ColumnType::Text => "TEXT",
    }
}

/// The type name of the geometries of a layer.
fn name_of(form: Option<Form>) -> &'static str {
    match form {
        None => "GEOMETRY",
        Some(Form { kind: Kind::Point, is_multiple: false }) => "POINT",
        Some(Form { kind: Kind::Line, is_multiple: false }) => "LINESTRING",
        Some(Form { kind: Kind::Polygon, is_multiple: false }) => "POLYGON",
        Some(Form { kind: Kind::Point, is_multiple: true }) => "MULTIPOINT",
        Some(Form { kind: Kind::Line, is_multiple: true }) => "MULTILINESTRING",
        Some(Form { kind: Kind::Polygon, is_multiple: true }) => "MULTIPOLYGON",
    }
}

/// Registers a system, and gives the number that it has in the file.
fn write_system(connection: &Connection, crs: Option<&Crs>) -> rusqlite::Result<u32> {
    const INSERT: &str = "INSERT OR IGNORE INTO gpkg_spatial_ref_sys VALUES (?, ?, ?, ?, ?, NULL)";
    /// The number of a system that has none in the registry.
    const OWN: u32 = 100_000;
    let Some(crs) = crs else {
        connection.execute(NO_SYSTEM, [])?;
        return Ok(99_999);
    };
    let (authority, number) = match vector::number(crs) {
        Some(number) => ("EPSG", number),
        None => ("NONE", OWN),
    };
    let definition = crs.wkt.as_deref().unwrap_or("undefined");
    let name = crs.name.clone().unwrap_or_else(|| format!("{authority}:{number}"));
    connection.execute(INSERT, params![name, number, authority, number, definition])?;
    Ok(number)
}

fn bind(
    insert: &mut rusqlite::Statement,
    place: usize,
    column: ColumnType,
    value: &Value,
) -> rusqlite::Result<()> {
    match (column, value) {
        (_, Value::Null) => Ok(()),
        (ColumnType::Text, value) => insert.raw_bind_parameter(place, value.text()),
        (_, Value::Bool(is_so)) => insert.raw_bind_parameter(place, is_so),
        (ColumnType::Number, Value::Integer(number)) => insert.raw_bind_parameter(place, *number as f64),
        (_, Value::Integer(number)) => insert.raw_bind_parameter(place, number),
        (_, Value::Number(number)) => insert.raw_bind_parameter(place, number),
        _ => Ok(()),
    }
}

/// A box with a position more.
fn widened(known: Option<[[f64; 2]; 2]>, p: [f64; 2]) -> [[f64; 2]; 2] {
    let [low, high] = known.unwrap_or([p, p]);
    [[0, 1].map(|k| f64::min(low[k], p[k])), [0, 1].map(|k| f64::max(high[k], p[k]))]
}

/// Writes a head with the box of the geometry, which points do without, and the geometry as well-known binary of OGC.
fn write_geometry(
    out: &mut Vec<u8>,
    geometry: &Geometry,
    form: Form,
    is_high: bool,
    system: u32,
    bounds: Option<[[f64; 2]; 2]>,
) -> io::Result<()> {
    const LITTLE_ENDIAN: u8 = 1;
    const WITH_BOX: u8 = 1 << 1;
    let is_point = form.kind == Kind::Point && !form.is_multiple;
    out.write_all(&[b'G', b'P', 0, LITTLE_ENDIAN | if is_point { 0 } else { WITH_BOX }])?;
    out.write_all(&system.to_le_bytes())?;
    if !is_point && let Some([low, high]) = bounds {
        let numbers = [low[0], high[0], low[1], high[1]];
        numbers.iter().for_each(|x| out.extend(x.to_le_bytes()));
    }
    if form.is_multiple {
        begin(out, form, is_high)?;
        wkb::write_count(out, geometry.count())?;
    }
    let one = Form { is_multiple: false, ..form };
    for i in 0..geometry.count() {
        begin(out, one, is_high)?;
        match form.kind {
            Kind::Point => write_positions(out, &geometry.positions[i..=i], is_high),
            Kind::Line => write_line(out, geometry.line(i), is_high)?,
            Kind::Polygon => {
                wkb::write_count(out, geometry.rings(i).len())?;
                geometry.rings(i).try_for_each(|ring| write_line(out, ring, is_high))?;
            }
        }
    }
    Ok(())
}

/// The first bytes of a geometry. Kinds with heights are a thousand further.
fn begin(out: &mut Vec<u8>, form: Form, is_high: bool) -> io::Result<()> {
    wkb::begin(out, u32::from(form.number()) + if is_high { 1000 } else { 0 }, None)
}

fn write_line(out: &mut Vec<u8>, line: &[[f64; 3]], is_high: bool) -> io::Result<()> {
    wkb::write_count(out, line.len())?;
    write_positions(out, line, is_high);
    Ok(())
}

fn write_positions(out: &mut Vec<u8>, positions: &[[f64; 3]], is_high: bool) {
    let width = if is_high { 3 } else { 2 };
    let numbers = positions.iter().flat_map(|position| &position[..width]);
    numbers.for_each(|x| out.extend(x.to_le_bytes()));
}
