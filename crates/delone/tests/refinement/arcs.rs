//! Arcs: new vertices on their constraints are on the circles, meshes fill what the circles bound, and elements of second order are not inverted.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use delone::{
    Arc2, ArcProblem, Constrained2, Error, Fill, Layers2, Refined2, Refinement, SegmentId, VertexId,
};
use delone_oracle::exact;

use super::judge::{Points, Segments, area, has_angles};

/// Lines and arcs.
#[derive(Default)]
struct Drawing {
    points: Points,
    segments: Segments,
    arcs: Vec<(SegmentId, [f64; 2])>,
}

impl Drawing {
    fn point(&mut self, p: [f64; 2]) -> usize {
        self.points.iter().position(|&q| q == p).unwrap_or_else(|| {
            self.points.push(p);
            self.points.len() - 1
        })
    }

    fn line(&mut self, a: [f64; 2], b: [f64; 2]) {
        let ends = [a, b].map(|p| self.point(p));
        self.segments.push(ends);
    }

    fn arc(&mut self, ends: [[f64; 2]; 2], center: [f64; 2]) {
        let arc = Arc2::new(ends, center).expect("an arc");
        let points: Points = [&ends[..1], &arc.inner_points()[..], &ends[1..]].concat();
        for pair in points.windows(2) {
            self.arcs.push((SegmentId::new(self.segments.len()), center));
            self.line(pair[0], pair[1]);
        }
    }

    fn circle(&mut self, [x, y]: [f64; 2], r: f64) {
        let around = [[x + r, y], [x, y + r], [x - r, y], [x, y - r]];
        (0..4).for_each(|k| self.arc([around[k], around[(k + 1) % 4]], [x, y]));
    }

    fn rectangle(&mut self, [x, y]: [f64; 2], [w, h]: [f64; 2]) {
        let around = [[x, y], [x + w, y], [x + w, y + h], [x, y + h]];
        (0..4).for_each(|k| self.line(around[k], around[(k + 1) % 4]));
    }

    fn refined(&self, how: Refinement) -> (Constrained2, Refined2) {
        let mut c = Constrained2::from_parts(&self.points, &self.segments).expect("nothing crosses");
        let refined = how.fill(Fill::EvenOdd).arcs(&self.arcs).run(&mut c).expect("it ends");
        (c, refined)
    }
}

/// Six nodes of a triangle: the corners, and the middles of the sides from each to the next.
fn nodes(
    c: &Constrained2,
    corners: [VertexId; 3],
    on_arcs: &BTreeMap<[VertexId; 2], [f64; 2]>,
) -> [[f64; 2]; 6] {
    let p = corners.map(|v| c.point(v));
    let middle = |i: usize, j: usize| {
        let ends = [corners[i].min(corners[j]), corners[i].max(corners[j])];
        on_arcs.get(&ends).copied().unwrap_or([0, 1].map(|k| p[i][k].midpoint(p[j][k])))
    };
    [p[0], p[1], p[2], middle(0, 1), middle(1, 2), middle(2, 0)]
}

/// The Jacobian at barycentric coordinates, from the shape functions.
fn jacobian(n: &[[f64; 2]; 6], [l, m]: [f64; 2]) -> f64 {
    let k = 1.0 - l - m;
    let along_l = [1.0 - 4.0 * k, 4.0 * l - 1.0, 0.0, 4.0 * (k - l), 4.0 * m, -4.0 * m];
    let along_m = [1.0 - 4.0 * k, 0.0, 4.0 * m - 1.0, -4.0 * l, 4.0 * l, 4.0 * (k - m)];
    let sum = |w: &[f64; 6], axis: usize| w.iter().zip(n).map(|(w, p)| w * p[axis]).sum::<f64>();
    sum(&along_l, 0) * sum(&along_m, 1) - sum(&along_l, 1) * sum(&along_m, 0)
}

/// Vertices on arcs are on their circles.
fn are_on_circles(drawing: &Drawing, c: &Constrained2, name: &str) {
    for &(s, center) in &drawing.arcs {
        let chain = c.chain(s).expect("there");
        let radius = |v: VertexId| (c.point(v)[0] - center[0]).hypot(c.point(v)[1] - center[1]);
        let r = radius(chain[0]);
        assert!(chain.iter().all(|&v| (radius(v) - r).abs() < 1e-13 * r.max(1.0)), "{name}");
    }
}

