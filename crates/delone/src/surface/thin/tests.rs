//! Tests of thinning: the rest is near all points by an independent triangulation, and is what rounds by definition choose.

use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

use delone_generators::{Kind, Random};
use delone_predicates::lexicographic;

use super::lattice::Lattice;
use super::{Samples, Thinned, Thinning, Verdict};
use crate::surface::Grid;
use crate::{Constrained2, Delaunay2, Error, VertexId};

fn heights(points: &[[f64; 2]]) -> Vec<f64> {
    points.iter().map(|p| 10.0 * (6.0 * p[0]).sin() * (4.0 * p[1]).cos() + p[0]).collect()
}

/// The height of the plane over three corners, by the definition in long arithmetic order.
fn plane(c: [[f64; 2]; 3], z: [f64; 3], q: [f64; 2]) -> f64 {
    let cross =
        |a: [f64; 2], b: [f64; 2], c: [f64; 2]| (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    let weights = [cross(q, c[1], c[2]), cross(q, c[2], c[0]), cross(q, c[0], c[1])];
    let all: f64 = weights.iter().sum();
    weights.iter().zip(z).map(|(w, z)| w * z).sum::<f64>() / all
}

/// The largest error of all points over the triangles of those that are left.
fn error(points: &[[f64; 2]], z: &[f64], left: &[usize], segments: &[[usize; 2]]) -> f64 {
    let chosen: Vec<[f64; 2]> = left.iter().map(|&i| points[i]).collect();
    let place = |i: usize| left.iter().position(|&j| points[j] == points[i]).expect("an end is left");
    let segments: Vec<[usize; 2]> = segments.iter().map(|ends| ends.map(place)).collect();
    let c = Constrained2::from_parts(&chosen, &segments).expect("valid");
    if c.triangle_count() == 0 {
        return 0.0;
    }
    let mut worst = 0.0_f64;
    for (&q, z_q) in points.iter().zip(z) {
        let found = crate::Ask::find(&c, q).expect("finite");
        let t = found.simplex.expect("inside of the hull");
        let corners = c.mesh().corners(t);
        let height = |v: VertexId| z[left[v.index()]];
        worst = worst.max((z_q - plane(corners.map(|v| c.point(v)), corners.map(height), q)).abs());
    }
    worst
}

#[test]
fn all_points_are_near() {
    for kind in [Kind::Uniform, Kind::Clusters, Kind::Grid, Kind::Circle, Kind::Ellipse2] {
        let points = kind.points(600, 5);
        let z = heights(&points);
        for bound in [5.0, 1.0, 0.1, 0.0] {
            let thinned = Thinning::new().max_error(bound).points(&points, &z, &[]).expect("valid");
            let found = error(&points, &z, &thinned.vertices, &[]);
            // Planes over slivers are rounded more by the definition.
            assert!(found <= bound + 1e-6, "{} {bound}: {found}", kind.name());
            assert!((thinned.error - found).abs() < 1e-6, "{}: {} and {found}", kind.name(), thinned.error);
        }
    }
}

/// The worst of the points that are left out of each triangle, the worst of all first, and the corners of the triangles.
fn worst_by_definition(points: &[[f64; 2]], z: &[f64], left: &[usize]) -> Vec<(f64, usize, [usize; 3])> {
    let chosen: Vec<[f64; 2]> = left.iter().map(|&i| points[i]).collect();
    let d = Delaunay2::from_points(&chosen).expect("finite");
    let mut worst: Vec<(f64, usize, [usize; 3])> = Vec::new();
    for i in (0..points.len()).filter(|i| !left.contains(i)) {
        let t = crate::Ask::find(&d, points[i]).expect("finite").simplex.expect("inside");
        let mut corners = d.mesh().corners(t).map(|v| left[v.index()]);
        let at = |f: &dyn Fn(usize) -> f64| corners.map(f);
        let error = (z[i] - plane(corners.map(|i| points[i]), at(&|i| z[i]), points[i])).abs();
        corners.sort_unstable();
        match worst.iter_mut().find(|other| other.2 == corners) {
            Some(other) if other.0 < error => *other = (error, i, corners),
            Some(_) => {}
            None => worst.push((error, i, corners)),
        }
    }
    worst.sort_unstable_by(|a, b| b.0.total_cmp(&a.0));
    worst
}

/// The corners of the hull.
fn start(points: &[[f64; 2]]) -> Vec<usize> {
    let mut start = crate::Hull2::from_points(points).expect("finite").corners().to_vec();
    start.sort_unstable();
    start
}

/// Rounds by their definition, with a new triangulation for each point; then what is not needed goes, from the last one on.
fn by_definition(points: &[[f64; 2]], z: &[f64], bound: f64) -> Vec<usize> {
    let mut left = start(points);
    let first = left.len();
    loop {
        let before = left.len();
        for (error, i, corners) in worst_by_definition(points, z, &left) {
            if error <= bound || left.contains(&i) {
                continue;
            }
            let chosen: Vec<[f64; 2]> = left.iter().map(|&i| points[i]).collect();
            let d = Delaunay2::from_points(&chosen).expect("finite");
            let t = crate::Ask::find(&d, points[i]).expect("finite").simplex.expect("inside");
            let mut there = d.mesh().corners(t).map(|v| left[v.index()]);
            let now = (z[i] - plane(there.map(|i| points[i]), there.map(|i| z[i]), points[i])).abs();
            there.sort_unstable();
            if there == corners || now > bound.max(error / 2.0) {
                left.push(i);
            }
        }
        if left.len() == before {
            break;
        }
    }
    for k in (first..left.len()).rev() {
        let without: Vec<usize> = left.iter().copied().filter(|&i| i != left[k]).collect();
        if error(points, z, &without, &[]) <= bound {
            left = without;
        }
    }
    left
}

#[test]
fn rounds_are_those_of_the_definition() {
    for seed in 0..6 {
        let points = Kind::Uniform.points(150, seed);
        // Rough heights, so that rounding decides nothing.
        let mut random = Random::new(seed);
        let z: Vec<f64> = points.iter().map(|_| random.below(1_000_003) as f64 / 1e5).collect();
        for bound in [2.0, 4.0] {
            let thinned = Thinning::new().max_error(bound).points(&points, &z, &[]).expect("valid");
            assert_eq!(thinned.vertices, by_definition(&points, &z, bound));
        }
        // Where their number is bounded it is always the worst of all.
        let mut greedy = start(&points);
        while greedy.len() < 90 {
            greedy.push(worst_by_definition(&points, &z, &greedy)[0].1);
        }
        for count in [60, 90] {
            let few = Thinning::new().max_points(count).points(&points, &z, &[]).expect("valid");
            assert_eq!(few.vertices, greedy[..count]);
        }
    }
}

/// Rounds are measured on several threads where they are large.
#[test]
#[cfg(feature = "rayon")]
fn threads_do_not_show() {
    let grid = Grid::new([0.0, 0.0], [1.0, -1.0], 230, 190).expect("a raster");
    let z: Vec<f64> = (0..230 * 190)
        .map(|i| f64::from(i % 230) / 17.0)
        .zip((0..230 * 190).map(|i| f64::from(i / 230) / 11.0))
        .map(|(x, y)| 20.0 * (x.sin() + (y + 0.3 * x).cos()) + ((x * 97.0).sin() * 43.0).fract())
        .collect();
    let thin = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| Thinning::new().max_error(0.3).raster(&grid, &z).expect("valid"))
    };
    let one = thin(1);
    assert!(one.vertices.len() > 2000, "rounds are large: {}", one.vertices.len());
    assert_eq!(thin(4), one);
}

