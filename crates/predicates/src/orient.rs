//! Orientation of three points: filter, exact.

use crate::counters::{Predicate, Stage, count};
use crate::filter::orient2d_filter;
use crate::{Point2, Sign, exact};

/// On which side of the directed line from `a` to `b` the point `c` lies: positive on the left, zero on it,
/// negative on the right; the sign of twice the signed area of the triangle (counter-clockwise positive).
///
/// Exact for every finite input. O(1), a few nanoseconds unless the points are nearly collinear.
///
/// ```
/// use delone_predicates::{Sign, orient2d};
/// // Far below what f64 arithmetic can see: 2^-53 at (0.5, 0.5).
/// let c = [0.5 + f64::EPSILON / 2.0, 0.5];
/// assert_eq!(orient2d([0.5, 0.5], [12.0, 12.0], c), Sign::Negative);
/// ```
#[inline]
pub fn orient2d(a: Point2, b: Point2, c: Point2) -> Sign {
    if let Some(sign) = orient2d_filter(a, b, c) {
        count(Predicate::Orient2d, Stage::Filter);
        return sign;
    }
    orient2d_exact(a, b, c)
}

/// The exact stage, out of line: it is rarely reached.
#[cold]
#[inline(never)]
pub(crate) fn orient2d_exact(a: Point2, b: Point2, c: Point2) -> Sign {
    exact::orient2d(a, b, c)
}

/// Both stages for three points that the filter of a box leaves in doubt: they may be close together in it.
#[cold]
#[inline(never)]
pub(crate) fn orient2d_in_doubt(a: Point2, b: Point2, c: Point2) -> Sign {
    orient2d(a, b, c)
}
