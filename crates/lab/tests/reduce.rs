//! `reduce`: points that fail, and those that do not.

use std::process::Command;

use serde_json::Value;

use crate::place::{Place, text};
use crate::set;

/// Two diagonals of a square and a point beside.
const CROSS: &str = "5 2 0 0\n1 0 0\n2 2 2\n3 0 2\n4 2 0\n5 4 1\n2 0\n1 1 2\n2 3 4\n0\n";

#[test]
fn graphs_that_do_not_fail_are_not_reduced() {
    let place = Place::new();
    place.file("cross.poly", CROSS);
    assert!(place.succeed("reduce cross.poly -o small.poly").starts_with("nothing to reduce"));
    place.file("p.csv", "0,0\n1,0\n0,1\n");
    place.file("s.csv", "0,1\n");
    assert!(place.succeed("reduce p.csv --segments s.csv").starts_with("nothing to reduce"));
    place.fail("reduce p.csv --segments s.csv --against true", 2, "--against judges points");
    // What is no number fails, and is what is left.
    place.file("nan.csv", "0,0\n1,0\n0,1\nnan,2\n5,5\n");
    let told = place.succeed("-q reduce nan.csv --segments s.csv");
    assert!(told.starts_with("// 1 points, 0 segments: point 0 has the x coordinate NaN"), "{told}");
}

#[test]
fn points_that_fail_are_reduced() {
    let place = Place::new();
    set(&place, "uniform", 60, "p.csv");
    assert!(place.succeed("reduce p.csv --stats s.json").starts_with("nothing to reduce"));
    let stats: Value = serde_json::from_str(&place.read("s.json")).expect("JSON");
    assert_eq!(stats["points"], 60);
    // A program that gives up on arrays of 300 bytes: on eleven points or more. Those on a line have no triangles.
    place.file("line.csv", (0..60).map(|k| format!("{k},{k}\n")).collect::<String>());
    place.file("nothing.txt", "");
    place.succeed("replay nothing.txt -o none.npy");
    let fails_on_eleven = "test $(wc -c < {points}) -lt 300 && cp none.npy {triangles}";
    let output = Command::new(crate::PROGRAM)
        .current_dir(place.0.path())
        .args(["reduce", "line.csv", "-o", "small.npy", "--against", fails_on_eleven])
        .output()
        .expect("the program starts");
    assert!(output.status.success());
    assert!(text(&output.stdout).starts_with("// 11 points: the command fails"));
    assert!(place.path("small.npy").exists());
    // Without triangles of points that have some, it fails on three.
    let output = Command::new(crate::PROGRAM)
        .current_dir(place.0.path())
        .args(["reduce", "p.csv", "--against", "cp none.npy {triangles}"])
        .output()
        .expect("the program starts");
    assert!(text(&output.stdout).starts_with("// 3 points: "), "{}", text(&output.stdout));
}

#[test]
fn what_cannot_be_reduced_is_refused() {
    let place = Place::new();
    place.file("p.csv", "0,0\n1,0\n0,1\n");
    place.fail("reduce p.csv --against no-such-program", 1, "cannot be run");
    place.fail("reduce p.csv --wkt lines", 2, "--wkt is for outputs of well-known text");
    place.fail("reduce p.csv --stats ./p.csv", 2, "would overwrite");
    // The points of a .poly file may be in another one.
    place.file("beside.poly", "0 2 0 0\n4 0\n0 0 1\n1 1 2\n2 2 3\n3 3 0\n0\n");
    place.file("beside.node", "4 2 0 0\n0 0 0\n1 2 0\n2 2 2\n3 0 2\n");
    place.fail("reduce beside.poly -o beside.node", 2, "would overwrite");
}
