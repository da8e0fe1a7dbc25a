//! The filter of the inside: the sign of an expression that is negative inside.
//!
//! Bounds are relative to sums of magnitudes, which Cauchy's inequality and that of the means bound by squared lengths: with U, V, Q
//! the squared lengths of u, v, q and H the sizes of lifts, |q . u| <= (Q + U) / 2, the terms of |u x v|^2 are at most 2 U V, and those of
//! (h v - k u) . ((u x v) x q) at most H V (Q + U) + K U (Q + V).

use super::Side;
use crate::filter::outside_of;
use crate::{Site, distance};

const U: f64 = f64::EPSILON / 2.0;
/// An edge: 13u times the size of its terms.
pub(super) const EDGE_BOUND: f64 = (13.0 + 256.0 * U) * U;
/// A triangle: 21u.
pub(super) const TRIANGLE_BOUND: f64 = (21.0 + 512.0 * U) * U;
/// The largest sum of the sizes of lifts for which [`FLOOR`] is valid: 2^200.
pub(super) const CEILING: f64 = f64::from_bits((1023 + 200) << 52);
/// All errors by underflow: each of fewer than 128 roundings is off by at most 2^-1075, and is multiplied by at most 2^405, two lifts
/// and two more lengths.
pub(super) const FLOOR: f64 = f64::from_bits((1023 - 660) << 52);

/// A site as seen from another: the difference, its squared length, the lift and its size.
struct Seen<const D: usize> {
    row: [f64; D],
    square: f64,
    lift: f64,
    size: f64,
}

#[inline]
fn seen<const D: usize>((p, w): Site<D>, (q, v): Site<D>) -> Seen<D> {
    let row: [f64; D] = std::array::from_fn(|axis| p[axis] - q[axis]);
    let (square, weight) = (dot(row, row), w - v);
    Seen { row, square, lift: square - weight, size: square + weight.abs() }
}

#[inline]
fn dot<const D: usize>(u: [f64; D], v: [f64; D]) -> f64 {
    (0..D).map(|axis| u[axis] * v[axis]).fold(0.0, |sum, x| sum + x)
}

#[inline]
fn cross(u: [f64; 3], v: [f64; 3]) -> [f64; 3] {
    [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
}

/// (a - q) . (b - q), negative where q sees an obtuse angle.
#[inline]
pub(super) fn angle<const D: usize>(a: [f64; D], b: [f64; D], q: [f64; D]) -> Option<Side> {
    let products: [f64; D] = std::array::from_fn(|axis| (a[axis] - q[axis]) * (b[axis] - q[axis]));
    let (value, size) = products.iter().fold((0.0, 0.0), |(sum, size), x| (sum + x, size + x.abs()));
    distance::told(value, size)
}

/// h_q |u|^2 - h (q . u), seen from b.
#[inline]
pub(super) fn edge<const D: usize>(a: Site<D>, b: Site<D>, q: Site<D>) -> Option<Side> {
    let (a, q) = (seen(a, b), seen(q, b));
    let value = q.lift * a.square - a.lift * dot(q.row, a.row);
    let size = q.size * a.square + 0.5 * a.size * (q.square + a.square);
    if a.size + q.size < CEILING { outside_of(value, EDGE_BOUND * size + FLOOR) } else { None }
}

/// h_q |n|^2 - (h v - k u) . (n x q) with n = u x v, seen from c.
#[inline]
pub(super) fn triangle(a: Site<3>, b: Site<3>, c: Site<3>, q: Site<3>) -> Option<Side> {
    let (a, b, q) = (seen(a, c), seen(b, c), seen(q, c));
    let n = cross(a.row, b.row);
    let t = [0, 1, 2].map(|axis| a.lift * b.row[axis] - b.lift * a.row[axis]);
    let value = q.lift * dot(n, n) - dot(t, cross(n, q.row));
    let size = 2.0 * q.size * a.square * b.square
        + a.size * b.square * (q.square + a.square)
        + b.size * a.square * (q.square + b.square);
    if a.size + b.size + q.size < CEILING { outside_of(value, TRIANGLE_BOUND * size + FLOOR) } else { None }
}
