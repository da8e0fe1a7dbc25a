//! One suite for every algorithm on every named generator: the same triangles, checked, and for small sets
//! those of the oracle.

use delone::{Algorithm2, Delaunay2, Dimension, Hierarchy, JumpAndWalk, Locate, Nearest, Walk};
use delone_generators::{Kind, Random};
use delone_oracle::brute;

/// Every way to build a triangulation.
fn algorithms() -> Vec<Algorithm2> {
    let mut all = vec![
        Algorithm2::DivideAndConquer,
        Algorithm2::Incremental { seed: 0 },
        Algorithm2::Incremental { seed: 77 },
        Algorithm2::ConflictLists { seed: 3 },
    ];
    all.extend(strategies().into_iter().map(|locate| Algorithm2::Located { locate, seed: 5 }));
    all
}

/// Every strategy of location, in its variants.
fn strategies() -> Vec<Locate> {
    let steep = Hierarchy { ratio: 3.0, smallest_level: 2, seed: 9, ..Hierarchy::default() };
    vec![
        Locate::Tree,
        Locate::Walk(Walk::Visibility),
        Locate::Walk(Walk::Stochastic { seed: 1 }),
        Locate::Walk(Walk::Straight),
        Locate::JumpAndWalk(JumpAndWalk::default()),
        Locate::Hierarchy(Hierarchy::default()),
        Locate::Hierarchy(Hierarchy::only_levels()),
        Locate::Hierarchy(steep),
        Locate::Hierarchy(Hierarchy { nearest: Nearest::Exact, levels: Some(3), ..steep }),
        Locate::Hierarchy(Hierarchy { nearest: Nearest::InCircle, walk: Some(Walk::Visibility), ..steep }),
        Locate::History,
        Locate::Stars,
        Locate::DelaunayTree,
    ]
}

fn build(points: &[[f64; 2]], algorithm: Algorithm2) -> Delaunay2 {
    Delaunay2::with_algorithm(points, algorithm).expect("finite points")
}

/// The triangles by coordinates, so that permutations of the input compare too.
fn triangles(d: &Delaunay2) -> Vec<[[f64; 2]; 3]> {
    brute::normalized(d.triangles().map(|corners| corners.map(|v| d.point(v))))
}

/// Those that are not slow on any large set: walks from the last of random points are.
fn scalable_algorithms() -> Vec<Algorithm2> {
    let scalable = |algorithm: &Algorithm2| match algorithm {
        Algorithm2::Located { locate, .. } => {
            [Locate::Tree, Locate::Hierarchy(Hierarchy::default()), Locate::History].contains(locate)
        }
        _ => true,
    };
    algorithms().into_iter().filter(scalable).collect()
}

/// Builds with all algorithms, checks each result and their agreement, and returns the triangles.
fn agreed(points: &[[f64; 2]], what: &str, algorithms: Vec<Algorithm2>) -> Vec<[[f64; 2]; 3]> {
    let first = build(points, Algorithm2::default());
    let expected = triangles(&first);
    for algorithm in algorithms {
        let d = build(points, algorithm);
        assert_eq!(d.check(), Ok(()), "{what} {algorithm:?}");
        assert!(triangles(&d) == expected, "{what} {algorithm:?} differs");
        assert!(d.duplicates().eq(first.duplicates()), "{what} {algorithm:?}");
        assert_eq!(d.dimension(), first.dimension(), "{what} {algorithm:?}");
        assert_eq!(d.hull_vertices().count(), first.hull_vertices().count(), "{what} {algorithm:?}");
    }
    let (d, order) = Delaunay2::along_curve(points).expect("finite points");
    assert_eq!(d.check(), Ok(()), "{what} along a curve");
    assert!(triangles(&d) == expected, "{what} along a curve differs");
    assert!(d.vertices().map(|v| d.point(v)).eq(order.iter().map(|&i| points[i as usize])), "{what}");
    let mut indices: Vec<usize> = order.iter().map(|&i| i as usize).collect();
    indices.sort_unstable();
    assert!(first.vertices().map(|v| v.index()).eq(indices), "{what} along a curve: other vertices");
    expected
}

#[test]
fn all_subsets_of_a_small_grid() {
    let grid: Vec<_> = (0..16).map(|i| [f64::from(i % 4), f64::from(i / 4)]).collect();
    let table = brute::Table::new(&grid);
    for subset in 0..1_u64 << 16 {
        let points: Vec<_> = (0..16).filter(|i| subset >> i & 1 == 1).map(|i| grid[i]).collect();
        let expected = table.delaunay(subset);
        for algorithm in &algorithms()[..2] {
            let d = build(&points, *algorithm);
            assert_eq!(triangles(&d), expected, "{algorithm:?} {points:?}");
        }
    }
}

