//! The order on points that every tie-break refers to.

use std::cmp::Ordering;

use crate::{Point2, Point3};

/// Compares by x, then by y. `-0.0` equals `0.0`; points that compare equal are one vertex.
///
/// ```
/// use std::cmp::Ordering;
/// use delone_predicates::lexicographic;
/// assert_eq!(lexicographic([0.0, 7.0], [1.0, 0.0]), Ordering::Less);
/// assert_eq!(lexicographic([-0.0, 1.0], [0.0, 1.0]), Ordering::Equal);
/// ```
#[inline]
pub fn lexicographic(a: Point2, b: Point2) -> Ordering {
    if a[0] < b[0] || (a[0] == b[0] && a[1] < b[1]) {
        Ordering::Less
    } else if a[0] == b[0] && a[1] == b[1] {
        Ordering::Equal
    } else {
        Ordering::Greater
    }
}

/// Compares points of space by x, then by y, then by z.
#[inline]
pub fn lexicographic3(a: Point3, b: Point3) -> Ordering {
    let different = (0..3).find(|&k| a[k] != b[k]);
    different.map_or(Ordering::Equal, |k| if a[k] < b[k] { Ordering::Less } else { Ordering::Greater })
}

/// Whether `q`, known to be collinear with `a` and `b`, lies strictly between them: the in-circle test one
/// dimension down, used for hull edges. Exact by comparison alone.
#[inline]
pub fn strictly_between(a: Point2, b: Point2, q: Point2) -> bool {
    let (low, high) = if lexicographic(a, b).is_lt() { (a, b) } else { (b, a) };
    lexicographic(low, q).is_lt() && lexicographic(q, high).is_lt()
}
