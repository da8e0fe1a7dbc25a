//! Attributes go with their features from file to file, and what is left out is said.

use std::fs;

use serde_json::Value;

use crate::place::{Place, text};

const TOWNS: &str = "id,name,x,y,elevation,site\n007,\"A, town\",0,0,1.5,s1\n12,B,10,0,2,s2\n3,,5,8,,s3\n";

/// The properties of a file's features.
fn properties(place: &Place, name: &str) -> Vec<Value> {
    let all: Value = serde_json::from_str(&place.read(name)).expect("JSON");
    all["features"]
        .as_array()
        .expect("features")
        .iter()
        .map(|feature| feature["properties"].clone())
        .collect()
}

#[test]
fn sites_hand_them_to_their_cells() {
    let place = Place::new();
    place.file("t.csv", TOWNS.replace(",,s3", ",3,s3"));
    place.succeed("-q voronoi t.csv -o c.geojson -o c.csv");
    let cells = properties(&place, "c.geojson");
    let expected = serde_json::json!(
        {"site": 0, "area": cells[0]["area"], "id": "007", "name": "A, town", "elevation": 1.5, "site_2": "s1"}
    );
    assert_eq!(cells[0], expected);
    assert_eq!((&cells[2]["name"], &cells[2]["id"]), (&Value::Null, &Value::from("3")));
    let table = place.read("c.csv");
    let lines: Vec<&str> = table.lines().collect();
    assert_eq!(lines[0], "site,area,id,name,elevation,site_2,wkt");
    assert!(lines[1].contains(",007,\"A, town\",1.5,s1,\"POLYGON (("), "{}", lines[1]);
    // What was written is read again: polygons with all of that.
    place.succeed("-q polygons c.csv -o p.geojson");
    assert_eq!(properties(&place, "p.geojson")[0]["name"], "A, town");
    // With weights too; and the heights of GeoJSON.
    place.file(
        "s.geojson",
        r#"{"type":"FeatureCollection","features":[
{"type":"Feature","properties":{"n":1},"geometry":{"type":"Point","coordinates":[0,0,7]}},
{"type":"Feature","properties":{"n":2},"geometry":{"type":"Point","coordinates":[4,0,8]}},
{"type":"Feature","properties":{"n":3},"geometry":{"type":"Point","coordinates":[0,4,9]}}]}"#,
    );
    place.succeed("-q voronoi s.geojson --areas equal -o w.geojson");
    let cells = properties(&place, "w.geojson");
    assert_eq!((&cells[2]["n"], &cells[2]["z"]), (&Value::from(3), &Value::from(9.0)));
}

#[test]
fn what_is_left_out_is_said() {
    let place = Place::new();
    place.file("t.csv", TOWNS.replace(",,s3", ",3,s3"));
    let output = place.run("voronoi t.csv -o c.wkt -o c.geojson");
    let said = text(&output.stderr);
    assert!(
        said.contains("note: c.wkt: the attributes of the input are left out: id, name, elevation, site"),
        "{said}"
    );
    assert!(!said.contains("c.geojson: the attributes"), "{said}");
    place.fail("-q --strict voronoi t.csv -o d.wkt", 1, "the attributes of the input are left out");
    assert!(!place.path("d.wkt").exists());
    place.succeed("--strict voronoi t.csv -o d.geojson");
    // Indices tell which point is which.
    let output = place.run("triangulate t.csv -o t.npy -o t.ply");
    let said = text(&output.stderr);
    assert!(said.contains("t.ply: the attributes") && !said.contains("t.npy: the attributes"), "{said}");
    // Of sites at one place one has a cell.
    place.file("twice.csv", "x,y,n\n0,0,1\n4,0,2\n0,4,3\n0,4,4\n");
    let output = place.run("voronoi twice.csv -o c.geojson");
    assert!(text(&output.stderr).contains("sites that equal an earlier one are left out: 1"));
    place.fail("-q --strict voronoi twice.csv -o d.csv", 1, "sites that equal an earlier one");
}

