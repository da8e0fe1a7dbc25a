//! Where a circumcenter lies, seen from a corner: filter, exact. Degree four, without perturbation: zero is an answer.

use crate::{Point2, Sign, exact};

/// Relative error of a product of two sums of two products of rounded differences, and of the difference of two
/// such products, doubled for safety: ten roundings.
pub(crate) const ERROR: f64 = 20.0 * (f64::EPSILON / 2.0);
/// Below this magnitude an underflow could be as large as the error bound.
const SMALLEST: f64 = 1e-280;
/// The factor of an underflow in a product with `w` may be this multiple of the size of the terms: the product is
/// off by at most 2^-1075, and 2^-1000 leaves it below 2^-20 of the error bound.
pub(crate) const LOST: f64 = f64::from_bits((1023 - 1000) << 52);

/// On which side of the line from `o` through the circumcenter of `o`, `a`, `b` the point `p` is: positive on its
/// left. For `o`, `a`, `b` counter-clockwise. Zero if `p` is on the line, or the center is `o`.
///
/// With u = a - o, v = b - o, w = p - o it is the sign of |u|^2 (v.w) - |v|^2 (u.w). Exact for every finite input. O(1).
///
/// ```
/// use delone_predicates::{Sign, center_side};
/// // The center is (1, 1).
/// let side = |p| center_side([0.0, 0.0], [2.0, 0.0], [0.0, 2.0], p);
/// assert_eq!(side([1.0, 2.0]), Sign::Positive);
/// assert_eq!(side([3.0, 3.0]), Sign::Zero);
/// ```
#[inline]
pub fn center_side(o: Point2, a: Point2, b: Point2, p: Point2) -> Sign {
    let [u, v, w] = [a, b, p].map(|q| [q[0] - o[0], q[1] - o[1]]);
    side(u, v, w).unwrap_or_else(|| exact::center_side(o, a, b, p))
}

/// In which direction from `o` the circumcenter of `o`, `a`, `b` is, for `o`, `a`, `b` counter-clockwise: the signs
/// of its coordinates relative to `o`.
///
/// Exact for every finite input. O(1).
///
/// ```
/// use delone_predicates::{Sign, center_direction};
/// let direction = center_direction([0.0, 0.0], [2.0, 0.0], [1.0, 1.0]);
/// assert_eq!(direction, [Sign::Positive, Sign::Zero]);
/// ```
#[inline]
pub fn center_direction(o: Point2, a: Point2, b: Point2) -> [Sign; 2] {
    let [u, v] = [a, b].map(|q| [q[0] - o[0], q[1] - o[1]]);
    // What is left of the center, seen along an axis, and the other way round.
    match (side(u, v, [0.0, 1.0]), side(u, v, [-1.0, 0.0])) {
        (Some(x), Some(y)) => [x, y],
        _ => exact::center_direction(o, a, b),
    }
}

/// The filter, on differences.
#[inline]
pub(crate) fn side(u: Point2, v: Point2, w: Point2) -> Option<Sign> {
    let (uu, vv) = (u[0] * u[0] + u[1] * u[1], v[0] * v[0] + v[1] * v[1]);
    let ([ux, uy], [vx, vy]) = ([u[0] * w[0], u[1] * w[1]], [v[0] * w[0], v[1] * w[1]]);
    let value = uu * (vx + vy) - vv * (ux + uy);
    let size = uu * (vx.abs() + vy.abs()) + vv * (ux.abs() + uy.abs());
    // No product on the way may lose by underflow what counts. A sum of products loses nothing that counts if it is
    // normal itself; a product with w is multiplied by a length that may be huge.
    let kept = size >= SMALLEST && size >= LOST * (uu + vv);
    let in_range = uu.min(vv) >= SMALLEST && kept && size.is_finite();
    (value.abs() > ERROR * size && in_range).then(|| Sign::of(&value, &0.0))
}
