//! Polygons whose outside has narrow parts: what is valid is meshed.

use crate::place::{Place, text};

/// A corner lies inside of the hull by a rounding error: no number is in the bay there.
const BAY: &str =
    r#"{"type":"Polygon","coordinates":[[[0.1,0.01],[0.2,0.02],[0.3,0.03],[1.2,-0.98],[0.1,0.01]]]}"#;

/// A hole between three neighboring numbers: no number is in it.
const HOLE: &str = r#"{"type":"Polygon","coordinates":[[[0,0],[4,0],[4,4],[0,4],[0,0]],
[[1,1],[1,1.0000000000000002],[1.0000000000000002,1],[1,1]]]}"#;

/// How many triangles the last command counted.
fn triangles(place: &Place) -> u64 {
    let stats = std::fs::read(place.path("s.json")).expect("written");
    let stats: serde_json::Value = serde_json::from_slice(&stats).expect("JSON");
    stats["simplices"].as_u64().expect("a number")
}

#[test]
fn bays_without_a_number_in_them_are_outside() {
    let place = Place::new();
    place.file("bay.geojson", BAY);
    place.succeed("mesh bay.geojson --min-angle 0 --check -o bay.poly --stats s.json");
    // Four corners make two triangles; the third one of the hull is the bay.
    assert_eq!(triangles(&place), 2);
    // What is written means the same.
    place.succeed("mesh bay.poly --min-angle 0 --check -o again.npy --stats s.json");
    assert_eq!(triangles(&place), 2);
    place.succeed("mesh bay.geojson --fill nonzero --min-angle 0 -o bay.npy --stats s.json");
    assert_eq!(triangles(&place), 2);
}

#[test]
fn holes_without_a_number_in_them_stay_holes() {
    let place = Place::new();
    place.file("hole.geojson", HOLE);
    for fill in ["even-odd", "nonzero"] {
        let output = place.run(&format!("mesh hole.geojson --fill {fill} --check -o m.node -o m.ele"));
        let stderr = text(&output.stderr);
        assert!(output.status.success(), "{stderr}");
        assert!(stderr.contains("holes so narrow that no point is in them"), "{stderr}");
        // The hole has the points 4 to 6, and is no triangle.
        let triangles = std::fs::read_to_string(place.path("m.ele")).expect("written");
        let is_hole = |line: &str| {
            let row: Vec<&str> = line.split_whitespace().skip(1).take(3).collect();
            ["4", "5", "6"].iter().all(|corner| row.contains(corner))
        };
        assert!(triangles.lines().count() > 5 && !triangles.lines().skip(1).any(is_hole), "{fill}");
    }
}

/// The rows of a file of triangles, without their numbers.
fn rows(place: &Place, file: &str) -> Vec<Vec<String>> {
    let text = std::fs::read_to_string(place.path(file)).expect("written");
    let row = |line: &str| line.split_whitespace().skip(1).map(str::to_owned).collect();
    text.lines().skip(1).filter(|line| !line.starts_with('#')).map(row).collect()
}

#[test]
fn regions_and_lines_are_beside_holes_without_a_number_in_them() {
    let place = Place::new();
    let ring = "0 0 0\n1 4 0\n2 4 4\n3 0 4\n4 1 1\n5 1.0000000000000002 1\n6 1 1.0000000000000002\n";
    let segments = "0 0 1\n1 1 2\n2 2 3\n3 3 0\n4 4 5\n5 5 6\n6 6 4\n";
    place.file("r.poly", format!("7 2 0 0\n{ring}7 0\n{segments}0\n1\n0 2 2 7 0.5\n"));
    place.succeed("mesh r.poly --fill even-odd --check --stats s.json -o r.node -o r.ele");
    let with_regions = triangles(&place);
    let hole = ["4", "5", "6"];
    for row in rows(&place, "r.ele") {
        assert!(!hole.iter().all(|corner| row[..3].iter().any(|c| c == corner)), "{row:?}");
        assert_eq!(row[3], "7.0");
    }
    place.succeed("mesh r.poly --fill even-odd --max-area 0.5 --stats s.json -o plain.npy");
    assert_eq!(triangles(&place), with_regions);
    // A line is no border, though it comes back to where it began.
    let line = r#"{"type":"LineString","coordinates":[[2,2],[3,2],[3,3.5],[2,2]]}"#;
    let both = format!(r#"{{"type":"GeometryCollection","geometries":[{HOLE},{line}]}}"#);
    place.file("line.geojson", both);
    for fill in ["even-odd", "nonzero"] {
        place.succeed(&format!("mesh line.geojson --fill {fill} --check -o l.node -o l.ele"));
        let rows = rows(&place, "l.ele");
        assert!(rows.len() > 8, "{fill}");
        assert!(
            !rows.iter().any(|row| hole.iter().all(|corner| row.contains(&(*corner).to_owned()))),
            "{fill}"
        );
    }
}
