//! Imprecise points: every instance is what it is without hints, and walks are as short as the paper says.

use delone::{
    Algorithm2, Algorithm3, Counters, Delaunay2, Delaunay3, Error, HintOrder, Hints2, Hints3, Imprecise,
    Moving2, Moving3, Step2, Step3, VertexId, Work,
};
use delone_generators::{Kind, Kind3, Random};
use delone_oracle::{all_cases, brute, exact};

const ORDERS: [HintOrder; 2] = [HintOrder::Random { seed: 3 }, HintOrder::Spatial { seed: 4 }];

fn triangles(d: &Delaunay2) -> Vec<[[f64; 2]; 3]> {
    brute::normalized(d.triangles().map(|corners| corners.map(|v| d.point(v))))
}

fn same(d: &Delaunay2, points: &[[f64; 2]], what: &str) {
    assert_eq!(d.check(), Ok(()), "{what}");
    let fresh = Delaunay2::from_points(points).expect("finite");
    assert!(triangles(d) == triangles(&fresh), "{what}");
    assert!(d.duplicates().eq(fresh.duplicates()), "{what}");
    assert_eq!(d.points(), points, "{what}");
}

#[test]
fn every_instance_is_the_canonical_triangulation() {
    for &kind in Kind::ALL {
        for order in ORDERS {
            let centers = kind.points(300, 1);
            let mut hints = Hints2::from_points(&centers, order).expect("finite");
            let mut random = Random::new(7);
            for round in 0..6 {
                let instance: Vec<[f64; 2]> = match round {
                    0 => centers.clone(),
                    1 => centers.iter().map(|p| p.map(|x| x + random.between(-0.5, 0.5))).collect(),
                    // Anywhere, all in one place, on a line, and apart again.
                    2 => kind.points(300, 99),
                    3 => vec![[2.0, 3.0]; 300],
                    4 => (0..300).map(|i| [f64::from(i % 50), 1.0]).collect(),
                    _ => centers.iter().rev().copied().collect(),
                };
                let what = format!("{} {order:?} {round}", kind.name());
                if round % 2 == 0 {
                    same(hints.triangulate(&instance).expect("finite"), &instance, &what);
                } else {
                    same(hints.follow(&instance).expect("finite"), &instance, &what);
                }
            }
        }
    }
}

/// Of each point the nearest of those that come before it.
#[test]
fn hints_are_the_nearest_before() {
    for (order, kind) in ORDERS.into_iter().flat_map(|order| [Kind::Uniform, Kind::Line].map(|k| (order, k)))
    {
        let centers = kind.points(300, 1);
        let hints = Hints2::from_points(&centers, order).expect("finite");
        let (order, found): (Vec<usize>, Vec<usize>) = hints.order().zip(hints.hints()).unzip();
        assert_eq!(found[0], order[0]);
        for k in 1..300 {
            let distance =
                |i: usize| exact::compare_distances(centers[order[k]], centers[found[k]], centers[i]);
            assert!(order[..k].contains(&found[k]) && order[..k].iter().all(|&i| distance(i) <= 0), "{k}");
        }
    }
}

#[test]
fn hints_that_mislead_are_given_up() {
    let centers = Kind::Uniform.points(30_000, 1);
    let mut hints = Hints2::from_points(&centers, HintOrder::default()).expect("finite");
    hints.triangulate(&centers).expect("finite");
    assert!(!hints.gave_up());
    let mut shuffled = centers.clone();
    Random::new(3).shuffle(&mut shuffled);
    let mut work = Work::default();
    let d = hints.triangulate_observed(&shuffled, &mut work).expect("finite");
    same(d, &shuffled, "shuffled");
    assert!(hints.gave_up());
    assert!(work.visited < 60 * 30_000, "{}", work.visited);
    // The hints themselves are as good as before.
    same(hints.triangulate(&centers).expect("finite"), &centers, "again");
    assert!(!hints.gave_up());
}

#[test]
fn nested_disks_take_quadratic_time_until_hints_are_given_up() {
    // §6.2: disks that overlap two by two, of which an instance can make all hints bad.
    let mut last = 0.0;
    for (n, gives_up) in [(101, false), (201, false), (401, false), (1201, true)] {
        let (centers, instance) = (Kind::Nested.points(n, 0), Kind::NestedInstance.points(n, 0));
        // The instance is inside of the disks, of radius 2.1 times their height.
        for (p, q) in centers.iter().zip(&instance).skip(1) {
            assert!(((p[0] - q[0]) / p[1]).hypot((p[1] - q[1]) / p[1]) <= 2.1);
        }
        let mut hints = Hints2::from_points(&centers, HintOrder::Random { seed: 1 }).expect("finite");
        let mut work = Work::default();
        same(hints.triangulate_observed(&instance, &mut work).expect("finite"), &instance, "nested");
        assert_eq!(hints.gave_up(), gives_up, "{n}");
        let visited = work.visited as f64 / n as f64;
        if gives_up {
            assert!(visited < 40.0 + 10_000.0 / n as f64 + 2.0, "{n}: {visited}");
        } else {
            assert!(visited > 1.4 * last, "{n}: {visited} after {last}");
            last = visited;
        }
    }
}

