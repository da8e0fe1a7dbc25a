//! `contours` and `simplify` as a user meets them: results, exit statuses, messages.

use crate::place::{Place, data, rows, text};
use serde_json::Value;

/// A raster of a cone, 41 cells wide, with a hole in its data.
fn cone(place: &Place) {
    let mut grid =
        String::from("ncols 41\nnrows 41\nxllcorner 0\nyllcorner 0\ncellsize 2\nNODATA_value -1\n");
    for r in 0..41_i32 {
        for c in 0..41_i32 {
            let z = 40.0 - f64::from((r - 20).pow(2) + (c - 20).pow(2)).sqrt();
            grid += &if (r, c) == (3, 3) { "-1 ".to_owned() } else { format!("{z} ") };
        }
        grid += "\n";
    }
    place.file("cone.asc", grid);
}

fn features(text: &str) -> Vec<Value> {
    let json: Value = serde_json::from_str(text).expect("JSON");
    json["features"].as_array().expect("features").clone()
}

#[test]
fn a_cone_has_rings() {
    let place = Place::new();
    cone(&place);
    let found = features(&place.succeed("-q contours cone.asc --interval 5 --base 1 -o - --to geojson"));
    let closed: Vec<&Value> = found
        .iter()
        .filter(|feature| {
            let line = feature["geometry"]["coordinates"].as_array().expect("a line");
            line.first() == line.last()
        })
        .collect();
    let mut levels: Vec<f64> =
        closed.iter().map(|f| f["properties"]["elevation"].as_f64().expect("a height")).collect();
    levels.dedup();
    assert_eq!(levels, [21.0, 26.0, 31.0, 36.0]);
    assert!(found.iter().all(|feature| feature["geometry"]["type"] == "LineString"));
}

#[test]
fn bands_and_pictures_are_written() {
    let place = Place::new();
    cone(&place);
    place.succeed("contours cone.asc --levels 30,20 --bands -o b.geojson -o b.svg -o b.png --stats s.json");
    let bands = features(&std::fs::read_to_string(place.path("b.geojson")).expect("bands"));
    let bounds: Vec<[Option<f64>; 2]> =
        bands.iter().map(|band| ["lower", "upper"].map(|name| band["properties"][name].as_f64())).collect();
    assert_eq!(bounds, [[None, Some(20.0)], [Some(20.0), Some(30.0)], [Some(30.0), None]]);
    assert_eq!(bands[1]["geometry"]["coordinates"][0].as_array().expect("rings").len(), 2, "a hole");
    let stats: Value =
        serde_json::from_slice(&std::fs::read(place.path("s.json")).expect("stats")).expect("JSON");
    assert_eq!((&stats["bands"], &stats["levels"], &stats["points"]), (&3.into(), &2.into(), &1680.into()));
    assert!(std::fs::read(place.path("b.png")).expect("a picture").starts_with(b"\x89PNG"));
    assert!(std::fs::read_to_string(place.path("b.svg")).expect("a picture").contains("evenodd"));
    // Points of a cloud, from a pipe of text too.
    place.file("p.csv", "x,y,z\n0,0,0\n4,0,4\n0,4,0\n");
    let line = place.succeed("-q contours p.csv --levels 1 -o - --to geojson");
    assert!(line.contains("[[1.0,0.0],[1.0,3.0]]") || line.contains("[[1.0,3.0],[1.0,0.0]]"), "{line}");
}

#[test]
fn real_ground_has_contours_and_is_thinned() {
    let place = Place::new();
    let tile = data("autzen_trim.laz");
    let tile = tile.display();
    place.succeed(&format!("contours {tile} --class 2 --interval 5 --max-edge 100 -o c.geojson"));
    let lines = std::fs::read_to_string(place.path("c.geojson")).expect("lines");
    assert!(lines.contains("\"elevation\":410.0") && !lines.contains("\"elevation\":435.0"));
    place.succeed(&format!(
        "simplify {tile} --class 2 --max-error 2 -o t.ply -o t.npy --kept kept.csv --stats s.json"
    ));
    let stats: Value =
        serde_json::from_slice(&std::fs::read(place.path("s.json")).expect("stats")).expect("JSON");
    let (kept, error) = (stats["kept"].as_u64().expect("a number"), stats["error"].as_f64().expect("one"));
    assert!(kept < 26107 / 3 && error <= 2.0 + 1e-9, "{stats}");
    assert_eq!(stats["points"], kept);
    assert!(place.succeed("check t.ply t.npy").contains("and the canonical"));
    let kept_rows = rows(&std::fs::read_to_string(place.path("kept.csv")).expect("indices"));
    assert!(kept_rows.len() as u64 == kept && kept_rows.is_sorted());
}

