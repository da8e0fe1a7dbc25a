//! Content written to formats of layers comes back as from GeoJSON: positions bit for bit, attributes, the system.

use std::io::{Cursor, Write};

use delone::surface::{Contours, Levels};
use delone::{Delaunay2, Region2};
use delone_io::{
    Answers, Cloud, Contents, ContourMap, Crs, Diagram, Direction, Edges, Error, Features, Format, Found,
    Graph, GraphRing, Mesh, OrderDiagram, Patches, ReadOptions, Rows, Table, Value, picture, read_graph,
    read_points, read_rings, write_answers, write_contours, write_diagram, write_edges, write_graph,
    write_mesh, write_orders, write_patches, write_points,
};

const LAYERS: &[Format] = &[
    Format::FlatGeobuf,
    #[cfg(feature = "geopackage")]
    Format::GeoPackage,
];

/// The compared content: positions, heights, the cells of each row, the rows of positions, segments, the number of the system.
type Content = (Vec<String>, Vec<Vec<String>>, Vec<Option<usize>>, Vec<[usize; 2]>, Option<u32>);

fn content(format: Format, file: &[u8]) -> Content {
    let options = ReadOptions::default().attributes(true).dimension(2);
    let graph = read_graph(Box::new(Cursor::new(file.to_vec())), format, &options, None);
    let Graph { cloud, segments, rings, .. } = graph.unwrap_or_else(|error| panic!("{format}: {error}"));
    let own = read_rings(Box::new(Cursor::new(file.to_vec())), format).expect("rings");
    assert_eq!((own.rings.len(), &own.crs), (rings.len(), &cloud.crs));
    let Cloud { xy, z, crs, features, .. } = cloud;
    let height = |i: usize| z.as_ref().map(|z| z[i]);
    let positions = xy.iter().enumerate().map(|(i, p)| format!("{p:?} {:?}", height(i))).collect();
    let cell = |row: usize, (k, _): (usize, &str)| {
        let value = features.table.value(row, k);
        // Lists are texts where there is no type for them.
        let text = value.text().unwrap_or_default().replace(", ", ",");
        // SQLite has one zero.
        let text = if text == "-0.0" { "0.0".to_owned() } else { text };
        let number = if let Value::Integer(n) = value { format!("{:?}", n as f64) } else { text };
        format!("{}={number}", features.table.names()[k])
    };
    let table = &features.table;
    let rows = (0..table.len()).map(|row| table.row(row).map(|own| cell(row, own)).collect()).collect();
    let of = (0..xy.len()).map(|i| features.row(i)).collect();
    (positions, rows, of, segments, crs.and_then(|crs| crs.epsg))
}

fn points() -> Vec<[f64; 2]> {
    (0..30).map(|i| [f64::from(i * 37 % 101) / 7.0, f64::from(i * 53 % 97) / 3.0]).collect()
}

/// Attributes of all types, one of them with the name of a column of ours; the last row has none.
fn features() -> Features {
    let mut table = Table::default();
    for i in 0..30_i64 {
        table.begin();
        if i < 29 {
            table.set("area", Value::Integer(i - 7));
            table.set("name", Value::Text("\u{c5} \"b\""));
            table.set("is so", Value::Bool(i % 2 == 0));
            table.set("vertices", Value::Number(i as f64 / 8.0));
            table.set("mixed", if i % 3 == 0 { Value::Text("x") } else { Value::Null });
        }
    }
    Features::of_points(table)
}

/// Whether a thing that is written is the same in all formats.
fn compare(what: &str, write: impl Fn(&mut dyn Write, Format) -> Result<(), Error>) {
    let mut expected = Vec::new();
    write(&mut expected, Format::GeoJson).expect("GeoJSON");
    let expected = content(Format::GeoJson, &expected);
    for &format in LAYERS {
        let mut file = Vec::new();
        write(&mut file, format).unwrap_or_else(|error| panic!("{what} to {format}: {error}"));
        assert_eq!(content(format, &file), expected, "{what} in {format}");
    }
}

#[test]
fn cells_come_back() {
    let (points, crs) = (points(), Crs::of_epsg(25_832));
    let features = features();
    let d = Delaunay2::from_points(&points).expect("finite");
    let whole = vec![[0.0, 0.0], [15.0, 0.0], [15.0, 33.0], [0.0, 33.0]];
    let hole = vec![[2.0, 2.0], [13.0, 2.0], [13.0, 30.0], [2.0, 30.0]];
    let regions = [Region2::polygon(std::slice::from_ref(&whole)), Region2::polygon(&[whole, hole])];
    for region in regions {
        let region = region.expect("rings");
        let cells = d.voronoi().clip(&region);
        let features = Some(&features);
        let diagram = Diagram { triangulation: &d, cells: &cells, crs: Some(&crs), features };
        compare("cells", |out, format| write_diagram(out, format, &diagram, 9));
        let orders = d.order(2).expect("two of thirty");
        let cells = orders.cells(&region);
        let diagram = OrderDiagram { diagram: &orders, cells: &cells, crs: None };
        compare("regions of order 2", |out, format| write_orders(out, format, &diagram, 9));
    }
}

