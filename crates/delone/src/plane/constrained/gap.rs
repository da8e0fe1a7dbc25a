//! The narrowest gap between segments that do not meet: a mesh has to be as fine there.
//!
//! Around each vertex the triangles nearer than the narrowest gap so far are searched, up to constraints. Segments that meet at a small
//! angle, or are joined to the same vertex under one, are no gap: welding would not help.
//!
//! Cost: O(n log n) typical: few triangles beside its star are so near to a vertex.

use std::collections::BTreeSet;

use delone_predicates::{hypotenuse, lexicographic};

use super::domains::Domains2;
use super::{Constrained2, SegmentId};
use crate::ids::{EdgeId, TriangleId, VertexId};
use crate::points::Bounds;

/// A gap between two segments.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Gap2 {
    /// The distance across, rounded. In coordinate units.
    pub width: f64,
    /// An end of the second segment, on one side of the gap.
    pub at: [f64; 2],
    /// The width as a part of the diagonal of the box around all vertices, rounded.
    pub part: f64,
    /// The segments on both sides.
    pub segments: [SegmentId; 2],
}

impl Gap2 {
    /// Gaps narrower than this part of the diagonal are rarely meant: drawings and maps have six digits.
    pub const TINY_PART: f64 = 1e-6;

    /// Whether the gap is narrower than [`Self::TINY_PART`].
    pub fn is_tiny(&self) -> bool {
        self.part < Self::TINY_PART
    }

    /// The exponent of the least power of ten that is at least twice the width: a tolerance that closes it ([`crate::Weld2`]).
    pub fn exponent(&self) -> i32 {
        // By its digits, so that no logarithm is rounded.
        let digits = format!("{:e}", 2.0 * self.width);
        let exponent = digits.rsplit('e').next().and_then(|text| text.parse().ok()).unwrap_or(0);
        if digits.starts_with("1e") { exponent } else { exponent + 1 }
    }
}

/// Cosine of the angle, in degrees 60, below which segments meet instead of leaving a gap.
const COS_OF_MEETING: f64 = 0.5;

/// A gap by what bounds it: a constraint on one side, a vertex on the other.
#[derive(Clone, Copy)]
struct Found {
    width: f64,
    one: EdgeId,
    other: VertexId,
}

impl Constrained2 {
    /// The narrowest gap inside: an end of one segment, and the nearest place of another that it sees.
    ///
    /// ```
    /// use delone::{Constrained2, Fill};
    ///
    /// // Two lines, the second of which ends a millionth above the first.
    /// let points = [[0.0, 0.0], [4.0, 0.0], [2.0, 1e-6], [2.0, 3.0]];
    /// let c = Constrained2::from_parts(&points, &[[0, 1], [2, 3]])?;
    /// let gap = c.narrowest_gap(&c.domains(&Fill::All)?).expect("two segments");
    /// assert_eq!((gap.width, gap.at), (1e-6, [2.0, 1e-6]));
    /// assert_eq!(gap.segments.map(|s| s.index()), [0, 1]);
    /// assert_eq!((gap.is_tiny(), gap.exponent()), (true, -5));
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn narrowest_gap(&self, domains: &Domains2) -> Option<Gap2> {
        self.gap_below(domains, f64::INFINITY)
    }

    /// The narrowest gap inside if it is narrower than [`Gap2::TINY_PART`]: only what is so near to a vertex is looked at.
    pub fn tiny_gap(&self, domains: &Domains2) -> Option<Gap2> {
        self.gap_below(domains, Gap2::TINY_PART * self.diagonal()).filter(Gap2::is_tiny)
    }

    fn gap_below(&self, domains: &Domains2, limit: f64) -> Option<Gap2> {
        let mut has_segment = vec![false; self.points().len()];
        self.constraints().flatten().for_each(|v| has_segment[v.index()] = true);
        let mut best: Option<Found> = None;
        for v in self.vertices().filter(|v| has_segment[v.index()]) {
            best = self.narrowest_around(v, domains, (limit, &has_segment), best);
        }
        let found = best?;
        let segment = |e: EdgeId| self.covering(e).first().map(|covering| covering.segment);
        let spoke = self.fixed_spokes(found.other).min_by(|&e, &f| {
            let [p, q] = [e, f].map(|e| self.segment(e)[1]);
            lexicographic(p, q)
        })?;
        Some(Gap2 {
            width: found.width,
            at: self.point(found.other),
            part: found.width / self.diagonal(),
            segments: [segment(found.one)?, segment(spoke)?],
        })
    }

    fn diagonal(&self) -> f64 {
        let [width, height] = Bounds::of(self.vertices().map(|v| self.point(v))).extent();
        hypotenuse(width, height)
    }

