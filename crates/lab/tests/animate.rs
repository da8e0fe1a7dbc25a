//! `animate`: motions, and what algorithms do.

use serde_json::Value;

use crate::place::Place;
use crate::set;

#[test]
fn motions_are_shown() {
    let place = Place::new();
    set(&place, "disks", 40, "p.csv");
    place.succeed("animate p.csv -o motion.png --steps 5 --size 200 --stats m.json -q");
    let bytes = std::fs::read(place.path("motion.png")).expect("written");
    let count = |what: &[u8]| bytes.windows(4).filter(|window| *window == what).count();
    assert_eq!((count(b"acTL"), count(b"fcTL"), count(b"fdAT"), count(b"IEND")), (1, 6, 5, 1));
    let stats: Value =
        serde_json::from_slice(&std::fs::read(place.path("m.json")).expect("written")).expect("JSON");
    assert_eq!(stats["repaired"].as_u64().zip(stats["rebuilt"].as_u64()).map(|(a, b)| a + b), Some(5));
    place.succeed("animate p.csv -o f{}.svg --steps 10 --radius 0.5 -q");
    let frame = |k: usize| std::fs::read_to_string(place.path(&format!("f{k:02}.svg"))).expect("written");
    assert!(frame(0) != frame(1) && frame(10).ends_with("</svg>\n"));
    // No points, one place, and boxes that overflow.
    for points in ["", "1,1\n1,1\n", "1e308,1\n-1e308,1\n3,4\n"] {
        place.file("odd.csv", points);
        place.succeed("animate odd.csv -o odd.png --steps 2 -q");
    }
    place.file("bad.csv", "1,nan\n");
    place.fail("animate bad.csv -o x.png", 1, "NaN");
    place.fail("animate p.csv -o x.svg", 2, "no moving picture");
    place.fail("animate p.csv --show waltz -o x.png", 2, "waltz");
    // What algorithms do, of all sets: a picture at least.
    set(&place, "grid", 25, "grid.csv");
    for show in ["flips", "lists", "walk", "jump", "levels", "hints"] {
        for set in ["p", "grid", "odd"] {
            place.succeed(&format!("animate {set}.csv --show {show} -o {show}.png --steps 6 --size 120 -q"));
            let png = std::fs::read(place.path(&format!("{show}.png"))).expect("written");
            assert!(png.windows(4).any(|chunk| chunk == b"acTL"), "{show}");
        }
        place.succeed(&format!("animate p.csv --show {show} -o s{{}}.svg --steps 3 -q --stats s.json"));
        let svg = std::fs::read_to_string(place.path("s0.svg")).expect("written");
        assert!(svg.starts_with("<svg") && svg.trim_end().ends_with("</svg>"), "{show}");
        let stats = std::fs::read(place.path("s.json")).expect("written");
        let stats: Value = serde_json::from_slice(&stats).expect("JSON");
        assert!(stats["pictures"].as_u64().is_some_and(|count| (1..=4).contains(&count)), "{show}");
    }
    place.fail("animate p.csv -o x.png --radius inf", 2, "--radius");
    place.fail("animate p.csv -o x.png --radius -1", 2, "--radius is a length");
    place.fail("animate p.csv -o x.png --show levels --radius 1", 2, "for points that move");
}