/// Threads never show, and instances may be triangulated on one thread and on several in turns.
#[cfg(feature = "rayon")]
#[test]
fn instances_on_several_threads_are_those_on_one() {
    let n = 40_000;
    let mut hints = Hints2::from_points(&Kind::Uniform.points(n, 1), HintOrder::default()).expect("finite");
    let pool = |threads| rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
    let (one, many) = (pool(1), pool(3));
    for (kind, seed) in [(Kind::Uniform, 1), (Kind::SmallIntegers, 2), (Kind::Line, 3), (Kind::Uniform, 1)] {
        let instance = kind.points(n, seed);
        for threads in [&one, &many] {
            same(threads.install(|| hints.triangulate(&instance)).expect("finite"), &instance, kind.name());
        }
        let mut broken = instance.clone();
        broken[n / 2][1] = f64::NAN;
        assert!(
            many.install(|| hints.triangulate(&broken).is_err() && hints.triangulate(&broken[1..]).is_err())
        );
        same(hints.current(), &instance, "the last one is still there");
    }
}

#[test]
fn hints_that_mislead_in_space_are_given_up() {
    let n = 60_000;
    let centers = Kind3::Cube.points(n, 1);
    let mut hints = Hints3::from_points(&centers, HintOrder::default()).expect("finite");
    let mut shuffled = centers.clone();
    Random::new(3).shuffle(&mut shuffled);
    let d = hints.triangulate(&shuffled).expect("finite");
    let fresh = Delaunay3::from_points(&shuffled).expect("finite");
    assert_eq!(
        (d.tetrahedron_ids().count(), d.hull_facets().count()),
        (fresh.tetrahedron_ids().count(), fresh.hull_facets().count())
    );
    assert!(hints.gave_up());
    let count = fresh.tetrahedron_ids().count();
    assert_eq!(hints.triangulate(&centers).expect("finite").tetrahedron_ids().count(), count);
    assert!(!hints.gave_up());
}

#[test]
fn bad_instances_leave_the_last_one() {
    let centers = Kind::Uniform.points(50, 1);
    let mut hints = Hints2::from_points(&centers, HintOrder::default()).expect("finite");
    hints.triangulate(&centers).expect("finite");
    same(hints.current(), &centers, "current");
    let before = triangles(hints.current());
    let error = hints.triangulate(&centers[1..]).err();
    assert_eq!(error, Some(Error::Length { expected: 50, found: 49 }));
    let mut bad = centers.clone();
    bad[7][1] = f64::NAN;
    let error = hints.triangulate(&bad).err().map(|error| error.to_string());
    assert_eq!(error.as_deref(), Some("point 7 has the y coordinate NaN, which is not finite"));
    assert!(triangles(hints.current()) == before);
    bad[7][1] = f64::INFINITY;
    assert!(Hints2::from_points(&bad, HintOrder::default()).is_err());
    let mut none = Hints2::from_points::<[f64; 2]>(&[], HintOrder::default()).expect("finite");
    assert_eq!(none.triangulate::<[f64; 2]>(&[]).expect("finite").vertex_count(), 0);
}

#[test]
fn walks_are_as_short_as_in_the_paper() {
    // §5: 2.8 triangles visited a point for disjoint unit disks, whatever their number and the order.
    for order in ORDERS {
        for n in [1_000, 10_000, 100_000] {
            let centers = Kind::Disks.points(n, 5);
            let mut hints = Hints2::from_points(&centers, order).expect("finite");
            let mut random = Random::new(9);
            let instance: Vec<[f64; 2]> = centers
                .iter()
                .map(|&[x, y]| {
                    loop {
                        let (u, v) = (random.between(-1.0, 1.0), random.between(-1.0, 1.0));
                        if u * u + v * v <= 1.0 {
                            break [x + u, y + v];
                        }
                    }
                })
                .collect();
            let mut work = Work::default();
            hints.triangulate_observed(&instance, &mut work).expect("finite");
            let visited = work.visited as f64 / n as f64;
            // In spatial order the triangle where a walk starts is one of the last made, and a better one.
            let expected = if matches!(order, HintOrder::Random { .. }) { 2.65..2.95 } else { 2.4..2.7 };
            assert!(expected.contains(&visited), "{order:?} {n}: {visited}");
            // Spatial sort alone: 3.7 by straight walks, fewer by visibility.
            let d =
                Delaunay2::with_algorithm(&instance, Algorithm2::Incremental { seed: 1 }).expect("finite");
            let Counters::Incremental(work) = d.counters() else { panic!("counted") };
            let visited = work.visited as f64 / n as f64;
            assert!((3.0..3.8).contains(&visited), "spatial sort {n}: {visited}");
        }
    }
}

