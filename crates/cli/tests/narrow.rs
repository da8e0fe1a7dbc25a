//! Polygons whose outside has narrow parts: what is valid is meshed.

use crate::place::{Place, text};

/// A corner lies inside of the hull by a rounding error: no number is in the bay there.
const BAY: &str =
    r#"{"type":"Polygon","coordinates":[[[0.1,0.01],[0.2,0.02],[0.3,0.03],[1.2,-0.98],[0.1,0.01]]]}"#;

/// A hole between three neighbouring numbers: no number is in it.
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

#[test]
fn regions_need_a_point_in_every_hole() {
    let place = Place::new();
    let ring = "0 0 0\n1 4 0\n2 4 4\n3 0 4\n4 1 1\n5 1.0000000000000002 1\n6 1 1.0000000000000002\n";
    let segments = "0 0 1\n1 1 2\n2 2 3\n3 3 0\n4 4 5\n5 5 6\n6 6 4\n";
    place.file("r.poly", format!("7 2 0 0\n{ring}7 0\n{segments}0\n1\n0 2 2 7 -1\n"));
    place.fail("mesh r.poly --fill even-odd -o r.ele", 1, "so narrow that no point is in them");
}