#[test]
fn the_order_of_the_input_does_not_show() {
    let points = Kind::Clusters.points(500, 2);
    let z = heights(&points);
    let thin = |points: &[[f64; 2]], z: &[f64]| {
        let Thinned { vertices, error } =
            Thinning::new().max_error(0.5).points(points, z, &[]).expect("valid");
        let hull = crate::Hull2::from_points(points).expect("finite").corners().len();
        let mut chosen: Vec<[u64; 2]> = vertices.iter().map(|&i| points[i].map(f64::to_bits)).collect();
        chosen[..hull].sort_unstable();
        (chosen, error)
    };
    let order: Vec<usize> = (0..500).map(|i| (i * 7 + 3) % 500).collect();
    let other: Vec<[f64; 2]> = order.iter().map(|&i| points[i]).collect();
    let z_other: Vec<f64> = order.iter().map(|&i| z[i]).collect();
    assert_eq!(thin(&points, &z), thin(&other, &z_other));
}

#[test]
fn segments_stay() {
    let mut points = Kind::Uniform.points(400, 8);
    // A cross of two breaklines that share a point, and points on one of them.
    let first = points.len();
    points.extend([[0.1, 0.5], [0.5, 0.5], [0.9, 0.5], [0.5, 0.1], [0.5, 0.9], [0.25, 0.5], [0.75, 0.5]]);
    let segments =
        [[first, first + 1], [first + 1, first + 2], [first + 3, first + 1], [first + 1, first + 4]];
    let z: Vec<f64> = points.iter().map(|p| (p[0] - 0.5).abs() + 3.0 * (p[1] - 0.5).max(0.0)).collect();
    for bound in [0.3, 0.05, 0.0] {
        let thinned = Thinning::new().max_error(bound).points(&points, &z, &segments).expect("valid");
        assert!((first..first + 5).all(|i| thinned.vertices.contains(&i)), "ends of segments");
        let found = error(&points, &z, &thinned.vertices, &segments);
        assert!(found <= bound + 1e-9, "{bound}: {found}");
        assert!((thinned.error - found).abs() < 1e-9);
    }
}

