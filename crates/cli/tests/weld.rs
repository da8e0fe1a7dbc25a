//! `--weld`: what nearly touches is one, and what that did is told.

use crate::place::{Place, text};

/// Two squares that share a side but for a gap of 1e-9, the right one with a corner in the middle of that side.
const GAP: &str = "POLYGON ((0 0, 1 0, 1 2, 0 2, 0 0))\nPOLYGON ((1.000000001 0, 2 0, 2 1, 1.000000001 1, 1.000000001 0))\n";

fn stats(place: &Place) -> serde_json::Value {
    serde_json::from_slice(&std::fs::read(place.path("s.json")).expect("statistics")).expect("JSON")
}

#[test]
fn outlines_that_nearly_touch_are_one() {
    let place = Place::new();
    place.file("gap.wkt", GAP);
    for command in ["triangulate", "mesh --min-angle 25", "polygons"] {
        let output = place.run(&format!("{command} gap.wkt --weld 1e-6 -o t.obj --stats s.json"));
        let told = text(&output.stderr);
        assert!(output.status.success(), "{told}");
        assert!(told.contains("note: welded: points moved by up to 0.0000000010000000"), "{told}");
        assert!(told.contains(": 1, groups: 1, vertices that joined a segment: 1, "), "{told}");
        let weld = &stats(&place)["weld"];
        assert_eq!((&weld["groups"], &weld["bends"]), (&serde_json::json!([[1, 4]]), &1.into()));
        assert!(weld["largest_move"].as_f64().expect("a length") < 1.1e-9);
    }
    // No triangle in the gap, and none thin.
    place.succeed("mesh gap.wkt --weld 1e-6 --min-angle 25 -o t.npy --stats s.json");
    assert!(stats(&place)["smallest_angle"].as_f64().expect("an angle") >= 25.0);
    assert!(stats(&place)["vertices"].as_u64().expect("a count") < 30);
}

/// Indices, markers and arcs are those of the input.
#[test]
fn what_segments_have_stays() {
    let place = Place::new();
    let poly = "5 2 0 0\n1 0 0\n2 4 0\n3 4 4\n4 0 4\n5 2 1e-9\n4 1\n1 1 2 7\n2 2 3 8\n3 3 4 9\n4 4 1 9\n0\n";
    place.file("p.poly", poly);
    place.succeed("triangulate p.poly --weld 1e-6 -o t.poly -o t.ele");
    let written = std::fs::read_to_string(place.path("t.poly")).expect("segments");
    assert_eq!(written.lines().filter(|line| line.trim_end().ends_with(" 7")).count(), 2, "{written}");
    assert!(
        written.contains("2 0.000000001") || written.contains("1e-9"),
        "vertices stay for segments: {written}"
    );
}

#[test]
fn what_goes_is_told() {
    let place = Place::new();
    let hole = "POLYGON ((0 0, 9 0, 9 9, 0 9, 0 0), (4 4, 4.001 4, 4.001 4.001, 4 4))\nPOLYGON ((20 0, 29 0, 29 0.001, 20 0))\n";
    place.file("h.wkt", hole);
    for command in ["triangulate", "mesh", "polygons"] {
        let output = place.run(&format!("{command} h.wkt --weld 0.01 -o t.ply"));
        let told = text(&output.stderr);
        assert!(output.status.success(), "{told}");
        assert!(told.contains("note: polygon 0, ring 1 is a hole that closed"), "{told}");
        assert!(told.contains("note: polygon 1, ring 0 has no area left"), "{told}");
    }
    place.file("all.wkt", hole);
    assert!(place.run("mesh all.wkt --weld 1e6 -o t.ply").status.code() != Some(101));
    place.fail("mesh h.wkt --weld -1 -o t.ply", 2, "--weld");
    place.fail("mesh h.wkt --weld nan -o t.ply", 2, "it is no length");
}