#[test]
fn rasters_and_their_points_are_thinned_alike() {
    let place = Place::new();
    cone(&place);
    let kept = |line: &str| {
        place.succeed(&format!("-q simplify {line} -o m.ele --kept k.csv --stats s.json"));
        let stats = std::fs::read(place.path("s.json")).expect("stats");
        let stats: Value = serde_json::from_slice(&stats).expect("JSON");
        assert_eq!((&stats["input_points"], &stats["kept"]), (&1680.into(), &stats["points"]));
        stats["kept"].as_u64().expect("a number")
    };
    let count = kept("cone.asc --max-error 0.5");
    assert!((5..300).contains(&count), "{count}");
    assert_eq!(kept("cone.asc --points 50"), 50);
    assert_eq!(kept("cone.asc --points 50 --max-error 100"), 4);
}

#[test]
fn of_several_heights_a_rule_takes_one() {
    let place = Place::new();
    place.file("p.csv", "x,y,z\n0,0,0\n4,0,4\n0,4,0\n4,0,8\n");
    for (rule, lines) in [("", 0), ("--duplicates highest", 1), ("--duplicates mean", 1)] {
        let found = place.succeed(&format!("-q contours p.csv --levels 5 {rule} -o - --to geojson"));
        assert_eq!(features(&found).len(), lines, "{rule}");
    }
    place.succeed("simplify p.csv --max-error 0 --duplicates mean -o m.obj");
    assert!(std::fs::read_to_string(place.path("m.obj")).expect("a mesh").contains("v 4.0 0.0 6.0"));
}

#[test]
fn segments_stay_edges() {
    let place = Place::new();
    let mut table = String::from("x,y,z\n");
    (0..121).for_each(|i| table += &format!("{},{},{}\n", i % 11, i / 11, f64::from(i % 11 - 5).abs()));
    place.file("p.csv", table);
    place.file("s.csv", "24,96\n30,96\n");
    place.succeed("simplify p.csv --segments s.csv --max-error 9 -o m.poly -o m.ply --kept k.csv");
    let kept = rows(&std::fs::read_to_string(place.path("k.csv")).expect("indices"));
    assert_eq!(kept.concat(), [0, 10, 24, 30, 96, 110, 120]);
    let poly = std::fs::read_to_string(place.path("m.poly")).expect("a graph");
    assert!(poly.contains("2 4") && poly.contains("3 4"), "{poly}");
    // They may meet at a point, which stays; those that cross elsewhere are named.
    place.file("x.csv", "0,120\n10,110\n");
    place.succeed("simplify p.csv --segments x.csv --max-error 9 -o m.ply --kept k.csv");
    let kept = rows(&std::fs::read_to_string(place.path("k.csv")).expect("indices"));
    assert_eq!(kept.concat(), [0, 10, 60, 110, 120]);
    place.file("x.csv", "0,12\n1,11\n");
    place.fail("simplify p.csv --segments x.csv --max-error 1 -o m.ply", 1, "segments 0 and 1 cross");
}

#[test]
fn arrays_are_points_or_rasters() {
    let place = Place::new();
    place.file("cone.csv", "x,y,z\n0,0,0\n9,0,0\n0,9,0\n3,3,5\n");
    let mut array = b"\x93NUMPY\x01\0\x76\0".to_vec();
    array.extend(format!("{:<117}\n", "{'descr': '<f8', 'fortran_order': False, 'shape': (4, 5), }").bytes());
    (0..20).for_each(|i| array.extend(f64::from(i % 5).to_le_bytes()));
    place.file("grid.npy", &array);
    let lines = features(&place.succeed("-q contours grid.npy --levels 1.5 -o - --to geojson"));
    assert_eq!(lines.len(), 1);
    assert_eq!(place.succeed("-q simplify grid.npy --max-error 0 -o - --to ele").lines().count(), 3);
}

