//! Voronoi cells of lines: against distances from all segments.

use delone::{Constrained2, Error, LineCells2, Region2, VertexId};
use delone_generators::Random;

type Lines = (Vec<[f64; 2]>, Vec<[usize; 2]>, Vec<usize>);

/// Chains that cross, one of which begins at a corner of another.
fn chains(seed: u64, count: usize) -> Lines {
    let mut random = Random::new(seed);
    let (mut points, mut segments, mut lines) = (Vec::new(), Vec::new(), Vec::new());
    for line in 0..count {
        let mut p = [random.unit(), random.unit()];
        if line == 1 {
            p = points[1];
        }
        points.push(p);
        for _ in 0..=(line % 4) {
            p = p.map(|x: f64| x + 0.3 * (random.unit() - 0.5));
            points.push(p);
            segments.push([points.len() - 2, points.len() - 1]);
            lines.push(line);
        }
    }
    (points, segments, lines)
}

fn distance(q: [f64; 2], [a, b]: [[f64; 2]; 2]) -> f64 {
    let (u, w) = ([b[0] - a[0], b[1] - a[1]], [q[0] - a[0], q[1] - a[1]]);
    let part = ((u[0] * w[0] + u[1] * w[1]) / (u[0] * u[0] + u[1] * u[1])).clamp(0.0, 1.0);
    // Of a segment without a length it is no number.
    let part = if part.is_nan() { 0.0 } else { part };
    (q[0] - a[0] - part * u[0]).hypot(q[1] - a[1] - part * u[1])
}

fn region() -> Region2 {
    Region2::rectangle([-0.5, -0.5], [1.5, 1.5]).expect("a box")
}

fn is_in(made: &LineCells2, line: usize, [x, y]: [f64; 2]) -> bool {
    let sides = made.cells.rings(VertexId::new(line)).flat_map(|ring| ring.sides());
    let crossed = sides
        .filter(|[p, q]| (p[1] > y) != (q[1] > y) && x < p[0] + (y - p[1]) / (q[1] - p[1]) * (q[0] - p[0]));
    crossed.count() % 2 == 1
}

#[test]
fn places_belong_to_the_nearest_line_within_the_tolerance() {
    let mut off = 0;
    for seed in 0..12 {
        let count = 2 + seed as usize;
        let (points, segments, lines) = chains(seed, count);
        for tolerance in [0.1, 0.003] {
            let made = LineCells2::new(&points, &segments, &lines, &region(), tolerance).expect("cells");
            let areas: f64 = (0..count).map(|line| made.cells.area(VertexId::new(line))).sum();
            assert!((areas - 4.0).abs() < 1e-12, "{areas}");
            assert!(made.deviation <= tolerance);
            let mut random = Random::new(seed + 100);
            for _ in 0..400 {
                let q = [0, 1].map(|_| 2.0 * random.unit() - 0.5);
                let from = |line: usize| {
                    let own = segments.iter().zip(&lines).filter(|one| *one.1 == line);
                    own.map(|(ends, _)| distance(q, ends.map(|i| points[i]))).fold(f64::INFINITY, f64::min)
                };
                let distances: Vec<f64> = (0..count).map(from).collect();
                let least = distances.iter().copied().fold(f64::INFINITY, f64::min);
                let owners: Vec<usize> = (0..count).filter(|&line| is_in(&made, line, q)).collect();
                assert_eq!(owners.len(), 1, "{q:?}");
                // Where a border is off by the tolerance, distances differ by at most twice as much.
                let more = distances[owners[0]] - least;
                assert!(more <= 2.0 * tolerance, "{more} at {q:?}, {seed}");
                off += usize::from(more > 0.0);
            }
        }
    }
    assert!(off > 0);
}