#[test]
fn sites_and_points_are_joined() {
    let place = Place::new();
    place.file("p.csv", "x,y\n0,0\n4,0\n4,4\n0,4\n4.000001,4\n");
    place.succeed("voronoi p.csv --weld 0.001 -o cells.geojson --stats s.json");
    assert_eq!(stats(&place)["cells"], 4);
    place.succeed("triangulate p.csv --weld 0.001 -o t.npy --stats s.json");
    assert_eq!(stats(&place)["simplices"], 2);
    place.fail(
        "voronoi p.csv --weld 0.001 --periodic 5,5 -o c.geojson",
        2,
        "--weld is for points in the plane",
    );
    place.file("t.csv", "0,1,2\n");
    place.fail(
        "mesh p.csv --refine t.csv --weld 0.001 -o t.ply",
        2,
        "--weld is not for triangles that are refined",
    );
}

/// Lines and polygons keep their own attributes where they start at a vertex of another one.
#[test]
fn attributes_stay_with_their_features() {
    let place = Place::new();
    let feature = |name: &str, kind: &str, corners: &str| {
        format!(
            r#"{{"type":"Feature","properties":{{"n":"{name}"}},"geometry":{{"type":"{kind}","coordinates":{corners}}}}}"#
        )
    };
    let left = feature("left", "Polygon", "[[[0,0],[1,0],[1,2],[0,2],[0,0]]]");
    let right = feature("right", "Polygon", "[[[1.00000001,0],[2,0],[2,2],[1.00000001,2],[1.00000001,0]]]");
    place.file("p.geojson", format!(r#"{{"type":"FeatureCollection","features":[{left},{right}]}}"#));
    for command in ["triangulate", "mesh", "polygons"] {
        place.succeed(&format!("-q {command} p.geojson --weld 1e-6 -o t.geojson"));
        let written = std::fs::read_to_string(place.path("t.geojson")).expect("features");
        let counts = ["left", "right"].map(|name| written.matches(&format!("\"{name}\"")).count());
        assert_eq!(counts, [2, 2], "{command}: {written}");
    }
}

/// The warning names the segments, the place and the option, and the option helps.
#[test]
fn a_gap_that_is_too_narrow_is_told() {
    let place = Place::new();
    place.file(
        "p.poly",
        "6 2 0 0\n1 0 0\n2 4 0\n3 4 4\n4 0 4\n5 2 1e-7\n6 2 3\n5 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n5 5 6\n0\n",
    );
    let output = place.run("mesh p.poly --min-angle 20 --max-vertices 100 -o t.obj");
    let told = text(&output.stderr);
    assert!(output.status.success(), "{told}");
    assert!(
        told.contains("warning: segments 0 and 4 are 0.0000001 apart near (2, 0.0000001): ")
            && told.contains("; --weld 1e-6 joins"),
        "{told}"
    );
    let output = place.run("mesh p.poly --min-angle 20 --weld 1e-6 -o t.obj");
    let told = text(&output.stderr);
    assert!(output.status.success() && !told.contains("warning"), "{told}");
    let output = place.run("mesh p.poly --min-angle 20 --min-edge 0.1 -o t.obj --stats s.json");
    let told = text(&output.stderr);
    assert!(output.status.success() && told.contains(" no shorter edges allowed"), "{told}");
    assert!(stats(&place)["left"]["short"].as_u64().expect("a count") > 0);
    assert!(stats(&place)["points"].as_u64().expect("a count") < 500);
}

/// Points that became another one are no lone points of the input.
#[test]
fn welded_points_are_not_told_as_left_out() {
    let place = Place::new();
    let square = |x: f64, name: &str| {
        format!(
            r#"{{"type":"Feature","properties":{{"m":"{name}"}},"geometry":{{"type":"Polygon","coordinates":[[[{x},0],[{0},0],[{0},1],[{x},1],[{x},0]]]}}}}"#,
            x + 1.0
        )
    };
    let two = [square(0.0, "a"), square(1.000_000_1, "b")].join(",");
    place.file("two.geojson", format!(r#"{{"type":"FeatureCollection","features":[{two}]}}"#));
    for command in ["polygons", "mesh", "triangulate", "voronoi --of areas"] {
        let output = place.run(&format!("{command} two.geojson --strict --weld 1e-6 -o o.geojson"));
        assert!(output.status.success(), "{command}: {}", text(&output.stderr));
        assert!(!text(&output.stderr).contains("are left out"), "{command}: {}", text(&output.stderr));
    }
}
