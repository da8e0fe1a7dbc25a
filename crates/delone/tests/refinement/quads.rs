//! Triangles in pairs: convex quadrilaterals that cover what they covered, whatever the order of the input.

use std::collections::{BTreeMap, BTreeSet};

use delone::{AllQuads2, Constrained2, Fill, Quads2, Refined2, Refinement, TriangleId, VertexId};
use delone_generators::Random;
use delone_oracle::exact;

use super::judge::{Points, Segments};
use super::nasty::nasty;

/// Every triangle inside is in one pair or is left, and pairs are convex and on one side of constraints.
fn judge(c: &Constrained2, refined: &Refined2, quads: &Quads2, name: &str) {
    let mut seen: Vec<TriangleId> = quads.pairs.iter().flatten().chain(&quads.triangles).copied().collect();
    seen.sort_unstable();
    let inside: Vec<TriangleId> = c.triangle_ids().filter(|&t| refined.domains.is_inside(t)).collect();
    assert_eq!(seen, inside, "{name}");
    let walls: BTreeSet<[VertexId; 2]> = c.constraints().collect();
    for (corners, pair) in quads.corners.iter().zip(&quads.pairs) {
        let of = |t: TriangleId| c.mesh().corners(t).into_iter().collect::<BTreeSet<_>>();
        assert_eq!(&of(pair[0]) | &of(pair[1]), corners.iter().copied().collect(), "{name}");
        let [a, _, b, _] = corners;
        assert!(!walls.contains(&[*a.min(b), *a.max(b)]), "{name}: a constraint is a diagonal");
        let p = corners.map(|v| c.point(v));
        assert!(is_convex(p), "{name}");
        for k in 0..4 {
            let [before, at, after] = [p[(k + 3) % 4], p[k], p[(k + 1) % 4]];
            let angle = |q: [f64; 2]| (q[1] - at[1]).atan2(q[0] - at[0]);
            let degrees = (angle(before) - angle(after)).to_degrees().rem_euclid(360.0);
            assert!((29.999..150.001).contains(&degrees), "{name}: {degrees}");
        }
    }
}

fn is_convex(p: [[f64; 2]; 4]) -> bool {
    (0..4).all(|k| exact::orient2d(p[(k + 3) % 4], p[k], p[(k + 1) % 4]) > 0)
}

/// Parts of cells fit to each other, their outer sides are halves of edges, and exactly those that are told are not convex.
fn judge_all(c: &Constrained2, quads: &Quads2, all: &AllQuads2, name: &str) {
    assert_eq!(all.corners.len(), 4 * quads.corners.len() + 3 * quads.triangles.len(), "{name}");
    let mut sides: BTreeMap<[usize; 2], i32> = BTreeMap::new();
    for (row, corners) in all.corners.iter().enumerate() {
        assert_eq!(is_convex(all.places(row)), all.left.binary_search(&row).is_err(), "{name}");
        for k in 0..4 {
            let [from, to] = [corners[k], corners[(k + 1) % 4]];
            let count = sides.entry([from.min(to), from.max(to)]).or_default();
            // A side is once there each way.
            assert!(*count != if from < to { 1 } else { 2 } && *count < 3, "{name}");
            *count += if from < to { 1 } else { 2 };
        }
    }
    let of_cells = |t: &TriangleId| [0, 1, 2].map(|k| t.edge(k));
    let edges = quads.pairs.iter().flatten().chain(&quads.triangles).flat_map(of_cells);
    let cells: BTreeSet<TriangleId> = quads.pairs.iter().flatten().chain(&quads.triangles).copied().collect();
    let mut border = BTreeSet::new();
    for e in edges.filter(|&e| !cells.contains(&c.mesh().twin(e).triangle())) {
        let [v, w] = [c.mesh().origin(e), c.mesh().destination(e)];
        let middle = all.first + all.middles.binary_search(&[v.min(w), v.max(w)]).expect("a middle");
        border.extend([v, w].map(|v| [v.index(), middle]));
        let [p, q, m] = [c.point(v), c.point(w), all.points[middle]];
        assert_eq!(m, [0, 1].map(|k| p[k].midpoint(q[k]) + 0.0), "{name}");
    }
    let alone: BTreeSet<[usize; 2]> = sides.iter().filter(|side| *side.1 < 3).map(|side| *side.0).collect();
    assert_eq!(alone, border, "{name}");
}

#[test]
fn all_cells_become_quadrilaterals() {
    let square = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]];
    for scale in [1.0, 2f64.powi(-300), 2f64.powi(300)] {
        let points = square.map(|p| p.map(|x| x * scale));
        let mut c = Constrained2::from_parts(&points, &[]).expect("finite");
        let refined = Refinement::new().edge(0.1 * scale).min_angle(30.0).run(&mut c).expect("it ends");
        let quads = Quads2::of(&c, &refined);
        let all = AllQuads2::of(&c, &quads);
        judge_all(&c, &quads, &all, "square");
        let [low, high] = all.angles().expect("some");
        assert!(all.left.is_empty() && low > 25.0 && high < 165.0, "{low} {high}");
        let mut smooth = all.clone();
        smooth.smooth(&c, &refined, 4);
        judge_all(&c, &quads, &smooth, "smoothed");
        let [lower, higher] = smooth.angles().expect("some");
        assert!(lower > low + 4.0 && higher <= high, "{low} {high} {lower} {higher}");
        // The vertices given and the border stay; all moves are within the square, so the area is as it was.
        assert_eq!(smooth.points[..4], all.points[..4]);
        assert!(smooth.points.iter().all(|&[x, y]| x >= 0.0 && y >= 0.0 && x <= 2.0 * scale && y <= scale));
    }
    // Between neighbors among the numbers no middle fits.
    let next = 1.0 + f64::EPSILON;
    let mut c = Constrained2::from_parts(&[[1.0, 1.0], [next, 1.0], [1.0, next]], &[]).expect("finite");
    let refined = Refinement::new().min_angle(0.0).run(&mut c).expect("it ends");
    let quads = Quads2::of(&c, &refined);
    let all = AllQuads2::of(&c, &quads);
    judge_all(&c, &quads, &all, "tiny");
    assert_eq!(all.left, [0, 1, 2]);
    let none = AllQuads2::of(&Constrained2::new(), &Quads2::default());
    assert_eq!((none.corners.len(), none.angles()), (0, None));
}

