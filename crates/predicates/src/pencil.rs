//! All circles through two points: the language of a divide-and-conquer merge.
//!
//! For a base l-r and a candidate q let
//! `dot = (q - l) . (q - r)` and `cross = (q - l) x (q - r)`. Then q is above the base (left of l to r) iff
//! `cross > 0`, the angle at q has cotangent `dot / cross`, and `in_circle(l, r, p, q)` has the sign of
//! `dot_p cross_q - dot_q cross_p` (Cline & Renka, "A storage-efficient method for construction of a
//! Thiessen triangulation", 1984): four products a candidate, two a comparison.

use std::hint::select_unpredictable;

use crate::counters::{Predicate, Stage, count};
use crate::in_circle::{in_circle_in_doubt, in_circle_tie};
use crate::orient::orient2d_in_doubt;
use crate::{Filter, Point2, Sign};

/// The circles through a base l-r. The filter given with a question must hold for all points in it.
#[derive(Clone, Copy, Debug)]
pub struct Pencil {
    l: Point2,
    r: Point2,
}

/// A candidate and its two numbers over a base.
#[derive(Clone, Copy, Debug)]
pub struct Member {
    point: Point2,
    dot: f64,
    cross: f64,
}

impl Pencil {
    /// The circles through `l` and `r`.
    #[inline]
    pub fn new(l: Point2, r: Point2) -> Self {
        Self { l, r }
    }

    /// The circle of the pencil that passes through `q`.
    #[inline]
    pub fn member(&self, q: Point2) -> Member {
        let (lx, ly) = (q[0] - self.l[0], q[1] - self.l[1]);
        let (rx, ry) = (q[0] - self.r[0], q[1] - self.r[1]);
        Member { point: q, dot: lx * rx + ly * ry, cross: lx * ry - ly * rx }
    }

    /// The side of the base on which `m` lies: positive above, that is left of l to r.
    #[inline]
    pub fn side(&self, m: &Member, filter: &Filter) -> Sign {
        if let Some(sign) = filter.orient(m.cross) {
            count(Predicate::Orient2d, Stage::Filter);
            return sign;
        }
        orient2d_in_doubt(self.l, self.r, m.point)
    }

    /// `in_circle(l, r, p, q)`, canonical on ties: positive iff q is inside the circle through l, r and a
    /// point p above the base.
    #[inline]
    pub fn in_circle(&self, p: &Member, q: &Member, filter: &Filter) -> Sign {
        match filter.circle(p.dot * q.cross - q.dot * p.cross) {
            Some(Sign::Zero) => in_circle_tie(self.l, self.r, p.point, q.point),
            Some(sign) => {
                count(Predicate::InCircle, Stage::Filter);
                sign
            }
            None => in_circle_in_doubt(self.l, self.r, p.point, q.point),
        }
    }

    /// Which of some points is above the base and has none of the others that are above inside of its circle, and how many are above; if
    /// floating point can tell all of that: `None` if not, or if none is above.
    ///
    /// Whether a point is better than those before is chance: it is selected, and not branched on.
    #[inline]
    pub fn apex(&self, points: impl Iterator<Item = Point2>, filter: &Filter) -> Option<(usize, usize)> {
        // So far the circle is the half-plane above.
        let (mut best, mut dot, mut cross) = (None, f64::INFINITY, 0.0);
        let (mut is_sure, mut above) = (true, 0);
        for (k, q) in points.enumerate() {
            let m = self.member(q);
            let circle = dot * m.cross - m.dot * cross;
            is_sure &= filter.tells_orient(m.cross) & ((m.cross < 0.0) | filter.tells_circle(circle));
            above += usize::from(m.cross > 0.0);
            let is_better = u8::from(m.cross > 0.0) & u8::from(circle > 0.0) != 0;
            best = select_unpredictable(is_better, Some(k), best);
            dot = select_unpredictable(is_better, m.dot, dot);
            cross = select_unpredictable(is_better, m.cross, cross);
        }
        best.filter(|_| is_sure).map(|best| (best, above))
    }
}

/// How four points lie, where floating point can tell all of it: the first question of who triangulates many fours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Four {
    /// Which of the triples (a, b, c), (a, b, d), (a, c, d) and (b, c, d) are counter-clockwise: bits 0 to 3.
    pub turns: u8,
    /// Whether `in_circle(a, b, c, d)` is positive.
    pub circle: bool,
}

impl Four {
    /// Of four points in a filter's box; nothing if a sign is in doubt, or zero.
    #[inline]
    pub fn of(a: Point2, b: Point2, c: Point2, d: Point2, filter: &Filter) -> Option<Self> {
        let (over_ab, over_cd) = (Pencil::new(a, b), Pencil::new(c, d));
        let (on_c, on_d) = (over_ab.member(c), over_ab.member(d));
        // (c, d, a) and (c, d, b) are rotations of (a, c, d) and (b, c, d).
        let turns = [on_c.cross, on_d.cross, over_cd.member(a).cross, over_cd.member(b).cross];
        let circle = on_c.dot * on_d.cross - on_d.dot * on_c.cross;
        let is_sure =
            turns.iter().fold(filter.tells_circle(circle), |all, &turn| all & filter.tells_orient(turn));
        is_sure.then(|| {
            for _ in 0..4 {
                count(Predicate::Orient2d, Stage::Filter);
            }
            count(Predicate::InCircle, Stage::Filter);
            let bits = turns.iter().enumerate().map(|(i, &turn)| u8::from(turn > 0.0) << i);
            Self { turns: bits.sum(), circle: circle > 0.0 }
        })
    }
}

impl Filter {
    /// Like [`crate::orient2d`], for points in the box.
    #[inline]
    pub fn orient2d(&self, a: Point2, b: Point2, c: Point2) -> Sign {
        self.orient(Pencil::new(a, b).member(c).cross).unwrap_or_else(|| crate::orient2d(a, b, c))
    }

    /// Like [`crate::in_circle`], for points in the box.
    #[inline]
    pub fn in_circle(&self, a: Point2, b: Point2, c: Point2, d: Point2) -> Sign {
        let pencil = Pencil::new(a, b);
        let (p, q) = (pencil.member(c), pencil.member(d));
        match self.circle(p.dot * q.cross - q.dot * p.cross) {
            Some(Sign::Zero) => in_circle_tie(a, b, c, d),
            Some(sign) => sign,
            None => crate::in_circle(a, b, c, d),
        }
    }
}