#[test]
fn what_is_wrong_is_said() {
    let place = Place::new();
    cone(&place);
    place.file("flat.csv", "x,y\n0,0\n4,0\n0,4\n");
    place.file("nan.csv", "x,y,z\n0,0,1\n4,0,nan\n0,4,2\n");
    for (line, status, message) in [
        ("contours cone.asc -o c.geojson", 2, "--interval"),
        ("contours cone.asc --interval 0 -o c.geojson", 2, "the interval of contours is 0"),
        ("contours cone.asc --interval 1e-9 -o c.geojson", 2, "the number of levels of contours"),
        ("contours cone.asc --levels nan -o c.geojson", 2, "a level of contours"),
        ("contours cone.asc --interval 5 -o c.ply", 2, "contours are not written to ply files"),
        ("contours cone.asc --interval 5 -o cone.asc", 2, "would overwrite"),
        ("contours flat.csv --interval 5 -o c.geojson", 1, "the points have no heights"),
        ("contours nan.csv --interval 5 -o c.geojson", 1, "point 1 has the height NaN"),
        ("contours none.csv --interval 5 -o c.geojson", 1, "none.csv"),
        ("simplify cone.asc -o m.ply", 2, "--max-error"),
        ("simplify cone.asc --max-error -1 -o m.ply", 2, "--max-error"),
        ("simplify cone.asc --max-error nan -o m.ply", 2, "--max-error takes a height"),
        ("simplify cone.asc --max-error 1 -o m.geotiff", 2, "no format has this extension"),
        ("simplify cone.asc --max-error 1 -o m.laz", 2, "triangles are not written to las files"),
        ("simplify cone.asc --max-error 1 -o m.ply --kept m.ply", 2, "would overwrite"),
        (
            "simplify cone.asc --max-error 1 -o m.ply --kept k.ply",
            2,
            "rows of indices are not written to ply files",
        ),
        ("simplify flat.csv --max-error 1 -o m.ply", 1, "the points have no heights"),
        ("simplify nan.csv --max-error 1 -o m.ply", 1, "point 1 has the height NaN"),
    ] {
        place.fail(line, status, message);
    }
    for command in ["contours", "simplify"] {
        assert!(place.succeed(&format!("{command} --help")).contains("Examples:"), "{command}");
    }
    // What spans no triangle has no contours, and stays whole.
    place.file("line.csv", "x,y,z\n0,0,1\n1,1,5\n2,2,3\n");
    assert_eq!(features(&place.succeed("-q contours line.csv --levels 2 -o - --to geojson")).len(), 0);
    let output = place.run("simplify line.csv --max-error 9 -o m.ply");
    assert!(output.status.success() && text(&output.stderr).contains("3 of 3 points are left"));
}

#[test]
fn rasters_are_read_as_points_by_all_commands() {
    let place = Place::new();
    cone(&place);
    let output = place.run("triangulate cone.asc -o cone.ply --check");
    assert!(output.status.success() && text(&output.stderr).contains("1 cells without data are left out"));
    place.file("broken.tif", b"II\x2a\0\x08\0\0\0");
    place.fail("triangulate broken.tif -o m.ply", 1, "broken.tif: ");
    place.file("broken.asc", "ncols 3\nnrows 3\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2 3\n");
    place.fail("triangulate broken.asc -o m.ply", 1, "broken.asc: the file ends after 3 of 9 values");
}

#[test]
fn places_and_numbers_that_are_none_are_named() {
    let place = Place::new();
    place.file("inf.csv", "x,y,z\n0,0,1\ninf,0,2\n0,1,3\n1,1,1\n");
    place.file("none.csv", "x,y,z\n");
    place.file("high.csv", "x,y,z\n0,0,1\n1,0,inf\n0,1,3\n");
    place.file("p.csv", "x,y,z\n0,0,1\n1,0,2\n0,1,3\n");
    let infinite = "point 1 has the x coordinate inf, which is not finite";
    for (status, arguments, part) in [
        (1, "dtm inf.csv --cell 1 -o a.npy", infinite),
        (1, "dtm inf.csv -o a.npy", infinite),
        (1, "dtm inf.csv --cell 1 --memory 64M -o a.npy", infinite),
        (1, "interpolate inf.csv --grid 1 -o a.npy", infinite),
        (1, "simplify inf.csv --max-error 1 -o a.ply", infinite),
        (1, "interpolate none.csv --grid 1 -o a.npy", "there are no points"),
        (1, "dtm high.csv --cell 1 -o a.npy", "point 1 has the height inf, which is not finite"),
        (1, "dtm high.csv --cell 1 --memory 64M -o a.npy", "point 1 has the height inf, which is not finite"),
        (2, "dtm p.csv --memory 1K -o a.npy", "--memory 1K is not enough"),
        (2, "dtm p.csv --epsg 99999999 -o a.tif", "99999999"),
        (2, "contours p.csv --interval 1e-300 -o a.geojson", "e300"),
    ] {
        place.fail(&format!("-q {arguments}"), status, part);
    }
}