fn same_in_space(d: &Delaunay3, points: &[[f64; 3]], what: &str) {
    assert_eq!(d.check(), Ok(()), "{what}");
    let fresh = Delaunay3::from_points(points).expect("finite");
    let sorted = |mut t: [VertexId; 4]| {
        t.sort_unstable();
        t
    };
    let ids = |d: &Delaunay3| {
        let mut all: Vec<_> = d.tetrahedra().map(sorted).collect();
        all.sort_unstable();
        (all, d.dimension(), d.edges().count(), d.duplicates().collect::<Vec<_>>())
    };
    assert!(ids(d) == ids(&fresh), "{what}");
    assert!(d.vertices().all(|v| d.point(v) == points[v.index()]), "{what}");
}

#[test]
fn every_instance_in_space_is_the_canonical_triangulation() {
    for &kind in Kind3::ALL {
        for order in ORDERS {
            let n = if kind == Kind3::HugeSpan3 { 40 } else { 200 };
            let centers = kind.points(n, 1);
            let mut hints = Hints3::from_points(&centers, order).expect("finite");
            let mut random = Random::new(7);
            for round in 0..6 {
                let instance: Vec<[f64; 3]> = match round {
                    0 => centers.clone(),
                    1 => centers.iter().map(|p| p.map(|x| x + random.between(-0.5, 0.5))).collect(),
                    2 => kind.points(n, 99),
                    3 => vec![[2.0, 3.0, 4.0]; n],
                    4 => (0..n).map(|i| [(i % 50) as f64, 1.0, (i % 2) as f64]).collect(),
                    _ => centers.iter().rev().copied().collect(),
                };
                let what = format!("{} {order:?} {round}", kind.name());
                let d = if round % 2 == 0 { hints.triangulate(&instance) } else { hints.follow(&instance) };
                same_in_space(d.expect("finite"), &instance, &what);
            }
        }
    }
}

#[test]
fn walks_in_space_are_shorter_than_in_the_paper() {
    // §5: 5.2 to 5.3 visited in random order, 4.5 in spatial order. Ours cross the facet furthest from the goal.
    for order in ORDERS {
        for n in [1_000, 20_000] {
            let centers = Kind3::Balls.points(n, 5);
            let mut hints = Hints3::from_points(&centers, order).expect("finite");
            let mut random = Random::new(9);
            let mut inside = || loop {
                let u = [0, 1, 2].map(|_| random.between(-1.0, 1.0));
                if u.iter().map(|x| x * x).sum::<f64>() <= 1.0 {
                    break u;
                }
            };
            let instance: Vec<[f64; 3]> = centers
                .iter()
                .map(|p| {
                    let u = inside();
                    [0, 1, 2].map(|k| p[k] + u[k])
                })
                .collect();
            let mut work = Work::default();
            hints.triangulate_observed(&instance, &mut work).expect("finite");
            let visited = work.visited as f64 / n as f64;
            let expected = if matches!(order, HintOrder::Random { .. }) { 4.8..5.05 } else { 4.1..4.35 };
            assert!(expected.contains(&visited), "{order:?} {n}: {visited}");
            // Spatial sort alone: 6.6.
            let d =
                Delaunay3::with_algorithm(&instance, Algorithm3::Incremental { seed: 1 }).expect("finite");
            let visited = d.counters().work().expect("counted").visited as f64 / n as f64;
            assert!((5.4..6.0).contains(&visited), "spatial sort {n}: {visited}");
        }
    }
}

