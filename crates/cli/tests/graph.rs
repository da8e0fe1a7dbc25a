//! `delone graph`: what is written, of what, and what is refused.

use crate::place::{Place, rows};

/// A square, its middle twice, and a far point.
const POINTS: &str = "0,0\n2,0\n2,2\n0,2\n1,1\n1,1\n9,1\n";

fn edges(text: &str) -> Vec<Vec<i64>> {
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some("from,to,length"));
    let without_length = |line: &str| line.rsplit_once(',').expect("three columns").0.to_owned();
    rows(&lines.map(without_length).collect::<Vec<_>>().join("\n"))
}

#[test]
fn every_kind_is_written() {
    let place = Place::new();
    place.file("p.csv", POINTS);
    let of = |kind: &str| edges(&place.succeed(&format!("graph p.csv --kind {kind} -o - --to csv -q")));
    let spokes = [[0, 4], [1, 4], [2, 4], [3, 4]];
    let with = |more: &[[i64; 2]]| {
        let mut all: Vec<Vec<i64>> = spokes.iter().chain(more).map(|edge| edge.to_vec()).collect();
        all.sort();
        all
    };
    assert_eq!(of("gabriel"), with(&[[1, 6], [2, 6]]));
    assert_eq!(of("relative-neighbors"), with(&[[1, 6], [2, 6]]));
    assert_eq!(of("relative-neighbours"), with(&[[1, 6], [2, 6]]));
    assert_eq!(of("spanning-tree"), with(&[[1, 6]]));
    assert_eq!(of("beta --beta 1"), with(&[[1, 6], [2, 6]]));
    assert_eq!(of("beta --beta 40"), with(&[]));
    assert_eq!(of("nearest -k 1"), with(&[[1, 6]]));
    assert_eq!(of("nearest -k 0"), Vec::<Vec<i64>>::new());
    let first = place.succeed("graph p.csv --kind spanning-tree -o - --to csv -q");
    assert!(first.starts_with("from,to,length\n0,4,1.4142135623730951\n"), "{first}");
}

#[test]
fn every_format_says_the_same() {
    let place = Place::new();
    place.file("p.csv", POINTS);
    place.succeed(
        "graph p.csv --kind spanning-tree -o t.npy -o t.csv -o t.geojson -o t.svg -o t.png --stats s.json",
    );
    let bytes = std::fs::read(place.path("t.npy")).expect("written");
    let header = String::from_utf8_lossy(&bytes[..100]).into_owned();
    assert!(header.contains("'<i8'") && header.contains("(5, 2, )"), "{header}");
    assert_eq!(bytes[bytes.len() - 80..bytes.len() - 64], [0, 0, 0, 0, 0, 0, 0, 0, 4, 0, 0, 0, 0, 0, 0, 0]);
    let read = |name: &str| std::fs::read_to_string(place.path(name)).expect("written");
    let json: serde_json::Value = serde_json::from_str(&read("t.geojson")).expect("JSON");
    assert_eq!(json["features"].as_array().map(Vec::len), Some(5));
    assert_eq!(json["features"][0]["properties"]["vertices"], serde_json::json!([0, 4]));
    let stats: serde_json::Value = serde_json::from_str(&read("s.json")).expect("JSON");
    assert_eq!((&stats["edges"], &stats["duplicates"]), (&5.into(), &1.into()));
    assert!((stats["length"].as_f64().expect("a number") - 4.0 * 2f64.sqrt() - 50f64.sqrt()).abs() < 1e-12);
    assert!(read("t.svg").contains("<svg") && place.path("t.png").exists());
    place.file("one.csv", "x,y\n1,2\n");
    place.succeed("graph one.csv --kind spanning-tree -o one.npy --stats s.json");
    assert!(read("s.json").contains("\"length\": 0.0"), "{}", read("s.json"));
    // What is written is read as segments again.
    place.succeed("triangulate p.csv --segments t.npy -o again.npy");
}

#[test]
fn space_and_few_points() {
    let place = Place::new();
    place.file("cube.csv", "0,0,0\n1,0,0\n0,1,0\n0,0,1\n1,1,0\n1,0,1\n0,1,1\n1,1,1\n");
    let found = edges(&place.succeed("graph cube.csv --kind gabriel --dim 3 -o - --to csv"));
    assert_eq!(found.len(), 12);
    place.succeed("graph cube.csv --kind spanning-tree --dim 3 -o t.geojson");
    place.file("empty.csv", "");
    place.file("same.csv", "1,1\n1,1\n");
    for name in ["empty", "same"] {
        for kind in ["gabriel", "relative-neighbors", "spanning-tree", "nearest -k 3", "beta --beta 1.5"] {
            let text = place.succeed(&format!("graph {name}.csv --kind {kind} -o - --to csv -q"));
            assert_eq!(text, "from,to,length\n", "{name} {kind}");
        }
    }
}

#[test]
fn what_makes_no_sense_is_refused() {
    let place = Place::new();
    place.file("p.csv", POINTS);
    place.file("bad.csv", "0,0\n1,nan\n");
    place.fail("graph p.csv --kind beta --beta 0.9 -o e.npy", 2, "beta is 0.9; it must be from 1 on");
    place.fail("graph p.csv --kind beta --beta nan -o e.npy", 2, "beta is NaN");
    place.fail("graph p.csv --kind beta -o e.npy", 2, "--beta goes with --kind beta");
    place.fail("graph p.csv --kind gabriel --beta 2 -o e.npy", 2, "--beta goes with --kind beta");
    place.fail("graph p.csv --kind nearest -o e.npy", 2, "-k goes with --kind nearest");
    place.fail("graph p.csv --kind gabriel -k 2 -o e.npy", 2, "-k goes with --kind nearest");
    place.fail("graph p.csv --kind gabriel -o e.ply", 2, "edges or pictures are not written to ply files");
    place.fail("graph p.csv --kind gabriel -o p.csv", 2, "overwrite");
    place.fail("graph bad.csv --kind gabriel -o e.npy", 1, "point 1 has the y coordinate NaN");
    place.fail("graph p.csv --kind gabriel --dim 3 -o e.npy", 1, "no third coordinate");
    place.file("q.csv", "0,0,0\n1,1,1\n");
    place.fail("graph q.csv --kind gabriel --dim 3 -o e.svg", 2, "for the plane");
}