/// Judges, and gives the areas of straight and of curved triangles.
fn judge(drawing: &Drawing, c: &Constrained2, refined: &Refined2, degrees: f64, name: &str) -> [f64; 2] {
    c.check().unwrap_or_else(|flaw| panic!("{name}: {flaw:?}"));
    let left: Vec<_> = refined.report.left.iter().map(|left| left.triangle).collect();
    for t in c.triangle_ids().filter(|&t| refined.domains.is_inside(t)) {
        let corners = c.mesh().corners(t).map(|v| c.point(v));
        assert!(exact::orient2d(corners[0], corners[1], corners[2]) > 0, "{name}");
        assert!(left.contains(&t) || has_angles(corners, degrees), "{name}: {corners:?}");
    }
    are_on_circles(drawing, c, name);
    let middles = refined.arc_middles(c, &drawing.arcs).expect("arcs");
    let on_arcs: BTreeMap<_, _> = middles.iter().copied().collect();
    let count: usize = drawing.arcs.iter().map(|(s, _)| c.chain(*s).expect("there").len() - 1).sum();
    assert_eq!(middles.len(), count, "{name}: all arcs are sides of valid elements");
    let mut curved = 0.0;
    for t in c.triangle_ids().filter(|&t| refined.domains.is_inside(t)) {
        let n = nodes(c, c.mesh().corners(t), &on_arcs);
        let places = (0..=8).flat_map(|i| (0..=8 - i).map(move |j| [i, j].map(|x| f64::from(x) / 8.0)));
        let values: Vec<f64> = places.map(|at| jacobian(&n, at)).collect();
        assert!(values.iter().all(|&value| value > 0.0), "{name}: inverted {n:?}");
        // The middles of the sides integrate a quadratic function exactly.
        let sides = [[0.5, 0.0], [0.5, 0.5], [0.0, 0.5]];
        curved += sides.map(|at| jacobian(&n, at)).iter().sum::<f64>() / 6.0;
    }
    [area(c, |t| refined.domains.is_inside(t)), curved]
}

#[test]
fn new_vertices_are_on_the_circles() {
    let plain = |degrees: f64| Refinement::new().min_angle(degrees);
    let hows = [
        ("angles", plain(30.0), 30.0),
        ("areas", plain(25.0).max_area(0.01), 25.0),
        ("conforming", plain(20.0).max_area(0.02).conforming(true), 20.0),
        ("lengths", plain(30.0).edge(0.1), 30.0),
        ("smooth", plain(25.0).max_area(0.01).smooth(5), 25.0),
    ];
    for (how, refinement, degrees) in hows {
        let mut disk = Drawing::default();
        disk.circle([0.0, 0.0], 1.0);
        let mut ring = Drawing::default();
        ring.circle([3.0, 1.0], 1.0);
        ring.circle([3.0, 1.0], 0.95);
        let mut plate = Drawing::default();
        plate.rectangle([0.0, 0.0], [3.0, 1.0]);
        plate.circle([0.5, 0.5], 0.3);
        plate.circle([1.5, 0.5], 0.4375);
        plate.circle([2.5, 0.5], 0.01);
        // A fillet, and bulges in and out.
        let mut fillet = Drawing::default();
        fillet.line([0.0, 0.0], [2.0, 0.0]);
        fillet.arc([[2.0, 0.0], [2.0, 1.0]], [2.0 - 0.4, 0.5]);
        fillet.line([2.0, 1.0], [1.0, 1.0]);
        fillet.arc([[1.0, 1.0], [0.5, 1.5]], [1.0, 1.5]);
        fillet.line([0.5, 1.5], [0.5, 2.0]);
        fillet.line([0.5, 2.0], [0.0, 2.0]);
        fillet.arc([[0.0, 2.0], [0.0, 0.0]], [-3.0, 1.0]);
        let segment = |r: f64, half: f64| r * r * (half - half.sin() * half.cos());
        let shapes = [
            ("disk", disk, PI),
            ("ring", ring, PI * (1.0 - 0.95 * 0.95)),
            ("plate", plate, 3.0 - PI * (0.09 + 0.4375 * 0.4375 + 0.0001)),
            ("fillet", fillet, {
                let corner = 0.25 - PI * 0.25 / 4.0;
                let right = segment(0.4f64.hypot(0.5), 0.5f64.atan2(0.4));
                let left = segment(3.0f64.hypot(1.0), 1.0f64.atan2(3.0));
                2.0 + 0.5 + corner + right - left
            }),
        ];
        for (name, drawing, expected) in shapes {
            let name = format!("{name}, {how}");
            let (c, refined) = drawing.refined(refinement);
            let [straight, curved] = judge(&drawing, &c, &refined, degrees, &name);
            assert!((straight / expected - 1.0).abs() < 0.02, "{name}: {straight} {expected}");
            assert!((curved / expected - 1.0).abs() < 1e-5, "{name}: {curved} {expected}");
            assert!(refined.report.left.is_empty() || name.starts_with("fillet"), "{name}");
        }
    }
}

