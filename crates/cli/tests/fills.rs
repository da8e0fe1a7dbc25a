//! Rules of what is inside of polygons, and seeds that are nowhere.

use crate::place::{Place, text};

/// A square of area 100 with two holes of 16 that overlap in 4.
const OVERLAPPING: &str =
    "POLYGON ((0 0, 10 0, 10 10, 0 10, 0 0), (2 2, 2 6, 6 6, 6 2, 2 2), (4 4, 4 8, 8 8, 8 4, 4 4))";

fn area(place: &Place, arguments: &str) -> f64 {
    place.succeed(&format!("{arguments} -o area.stl --crossings split --stats s.json"));
    let stl = std::fs::read(place.path("area.stl")).expect("triangles");
    let number = |at: usize| f64::from(f32::from_le_bytes(stl[at..at + 4].try_into().expect("four bytes")));
    let triangle = |record: usize| {
        let corner = |k: usize| [0, 4].map(|axis| number(84 + 50 * record + 12 + 12 * k + axis));
        let [a, b, c] = [0, 1, 2].map(corner);
        ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2.0
    };
    (0..(stl.len() - 84) / 50).map(triangle).sum()
}

#[test]
fn rules_tell_what_is_inside() {
    let place = Place::new();
    place.file("p.wkt", OVERLAPPING);
    for command in ["triangulate", "polygons", "mesh --min-angle 20"] {
        // By rings in opposite directions holes have winding 0, and where they overlap it is -1.
        let rules = [
            ("even-odd", 76.0),
            ("nonzero", 76.0),
            ("positive", 72.0),
            ("negative", 4.0),
            ("shells-minus-holes", 72.0),
        ];
        for (rule, expected) in rules {
            let found = area(&place, &format!("{command} p.wkt --fill {rule}"));
            assert!((found - expected).abs() < 1e-4, "{command} {rule}: {found}");
        }
    }
}

#[test]
fn holes_that_are_filled_are_told() {
    let place = Place::new();
    place.file("p.wkt", OVERLAPPING);
    for command in ["triangulate", "polygons", "mesh"] {
        let told = |rule: &str| {
            let output = place.run(&format!("{command} p.wkt --crossings split --fill {rule} -o t.ply"));
            text(&output.stderr)
        };
        let note = "note: holes that are filled at least in part: 2 (polygon 0, ring 1); --fill shells-minus-holes leaves them out";
        assert!(told("even-odd").contains(note), "{}", told("even-odd"));
        assert!(!told("shells-minus-holes").contains("filled"));
    }
    place.file("l.wkt", "LINESTRING (0 0, 4 0, 0 4, 0 0)");
    place.fail("mesh l.wkt --fill shells-minus-holes -o t.ply", 1, "is for polygons, and there are none");
}

#[test]
fn seeds_outside_of_the_hull_are_told_and_left_out() {
    let place = Place::new();
    let poly = "4 2 0 0\n1 0 0\n2 4 0\n3 4 4\n4 0 4\n4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n1\n1 9 9\n";
    place.file("s.poly", poly);
    for command in ["triangulate", "mesh"] {
        let output = place.run(&format!("{command} s.poly -o t.ply"));
        assert!(output.status.success());
        let told = text(&output.stderr);
        assert!(told.contains("note: seeds of holes outside of the convex hull: 1, left out"), "{told}");
    }
    place.file("on.poly", poly.replace("1 9 9", "1 4 2"));
    place.fail("mesh on.poly -o t.ply", 1, "on a constraint");
}