#[test]
fn thousands_of_small_sets_against_the_oracle() {
    for &kind in Kind::ALL {
        for seed in 0..1500 {
            let points = kind.points(1 + seed as usize % 9, seed);
            assert_eq!(
                agreed(&points, kind.name(), algorithms()),
                brute::delaunay(&points),
                "{} {seed}",
                kind.name()
            );
        }
    }
}

#[test]
fn medium_sets_against_the_oracle() {
    for &kind in Kind::ALL {
        for seed in 0..2 {
            let points = kind.points(if kind.is_extreme() { 16 } else { 32 }, 1000 + seed);
            assert_eq!(
                agreed(&points, kind.name(), algorithms()),
                brute::delaunay(&points),
                "{} {seed}",
                kind.name()
            );
        }
    }
}

#[test]
fn sets_of_ten_thousand_agree_across_algorithms_and_shuffles() {
    large_sets_agree(Kind::ALL.iter(), 10_000, 1_000);
}

#[test]
#[ignore = "long: .ci/run"]
fn sets_of_a_hundred_thousand_agree_across_algorithms_and_shuffles() {
    large_sets_agree(Kind::ALL.iter().step_by(2), 100_000, 3_000);
}

/// The other kinds, at the same time.
#[test]
#[ignore = "long: .ci/run"]
fn more_sets_of_a_hundred_thousand_agree_across_algorithms_and_shuffles() {
    large_sets_agree(Kind::ALL.iter().skip(1).step_by(2), 100_000, 3_000);
}

fn large_sets_agree<'a>(kinds: impl Iterator<Item = &'a Kind>, size: usize, extreme: usize) {
    for kind in kinds {
        let mut points = kind.points(if kind.is_extreme() { extreme } else { size }, 11);
        let expected = agreed(&points, kind.name(), scalable_algorithms());
        Random::new(5).shuffle(&mut points);
        assert!(triangles(&build(&points, Algorithm2::default())) == expected, "{} shuffled", kind.name());
    }
}

#[test]
fn sets_of_lower_dimension() {
    for (points, dimension, hull) in [
        (vec![], Dimension::Empty, vec![]),
        (vec![[1.0, 2.0]], Dimension::Point, vec![0]),
        (vec![[1.0, 2.0]; 3], Dimension::Point, vec![0]),
        (vec![[0.0, 0.0], [-0.0, 0.0]], Dimension::Point, vec![0]),
        (vec![[0.0, 0.0], [1.0, 0.0]], Dimension::Line, vec![0, 1]),
        (vec![[1.0, 1.0], [0.0, 0.0], [3.0, 3.0], [2.0, 2.0]], Dimension::Line, vec![1, 0, 3, 2]),
        (vec![[0.0, 5.0], [0.0, 1.0], [0.0, 3.0]], Dimension::Line, vec![1, 2, 0]),
    ] {
        for algorithm in algorithms() {
            let d = build(&points, algorithm);
            assert_eq!(d.check(), Ok(()), "{points:?} {algorithm:?}");
            assert_eq!(d.dimension(), dimension, "{points:?} {algorithm:?}");
            assert_eq!(d.triangles().count(), 0);
            let mut found: Vec<_> = d.hull_vertices().map(|v| v.index()).collect();
            if found.first() > found.last() && hull.first() < hull.last() {
                found.reverse(); // a line may be read from either end
            }
            let mut sorted_hull: Vec<_> = hull.clone();
            sorted_hull.sort_unstable();
            let mut sorted: Vec<_> = found.clone();
            sorted.sort_unstable();
            assert_eq!(sorted, sorted_hull, "{points:?} {algorithm:?}");
            assert!(
                found
                    .windows(2)
                    .all(|w| d.mesh().neighbors(delone::VertexId::new(w[0])).any(|v| v.index() == w[1]))
            );
        }
    }
}

#[test]
fn counts_obey_euler() {
    for &kind in Kind::ALL {
        let d = build(&kind.points(500, 2), Algorithm2::default());
        assert_eq!(d.triangle_count(), d.triangles().count(), "{}", kind.name());
        if d.dimension() != Dimension::Plane {
            continue;
        }
        let (n, h) = (d.vertex_count(), d.hull_vertices().count());
        assert_eq!(d.triangles().count(), 2 * n - 2 - h, "{}", kind.name());
        assert_eq!(d.edges().count(), 3 * n - 3 - h, "{}", kind.name());
        let degrees: usize = d.vertices().map(|v| d.mesh().neighbors(v).count()).sum();
        assert_eq!(degrees, 2 * d.edges().count(), "{}", kind.name());
        let hull: Vec<_> = d.hull_vertices().map(|v| d.point(v)).collect();
        let around: f64 =
            (0..h).map(|i| hull[i][0] * hull[(i + 1) % h][1] - hull[i][1] * hull[(i + 1) % h][0]).sum();
        let inside: f64 = d.mesh().triangles().map(|t| d.area(t)).sum();
        if kind == Kind::Uniform {
            assert!((around / 2.0 - inside).abs() < 1e-12);
        }
    }
}