#[test]
fn triangles_come_back() {
    let (points, crs) = (points(), Crs::of_epsg(4326));
    let heights: Vec<f64> = points.iter().map(|p| p[0] - 7.3).collect();
    let regions: Vec<f64> = (0..100).map(|i| f64::from(i) / 8.0).collect();
    let d = Delaunay2::from_points(&points).expect("finite");
    let flat = Mesh { crs: Some(&crs), ..Mesh::new(&d, &points) };
    let (features, of) = (features(), (0..100).map(|i| (i % 4 > 0).then_some(i % 28)).collect::<Vec<_>>());
    let rows = Some(Rows { table: &features.table, of: &of });
    let high =
        Mesh { heights: Some(&heights), regions: Some(&regions), features: rows, ..Mesh::new(&d, &points) };
    for mesh in [flat, high] {
        compare("triangles", |out, format| {
            write_mesh(out, format, &mesh, &picture::Options::default()).map(|_| ())
        });
    }
    let patches = Patches {
        triangles: vec![[0, 1, 2], [3, 4, 5]],
        polygons: vec![0, 7],
        heights: Some(heights),
        points,
        crs: Some(crs),
        table: features.table,
        rows: vec![Some(3); 8],
    };
    compare("patches", |out, format| write_patches(out, format, &patches, 9).map(|_| ()));
}

#[test]
fn contours_come_back() {
    let points = points();
    let heights: Vec<f64> = points.iter().map(|p| p[0] * p[1]).collect();
    let d = Delaunay2::from_points(&points).expect("finite");
    let contours = Contours::new(&d, &heights).expect("heights");
    let levels = Levels::given(&[20.0, 40.0, 200.0]).expect("levels");
    let lines = contours.lines(&levels).expect("lines");
    let bands = contours.bands(&levels).expect("bands");
    for (lines, bands) in [(&lines[..], &[][..]), (&[], &bands), (&lines, &bands)] {
        let map = ContourMap { lines, bands, crs: None };
        compare("contours", |out, format| write_contours(out, format, &map, 9));
    }
}

#[test]
fn graphs_and_edges_come_back() {
    let points = points();
    let edges = Edges { points: &points, pairs: &[[0, 1], [7, 3]], widths: None, crs: None };
    compare("edges", |out, format| write_edges(out, format, &edges));
    let z = Some(points.iter().map(|p| p[1]).collect());
    let graph = Graph {
        cloud: Cloud { xy: points[..9].to_vec(), z, ..Cloud::default() },
        segments: vec![[0, 1], [1, 2], [2, 0], [3, 4], [4, 5], [6, 7]],
        is_border: vec![true, true, true, false, false, false],
        rings: vec![GraphRing { polygon: 0, ring: 0, segments: 0..3 }],
        ..Graph::default()
    };
    compare("a graph", |out, format| write_graph(out, format, &graph));
    let lines = Graph { rings: Vec::new(), segments: graph.segments[3..].to_vec(), ..graph };
    compare("lines", |out, format| write_graph(out, format, &lines));
    compare("nothing", |out, format| write_graph(out, format, &Graph::default()));
}

#[test]
fn answers_come_back() {
    let (points, features, crs) = (points(), features(), Crs::of_epsg(25_832));
    let names = ["nearest".to_owned(), "name".to_owned()];
    let indices: Vec<i64> = (-1..59).collect();
    let numbers: Vec<f64> = (0..60).map(|i| if i == 7 { f64::NAN } else { f64::from(i) / 4.0 }).collect();
    for found in [Found::Indices(&indices), Found::Numbers(&numbers)] {
        let answers =
            Answers { queries: &points, features: &features, crs: Some(&crs), names: &names, found };
        compare("answers", |out, format| write_answers(out, format, &answers));
    }
}

/// Points have a feature each, which one geometry of GeoJSON has not.
#[test]
fn points_come_back() {
    let solid = [[1.0, 2.0, 3.0], [-0.0, 1e-300, 4.5]];
    for &format in LAYERS {
        for contents in [Contents::Points, Contents::Cells, Contents::Lines] {
            assert!(format.holds(contents, Direction::Written));
        }
        let mut file = Vec::new();
        write_points(&mut file, format, &solid).expect("written");
        let cloud =
            read_points(Box::new(Cursor::new(file)), format, &ReadOptions::default()).expect("points");
        assert_eq!((cloud.xy, cloud.z), (vec![[1.0, 2.0], [-0.0, 1e-300]], Some(vec![3.0, 4.5])));
        let mut file = Vec::new();
        write_points::<2>(&mut file, format, &[]).expect("written");
        let cloud =
            read_points(Box::new(Cursor::new(file)), format, &ReadOptions::default()).expect("no points");
        assert!(cloud.xy.is_empty());
    }
}

/// A system that has no number is in the file by its definition.
#[test]
fn systems_come_back() {
    let text = "COMPD_CS[\"both\",PROJCS[\"ours\",GEOGCS[\"theirs\"],AUTHORITY[\"EPSG\",\"25832\"]],VERT_CS[\"up\",AUTHORITY[\"EPSG\",\"7837\"]]]";
    let local = "PROJCS[\"ours\",GEOGCS[\"theirs\"],UNIT[\"metre\",1]]";
    for crs in [Crs::of_wkt(text), Crs::of_wkt(local), Some(Crs::of_epsg(3857)), None] {
        let graph = Graph {
            cloud: Cloud { xy: vec![[1.0, 2.0]], crs: crs.clone(), ..Cloud::default() },
            ..Graph::default()
        };
        for &format in LAYERS {
            let mut file = Vec::new();
            write_graph(&mut file, format, &graph).expect("written");
            let back = read_points(Box::new(Cursor::new(file)), format, &ReadOptions::default());
            assert_eq!(back.expect("a point").crs, crs, "{format}");
        }
    }
}