#[test]
fn attributes_of_lines_and_points_that_triangles_do_not_have_are_said() {
    let place = Place::new();
    let line = |name: &str, way: &str| {
        format!(
            r#"{{"type":"Feature","properties":{{"name":"{name}"}},"geometry":{{"type":"LineString","coordinates":{way}}}}}"#
        )
    };
    let file = |features: &[String]| {
        format!(r#"{{"type":"FeatureCollection","features":[{}]}}"#, features.join(","))
    };
    let mut features = vec![line("high", "[[0,0],[10,1],[20,0]]"), line("low", "[[0,5],[20,6]]")];
    place.file("roads.geojson", file(&features));
    for command in ["triangulate", "mesh --max-area 9"] {
        let said =
            text(&place.run(&format!("{command} roads.geojson -o r.geojson -o r.fgb -o r.gpkg")).stderr);
        for name in ["r.geojson", "r.fgb"] {
            assert!(
                said.contains(&format!("note: {name}: the attributes of lines are left out: name")),
                "{said}"
            );
        }
        assert!(!said.contains("r.gpkg:"), "{said}");
        place.succeed(&format!("-q {command} roads.geojson -o s.gpkg"));
    }
    place.fail("-q --strict triangulate roads.geojson -o s.geojson", 1, "of lines are left out");
    place.succeed("--strict triangulate roads.geojson -o t.gpkg");
    let point =
        r#"{"type":"Feature","properties":{"name":"here"},"geometry":{"type":"Point","coordinates":[3,3]}}"#;
    features.push(point.to_owned());
    place.file("more.geojson", file(&features));
    place.fail("-q --strict triangulate more.geojson -o u.gpkg", 1, "of points are left out: name");
}

/// A file of features with a column `k`, by the kind and coordinates of each; a kind alone has no geometry.
fn kinds(features: &[(&str, &str)]) -> String {
    let one = |(i, (kind, coordinates)): (usize, &(&str, &str))| {
        let geometry = format!(r#"{{"type":"{kind}","coordinates":{coordinates}}}"#);
        let geometry = if coordinates.is_empty() { "null" } else { &geometry };
        format!(r#"{{"type":"Feature","properties":{{"k":{i}}},"geometry":{geometry}}}"#)
    };
    let all: Vec<String> = features.iter().enumerate().map(one).collect();
    format!(r#"{{"type":"FeatureCollection","features":[{}]}}"#, all.join(","))
}

const SQUARE: (&str, &str) = ("Polygon", "[[[0,0],[9,0],[9,9],[0,9],[0,0]]]");
const INNER: (&str, &str) = ("Polygon", "[[[2,2],[4,2],[4,4],[2,4],[2,2]]]");

#[test]
fn features_that_the_triangles_hide_are_told() {
    let place = Place::new();
    let line = ("LineString", "[[0,0],[9,9]]");
    for (features, whose) in [
        // A hole, and what a later one covers.
        (vec![SQUARE, INNER], "polygons without a triangle"),
        (vec![INNER, SQUARE], "polygons without a triangle"),
        (vec![SQUARE, ("LineString", "[[20,0],[30,5]]")], "lines without an edge"),
        (vec![SQUARE, line, line], "lines without an edge"),
        (vec![INNER, SQUARE, ("Point", "[1,5]")], "polygons without a triangle, of points"),
    ] {
        place.file("h.geojson", kinds(&features));
        for command in ["triangulate", "mesh --max-area 9"] {
            let what = format!("the attributes of {whose} are left out: k");
            place.fail(&format!("-q --strict {command} h.geojson -o h.gpkg"), 1, &what);
            assert!(!place.path("h.gpkg").exists());
        }
    }
    place.file("h.geojson", kinds(&[SQUARE, line, ("LineString", "[[20,0],[9,9],[0,9]]")]));
    place.succeed("-q --strict triangulate h.geojson -o h.gpkg");
    place.file("h.geojson", kinds(&[SQUARE, ("Point", "[1,5]")]));
    place.fail("-q --strict polygons h.geojson -o h.geojsonl --to geojson", 1, "points are left out");
}

#[test]
fn features_without_geometry_are_told() {
    let place = Place::new();
    let points = [("Point", "[0,0]"), ("Point", ""), ("Point", "[4,1]"), ("LineString", "[]"), SQUARE];
    place.file("e.geojson", kinds(&points));
    place.file(
        "e.csv",
        "k,wkt\n0,POINT (0 0)\n1,POINT EMPTY\n2,POINT (4 1)\n3,POLYGON EMPTY\n4,POINT (5 6)\n",
    );
    place.file("e.wkt", "POINT (0 0)\nPOINT EMPTY\nPOINT (4 1)\nPOINT (5 6)\nLINESTRING EMPTY\n");
    place.file("cells.csv", "x,y\n0,0\n1,0\n0,1\n9,9\n");
    for name in ["e.geojson", "e.csv", "e.wkt"] {
        for line in ["voronoi", "triangulate", "nearest cells.csv --queries"] {
            let what = format!("{name}: 2 features without geometry are left out");
            let output = if line == "triangulate" { "o.npy" } else { "o.csv" };
            place.fail(&format!("-q --strict {line} {name} -o {output}"), 1, &what);
            assert!(!place.path(output).exists());
        }
    }
    // Cells that are clipped away have none, in all formats of layers.
    place.file("clip.geojson", kinds(&[INNER]));
    place.succeed("-q voronoi cells.csv --clip clip.geojson -o c.gpkg -o c.fgb -o c.geojson");
    for name in ["c.gpkg", "c.fgb", "c.geojson"] {
        place.fail(&format!("-q --strict voronoi {name} -o p.csv"), 1, "2 features without geometry");
    }
}

const MATERIALS: &str = r#"{"type":"FeatureCollection","features":[
{"type":"Feature","properties":{"material":"clay"},"geometry":{"type":"Polygon","coordinates":[[[0,0],[2,0],[2,2],[0,2],[0,0]]]}},
{"type":"Feature","properties":{"material":"sand"},"geometry":{"type":"MultiPolygon","coordinates":[[[[2,0],[5,0],[5,2],[2,2],[2,0]]],[[[7,0],[8,0],[7,1],[7,0]]]]}}]}"#;

#[test]
fn polygons_are_regions() {
    let place = Place::new();
    place.file("m.geojson", MATERIALS);
    for command in ["triangulate m.geojson", "mesh m.geojson --max-area 0.25 --check"] {
        place.succeed(&format!("-q {command} -o t.geojson -o t.msh -o t.vtu -o t.inp -o t.ele -o t.ply"));
        let triangles = properties(&place, "t.geojson");
        assert!(triangles.len() >= 5);
        for triangle in &triangles {
            let region = if triangle["material"] == "clay" { 1.0 } else { 2.0 };
            assert_eq!(triangle["region"], region, "{triangle}");
        }
        let of_clay = triangles.iter().filter(|triangle| triangle["material"] == "clay").count();
        let inp = place.read("t.inp");
        assert!(inp.contains("ELSET=region_1") && inp.contains("ELSET=region_2"), "{inp}");
        let ele = place.read("t.ele");
        assert_eq!(ele.lines().skip(1).filter(|line| line.ends_with(" 1.0")).count(), of_clay, "{ele}");
    }
    // A single polygon is no region among others, but has its attributes.
    let (clay, _) = MATERIALS.rsplit_once(",\n").expect("two features");
    place.file("one.geojson", format!("{clay}]}}"));
    place.succeed("-q triangulate one.geojson -o t.geojson");
    let triangles = properties(&place, "t.geojson");
    assert_eq!((&triangles[0]["material"], &triangles[0]["region"]), (&Value::from("clay"), &Value::Null));
    // Well-known text has no attributes; its geometries are regions.
    place.file("two.wkt", "POLYGON ((0 0, 2 0, 2 2, 0 0))\nPOLYGON ((2 0, 4 0, 4 2, 2 0))\n");
    place.succeed("-q triangulate two.wkt -o t.geojson");
    let regions: Vec<Value> =
        properties(&place, "t.geojson").iter().map(|all| all["region"].clone()).collect();
    assert!(regions.contains(&Value::from(1.0)) && regions.contains(&Value::from(2.0)), "{regions:?}");
}

/// Grids of VTK have arrays of numbers: what is none of these is told.
#[test]
fn grids_have_numbers() {
    let place = Place::new();
    let numbered = MATERIALS
        .replace(
            r#""material":"clay""#,
            r#""material":"clay","density":1.75,"layer":3,"a<\"b":null,"code":9007199254740993"#,
        )
        .replace(
            r#""material":"sand""#,
            r#""material":"sand","density":null,"layer":-4,"a<\"b":2,"region":8"#,
        );
    place.file("m.geojson", numbered);
    for command in ["triangulate m.geojson", "mesh m.geojson --max-area 0.25", "polygons m.geojson"] {
        let output = place.run(&format!("{command} -o t.geojson -o t.vtu"));
        let said = text(&output.stderr);
        assert!(
            said.contains(
                "t.vtu: arrays have numbers alone: these attributes are left out: material, code\n"
            ),
            "{said}"
        );
        let triangles = properties(&place, "t.geojson");
        let grid = fs::read(place.path("t.vtu")).expect("a file");
        let head = String::from_utf8_lossy(&grid).into_owned();
        for (name, array) in [
            ("density", "density"),
            ("layer", "layer"),
            ("a<\"b", "a&lt;&quot;b"),
            ("region_2", "region_2"),
            ("region", "region"),
        ] {
            let (_, rest) =
                head.split_once(&format!("Name=\"{array}\" format=\"appended\" offset=\"")).expect(name);
            let offset: usize = rest.split('"').next().and_then(|text| text.parse().ok()).expect(name);
            let begin = b"\"raw\">\n_";
            let start =
                grid.windows(begin.len()).position(|bytes| bytes == begin).expect("data") + begin.len();
            let bytes = &grid[start + offset..];
            let (length, values) = bytes.split_at(8);
            assert_eq!(u64::from_le_bytes(length.try_into().expect("eight")), 8 * triangles.len() as u64);
            let values =
                values.chunks_exact(8).map(|bytes| f64::from_le_bytes(bytes.try_into().expect("eight")));
            for (value, triangle) in values.zip(&triangles) {
                match triangle[name].as_f64() {
                    Some(known) => assert_eq!(value, known, "{name}"),
                    None if name == "region" => {}
                    None => assert!(value.is_nan(), "{name}"),
                }
            }
        }
    }
    place.fail(
        "-q --strict triangulate m.geojson -o s.vtu",
        1,
        "these attributes are left out: material, code",
    );
    // Lines are no triangles, which have nothing of theirs.
    place.file(
        "lines.geojson",
        r#"{"type":"Feature","properties":{"k":1},"geometry":{"type":"LineString","coordinates":[[0,0],[4,0],[4,4]]}}"#,
    );
    for command in ["triangulate", "mesh"] {
        let output = place.run(&format!("{command} lines.geojson -o l.geojson -o l.vtu"));
        let said = text(&output.stderr);
        assert!(
            said.contains("l.geojson: the attributes") && said.contains("l.vtu: the attributes"),
            "{said}"
        );
    }
}

#[test]
fn queries_keep_theirs_beside_the_answers() {
    let place = Place::new();
    place.file("p.csv", "x,y,t\n0,0,1\n4,0,2\n0,4,3\n4,4,4\n");
    place.file("q.csv", "id,x,y,t\nq1,1,1,seen\n02,9,9,\"far, away\"\n");
    let table = place.succeed("-q interpolate p.csv --value t --queries q.csv --method linear -o - --to csv");
    assert_eq!(table, "x,y,id,t_2,t\n1.0,1.0,q1,seen,1.75\n9.0,9.0,02,\"far, away\",NaN\n");
    place.succeed("-q nearest p.csv --queries q.csv -o n.geojson");
    let answers = properties(&place, "n.geojson");
    assert_eq!(answers[1], serde_json::json!({"nearest": 3, "id": "02", "t": "far, away"}));
    let furthest = place.succeed("-q furthest p.csv --queries q.csv -o - --to csv");
    assert_eq!(furthest.lines().nth(1), Some("1.0,1.0,q1,seen,3"));
}

#[test]
fn two_systems_are_an_error() {
    let place = Place::new();
    let in_system = |name: &str, number: u32, geometry: &str| {
        let named = format!("urn:ogc:def:crs:EPSG::{number}");
        let crs = format!(r#""crs":{{"type":"name","properties":{{"name":"{named}"}}}}"#);
        place.file(name, format!("{{{crs},{geometry}}}"));
    };
    let points = r#""type":"MultiPoint","coordinates":[[0,0,1],[4,0,2],[0,4,3],[4,4,4]]"#;
    let area = r#""type":"Polygon","coordinates":[[[0,0],[3,0],[3,3],[0,0]]]"#;
    in_system("p.geojson", 25832, points);
    in_system("q.geojson", 25833, points);
    in_system("area.geojson", 25833, area);
    for line in [
        "voronoi p.geojson --clip area.geojson -o c.geojson",
        "nearest p.geojson --queries q.geojson -o n.csv",
        "interpolate p.geojson --queries q.geojson -o n.csv",
        "dtm p.geojson --cell 1 --clip area.geojson -o d.tif",
        "dtm p.geojson --cell 1 --breaklines area.geojson -o d.tif",
        "triangulate p.geojson area.geojson -o t.geojson",
    ] {
        place.fail(line, 1, "EPSG:25833");
    }
}

#[test]
fn systems_are_said_and_passed_on() {
    let place = Place::new();
    place.file("p.csv", "x,y,z\n0,0,1\n4,0,2\n0,4,3\n");
    let name = "urn:ogc:def:crs,crs:EPSG::25832,crs:EPSG::7837";
    for line in
        ["voronoi p.csv", "triangulate p.csv", "contours p.csv --interval 1", "nearest p.csv --queries p.csv"]
    {
        place.succeed(&format!("-q --epsg 25832+7837 {line} -o o.geojson"));
        let all: Value = serde_json::from_str(&place.read("o.geojson")).expect("JSON");
        assert_eq!(all["crs"]["properties"]["name"], name, "{line}");
    }
    // Both parts are read again.
    place.succeed("-q triangulate o.geojson -o t.geojson");
    assert!(place.read("t.geojson").contains(name));
    // What is said counts, whatever files tell.
    place.succeed("-q triangulate o.geojson --epsg EPSG:31467 -o t.geojson");
    assert!(place.read("t.geojson").contains("EPSG::31467"));
    // A definition without a number goes from file to file.
    let wkt = r#"PROJCS[\"ours\",GEOGCS[\"WGS 84\"],UNIT[\"foot\",0.3048]]"#;
    let points = r#""type":"MultiPoint","coordinates":[[0,0,1],[4,0,2],[0,4,3]]"#;
    place.file(
        "w.geojson",
        format!(r#"{{"crs":{{"type":"name","properties":{{"name":"{wkt}"}}}},{points}}}"#),
    );
    place.succeed("-q --strict voronoi w.geojson -o c.geojson");
    assert!(place.read("c.geojson").contains(wkt));
    place.succeed("-q dtm w.geojson --cell 1 -o d.asc");
    assert!(place.read("d.prj").contains("PROJCS[\"ours\""));
    for wrong in ["0", "25832+1", "abc", "1+2+3", "99999"] {
        place.fail(
            &format!("triangulate p.csv --epsg {wrong} -o t.ply"),
            2,
            "it is no number from 1024 to 32766",
        );
    }
}

/// Blanks in quotes are a text's own, and infinities are numbers where a format has them.
#[test]
fn values_are_what_they_were() {
    let place = Place::new();
    place.file("c.csv", "x,y,name\n0,0,\"  a \"\n1,0,\"  \"\n0,1,b\n");
    place.succeed("-q voronoi c.csv -o cells.csv -o cells.json");
    let table = fs::read_to_string(place.path("cells.csv")).expect("cells");
    let names: Vec<&str> = table.lines().skip(1).filter_map(|line| line.split(',').nth(2)).collect();
    assert_eq!(names, ["\"  a \"", "\"  \"", "b"]);
    place.file("i.csv", "x,y,v\n0,0,1e400\n1,0,-1e999\n0,1,2\n");
    let told = text(&place.run("voronoi i.csv -o cells.fgb -o cells.json").stderr);
    assert!(told.contains("cells.json: infinite values are null in it"), "{told}");
    let told = text(&place.run("voronoi cells.fgb -o again.csv").stderr);
    assert!(!told.contains("infinite"), "{told}");
    let again = fs::read_to_string(place.path("again.csv")).expect("cells");
    assert!(again.contains(",inf,") && again.contains(",-inf,"), "{again}");
    let cells: Value =
        serde_json::from_slice(&fs::read(place.path("cells.json")).expect("cells")).expect("JSON");
    assert_eq!([0, 2].map(|i| &cells["features"][i]["properties"]["v"]), [&Value::Null, &Value::from(2)]);
}

#[test]
fn rows_without_coordinates_go_with_theirs() {
    let place = Place::new();
    place.file("t.csv", "name,x,y\nA,0,0\nB,,\nC,4,0\nD,NA,nan\nE,0,4\n");
    place.fail("voronoi t.csv -o c.geojson", 1, "line 3");
    let output = place.run("voronoi t.csv --skip-missing -o c.geojson");
    assert!(output.status.success());
    assert!(text(&output.stderr).contains("2 rows without coordinates left out: lines 3, 5"), "{output:?}");
    let names: Vec<_> = properties(&place, "c.geojson").iter().map(|row| row["name"].clone()).collect();
    assert_eq!(names, ["A", "C", "E"]);
    // A column of numbers has those of the rows that stay.
    place.file("w.csv", "x,y,w\n0,0,1\n,,2\n4,0,1\nNA,nan,x\n0,4,9\n");
    let output = place.run("voronoi w.csv --skip-missing --weights w -o w.geojson");
    assert!(output.status.success(), "{output:?}");
    place.file("v.csv", "x,y,w\n0,0,1\n4,0,1\n0,4,9\n");
    place.succeed("-q voronoi v.csv --weights w -o v.geojson");
    assert_eq!(place.read("w.geojson"), place.read("v.geojson"));
    place.fail("voronoi w.csv --skip-missing --weights nothing -o n.geojson", 1, "nothing");
    place.file("p.ply", "ply\n");
    place.fail("info p.ply --skip-missing", 2, "--skip-missing is for text");
}
