//! Slivers along the border, which are exact and unwanted: left out on request, and told.

use crate::place::{Place, text};

/// A turned lattice of 12 points a side: its border is straight but for rounding.
fn lattice() -> String {
    let (sin, cos) = 0.3_f64.sin_cos();
    let point = |i: i32| {
        let (x, y) = (f64::from(i % 12), f64::from(i / 12));
        format!("{:?},{:?},{:?}\n", x * cos - y * sin, x * sin + y * cos, x * y)
    };
    (0..144).map(point).collect()
}

fn stats(place: &Place) -> serde_json::Value {
    let stats = std::fs::read(place.path("s.json")).expect("written");
    serde_json::from_slice(&stats).expect("JSON")
}

#[test]
fn slivers_of_the_border_are_left_out_and_told() {
    let place = Place::new();
    place.file("p.csv", lattice());
    place.file("w.csv", "0\n".repeat(144));
    place.succeed("triangulate p.csv -o all.ply --stats s.json -q");
    let all = stats(&place)["simplices"].as_u64().expect("a number");
    assert!(all > 242 && stats(&place)["slivers"].is_null());
    for more in ["", "--weights w.csv"] {
        let output = place
            .run(&format!("triangulate p.csv {more} --drop-slivers 1e-9 -o m.ply -o m.obj --stats s.json"));
        let stderr = text(&output.stderr);
        assert!(output.status.success(), "{stderr}");
        assert_eq!(stats(&place)["slivers"], all - 242, "{more}");
        assert_eq!(stats(&place)["left_out"], all - 242, "{more}");
        let told = format!("triangles of the border flatter than 1e-9: {}, left out", all - 242);
        assert!(stderr.contains(&told), "{stderr}");
        let obj = std::fs::read_to_string(place.path("m.obj")).expect("written");
        assert_eq!(obj.lines().filter(|line| line.starts_with("f ")).count(), 242, "{more}");
    }
    // What is long goes too, and is no sliver.
    place.succeed("triangulate p.csv --drop-slivers 1e-9 --max-edge 0.5 -o m.ply --stats s.json -q");
    assert_eq!((&stats(&place)["slivers"], &stats(&place)["left_out"]), (&0.into(), &all.into()));
}

#[test]
fn segments_stay_edges() {
    let place = Place::new();
    // Two slivers over the lower side, over one of which a segment passes.
    place.file("p.csv", "0,0\n1,1e-16\n2,0\n3,1e-16\n4,0\n2,2\n");
    place.file("s.csv", "0,1\n");
    place.succeed("triangulate p.csv --drop-slivers 1e-9 -o m.npy --stats s.json -q");
    let without = stats(&place)["slivers"].as_u64().expect("a number");
    place.succeed("triangulate p.csv --segments s.csv --drop-slivers 1e-9 -o m.npy --stats s.json -q");
    assert_eq!((without, &stats(&place)["slivers"]), (2, &1.into()));
}

#[test]
fn wrong_parts_are_named() {
    let place = Place::new();
    place.file("p.csv", "0,0,0\n1,0,0\n0,1,0\n0,0,1\n");
    place.fail(
        "triangulate p.csv --dim 3 --drop-slivers 1e-9 -o m.npy",
        2,
        "--drop-slivers is for the plane",
    );
    for ratio in ["-1", "2", "nan", "x"] {
        place.fail(
            &format!("triangulate p.csv --drop-slivers={ratio} -o m.npy"),
            2,
            "a ratio is from 0 to 1",
        );
    }
}
