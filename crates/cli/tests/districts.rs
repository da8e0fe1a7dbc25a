//! `voronoi --of lines|areas`: cells of what is no point.

use serde_json::Value;

use crate::place::{Place, text};

const ROADS: &str = r#"{"type":"FeatureCollection","features":[
{"type":"Feature","properties":{"name":"north"},"geometry":{"type":"LineString","coordinates":[[0,3],[4,3]]}},
{"type":"Feature","properties":{"name":"south"},"geometry":{"type":"MultiLineString","coordinates":[[[0,1],[2,1]],[[2,1],[4,1]]]}},
{"type":"Feature","properties":{"name":"mast"},"geometry":{"type":"Point","coordinates":[9,9]}}]}"#;

fn json(place: &Place, name: &str) -> Value {
    serde_json::from_slice(&std::fs::read(place.path(name)).expect("a file")).expect("JSON")
}

#[test]
fn roads_have_cells_with_their_attributes() {
    let place = Place::new();
    place.file("roads.geojson", ROADS);
    let output = place.run(
        "voronoi roads.geojson --of lines --tolerance 0.01 --box 0,0,4,4 -o c.geojson -o c.csv -o c.svg -o c.gpkg --sites s.npy --stats s.json",
    );
    let told = text(&output.stderr);
    assert!(output.status.success() && told.contains("points without a line are left out"), "{told}");
    let cells = json(&place, "c.geojson");
    let features = cells["features"].as_array().expect("features");
    let of = |k: usize, name: &str| features[k]["properties"][name].clone();
    assert_eq!((features.len(), of(0, "name"), of(1, "name")), (2, "north".into(), "south".into()));
    assert_eq!(of(0, "site"), 0);
    // A border of 4 is off by the tolerance at most.
    assert!([0, 1].iter().all(|&k| (of(k, "area").as_f64().expect("an area") - 8.0).abs() <= 0.04));
    let stats = json(&place, "s.json");
    assert_eq!((&stats["lines"], &stats["tolerance"]), (&2.into(), &0.01.into()));
    assert!(
        stats["sites"].as_u64().expect("a count") >= 4
            && stats["deviation"].as_f64().expect("a length") <= 0.01
    );
}

/// Without attributes a chain is a line, and a polygon is one with its holes.
#[test]
fn what_has_no_attributes_is_counted() {
    let place = Place::new();
    place.file("a.wkt", "LINESTRING (0 0, 1 0, 2 0)\nLINESTRING (0 2, 2 2)\nPOLYGON ((3 0, 4 0, 4 2, 3 2, 3 0), (3.2 0.5, 3.8 0.5, 3.8 1.5, 3.2 1.5, 3.2 0.5))\n");
    place.succeed("voronoi a.wkt --of lines -o c.geojson");
    let count = |name: &str| json(&place, name)["features"].as_array().expect("features").len();
    assert_eq!(count("c.geojson"), 3);
    let output = place.run("voronoi a.wkt --of areas --box 0,0,5,2 -o c.geojson");
    assert!(
        text(&output.stderr).contains("lines are left out: they are no areas"),
        "{}",
        text(&output.stderr)
    );
    assert_eq!(count("c.geojson"), 1);
}

#[test]
fn areas_may_share_sides_and_overlap() {
    let place = Place::new();
    let square =
        |x: f64, size: f64| format!("POLYGON (({x} 0, {0} 0, {0} {size}, {x} {size}, {x} 0))\n", x + size);
    for (other, expected) in [
        (square(1.0, 2.0), ""),
        (square(0.5, 0.25), "areas overlap in 1 places, such as 0 and 1"),
        (square(0.5, 2.0), "areas overlap in 1 places, such as 0 and 1"),
        (
            "POLYGON ((0.2 0.2, 0.4 0.2, 0.4 0.4, 0.2 0.2))\n".to_owned(),
            "areas overlap in 1 places, such as 0 and 1",
        ),
    ] {
        place.file("a.wkt", square(0.0, 1.0) + &other);
        let output = place.run("voronoi a.wkt --of areas --box 0,0,3,3 -o c.geojson");
        let told = text(&output.stderr);
        assert!(output.status.success() && told.contains(expected), "{told}");
        assert_eq!(told.contains("overlap"), !expected.is_empty(), "{told}");
        let area =
            |k: usize| json(&place, "c.geojson")["features"][k]["properties"]["area"].as_f64().unwrap_or(0.0);
        assert!(area(0) >= 1.0 && (area(0) + area(1) - 9.0).abs() < 1e-9, "{} {}", area(0), area(1));
        place.succeed("voronoi a.wkt --of lines --tolerance 0.05 -o c.geojson");
    }
    // In a hole there is room.
    place.file("a.wkt", "POLYGON ((0 0, 4 0, 4 4, 0 4, 0 0), (1 1, 3 1, 3 3, 1 3, 1 1))\nPOLYGON ((1.8 1.8, 2.2 1.8, 2.2 2.2, 1.8 2.2, 1.8 1.8))\n");
    place.succeed("voronoi a.wkt --of areas --tolerance 0.001 -o c.geojson");
    let inner = json(&place, "c.geojson")["features"][1]["properties"]["area"].as_f64().expect("an area");
    // A square of 1.2 with corners that parabolas cut.
    assert!((1.35..1.4).contains(&inner), "{inner}");
}