#[test]
fn cells_are_a_function_of_the_lines() {
    let (points, segments, lines) = chains(5, 6);
    let made = LineCells2::new(&points, &segments, &lines, &region(), 0.01).expect("cells");
    let areas =
        |made: &LineCells2| (0..6).map(|line| made.cells.area(VertexId::new(line))).collect::<Vec<_>>();
    // Segments in another order and direction.
    let turned: Vec<[usize; 2]> = segments.iter().rev().map(|&[v, w]| [w, v]).collect();
    let back: Vec<usize> = lines.iter().rev().copied().collect();
    let other = LineCells2::new(&points, &turned, &back, &region(), 0.01).expect("cells");
    assert_eq!(made.sites.len(), other.sites.len());
    let close = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-12);
    assert!(close(&areas(&made), &areas(&other)));
    // Powers of two.
    for power in [-660, -300, 40, 300, 660] {
        let by = 2.0_f64.powi(power);
        let scaled: Vec<[f64; 2]> = points.iter().map(|p| p.map(|x| x * by)).collect();
        let box_of = Region2::rectangle([-0.5 * by; 2], [1.5 * by; 2]).expect("a box");
        let other = LineCells2::new(&scaled, &segments, &lines, &box_of, 0.01 * by).expect("cells");
        assert_eq!((made.rounds, made.sites.len()), (other.rounds, other.sites.len()));
        assert!(made.sites.iter().zip(&other.sites).all(|(p, q)| p.map(|x| x * by) == *q));
        assert_eq!(made.deviation * by, other.deviation);
    }
}

/// Pieces that several lines share are the first one's, and crossings are no error.
#[test]
fn lines_may_overlap_and_cross() {
    let points = [[0.0, 0.0], [1.0, 0.0], [0.5, 0.0], [1.0, 1.0], [0.0, 1.0], [1.0, -0.4]];
    let segments = [[0, 1], [2, 1], [1, 3], [4, 5]];
    let made = LineCells2::new(&points, &segments, &[0, 1, 1, 2], &region(), 0.01).expect("cells");
    assert!(made.shared > 0);
    assert!((0..3).all(|line| made.cells.area(VertexId::new(line)) > 0.0));
    let none = LineCells2::new::<[f64; 2]>(&[], &[], &[], &region(), 0.01).expect("no cell");
    assert_eq!((none.sites.len(), none.rounds), (0, 1));
    let point = LineCells2::new(&[[0.0, 0.0]], &[[0, 0]], &[0], &region(), 0.01).expect("no length");
    assert_eq!((point.sites.len(), point.cells.area(VertexId::new(0))), (1, 4.0));
}

/// By how much more than the tolerance, at most, places are farther from their line than from the nearest one; and the areas in all.
fn worst(made: &LineCells2, lines: &[Vec<[f64; 2]>], [low, high]: [[f64; 2]; 2]) -> (f64, f64) {
    let mut random = Random::new(7);
    let mut worst: f64 = 0.0;
    for _ in 0..2000 {
        let q = [0, 1].map(|k| low[k] + (high[k] - low[k]) * random.unit());
        let from = |line: &Vec<[f64; 2]>| {
            line.windows(2).map(|two| distance(q, [two[0], two[1]])).fold(f64::INFINITY, f64::min)
        };
        let distances: Vec<f64> = lines.iter().map(from).collect();
        let least = distances.iter().copied().fold(f64::INFINITY, f64::min);
        let owners: Vec<usize> = (0..lines.len()).filter(|&line| is_in(made, line, q)).collect();
        assert_eq!(owners.len(), 1, "{q:?}");
        worst = worst.max(distances[owners[0]] - least);
    }
    (worst, (0..lines.len()).map(|line| made.cells.area(VertexId::new(line))).sum())
}

/// Points, segments and the line of each.
fn parts(lines: &[Vec<[f64; 2]>]) -> Lines {
    let (mut points, mut segments, mut of) = (Vec::new(), Vec::new(), Vec::new());
    for (number, line) in lines.iter().enumerate() {
        let first = points.len();
        points.extend(line);
        segments.extend((first + 1..points.len()).map(|i| [i - 1, i]));
        of.resize(segments.len(), number);
    }
    (points, segments, of)
}

/// Lines, and the lower left and upper right corner of a box.
type Case = (&'static [&'static [[f64; 2]]], [[f64; 2]; 2]);

