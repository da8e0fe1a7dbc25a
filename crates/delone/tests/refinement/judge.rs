//! The judge of refined meshes.

use std::collections::BTreeSet;

use delone::{Constrained2, Crossings, Fill, Refined2, Refinement, TriangleId};
use delone_oracle::exact;

pub(crate) type Points = Vec<[f64; 2]>;
pub(crate) type Segments = Vec<[usize; 2]>;

pub(crate) fn squared_cosine(degrees: f64) -> f64 {
    // A unit in the last place: what a cosine may be rounded by.
    let cosine = degrees.to_radians().cos();
    cosine * cosine * (1.0 + 4.0 * f64::EPSILON)
}

pub(crate) fn corners(c: &Constrained2, t: TriangleId) -> [[f64; 2]; 3] {
    c.mesh().corners(t).map(|v| c.point(v))
}

pub(crate) fn has_angles([a, b, c]: [[f64; 2]; 3], degrees: f64) -> bool {
    let bound = squared_cosine(degrees);
    [(a, b, c), (b, c, a), (c, a, b)].into_iter().all(|(o, p, q)| exact::is_angle_at_least(o, p, q, bound))
}

/// All that must be true of any refined mesh.
pub(crate) fn judge(before: &Constrained2, c: &Constrained2, refined: &Refined2, degrees: f64, name: &str) {
    c.check().unwrap_or_else(|flaw| panic!("{name}: {flaw:?}"));
    let Refined2 { domains, report, .. } = refined;
    // Nothing that was there is lost or moved, and what is counted is there.
    for v in before.vertices() {
        assert_eq!(before.point(v), c.point(v), "{name}");
    }
    assert_eq!(c.vertex_count(), before.vertex_count() + report.inside + report.on_constraints, "{name}");
    let inside: Vec<_> = c.triangle_ids().filter(|&t| domains.is_inside(t)).collect();
    assert_eq!(report.triangles, inside.len(), "{name}");
    let (layers, inside): (Vec<_>, Vec<_>) = inside.into_iter().partition(|&t| domains.is_layer(t));
    assert_eq!(report.layers.triangles, layers.len(), "{name}");
    let is_positive = |[p, q, r]: [[f64; 2]; 3]| exact::orient2d(p, q, r) > 0;
    assert!(layers.iter().all(|&t| is_positive(corners(c, t))), "{name}: layers");
    assert_eq!(report.smallest_angles.iter().sum::<usize>(), inside.len(), "{name}");
    assert_eq!(report.angles.iter().sum::<usize>(), 3 * inside.len(), "{name}");
    // What is not said to be left is good, and what is left is bad: both exactly.
    let left: BTreeSet<_> = report.left.iter().map(|left| left.triangle).collect();
    assert_eq!(left.len(), report.left.len(), "{name}: twice");
    for &t in &inside {
        assert!(is_positive(corners(c, t)), "{name}");
        assert!(left.contains(&t) || has_angles(corners(c, t), degrees), "{name}: {:?}", corners(c, t));
    }
    // Near zero a cosine says too little.
    for angle in [report.smallest_angle - 1e-9, report.smallest_angle + 1e-9].into_iter().filter(|a| *a > 1.0)
    {
        let all = inside.iter().all(|&t| has_angles(corners(c, t), angle));
        assert_eq!(all, angle < report.smallest_angle, "{name}: smallest angle {}", report.smallest_angle);
    }
    // Every segment is a chain of constraints from end to end, along its line.
    for (s, ends) in c.segments() {
        let chain = c.chain(s).expect("it is there");
        assert_eq!([chain[0], chain[chain.len() - 1]], ends, "{name}");
        let [p, q] = ends.map(|v| c.point(v));
        let size = [p, q].iter().flatten().fold(0.0, |size: f64, x| size.max(x.abs()));
        let length = (q[0] - p[0]).hypot(q[1] - p[1]);
        for link in chain.windows(2) {
            let [i, j] = [0, 1].map(|k| c.point(link[k]));
            assert!(c.mesh().star(link[0]).any(|e| c.mesh().destination(e) == link[1] && c.is_constraint(e)));
            let off = |x: [f64; 2]| ((q[0] - p[0]) * (x[1] - p[1]) - (q[1] - p[1]) * (x[0] - p[0])) / length;
            assert!(off(j).abs() <= 64.0 * f64::EPSILON * size, "{name}: {} off", off(j));
            assert!((j[0] - i[0]) * (q[0] - p[0]) + (j[1] - i[1]) * (q[1] - p[1]) > 0.0, "{name}: forward");
        }
    }
    // No constraint is there that is none of a segment.
    let chains = c.segments().flat_map(|(s, _)| {
        let chain = c.chain(s).expect("there");
        chain.windows(2).map(|w| [w[0].min(w[1]), w[0].max(w[1])]).collect::<Vec<_>>()
    });
    assert_eq!(chains.collect::<BTreeSet<_>>(), c.constraints().collect(), "{name}");
}

pub(crate) fn area(c: &Constrained2, is_inside: impl Fn(TriangleId) -> bool) -> f64 {
    c.triangle_ids().filter(|&t| is_inside(t)).map(|t| c.area(t)).sum()
}

/// Refines, judges, and gives the mesh.
pub(crate) fn refine(
    points: &[[f64; 2]],
    segments: &[[usize; 2]],
    how: Refinement,
    fill: Fill,
    degrees: f64,
    name: &str,
) -> (Constrained2, Refined2) {
    let before = Constrained2::with_crossings(points, segments, Crossings::Split).expect("finite");
    let mut c = before.clone();
    let refined = how.min_angle(degrees).fill(fill).run(&mut c).unwrap_or_else(|e| panic!("{name}: {e}"));
    judge(&before, &c, &refined, degrees, name);
    let domains = before.domains(&fill).expect("seeds");
    let (old, new) = (area(&before, |t| domains.is_inside(t)), area(&c, |t| refined.domains.is_inside(t)));
    assert!((old - new).abs() <= 1e-9 * old.abs(), "{name}: area {old} became {new}");
    (c, refined)
}

pub(crate) fn coordinates(c: &Constrained2, refined: &Refined2) -> Vec<[[f64; 2]; 3]> {
    let inside = c.triangle_ids().filter(|&t| refined.domains.is_inside(t));
    delone_oracle::brute::normalized(inside.map(|t| corners(c, t)))
}