/// Arcs of a quarter, with nothing beside them, need not be divided before; refined again new vertices are on the circles too.
#[test]
fn quarters_are_divided_and_meshes_refined_again() {
    let corners = [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]];
    let segments = [[0, 1], [1, 2], [2, 3], [3, 0]];
    let drawing = Drawing {
        points: corners.to_vec(),
        segments: segments.to_vec(),
        arcs: (0..4).map(|s| (SegmentId::new(s), [0.0, 0.0])).collect(),
    };
    let (mut c, mut refined) = drawing.refined(Refinement::new().min_angle(25.0));
    for area in [0.1, 0.01, 0.001] {
        let [straight, curved] = judge(&drawing, &c, &refined, 25.0, "quarters");
        assert!((curved - PI).abs() < 1e-4 && straight < PI, "{straight} {curved}");
        let again = Refinement::new().min_angle(25.0).max_area(area).arcs(&drawing.arcs);
        refined = again.fill(Fill::Parts(&refined.domains)).run(&mut c).expect("it ends");
    }
    let [straight, _] = judge(&drawing, &c, &refined, 25.0, "quarters");
    assert!((straight / PI - 1.0).abs() < 1e-3, "{straight}");
}

/// Where a circle touches a line, where others cross it, and where something is between arc and chord: it ends, and is a triangulation.
#[test]
fn arcs_in_the_way_end() {
    let mut touching = Drawing::default();
    touching.rectangle([-2.0, -1.0], [4.0, 3.0]);
    touching.points.push([0.0, -1.0]);
    touching.circle([0.0, 0.0], 1.0);
    let mut narrow = Drawing::default();
    narrow.circle([0.0, 0.0], 1.0);
    narrow.circle([0.0, 0.0], 1.0 - 1e-3);
    let mut between = Drawing::default();
    between.rectangle([-2.0, -2.0], [4.0, 4.0]);
    // A point between the chord and the arc, and a line across.
    between.points.push([0.6, 0.6]);
    between.line([0.55, 0.55], [0.9, 0.9]);
    for k in 0..2 {
        let ends = if k == 0 { [[1.0, 0.0], [0.0, 1.0]] } else { [[-1.0, 0.0], [0.0, -1.0]] };
        between.arcs.push((SegmentId::new(between.segments.len()), [0.0, 0.0]));
        between.line(ends[0], ends[1]);
    }
    for (name, drawing) in [("touching", touching), ("narrow", narrow), ("between", between)] {
        for how in [Refinement::new(), Refinement::new().edge(0.2), Refinement::new().max_area(0.05)] {
            let Ok(mut c) = Constrained2::from_parts(&drawing.points, &drawing.segments) else {
                panic!("{name}: chords cross")
            };
            let how = how.fill(Fill::EvenOdd).arcs(&drawing.arcs).max_vertices(50_000);
            let refined = how.run(&mut c).expect("it ends");
            c.check().unwrap_or_else(|flaw| panic!("{name}: {flaw}"));
            let left = refined.report.left.len();
            assert!(refined.report.triangles > 10 && left < 50, "{name}: {left}");
            refined.arc_middles(&c, &drawing.arcs).expect("arcs");
        }
    }
}

/// Between the ends of two arcs that are nearer to each other than their chords are to them.
#[test]
fn thin_pieces_of_rings_have_their_area() {
    for inner in [0.999, 0.9985] {
        let mut drawing = Drawing::default();
        let ends = [[1.0, 0.0], [0.0, 1.0]];
        let inside = ends.map(|p| p.map(|x| inner * x));
        drawing.line(inside[0], ends[0]);
        drawing.arc(ends, [0.0, 0.0]);
        drawing.line(ends[1], inside[1]);
        drawing.arc([inside[1], inside[0]], [0.0, 0.0]);
        let (c, refined) = drawing.refined(Refinement::new().min_angle(10.0));
        c.check().expect("a triangulation");
        are_on_circles(&drawing, &c, "thin");
        let pieces = drawing.arcs.iter().map(|(s, _)| c.chain(*s).expect("there").len() - 1);
        assert!(pieces.min() > Some(1), "{inner}: all chords are divided");
        let (found, expected) =
            (area(&c, |t| refined.domains.is_inside(t)), 0.25 * PI * (1.0 - inner * inner));
        assert!((found / expected - 1.0).abs() < 0.5, "{inner}: {found} {expected}");
    }
}