/// Whether a ring is a hole is no matter of its area, which may be too small for a number.
#[test]
fn tiny_cells_are_written() {
    let place = Place::new();
    let square = |x: i32, y: i32| {
        format!(
            "POLYGON (({x}e-200 {y}e-200, {0}e-200 {y}e-200, {0}e-200 {1}e-200, {x}e-200 {1}e-200, {x}e-200 {y}e-200))\n",
            x + 1,
            y + 1
        )
    };
    place.file("a.wkt", (0..9).map(|k| square(k / 6, k % 6)).collect::<String>());
    place.succeed(
        "voronoi a.wkt --of areas --tolerance 1e-202 --box=-1e-200,-1e-200,7e-200,7e-200 -o c.geojson",
    );
    let cells = json(&place, "c.geojson");
    let features = cells["features"].as_array().expect("features");
    assert!(features.len() == 9 && features.iter().all(|feature| !feature["geometry"].is_null()));
}

#[test]
fn what_is_for_points_is_refused() {
    let place = Place::new();
    place.file("roads.geojson", ROADS);
    for more in ["--order 2", "--relax 3", "--merge auto", "--dim 3", "--areas equal"] {
        let output = place.run(&format!("voronoi roads.geojson --of lines {more} -o c.geojson"));
        assert_eq!(output.status.code(), Some(2), "{more}: {}", text(&output.stderr));
    }
    let output = place.run("voronoi roads.geojson --of lines --tolerance -1 -o c.geojson");
    assert_eq!(output.status.code(), Some(2), "{}", text(&output.stderr));
    place.file("points.csv", "x,y\n0,0\n1,1\n");
    let output = place.run("voronoi points.csv --of lines -o c.geojson");
    assert!(output.status.code() == Some(1) && text(&output.stderr).contains("there is no line in it"));
}

/// A bar of 8 by 2: a line of 6 in its middle, and four branches into corners.
#[test]
fn a_medial_axis_has_widths() {
    let place = Place::new();
    place.file("bar.wkt", "POLYGON ((0 0, 8 0, 8 2, 0 2, 0 0))\n");
    let options = "--tolerance 0.001 -o a.geojson -o a.csv -o a.fgb -o a.gpkg -o a.npy --stats s.json";
    place.succeed(&format!("voronoi bar.wkt --medial-axis {options}"));
    let axis = json(&place, "a.geojson");
    let (mut middle, mut branches) = (0.0, 0.0);
    for feature in axis["features"].as_array().expect("features") {
        let number = |name: &str| feature["properties"][name].as_f64().expect("a number");
        let corner =
            |k: usize, axis: usize| feature["geometry"]["coordinates"][k][axis].as_f64().expect("a number");
        let at = [0, 1].map(|axis| 0.5 * (corner(0, axis) + corner(1, axis)));
        // The distance from the border of the bar.
        let distance = at[0].min(8.0 - at[0]).min(at[1]).min(2.0 - at[1]);
        assert!((number("width") - 2.0 * distance).abs() < 0.004, "{feature}");
        *(if (1.01..6.99).contains(&at[0]) { &mut middle } else { &mut branches }) += number("length");
    }
    assert!(
        (middle - 6.0).abs() < 0.1 && (branches - 4.0 * 2.0_f64.sqrt()).abs() < 0.1,
        "{middle} {branches}"
    );
    let text_of = std::fs::read_to_string(place.path("a.csv")).expect("text");
    assert!(text_of.starts_with("from,to,length,width\n"), "{text_of}");
    assert!(json(&place, "s.json")["deviation"].as_f64().expect("a length") <= 0.001);
    // Right corners are seen under 90 degrees.
    place.succeed("voronoi bar.wkt --medial-axis=100 --tolerance 0.001 -o a.geojson --stats s.json");
    assert!((json(&place, "s.json")["length"].as_f64().expect("a length") - 6.0).abs() < 0.1);
    for (more, status) in [("--of lines", 2), ("--clip hull", 2), ("--order 2", 2), ("--medial-axis=181", 2)]
    {
        let axis = if more.contains("axis") { "" } else { "--medial-axis" };
        let output = place.run(&format!("voronoi bar.wkt {axis} {more} -o b.geojson"));
        assert_eq!(output.status.code(), Some(status), "{more}: {}", text(&output.stderr));
    }
    place.file("point.wkt", "POLYGON ((1 1, 1 1, 1 1, 1 1))\n");
    place.succeed("voronoi point.wkt --medial-axis -o a.geojson");
    assert_eq!(json(&place, "a.geojson")["features"].as_array().expect("features").len(), 0);
}