/// Segments may meet at a point inside of both: it is where their edges end, so it stays.
#[test]
fn segments_meet_at_points() {
    let points: Vec<[f64; 2]> = (0..121).map(|i| [f64::from(i % 11), f64::from(i / 11)]).collect();
    let flat = vec![0.0; points.len()];
    let thin = |segments: &[[usize; 2]]| Thinning::new().max_error(1.0).points(&points, &flat, segments);
    assert_eq!(thin(&[[0, 120], [10, 110]]).expect("valid").vertices, [0, 10, 60, 110, 120]);
    let star = thin(&[[55, 65], [5, 115], [0, 120], [20, 100]]).expect("valid");
    assert_eq!(star.vertices, [0, 5, 10, 20, 55, 60, 65, 100, 110, 115, 120]);
    assert!(matches!(thin(&[[0, 120], [1, 11]]), Err(Error::SegmentsCross { first: 0, second: 1, .. })));
}

#[test]
fn rasters_are_thinned_as_points() {
    for (columns, rows) in [(40, 30), (2, 2), (65, 9), (33, 64)] {
        for missing in [0, 7, 2] {
            let grid = Grid::new([100.0, 50.0], [0.1, -0.1], columns, rows).expect("a raster");
            let centers: Vec<[f64; 2]> =
                (0..rows).flat_map(|r| (0..columns).map(move |c| grid.center(c, r))).collect();
            let mut z = heights(&centers);
            let has_data = |i: usize| missing == 0 || (i * i) % 11 >= missing;
            (0..z.len()).filter(|&i| !has_data(i)).for_each(|i| z[i] = f64::NAN);
            for bound in [3.0, 0.3, 0.0] {
                let thinned = Thinning::new().max_error(bound).raster(&grid, &z).expect("valid");
                let there: Vec<usize> = (0..z.len()).filter(|&i| has_data(i)).collect();
                let points: Vec<[f64; 2]> = there.iter().map(|&i| centers[i]).collect();
                let heights: Vec<f64> = there.iter().map(|&i| z[i]).collect();
                let left: Vec<usize> = thinned
                    .vertices
                    .iter()
                    .map(|i| there.binary_search(i).expect("a cell with data"))
                    .collect();
                let found = error(&points, &heights, &left, &[]);
                assert!(found <= bound + 1e-6, "{columns} {rows} {missing} {bound}: {found}");
                assert!((thinned.error - found).abs() <= 1e-6, "{} {found}", thinned.error);
                // As many as of the points, but for rounding.
                let points = Thinning::new().max_error(bound).points(&points, &heights, &[]).expect("valid");
                let (a, b) = (points.vertices.len() as f64, left.len() as f64);
                assert!((a - b).abs() <= 0.05 * a + 4.0, "{a} points, {b} cells");
            }
        }
    }
}