/// Cells that no site tells of at first: they come in over the rim, or from pieces whose ends are far away.
#[test]
fn cells_are_found_beyond_the_rim() {
    let cases: [Case; 3] = [
        (&[&[[3.0, 3.0], [4.0, 4.0]], &[[2.0, 3.0], [1.0, 8.0]]], [[3.0, 3.0], [6.0, 6.0]]),
        (&[&[[5.0, 0.0], [5.0, 6.0]], &[[0.0, 7.0], [4.0, 8.0]]], [[3.0, 3.0], [6.0, 6.0]]),
        (
            &[&[[0.0, 2.0], [0.0, 4.0], [0.0, 0.0]], &[[3.0, 2.0], [0.0, 0.0]], &[[1.0, 2.0], [0.0, 4.0]]],
            [[-5.0, -3.0], [8.0, 11.0]],
        ),
    ];
    let mut random = Random::new(59);
    let any = |random: &mut Random| [(); 2].map(|()| random.below(9) as f64);
    let drawn = (0..60).map(|k| {
        let lines: Vec<Vec<[f64; 2]>> =
            (0..2 + k % 3).map(|_| (0..2 + k % 2).map(|_| any(&mut random)).collect()).collect();
        (lines, [[3.0, 3.0], [6.0, 6.0]])
    });
    let given = cases.map(|(lines, bounds)| (lines.iter().map(|line| line.to_vec()).collect(), bounds));
    for (lines, bounds) in given.into_iter().chain(drawn) {
        let (points, segments, of) = parts(&lines);
        let region = Region2::rectangle(bounds[0], bounds[1]).expect("a box");
        for tolerance in [0.05, 0.01] {
            let made = LineCells2::new(&points, &segments, &of, &region, tolerance).expect("cells");
            let (more, area) = worst(&made, &lines, bounds);
            let whole = (bounds[1][0] - bounds[0][0]) * (bounds[1][1] - bounds[0][1]);
            assert!(more <= 2.0 * tolerance && (area / whole - 1.0).abs() < 1e-9, "{more} {lines:?}");
        }
    }
}

/// However near another area is, and whatever it shares.
#[test]
fn the_inside_of_an_area_is_its_own() {
    let square =
        |x: f64, y: f64, size: f64| vec![[x, y], [x + size, y], [x + size, y + size], [x, y + size], [x, y]];
    let bounds = [[-1.0, -1.0], [3.0, 3.0]];
    let region = Region2::rectangle(bounds[0], bounds[1]).expect("a box");
    for gap in [0.0, 1e-16, 1e-12, 1e-9, 1e-6, 1e-3, 0.1] {
        let lines = [square(0.0, 0.0, 1.0), square(1.0 + gap, 0.3, 0.5)];
        let (points, segments, of) = parts(&lines);
        for tolerance in [0.02, 0.005] {
            let made = LineCells2::of_areas(&points, &segments, &of, &region, tolerance).expect("cells");
            let mut random = Random::new(3);
            for _ in 0..500 {
                let q = [random.unit(), random.unit()];
                let beside = [1.0 + gap + 0.5 * q[0], 0.3 + 0.5 * q[1]];
                assert!(is_in(&made, 0, q) && !is_in(&made, 1, q), "{q:?} {gap}");
                assert!(is_in(&made, 1, beside) && !is_in(&made, 0, beside), "{beside:?} {gap}");
            }
            let areas = [0, 1].map(|area| made.cells.area(VertexId::new(area)));
            assert!((areas[0] + areas[1] - 16.0).abs() < 1e-9, "{areas:?}");
            assert!(made.cells.rings(VertexId::new(0)).count() == 1, "{gap}");
        }
    }
}

/// All ends of the second line are those of others.
#[test]
fn a_line_between_corners_of_others_has_its_cell() {
    let points = [[0.0, 0.0], [0.0, 1.0], [1.0, 0.0], [1.0, 1.0]];
    let made =
        LineCells2::new(&points, &[[0, 1], [2, 3], [0, 2]], &[0, 1, 2], &region(), 1e-3).expect("cells");
    let areas = [0, 1, 2].map(|line| made.cells.area(VertexId::new(line)));
    // Each is bounded by bisectors of right angles, and the box.
    assert!(
        areas.into_iter().zip([1.5, 1.5, 1.0]).all(|(found, area)| (found - area).abs() < 0.3),
        "{areas:?}"
    );
    assert!((areas[0] - areas[1]).abs() < 1e-2 && areas[2] > 0.7, "{areas:?}");
}

