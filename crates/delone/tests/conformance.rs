//! One suite for every algorithm on every named generator: the same triangles, checked, and for small sets
//! those of the oracle.

use delone::{Algorithm2, Delaunay2, Dimension, Hierarchy, JumpAndWalk, Locate, Nearest, Walk};
use delone_generators::{Kind, Random};
use delone_oracle::{all_cases, brute, share};

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
    let steep = Hierarchy::default().ratio(3.0).smallest_level(2).seed(9);
    vec![
        Locate::Tree,
        Locate::Walk(Walk::Visibility),
        Locate::Walk(Walk::Stochastic { seed: 1 }),
        Locate::Walk(Walk::Straight),
        Locate::JumpAndWalk(JumpAndWalk::default()),
        Locate::Hierarchy(Hierarchy::default()),
        Locate::Hierarchy(Hierarchy::only_levels()),
        Locate::Hierarchy(steep),
        Locate::Hierarchy(steep.nearest(Nearest::Exact).levels(3)),
        Locate::Hierarchy(steep.nearest(Nearest::InCircle).walk(Walk::Visibility)),
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

/// The algorithms that are not slow on any large set: walks from the last of random points are.
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
        for seed in 0..share(1500) as u64 {
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
        for seed in 0..share(2) as u64 {
            let most = if all_cases() { 32 } else { 24 };
            let points = kind.points(if kind.is_extreme() { 16 } else { most }, 1000 + seed);
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
fn sets_of_thousands_agree_across_algorithms_and_shuffles() {
    large_sets_agree(Kind::ALL.iter(), if all_cases() { 10_000 } else { 4_000 }, 1_000);
}

#[test]
#[ignore = "long: .ci/run --long"]
fn sets_of_a_hundred_thousand_agree_across_algorithms_and_shuffles() {
    large_sets_agree(Kind::ALL.iter().step_by(2), 100_000, 3_000);
}

/// The other kinds, at the same time.
#[test]
#[ignore = "long: .ci/run --long"]
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

/// Points nested at the origin, or seemingly: in one or all quadrants, on axes and rays, symmetric, on lattices, over all exponents, with
/// chains of boxes that are just full, samples that mislead, fans around a tiny segment, and columns of nests elsewhere.
fn nests() -> Vec<(&'static str, Vec<[f64; 2]>)> {
    let power = |e: i32| if e < -1022 { f64::from_bits(1 << (e + 1074)) } else { 2f64.powi(e) };
    let (least, all) = (-1074, 2097);
    let at = |count: usize, make: &dyn Fn(i32, usize) -> [f64; 2]| -> Vec<[f64; 2]> {
        (0..count).map(|i| make(least + (i * all as usize / count) as i32, i)).collect()
    };
    let sign = |i: usize, bit: u32| if i >> bit & 1 == 1 { -1.0 } else { 1.0 };
    let mut sets = vec![
        ("quadrant", at(300, &|e, i| [power(e) * (1.0 + i as f64 / 512.0), power(e) * (i % 7) as f64 / 8.0])),
        ("quadrants", at(400, &|e, i| [sign(i, 0) * power(e), sign(i, 1) * power(e) * (i % 5) as f64 / 4.0])),
        (
            "axes",
            at(300, &|e, i| {
                if i % 2 == 0 { [sign(i, 1) * power(e), 0.0] } else { [-0.0, sign(i, 2) * power(e)] }
            }),
        ),
        ("ray", at(200, &|e, _| [power(e), power(e) / 2.0])),
        ("squares", at(400, &|e, i| [sign(i, 0), sign(i, 1)].map(|s| s * power(e - (i % 4) as i32 / 4)))),
        ("subnormal lattice", at(300, &|_, i| [i % 17, i / 17].map(|k| f64::from_bits(k as u64)))),
        (
            "corners",
            at(200, &|e, i| {
                if i % 3 == 0 {
                    [sign(i, 0) * f64::MAX, sign(i, 1) * f64::MAX]
                } else {
                    [power(e), -power(e)]
                }
            }),
        ),
        ("one row", at(300, &|e, i| [sign(i, 0) * power(e), 1e300])),
    ];
    for octaves in [59, 60, 61, 120, 121] {
        let ring = move |i: usize| {
            let e = (i * octaves / 256) as i32;
            [
                sign(i, 0) * power(e - 40) * (1.0 + (i % 9) as f64 / 16.0),
                sign(i, 1) * power(e - 40) * (i % 3) as f64,
            ]
        };
        sets.push(("full chains", (0..256).map(ring).collect()));
    }
    let mut random = Random::new(1);
    // What a sample of 64 sees is nested, what it does not see is elsewhere, or deeper.
    for other in [-900, 3, 900] {
        let fooled = |i: usize| {
            let e = if i.is_multiple_of(5) { (i * 7) as i32 % 1500 - 700 } else { other };
            [power(e) * random.between(0.5, 1.0), power(e) * random.between(-1.0, 1.0)]
        };
        sets.push(("fooled", (0..320).map(fooled).collect()));
    }
    let fan = (0..60)
        .map(|j| (1.0 + f64::from(j) / 1_048_576.0, j))
        .map(|(d, j)| [-d * power(2 * j - 60), power(j)]);
    let segment = (0..200).map(|i| [0.0, (f64::from(i * 37 % 200) - 100.0) * power(-70)]);
    sets.push(("fans", fan.chain(segment).collect()));
    let column = |i: i32| [f64::from(16 + i % 3) * power(1000), power(i * 31 % 2058 - 1058)];
    sets.push(("columns", (0..300).map(column).collect()));
    sets
}

/// Also turned, mirrored and scaled: whatever the origin is in the order, the triangulation is that of the points.
#[test]
fn nests_agree_across_algorithms() {
    for (name, points) in nests() {
        let scalable = || scalable_algorithms().into_iter().take(4).collect::<Vec<_>>();
        let expected = agreed(&points, name, scalable());
        let turns: [fn([f64; 2]) -> [f64; 2]; 3] = [|[x, y]| [y, x], |[x, y]| [-x, y], |[x, y]| [y, -x]];
        for turn in turns {
            agreed(&points.iter().map(|&p| turn(p)).collect::<Vec<_>>(), name, scalable());
        }
        let mut shuffled = points.clone();
        Random::new(7).shuffle(&mut shuffled);
        assert!(agreed(&shuffled, name, Vec::new()) == expected, "{name} shuffled");
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