/// Blocks that are left out hold no worse cell, and no equally bad one that comes first.
#[test]
fn blocks_hide_nothing() {
    let mut random = Random::new(4);
    let (columns, rows) = (61, 45);
    for round in 0..6 {
        let step = [[0.5, -0.5], [-0.5, 0.25]][round % 2];
        let grid = Grid::new([3.0, 7.0], step, columns, rows).expect("a raster");
        // Steep and smooth, in steps so that many errors are equal, rough, and with holes.
        let height = |i: usize, random: &mut Random| {
            let (x, y) = ((i % columns) as f64, (i / columns) as f64);
            match round {
                0 | 1 => 40.0 * x - 30.0 * y + 0.01 * x * y,
                2 | 3 => (x / 5.0).floor() + (y / 7.0).floor(),
                _ if random.below(9) == 0 => f64::NAN,
                _ => random.between(-3.0, 3.0) + 5.0 * x,
            }
        };
        let z: Vec<f64> = (0..columns * rows).map(|i| height(i, &mut random)).collect();
        let samples = Lattice::new(&grid, &z);
        for _ in 0..400 {
            let corners = [0; 3].map(|_| random.below(z.len()) as u32);
            if corners.iter().any(|&s| !samples.is_there(s)) {
                continue;
            }
            let seen: Vec<AtomicBool> = z.iter().map(|_| AtomicBool::default()).collect();
            let mut verdict = Verdict::new(f64::INFINITY, &seen);
            samples.judge(corners, 0, &mut verdict);
            let floor = [0.0, verdict.largest / 2.0, verdict.largest][random.below(3)];
            let inside =
                (0..z.len() as u32).filter(|&s| seen[s as usize].load(Relaxed) && samples.is_there(s));
            let worst = inside
                .map(|s| (samples.error(corners, s), s))
                .filter(|worst| worst.0 > floor)
                .max_by(|a, b| {
                    let by_point = lexicographic(samples.point(b.1), samples.point(a.1));
                    a.0.total_cmp(&b.0).then(by_point)
                });
            let found = samples.worst(corners, floor);
            assert_eq!(found, worst, "{round} {corners:?}");
            assert_eq!(worst.map_or(floor, |worst| worst.0), floor.max(verdict.largest));
        }
    }
}

#[test]
fn what_spans_no_plane_stays_whole() {
    let line: Vec<[f64; 2]> = (0..5).map(|i| [f64::from(i), 2.0 * f64::from(i)]).collect();
    let thinned = Thinning::new().max_error(9.0).points(&line, &[1.0; 5], &[]).expect("valid");
    assert_eq!(thinned.vertices.len(), 5);
    let none = Thinning::new().points(&[], &[], &[]).expect("valid");
    assert_eq!((none.vertices.len(), none.error), (0, 0.0));
    let grid = Grid::new([0.0; 2], [1.0, -1.0], 3, 1).expect("a raster");
    let row = Thinning::new().max_error(9.0).raster(&grid, &[1.0, f64::NAN, 2.0]).expect("valid");
    assert_eq!(row.vertices, [0, 2]);
    let equal =
        Thinning::new().points(&[[0.0; 2], [1.0, 0.0], [0.0, 1.0], [0.0; 2]], &[1.0, 2.0, 3.0, 9.0], &[]);
    assert_eq!(equal.expect("valid").vertices, [0, 1, 2]);
}