#[test]
fn moving_points_are_repaired_or_rebuilt_into_the_canonical_triangulation() {
    for &kind in Kind::ALL {
        let n = 400;
        let start = kind.points(n, 1);
        let spacing = size(&start) / (n as f64).sqrt();
        let mut moving = Moving2::from_points(&start).expect("finite");
        same(moving.triangulation(), &start, kind.name());
        let mut random = Random::new(2);
        let mut points = start.clone();
        for round in 0..100 {
            let share = [0.0, 1e-9, 0.001, 0.01, 0.05, 0.1, 0.3, 1.0, 10.0, 0.02][round % 10];
            for p in &mut points {
                let there = p.map(|x| x + spacing * share * random.between(-1.0, 1.0));
                if there.iter().all(|x| x.is_finite()) {
                    *p = there;
                }
            }
            if round == 17 {
                points = vec![[1.0, 1.0]; n];
            }
            if round == 18 {
                points.clone_from(&start);
            }
            if round == 25 {
                points[3] = points[n - 1];
            }
            let step = moving.step(&points).expect("finite");
            same(moving.triangulation(), &points, &format!("{} {round} {step:?}", kind.name()));
        }
    }
    let mut moving = Moving2::from_points(&[[0.0, 0.0], [1.0, 0.0]]).expect("finite");
    assert_eq!(moving.step(&[[0.0, 0.0]]), Err(Error::Length { expected: 2, found: 1 }));
    assert!(moving.step(&[[0.0, 0.0], [f64::NAN, 0.0]]).is_err());
    assert_eq!(moving.triangulation().points(), [[0.0, 0.0], [1.0, 0.0]]);
}

/// Motions that cannot be repaired: equal points that part, lines that bend, a set that is turned over.
#[test]
fn motions_between_dimensions_are_rebuilt() {
    let square = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]];
    let with = |at: usize, p: [f64; 2]| {
        let mut points = square.to_vec();
        points.insert(at, p);
        points
    };
    let line = |bend: f64| vec![[0.0, 0.0], [1.0, bend], [2.0, 0.0], [3.0, 0.0]];
    let steps = [
        (with(4, square[1]), with(4, [2.0, 1.0])),
        (with(0, square[3]), with(0, [2.0, 1.0])),
        (with(4, [2.0, 1.0]), with(4, square[1])),
        (line(0.0), line(1.0)),
        (line(1.0), line(0.0)),
        (line(0.0), line(0.0)),
        (vec![[0.0, 0.0], [4.0, 0.0], [0.0, 4.0]], vec![[0.0, 0.0], [4.0, 0.0], [0.0, -4.0]]),
    ];
    for (from, to) in steps {
        let mut moving = Moving2::from_points(&from).expect("finite");
        assert_eq!(moving.step(&to), Ok(Step2::Rebuilt), "{from:?} to {to:?}");
        same(moving.triangulation(), &to, &format!("{from:?} to {to:?}"));
    }
}

/// Rounding lies about circles through tenths; the box around them is twice as wide as its largest coordinate.
#[test]
fn motions_onto_a_grid_around_the_origin_are_repaired() {
    // Around all, four that stay.
    let mut grid = vec![[-2.0, -2.0], [2.0, -2.0], [2.0, 2.0], [-2.0, 2.0]];
    grid.extend((0..441).map(|i| [i % 21, i / 21].map(|k| f64::from(k - 10) * 0.1)));
    let mut random = Random::new(3);
    for _ in 0..3 {
        let mut near: Vec<_> = grid.iter().map(|p| p.map(|x| x + 0.01 * random.between(-1.0, 1.0))).collect();
        near[..4].copy_from_slice(&grid[..4]);
        let mut moving = Moving2::from_points(&near).expect("finite");
        let step = moving.step(&grid).expect("finite");
        assert!(matches!(step, Step2::Repaired { .. }), "{step:?}");
        same(moving.triangulation(), &grid, "tenths");
    }
}

#[test]
fn small_motions_are_repaired() {
    let n = 20_000;
    let mut points = Kind::Uniform.points(n, 1);
    let spacing = 1.0 / (n as f64).sqrt();
    let mut moving = Moving2::from_points(&points).expect("finite");
    let mut random = Random::new(2);
    for round in 0..4 {
        for p in &mut points {
            *p = p.map(|x| x + 0.05 * spacing * random.between(-1.0, 1.0));
        }
        let step = moving.step(&points).expect("finite");
        assert!(
            matches!(step, Step2::Repaired { flips, reinserted } if flips > 0 && reinserted < n / 20),
            "{step:?}"
        );
        same(moving.triangulation(), &points, &format!("{round}"));
    }
}