#[test]
fn few_triangles_are_left() {
    let square = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]];
    for (edge, largest_part) in [(0.2, 0.12), (0.05, 0.06), (0.02, 0.04)] {
        let mut c = Constrained2::from_parts(&square, &[]).expect("finite");
        let refined = Refinement::new().edge(edge).min_angle(30.0).run(&mut c).expect("it ends");
        let quads = Quads2::of(&c, &refined);
        judge(&c, &refined, &quads, "square");
        let part = quads.triangles.len() as f64 / refined.report.triangles as f64;
        assert!(part < largest_part, "{edge}: {part}");
    }
    // Parallelograms that are cut in two become parallelograms again, whatever their unit; those with sharp angles do not.
    for (unit, lean) in [(1.0, 0.0), (2f64.powi(-700), 0.0), (2f64.powi(900), 0.0), (2f64.powi(700), 4.0)] {
        let at = |i: i32| [f64::from(i % 9) + lean * f64::from(i / 9), f64::from(i / 9)];
        let points: Points = (0..81).map(|i| at(i).map(|x| x * unit)).collect();
        let corners: Vec<_> =
            (0..72).filter(|i| i % 9 < 8).flat_map(|i| [[i, i + 1, i + 9], [i + 1, i + 10, i + 9]]).collect();
        let given: Vec<_> = corners.iter().map(|corners| corners.map(VertexId::new)).collect();
        let mut c = Constrained2::from_parts(&points, &[]).expect("finite");
        let kept = Refinement::new().min_angle(0.0).triangles(&given).run(&mut c).expect("it ends");
        let quads = Quads2::of(&c, &kept);
        let expected = if lean > 0.0 { 0 } else { 64 };
        assert_eq!(quads.corners.len(), expected, "{unit:e}");
    }
    let points: Points = (0..81).map(|i| [f64::from(i % 9), f64::from(i / 9)]).collect();
    let mut c = Constrained2::from_parts(&points, &[]).expect("finite");
    let refined = Refinement::new().min_angle(0.0).run(&mut c).expect("it ends");
    let quads = Quads2::of(&c, &refined);
    judge(&c, &refined, &quads, "grid");
    assert_eq!((quads.corners.len(), quads.triangles.len()), (64, 0));
}

#[test]
fn constraints_are_no_diagonals() {
    for (name, points, segments) in &nasty() {
        let built = Constrained2::with_crossings(points, segments, delone::Crossings::Split);
        let Ok(mut c) = built else { continue };
        let wanted = Refinement::new().min_angle(20.0).max_vertices(300).fill(Fill::EvenOdd);
        let refined = wanted.run(&mut c).expect("it ends");
        let quads = Quads2::of(&c, &refined);
        judge(&c, &refined, &quads, name);
        let mut all = AllQuads2::of(&c, &quads);
        judge_all(&c, &quads, &all, name);
        let count = all.left.len();
        all.smooth(&c, &refined, 2);
        judge_all(&c, &quads, &all, name);
        assert!(all.left.len() <= count, "{name}");
    }
}

#[test]
fn pairs_are_a_function_of_the_input() {
    let corners: Points = vec![[0.0, 0.0], [3.0, 0.0], [3.5, 2.0], [1.0, 2.5], [0.2, 1.0]];
    let sides: Segments = (0..5).map(|k| [k, (k + 1) % 5]).collect();
    let run = |points: &Points, segments: &Segments| {
        let mut c = Constrained2::from_parts(points, segments).expect("finite");
        let wanted = Refinement::new().edge(0.2).min_angle(30.0).fill(Fill::EvenOdd);
        let refined = wanted.run(&mut c).expect("it ends");
        let quads = Quads2::of(&c, &refined);
        judge(&c, &refined, &quads, "pentagon");
        let sorted = |corners: &[VertexId; 4]| {
            let mut places = corners.map(|v| c.point(v).map(f64::to_bits));
            places.sort_unstable();
            places
        };
        quads.corners.iter().map(sorted).collect::<BTreeSet<_>>()
    };
    let expected = run(&corners, &sides);
    let mut random = Random::new(8);
    for _ in 0..4 {
        let mut order: Vec<usize> = (0..5).collect();
        random.shuffle(&mut order);
        let mut rank = [0; 5];
        order.iter().enumerate().for_each(|(new, &old)| rank[old] = new);
        let moved: Points = order.iter().map(|&old| corners[old]).collect();
        let mut renamed: Segments = sides.iter().map(|s| s.map(|v| rank[v])).collect();
        random.shuffle(&mut renamed);
        assert_eq!(run(&moved, &renamed), expected);
    }
}
