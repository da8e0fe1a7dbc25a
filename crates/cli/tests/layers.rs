//! Boundary layers as a user meets them.

use crate::mesh::mesh;
use crate::place::{Place, text};

/// A channel: inlet and outlet 1, walls 2 and 3.
const CHANNEL: &str = "4 2 0 0\n1 0 0\n2 6 0\n3 6 1\n4 0 1\n4 1\n1 1 2 2\n2 2 3 1\n3 3 4 3\n4 4 1 1\n0\n";

fn place() -> Place {
    let place = Place::new();
    place.file("channel.poly", CHANNEL);
    place
}

#[test]
fn walls_get_rows_by_their_markers() {
    let place = place();
    place.succeed(
        "-q mesh channel.poly --edge 0.25 --min-angle 28 --layer-height 0.01 --layer-growth 2 --layer-count 4 --layers 2,3 \
         --check -o m.node -o m.ele -o m.poly --stats s.json",
    );
    let stats: serde_json::Value = serde_json::from_str(&place.read("s.json")).expect("JSON");
    let layers = &stats["layers"];
    let places = layers["places"].as_u64().expect("a number");
    assert_eq!((layers["rows"].as_u64(), layers["shortened"].as_u64()), (Some(4), Some(0)), "{layers}");
    assert_eq!(layers["vertices"].as_u64(), Some(4 * places));
    assert_eq!(layers["triangles"].as_u64(), Some(8 * (places - 2)));
    assert!(stats["smallest_angle"].as_f64().expect("a number") >= 28.0);
    let m = mesh(&place, "m");
    assert!((m.area() - 6.0).abs() < 1e-12);
    for y in [0.01, 0.03, 0.07, 0.15] {
        for y in [y, 1.0 - y] {
            let count = m.points.iter().filter(|p| (p[1] - y).abs() < 1e-15).count() as u64;
            assert_eq!(count, places / 2, "{y}");
        }
    }
    // Segments are those of the input: none is inside, and pieces of inlet and outlet keep their marker.
    let poly = place.read("m.poly");
    let mut segments = 0;
    for line in poly.lines().skip_while(|line| line.split_whitespace().count() != 2).skip(1) {
        let words: Vec<i64> = line.split_whitespace().filter_map(|word| word.parse().ok()).collect();
        let &[_, v, w, marker] = &words[..] else { break };
        let ends = [v, w].map(|v| m.points[v as usize - 1]);
        let expected = match ends {
            [p, q] if p[0] == q[0] && (p[0] == 0.0 || p[0] == 6.0) => 1,
            [p, q] if p[1] == 0.0 && q[1] == 0.0 => 2,
            [p, q] if p[1] == 1.0 && q[1] == 1.0 => 3,
            other => panic!("a segment from {other:?}"),
        };
        assert_eq!(marker, expected);
        segments += 1;
    }
    assert!(segments > places as usize, "{segments} segments");
}

#[test]
fn rows_without_room_are_told() {
    let place = place();
    let run = place.run("mesh channel.poly --edge 0.25 --layer-height 0.2 --layer-count 9 -o m.vtu");
    let said = text(&run.stderr);
    assert!(said.contains("vertices of walls have fewer rows than asked for"), "{said}");
}

#[test]
fn wrong_layers_are_refused() {
    let place = place();
    for (options, told) in [
        ("--layer-height 0", "layer-height is 0"),
        ("--layer-height=-1", "layer-height is -1"),
        ("--layer-height nan", "layer-height is NaN"),
        ("--layer-height 1 --layer-growth 0.5", "layer-growth is 0.5"),
        ("--layer-height 1 --layer-count 0", "layer-count"),
        ("--layer-height 1 --layer-count 5000", "layer-count is 5000"),
        ("--layer-height 1 --layer-thickness 0", "layer-thickness is 0"),
        ("--layers 2", "--layer-height"),
    ] {
        place.fail(&format!("mesh channel.poly {options} -o m.vtu"), 2, told);
    }
    place.fail(
        "mesh channel.poly --layer-height 0.1 --layers 2,9 -o m.vtu",
        1,
        "no segment has the marker 9",
    );
}