#[test]
fn what_is_wrong_is_named() {
    let points = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
    let thin = |bound: f64, z: &[f64], segments: &[[usize; 2]]| {
        Thinning::new().max_error(bound).points(&points, z, segments).map(|_| ()).expect_err("refused")
    };
    let z = [0.0; 4];
    assert!(matches!(thin(-1.0, &z, &[]), Error::Parameter { .. }));
    assert!(matches!(thin(f64::NAN, &z, &[]), Error::Parameter { .. }));
    assert!(matches!(thin(1.0, &z[..3], &[]), Error::Values { expected: 4, found: 3 }));
    assert!(matches!(thin(1.0, &[0.0, f64::NAN, 0.0, 0.0], &[]), Error::Height { index: 1, .. }));
    assert!(matches!(thin(1.0, &z, &[[0, 4]]), Error::NoSuchPoint { segment: 0, index: 4, count: 4 }));
    assert!(matches!(thin(1.0, &z, &[[0, 3], [1, 2]]), Error::SegmentsCross { .. }));
}

/// Where slopes are beyond what numbers can tell, points are measured all the same.
#[test]
fn thin_triangles_hide_no_points() {
    let sets: [&[([f64; 2], f64)]; 4] = [
        &[
            ([999_999_999.9, 1e9], -2.0),
            ([1_000_000_000.1, 1e9], 2.0),
            ([1e9, 1_000_000_000.1], -2.0),
            ([-6.1, 5.2], 2.0),
        ],
        &[([-1.0, 0.0], 1.0), ([-1.0, -1e-310], 2.0), ([-2.3e-308, -1.0], -1.0), ([-1.0, -5e-324], -1.0)],
        &[
            ([3e-323, 2e-323], -1.0),
            ([0.0, -4e-323], 2.0),
            ([0.0, -1.5e-323], 0.0),
            ([-2e-323, -2e-323], 2.0),
        ],
        &[([0.0, 0.0], -1e308), ([2.0, 0.0], 1e308), ([0.0, 2.0], 1e308), ([1.0, 0.5], -1e308)],
    ];
    for set in sets {
        let (points, heights): (Vec<_>, Vec<_>) = set.iter().copied().unzip();
        let thinned = Thinning::new().points(&points, &heights, &[]).expect("finite");
        assert_eq!((thinned.vertices.len(), thinned.error), (4, 0.0), "{set:?}: {thinned:?}");
    }
    // The same on a raster.
    let grid = Grid::new([0.0, 3.0], [1.0, -1.0], 3, 3).expect("a grid");
    let mut values = [-1e308; 9];
    values[4] = 1e308;
    let thinned = Thinning::new().raster(&grid, &values).expect("finite");
    assert_eq!((thinned.vertices, thinned.error), (vec![0, 2, 6, 8, 4], 0.0));
}

/// The height in a triangle, however thin, from areas in integers: coordinates are multiples of 2^-44 here.
fn exact_height(c: [[f64; 2]; 3], z: [f64; 3], q: [f64; 2]) -> f64 {
    let whole = |x: f64| {
        let scaled = x * 2f64.powi(44);
        assert!(scaled.fract() == 0.0 && scaled.abs() < 2f64.powi(60), "{x}");
        scaled as i128
    };
    let cross = |a: [f64; 2], b: [f64; 2], c: [f64; 2]| {
        let [a, b, c] = [a, b, c].map(|p| p.map(whole));
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    };
    let weights = [cross(q, c[1], c[2]), cross(q, c[2], c[0]), cross(q, c[0], c[1])];
    let all = weights.iter().sum::<i128>() as f64;
    weights.iter().zip(z).map(|(&w, z)| w as f64 / all * z).sum()
}