/// The vertices of walls are on the arcs, and no row follows an arc that it ends at.
#[test]
fn layers_are_on_arcs() {
    let mut ring = Drawing::default();
    ring.circle([0.0, 0.0], 2.0);
    ring.circle([0.0, 0.0], 1.0);
    let mut sector = Drawing::default();
    sector.line([0.0, 0.0], [2.0, 0.0]);
    sector.arc([[2.0, 0.0], [0.0, 2.0]], [0.0, 0.0]);
    sector.line([0.0, 2.0], [0.0, 0.0]);
    let lines = [SegmentId::new(0), SegmentId::new(sector.segments.len() - 1)];
    let all = Layers2::new(0.01, 5);
    let some = Layers2::new(0.05, 3).on(lines.to_vec());
    for (name, drawing, layers) in [("ring", ring, all), ("sector", sector, some)] {
        let (c, refined) = drawing.refined(Refinement::new().edge(0.2).layers(&layers));
        c.check().expect("a triangulation");
        assert!(refined.report.layers.rows > 0 && refined.report.on_constraints > 0, "{name}");
        are_on_circles(&drawing, &c, name);
    }
}

#[test]
fn what_is_no_arc_is_named() {
    let corners = [[0.0, 0.0], [4.0, 0.0], [4.0, 3.0]];
    let refused = |segments: &[[usize; 2]], arcs: &[(usize, [f64; 2])]| {
        let mut c = Constrained2::from_parts(&corners, segments).expect("nothing crosses");
        let arcs: Vec<_> = arcs.iter().map(|&(s, center)| (SegmentId::new(s), center)).collect();
        let before = c.vertex_count();
        let outcome = Refinement::new().max_area(0.1).arcs(&arcs).run(&mut c).map(|_| ());
        assert!(outcome.is_ok() || c.vertex_count() == before);
        outcome
    };
    let around = [[0, 1], [1, 2], [2, 0], [1, 0]];
    let flaw = |segment, problem| Err(Error::Arc { segment, problem });
    assert_eq!(refused(&around, &[(0, [2.0, 0.0])]), flaw(0, ArcProblem::HalfTurn));
    assert_eq!(refused(&around, &[(0, [2.0, 2.0])]), flaw(0, ArcProblem::Straight));
    assert_eq!(refused(&around, &[(1, [f64::NAN, 0.0])]), flaw(1, ArcProblem::NotFinite));
    assert_eq!(refused(&around, &[(9, [0.0, 0.0])]), flaw(9, ArcProblem::NoSegment));
    assert_eq!(refused(&around, &[(0, [2.0, 2.0]), (3, [2.0, 3.0])]), flaw(3, ArcProblem::Repeated));
    assert!(matches!(
        refused(&around, &[(1, [3.0, 1.0])]),
        Err(Error::Arc { segment: 1, problem: ArcProblem::Radii(factor) }) if (factor - 1.58).abs() < 0.01
    ));
    assert_eq!(refused(&around, &[(0, [2.0, 2.0]), (3, [2.0, 2.0])]), Ok(()));
}

#[test]
fn points_of_arcs_are_on_them() {
    let turns = |degrees: f64| {
        let t = degrees.to_radians();
        let ends = [[1.0, 0.0], [t.cos(), t.sin()]];
        Arc2::new(ends, [0.0, 0.0]).expect("an arc")
    };
    for degrees in [0.001, 1.0, 11.0, 45.0, 90.0, 120.0, 179.0] {
        for (arc, sign) in [(turns(degrees), 1.0), (turns(-degrees), -1.0)] {
            for part in [0.0, 0.125, 0.3, 0.5, 0.7, 0.99, 1.0] {
                let [x, y] = arc.at(part);
                assert!((x.hypot(y) - 1.0).abs() < 4e-16, "{degrees} {part}");
                let angle = sign * y.atan2(x).to_degrees();
                assert!((angle - part * degrees).abs() < 1e-5 * degrees, "{degrees} {part}: {angle}");
            }
            assert!((arc.sagitta() - (1.0 - (degrees / 2.0).to_radians().cos())).abs() < 1e-15);
            assert_eq!(arc.middle(), arc.at(0.5));
            let count = (degrees / 11.2501).ceil().max(1.0) as usize;
            assert_eq!(arc.inner_points().len() + 1, count.next_power_of_two(), "{degrees}");
        }
    }
    // A rise of a billionth of the chord, far from the origin: the last digit is right.
    let flat = Arc2::new([[100.0, 100.0], [101.0, 100.0]], [100.5, 100.0 - 125e6]).expect("an arc");
    assert_eq!(flat.middle(), [100.5, 100.0 + 1e-9]);
}
