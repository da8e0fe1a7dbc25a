//! Attributes of features are read with their points.

use std::io::Cursor;

use delone_io::{Cloud, Format, ReadOptions, Value, read_graph, read_points};

fn options() -> ReadOptions {
    ReadOptions::default().attributes(true).dimension(3)
}

fn points(format: Format, text: &str, options: &ReadOptions) -> Cloud {
    read_points(Box::new(Cursor::new(text.to_owned())), format, options).expect(text)
}

/// Names, and the cells of each point's row as JSON.
fn table(cloud: &Cloud) -> (Vec<String>, Vec<Vec<String>>) {
    let features = &cloud.features;
    let cells = |point| match features.row(point) {
        Some(row) => features.table.row(row).map(|(k, cell)| format!("{k}:{cell}")).collect(),
        None => Vec::new(),
    };
    (features.table.names().to_vec(), (0..cloud.xy.len()).map(cells).collect())
}

const CITIES: &str = r#"{"type":"FeatureCollection","features":[
{"type":"Feature","id":7,"properties":{"name":"A \"b\"","people":12345678901,"big":true},"geometry":{"type":"Point","coordinates":[1,2]}},
{"type":"Feature","properties":{"people":1.50,"list":[1,{"a":null}],"none":null},"geometry":{"type":"MultiPoint","coordinates":[[3,4],[5,6]]}},
{"type":"Feature","properties":{"name":"nowhere"},"geometry":null}]}"#;

#[test]
fn properties_of_geojson() {
    let cloud = points(Format::GeoJson, CITIES, &options());
    let (names, rows) = table(&cloud);
    assert_eq!(names, ["id", "name", "people", "big", "list", "none"]);
    assert_eq!(rows[0], ["0:7", r#"1:"A \"b\"""#, "2:12345678901", "3:true"]);
    assert_eq!(rows[1], ["2:1.5", r#"4:[1,{"a":null}]"#]);
    assert_eq!(rows[2], rows[1]);
    assert_eq!(cloud.features.table.len(), 3);
    let names_alone = points(Format::GeoJson, CITIES, &ReadOptions::default());
    assert_eq!(names_alone.features.table.names(), names);
    assert_eq!((names_alone.features.row(0), names_alone.features.table.len()), (None, 0));
}

#[test]
fn columns_of_text() {
    let text = "id,name,x,y,size\n007,\"a, b\",1,2,3.50\n12,,4,5,-1e3\n";
    let (names, rows) = table(&points(Format::Text, text, &options()));
    assert_eq!(names, ["id", "name", "size"]);
    assert_eq!(rows, [vec!["0:\"007\"", "1:\"a, b\"", "2:3.50"], vec!["0:\"12\"", "2:-1e3"]]);
    let (names, rows) = table(&points(Format::Text, "1 2 3 4\n5 6 7 8\n", &options()));
    assert_eq!(
        (names, rows),
        (vec!["field_4".to_owned()], vec![vec!["0:4".to_owned()], vec!["0:8".to_owned()]])
    );
    // In the plane heights are an attribute.
    let plane = options().dimension(2);
    let cloud = points(Format::Text, "x,y,elevation\n1,2,3\n", &plane);
    assert_eq!((table(&cloud).0, cloud.z.as_deref()), (vec!["elevation".to_owned()], Some(&[3.0][..])));
    assert_eq!(cloud.features.with_heights(&[3.0]), cloud.features);
    // R has a field more in its rows, and a row may end with a separator.
    let (names, rows) = table(&points(Format::Text, "\"x\",\"y\",\"w\"\n\"1\",2,3,4\n", &options()));
    assert_eq!((names, rows), (vec!["w".to_owned()], vec![vec!["0:4".to_owned()]]));
    let (names, rows) = table(&points(Format::Text, "x,y,w,\n2,3,4,\n", &options()));
    assert_eq!((names, rows), (vec!["w".to_owned()], vec![vec!["0:4".to_owned()]]));
}

#[test]
fn polygons_keep_theirs() {
    let text = "kind,wkt\nclay,\"POLYGON ((0 0, 4 0, 0 4, 0 0))\"\nsand,\"MULTIPOLYGON (((9 9, 10 9, 9 10, 9 9)), ((5 5, 6 5, 5 6, 5 5)))\"\n";
    let graph = read_graph(Box::new(Cursor::new(text)), Format::Text, &options(), None).expect("polygons");
    let kinds: Vec<_> = graph.rings.iter().map(|ring| graph.row_of(ring)).collect();
    assert_eq!(kinds, [Some(0), Some(1), Some(1)]);
    assert_eq!(graph.cloud.features.table.value(1, 0), Value::Text("sand"));
    let geojson = r#"{"type":"FeatureCollection","features":[{"type":"Feature","properties":{"m":1},"geometry":{"type":"Polygon","coordinates":[[[0,0],[4,0],[0,4],[0,0]]]}},
        {"type":"Feature","properties":{"m":2},"geometry":{"type":"LineString","coordinates":[[7,7],[8,8]]}}]}"#;
    let graph = read_graph(Box::new(Cursor::new(geojson)), Format::GeoJson, &options(), None).expect("both");
    assert_eq!(graph.row_of(&graph.rings[0]), Some(0));
    let rows: Vec<_> = (0..5).map(|i| graph.cloud.features.row(i)).collect();
    assert_eq!(rows, [Some(0), Some(0), Some(0), Some(1), Some(1)]);
}

#[test]
fn waypoints_and_tracks() {
    let gpx = r#"<gpx><wpt lon="1" lat="2"><name>Hut</name><ele>3</ele></wpt>
        <trk><name>Way</name><trkseg><trkpt lon="4" lat="5"/><trkpt lon="6" lat="7"/></trkseg></trk></gpx>"#;
    let graph = read_graph(Box::new(Cursor::new(gpx)), Format::Gpx, &options(), None).expect("both");
    let name = |i| graph.cloud.features.table.value(graph.cloud.features.row(i).expect("a row"), 0);
    assert_eq!([name(0), name(1), name(2)], [Value::Text("Hut"), Value::Text("Way"), Value::Text("Way")]);
}