    /// The narrowest of a gap and of those between a vertex and constraints that it sees inside, up to a limit.
    fn narrowest_around(
        &self,
        v: VertexId,
        domains: &Domains2,
        (limit, has_segment): (f64, &[bool]),
        mut best: Option<Found>,
    ) -> Option<Found> {
        let mesh = self.mesh();
        let q = self.point(v);
        let width_of = |e: EdgeId| distance(q, nearest(q, self.segment(e)));
        let star = mesh.star(v).filter(|e| domains.is_inside(e.triangle()));
        let mut edges: Vec<EdgeId> = star.map(|e| e.next()).collect();
        let mut seen: BTreeSet<TriangleId> = BTreeSet::new();
        while let Some(e) = edges.pop() {
            let most = best.map_or(limit, |best| best.width);
            let width = width_of(e);
            if width.is_nan() || width > most {
                continue;
            }
            let beyond = mesh.twin(e);
            let is_open = !mesh.is_fixed(e) && domains.is_inside(beyond.triangle());
            if is_open && mesh.apex(beyond) != v && seen.insert(beyond.triangle()) {
                edges.extend([beyond.next(), beyond.previous()]);
            }
            // The nearest place of a constraint is on this edge, or it is a vertex.
            let own = mesh.is_fixed(e).then_some((e, width));
            let ends = [mesh.origin(e), mesh.destination(e)].into_iter();
            let near = ends.filter(|w| has_segment[w.index()] && distance(q, self.point(*w)) <= most);
            let others = near.flat_map(|w| self.fixed_spokes(w)).map(|e| (e, width_of(e)));
            for (one, width) in own.into_iter().chain(others) {
                let most = best.map_or(limit, |best| best.width);
                let is_own = mesh.origin(one) == v || mesh.destination(one) == v;
                if !is_own && width > 0.0 && width <= most && !self.meet(v, one) {
                    let found = Found { width, one, other: v };
                    best = Some(best.map_or(found, |best| self.narrower(best, found)));
                }
            }
        }
        best
    }

    /// Whether a vertex, and a constraint or one that continues it, are joined to one vertex at a small angle.
    fn meet(&self, v: VertexId, one: EdgeId) -> bool {
        let mesh = self.mesh();
        let [a, b] = [mesh.origin(one), mesh.destination(one)];
        let is_small = |corner: VertexId, end: VertexId| {
            let [p, q, r] = [corner, v, end].map(|v| self.point(v));
            let [u, w] = [unit(p, q), unit(p, r)];
            u[0] * w[0] + u[1] * w[1] > COS_OF_MEETING
        };
        let is_joined = |corner: VertexId, end: VertexId| {
            corner != end
                && is_small(corner, end)
                && self.fixed_spokes(end).any(|e| mesh.destination(e) == corner)
        };
        // An end of the constraint is joined to its other end.
        let corners = self.fixed_spokes(v).map(|e| mesh.destination(e));
        corners.into_iter().any(|corner| is_joined(corner, a) || is_joined(corner, b))
    }

    /// The constraints that leave a vertex.
    fn fixed_spokes(&self, v: VertexId) -> impl Iterator<Item = EdgeId> + '_ {
        let mesh = self.mesh();
        mesh.star(v).filter(|&e| mesh.is_fixed(e))
    }

    /// The narrower of two gaps; of equal ones the one of the lexicographically smaller vertex, and then constraint.
    fn narrower(&self, a: Found, b: Found) -> Found {
        let place = |found: Found| self.point(found.other);
        let ends = |found: Found| {
            let [p, q] = self.segment(found.one);
            if lexicographic(p, q).is_lt() { [p, q] } else { [q, p] }
        };
        let of_ends = || {
            let ([p, q], [r, s]) = (ends(a), ends(b));
            lexicographic(p, r).then_with(|| lexicographic(q, s))
        };
        let order = a.width.total_cmp(&b.width).then_with(|| lexicographic(place(a), place(b)));
        if order.then_with(of_ends).is_le() { a } else { b }
    }
}

/// The nearest place of a segment, rounded. No square overflows or vanishes.
fn nearest(q: [f64; 2], [a, b]: [[f64; 2]; 2]) -> [f64; 2] {
    let way = unit(a, b);
    let along = ((q[0] - a[0]) * way[0] + (q[1] - a[1]) * way[1]).clamp(0.0, distance(a, b));
    [a[0] + along * way[0], a[1] + along * way[1]]
}

fn distance(p: [f64; 2], q: [f64; 2]) -> f64 {
    hypotenuse(q[0] - p[0], q[1] - p[1])
}

/// The direction from one place to another.
fn unit(p: [f64; 2], q: [f64; 2]) -> [f64; 2] {
    [0, 1].map(|k| (q[k] - p[k]) / distance(p, q))
}