#[test]
fn what_is_no_tolerance_is_refused() {
    let points = [[0.0, 0.0], [1.0, 0.0]];
    for tolerance in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let refused = LineCells2::new(&points, &[[0, 1]], &[0], &region(), tolerance);
        assert!(matches!(refused, Err(Error::Parameter { name: "tolerance", .. })));
    }
    let refused = LineCells2::new(&points, &[[0, 1]], &[], &region(), 0.1);
    assert!(matches!(refused, Err(Error::Parameter { name: "lines", .. })));
}

/// The cell of a ring is a polygon with a hole, and that of what is inside of it is the hole.
#[test]
fn a_cell_around_another_has_a_hole() {
    let points = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.4, 0.5], [0.6, 0.5]];
    let segments = [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5]];
    let made = LineCells2::new(&points, &segments, &[0, 0, 0, 0, 1], &region(), 1e-3).expect("cells");
    let rings: Vec<f64> = made.cells.rings(VertexId::new(0)).map(|ring| ring.area()).collect();
    assert_eq!(rings.len(), 2);
    assert!(rings.iter().any(|&area| area < 0.0) && rings.contains(&4.0));
    assert!(Constrained2::from_parts(&points, &segments).is_ok());
}

/// Cells of many corners, and a corner of many lines.
#[test]
fn long_borders_and_hubs_are_no_squares_of_work() {
    let n = 20_000;
    let at = |i: usize, radius: f64| {
        let angle = std::f64::consts::TAU * i as f64 / n as f64;
        [0.5 + radius * angle.cos(), 0.5 + radius * angle.sin()]
    };
    let mut points: Vec<[f64; 2]> = (0..n).map(|i| at(i, 0.4)).chain((0..n).map(|i| at(i, 0.2))).collect();
    let segments: Vec<[usize; 2]> = (0..2 * n).map(|i| [i, i / n * n + (i + 1) % n]).collect();
    let lines: Vec<usize> = (0..2 * n).map(|i| i / n).collect();
    let made = LineCells2::new(&points, &segments, &lines, &region(), 1e-3).expect("two rings");
    assert!((made.cells.area(VertexId::new(1)) - std::f64::consts::PI * 0.09).abs() < 0.002);
    points.truncate(n);
    points.push([0.5, 0.5]);
    let spokes: Vec<[usize; 2]> = (0..2000).map(|i| [n, i * 10]).collect();
    for lines in [vec![0; 2000], (0..2000).collect()] {
        let made = LineCells2::new(&points, &spokes, &lines, &region(), 0.05).expect("a hub");
        let area: f64 = (0..2000).map(|line| made.cells.area(VertexId::new(line))).sum();
        assert!((area - 4.0).abs() < 1e-9);
    }
}

/// Powers of two change nothing but sizes, and neither does the order of areas that share no place.
#[test]
fn cells_of_areas_are_a_function_of_the_areas() {
    let square = |x: f64, y: f64| vec![[x, y], [x + 1.0, y], [x + 1.0, y + 1.0], [x, y + 1.0], [x, y]];
    let squares: Vec<Vec<[f64; 2]>> = (0..9).map(|k| square(f64::from(k / 6), f64::from(k % 6))).collect();
    let areas = |by: f64| {
        let scaled: Vec<Vec<[f64; 2]>> =
            squares.iter().map(|ring| ring.iter().map(|p| p.map(|x| x * by)).collect()).collect();
        let (points, segments, of) = parts(&scaled);
        let region = Region2::rectangle([-by; 2], [7.0 * by; 2]).expect("a box");
        let made = LineCells2::of_areas(&points, &segments, &of, &region, 0.02 * by).expect("cells");
        // Corners rather than areas: these vanish before lengths do.
        let corners = |area| -> Vec<[f64; 2]> {
            made.cells.rings(VertexId::new(area)).flat_map(|ring| ring.points()).collect()
        };
        (0..9)
            .map(|area| corners(area).into_iter().map(|p| p.map(|x| x / by)).collect())
            .collect::<Vec<Vec<_>>>()
    };
    let expected = areas(1.0);
    assert!(expected.iter().all(|corners| corners.len() > 3));
    for power in [-900, -660, -300, -100, 100, 300, 660, 900] {
        assert_eq!(areas(2.0_f64.powi(power)), expected, "{power}");
    }
}
