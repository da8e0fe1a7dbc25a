//! Inputs on which other libraries failed, in public: every algorithm on every file of `data/torture`.

use std::path::Path;

use delone::verify::verify2;
use delone::{Algorithm2, Delaunay2, Locate};
use delone_generators::{Kind, Random};
use delone_oracle::brute;

const ALGORITHMS: [Algorithm2; 6] = [
    Algorithm2::DivideAndConquer,
    Algorithm2::Incremental { seed: 3 },
    Algorithm2::ConflictLists { seed: 3 },
    Algorithm2::Located { locate: Locate::Tree, seed: 3 },
    Algorithm2::Located { locate: Locate::History, seed: 3 },
    Algorithm2::Located { locate: Locate::Stars, seed: 3 },
];

fn triangles(d: &Delaunay2) -> Vec<[[f64; 2]; 3]> {
    brute::normalized(d.triangles().map(|corners| corners.map(|v| d.point(v))))
}

/// Canonical, checked, verified, whatever the algorithm and the order of the points.
fn endure(name: &str, points: &[[f64; 2]]) {
    let mut shuffled = points.to_vec();
    Random::new(1).shuffle(&mut shuffled);
    let mut expected = None;
    for algorithm in ALGORITHMS {
        for points in [points, &shuffled] {
            let d = Delaunay2::with_algorithm(points, algorithm)
                .unwrap_or_else(|error| panic!("{name}: {error}"));
            assert_eq!(d.check(), Ok(()), "{name} {algorithm:?}");
            let bare: Vec<_> = d.triangles().map(|t| t.map(|v| v.index() as u64)).collect();
            let verdict = verify2(points, &bare).unwrap_or_else(|objection| panic!("{name}: {objection}"));
            assert!(verdict.is_canonical(), "{name} {algorithm:?}");
            let found = triangles(&d);
            assert!(*expected.get_or_insert(found.clone()) == found, "{name} {algorithm:?}");
        }
    }
    if points.len() <= 40 {
        assert_eq!(expected, Some(brute::delaunay(points)), "{name}");
    }
}

#[test]
fn public_bug_cases() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/torture");
    let mut count = 0;
    for entry in std::fs::read_dir(folder).expect("data/torture") {
        let path = entry.expect("readable").path();
        let text = std::fs::read_to_string(&path).expect("text");
        let name = path.display().to_string();
        assert!(text.starts_with("# github.com/"), "{name} names no source");
        let lines = text.lines().filter(|line| !line.starts_with('#'));
        let points: Vec<[f64; 2]> = lines
            .map(|line| {
                let mut numbers = line.split(' ').map(|word| word.parse().expect("a number"));
                [(); 2].map(|()| numbers.next().expect("two numbers"))
            })
            .collect();
        endure(&name, &points);
        count += 1;
    }
    assert!(count >= 30, "only {count} files");
}

/// Sets on which many libraries return wrong triangles, lose points or hang.
fn stress_sets(side: usize) {
    for (kind, n) in [
        (Kind::TinyLattice, side * side + 2),
        (Kind::NearLine, side * side),
        (Kind::RotatedGrid, side * side),
        (Kind::UnitCircle, side * side),
        (Kind::FarClusters, side * side),
    ] {
        endure(kind.name(), &kind.points(n, 1));
    }
}

#[test]
fn stress_sets_of_ten_thousand() {
    stress_sets(100);
}

#[test]
#[ignore = "long: .ci/run --long"]
fn stress_sets_of_ninety_thousand() {
    stress_sets(300);
}

/// Boxes nested hundreds of times, on a thread with a small stack.
#[test]
fn points_of_all_magnitudes_need_no_deep_stack() {
    let points = Kind::Octaves.points(20_000, 1);
    let build = move || Delaunay2::from_points(&points).expect("finite").vertex_count();
    let small = std::thread::Builder::new().stack_size(1 << 20).spawn(build).expect("a thread");
    assert_eq!(small.join().expect("no overflow"), 20_000);
}
