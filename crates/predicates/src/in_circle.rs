//! In-circle test of four points: filter, exact, perturb.

use crate::counters::{Predicate, Stage, count};
use crate::filter::in_circle_filter;
use crate::perturb::in_circle_perturbed;
use crate::{Point2, Sign, exact};

/// Whether `d` lies inside the circle through `a`, `b`, `c`: positive when inside, negative when outside,
/// for `a`, `b`, `c` counter-clockwise (the sign flips when they are clockwise).
///
/// Four distinct cocircular points never give zero: the tie is broken by the canonical perturbation, which
/// raises the lexicographically largest of the four out of the circle of the others (Devillers & Teillaud,
/// "Perturbations for Delaunay and weighted Delaunay 3D triangulations", CGTA 2011). The answer is that of
/// one consistent set of points in general position, so everything built on it is unique. Zero is returned
/// only when all four are collinear. The four points must be distinct: no sign is promised for equal ones.
///
/// Exact for every finite input. O(1).
#[inline]
pub fn in_circle(a: Point2, b: Point2, c: Point2, d: Point2) -> Sign {
    if let Some(sign) = in_circle_filter(a, b, c, d) {
        count(Predicate::InCircle, Stage::Filter);
        return sign;
    }
    in_circle_exact(a, b, c, d)
}

/// Tells on which side of a circle a point is, without the perturbation: zero for cocircular points. For judging triangulations that broke
/// their ties in another way, which are Delaunay all the same.
pub fn in_circle_with_ties(a: Point2, b: Point2, c: Point2, d: Point2) -> Sign {
    in_circle_filter(a, b, c, d).unwrap_or_else(|| exact::in_circle(a, b, c, d))
}

/// All stages for four points that the filter of a box leaves in doubt: they may be close together in it.
#[cold]
#[inline(never)]
pub(crate) fn in_circle_in_doubt(a: Point2, b: Point2, c: Point2, d: Point2) -> Sign {
    in_circle(a, b, c, d)
}

/// The exact and the perturbed stage, out of line: they are rarely reached.
#[cold]
#[inline(never)]
pub(crate) fn in_circle_exact(a: Point2, b: Point2, c: Point2, d: Point2) -> Sign {
    match exact::in_circle(a, b, c, d) {
        Sign::Zero => in_circle_tie(a, b, c, d),
        sign => sign,
    }
}

/// The perturbed stage for four points known to be cocircular.
#[inline(never)]
pub(crate) fn in_circle_tie(a: Point2, b: Point2, c: Point2, d: Point2) -> Sign {
    count(Predicate::InCircle, Stage::Perturb);
    in_circle_perturbed(a, b, c, d)
}