/// A vertex goes through the edge in front of it, which is turned; nothing needs to be removed for that.
#[test]
fn a_flip_mends_what_turns_over() {
    let box_around = [[-50.0, -50.0], [50.0, -50.0], [50.0, 50.0], [-50.0, 50.0]];
    let with = |x: [f64; 2]| [&[[0.0, 0.0], [2.0, 0.0], [1.0, -3.0], x][..], &box_around].concat();
    let mut moving = Moving2::from_points(&with([1.0, 3.0])).expect("finite");
    let points = with([1.0, -0.125]);
    let step = moving.step(&points).expect("finite");
    assert!(matches!(step, Step2::Repaired { reinserted: 0, .. }), "{step:?}");
    same(moving.triangulation(), &points, "turned");
    // Where a removal would leave a line, all is built anew.
    let mut moving = Moving2::from_points(&[[0.0, 0.0], [2.0, 0.0], [1.0, 1.0]]).expect("finite");
    let mirrored = [[0.0, 0.0], [2.0, 0.0], [1.0, -1.0]];
    assert_eq!(moving.step(&mirrored), Ok(Step2::Rebuilt));
    same(moving.triangulation(), &mirrored, "mirrored");
}

/// Beyond one vertex in twelve, and some, repairing takes longer than building.
#[test]
fn where_too_much_turns_over_all_is_built_anew() {
    let points = Kind::Uniform.points(2000, 1);
    let mut moving = Moving2::from_points(&points).expect("finite");
    let mut random = Random::new(5);
    let (mut repaired, mut rebuilt, mut most) = (0, 0, 0);
    for round in 0..60 {
        let share = f64::from(round % 20) * 0.03 / 2000f64.sqrt();
        let there: Vec<[f64; 2]> =
            points.iter().map(|p| p.map(|x| x + share * random.between(-1.0, 1.0))).collect();
        match moving.step(&there).expect("finite") {
            Step2::Repaired { reinserted, .. } => {
                repaired += 1;
                most = most.max(reinserted);
            }
            _ => rebuilt += 1,
        }
        same(moving.triangulation(), &there, "moved");
    }
    assert!(repaired > 5 && rebuilt > 5 && most <= 2000 / 12 + 8, "{repaired} {rebuilt} {most}");
}

#[test]
fn moving_points_in_space_are_repaired_or_rebuilt_into_the_canonical_triangulation() {
    let mut repaired = [0; 10];
    for &kind in Kind3::ALL {
        let n = match kind {
            Kind3::HugeSpan3 => 40,
            _ if all_cases() => 300,
            _ => 100,
        };
        let start = kind.points(n, 1);
        let spacing = size(&start) / (n as f64).cbrt();
        let mut moving = Moving3::from_points(&start).expect("finite");
        same_in_space(moving.triangulation(), &start, kind.name());
        let mut random = Random::new(2);
        let mut points = start.clone();
        for round in 0..100 {
            let share = [0.0, 1e-9, 1e-5, 0.0001, 0.0003, 0.001, 0.01, 0.1, 1.0, 10.0][round % 10];
            for p in &mut points {
                let there = p.map(|x| x + spacing * share * random.between(-1.0, 1.0));
                if there.iter().all(|x| x.is_finite()) {
                    *p = there;
                }
            }
            match round {
                17 => points = vec![[1.0, 1.0, 2.0]; n],
                18 => points.clone_from(&start),
                25 => points[3] = points[n - 1],
                // A few go far while the others stay.
                40 | 50 | 60 => points[5] = points[n / 2].map(|x| x + spacing * 0.01),
                41 | 51 | 61 => points[7] = points[0].map(|x| x + spacing * 2.0),
                42 | 52 => points[9][2] += 3.0 * size(&start),
                _ => {}
            }
            let step = moving.step(&points).expect("finite");
            repaired[round % 10] += usize::from(matches!(step, Step3::Repaired { .. }));
            same_in_space(moving.triangulation(), &points, &format!("{} {round} {step:?}", kind.name()));
        }
    }
    assert!(repaired[0] > 60 && repaired[3] > 40 && repaired[9] == 0, "{repaired:?}");
    let start = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]];
    let mut moving = Moving3::from_points(&start).expect("finite");
    assert_eq!(moving.step(&start[1..]), Err(Error::Length { expected: 2, found: 1 }));
    assert!(moving.step(&[start[0], [f64::NAN, 0.0, 0.0]]).is_err());
    same_in_space(moving.triangulation(), &start, "after errors");
}

/// The longer side of the box around points.
fn size<const D: usize>(points: &[[f64; D]]) -> f64 {
    let along = |k: usize| points.iter().map(move |p| p[k]);
    let extent = |k| along(k).fold(f64::MIN, f64::max) / 2.0 - along(k).fold(f64::MAX, f64::min) / 2.0;
    2.0 * (0..D).map(extent).fold(0.0, f64::max)
}