/// Cells on a line are the corners of thin triangles where their centers are rounded.
#[test]
fn rasters_with_slanted_borders_and_rounded_cells_are_near() {
    let mut random = Random::new(5);
    let mut thin = 0;
    for (round, side) in
        [0.1, 0.3, 0.7, 1.1, 0.1, 1.0 / 3.0, 0.1, 2.7].into_iter().cycle().take(120).enumerate()
    {
        let n = 8 + random.below(16);
        let down = if round % 2 == 0 { side } else { -side };
        let origin = [500.1, 700.3].map(|x: f64| (x / side).round() * side);
        let grid = Grid::new(origin, [side, down], n, n).expect("a grid");
        let [a, b] = [1 + random.below(3), 1 + random.below(3)];
        let mut values: Vec<f64> = (0..n * n)
            .map(|i| if a * (i % n) > b * (i / n) { f64::NAN } else { (0.4 * (i % n) as f64).sin() * 3.0 })
            .collect();
        values.iter_mut().for_each(|z| *z += random.unit());
        let bound = [0.5, 1.5, 3.0][round % 3];
        let thinned = Thinning::new().max_error(bound).raster(&grid, &values).expect("valid");
        let center = |i: usize| grid.center(i % n, i / n);
        let chosen: Vec<[f64; 2]> = thinned.vertices.iter().map(|&i| center(i)).collect();
        let d = Delaunay2::from_points(&chosen).expect("finite");
        let mut worst = 0.0_f64;
        for i in (0..n * n).filter(|&i| !values[i].is_nan()) {
            let t = crate::Ask::find(&d, center(i)).expect("finite").simplex.expect("inside of the hull");
            let corners = d.mesh().corners(t);
            let height = |v: VertexId| values[thinned.vertices[v.index()]];
            let at = exact_height(corners.map(|v| d.point(v)), corners.map(height), center(i));
            worst = worst.max((values[i] - at).abs());
        }
        assert!(worst <= bound + 1e-9, "{round}: {worst} where {bound} is allowed");
        assert!((thinned.error - worst).abs() < 1e-9, "{round}: {} and {worst}", thinned.error);
        let on_line = |t| {
            let [a, b, c] = d.mesh().corners(t).map(|v| thinned.vertices[v.index()] as i64);
            let n = n as i64;
            (b % n - a % n) * (c / n - a / n) == (b / n - a / n) * (c % n - a % n)
        };
        thin += d.triangle_ids().filter(|&t| on_line(t)).count();
    }
    assert!(thin > 20, "{thin}");
}

/// Rounding of centers by more than a part of a cell: then cells are points.
#[test]
fn rasters_of_coarse_coordinates_are_near() {
    let grid = Grid::new([1e15, 1e15], [0.3, 0.3], 12, 9).expect("a grid");
    let values: Vec<f64> = (0..108).map(|i| f64::from(i % 7) * 1.5 + f64::from(i / 12)).collect();
    let centers: Vec<[f64; 2]> = (0..108).map(|i| grid.center(i % 12, i / 12)).collect();
    let by_points = Thinning::new().max_error(1.0).points(&centers, &values, &[]).expect("valid");
    assert_eq!(Thinning::new().max_error(1.0).raster(&grid, &values).expect("valid"), by_points);
}

#[test]
fn heights_at_the_end_of_numbers() {
    let points = [[0.0, 0.0], [4.0, 4.03], [8.0, 8.0], [4.0, 4.01]];
    for high in [1e300, 2e306, f64::MAX] {
        let z = [0.0, high, 0.0, -high];
        let thinned = Thinning::new().points(&points, &z, &[]).expect("valid");
        assert_eq!((thinned.vertices.len(), thinned.error), (4, 0.0), "{high}");
        let one = Thinning::new().max_points(3).points(&points, &z, &[]).expect("valid");
        // On the slope between a corner of the hull that is high and the base.
        assert!(one.error > high, "{high}: {}", one.error);
        let some = Thinning::new().max_error(3.0 * (high / 2.0)).points(&points, &z, &[]).expect("valid");
        assert!(some.vertices.len() == 3 && some.error <= 3.0 * (high / 2.0), "{high}: {some:?}");
    }
}

/// Many segments that meet at one point, which is no end of theirs: what crosses is not asked for where nothing does.
#[test]
fn many_segments_meet_at_one_point() {
    let count = 400;
    let mut points = vec![[0.0, 0.0]];
    let mut segments = Vec::new();
    for k in 0..count {
        let p = [f64::from(k + 1), f64::from((k * 37) % 401 + 1)];
        segments.push([points.len(), points.len() + 1]);
        points.extend([p, p.map(|x| -x)]);
    }
    let z = heights(&points.iter().map(|p| p.map(|x| x / 400.0)).collect::<Vec<_>>());
    let thinned =
        Thinning::new().max_error(1.0).points(&points, &z, &segments).expect("they meet at a point");
    assert!(thinned.vertices.contains(&0));
    assert!(error(&points, &z, &thinned.vertices, &segments) <= 1.0 + 1e-6);
}
