//! Floating point for numbers of any size: the filters once more, on differences that are scaled one by one.
//!
//! A filter on plain differences knows nothing where products leave the exponent range, as they do at 1e-100 and at 1e100,
//! and among numbers of very different sizes. So each row of a determinant is divided by a power of two of its own, which
//! changes no sign and is exact. The squared length in a row is then too large by that power; the smaller rows' powers are
//! brought back, relative to the largest one. Differences are taken from one of the two points that are nearest to each
//! other: from a far one, those that are near each other would look the same.
//!
//! Underflow then loses digits only beside numbers of size one, and a constant floor covers it. Cost: some fifty
//! operations more than the filter; asked only where big integers are what is left.

use super::space::{IN_SPHERE_BOUND, ORIENT3D_BOUND, orient3d_terms, sphere_terms};
use super::{IN_CIRCLE_BOUND, ORIENT_BOUND, circle_terms, orient_terms, outside_of};
use crate::{Point2, Point3, Sign};

/// All errors by underflow: fewer than 128 roundings, each off by at most 2^-1075, multiplied by less than 2^20. A row's
/// power may be rounded to zero, below 2^-1000.
pub(super) const FLOOR: f64 = f64::from_bits((1023 - 960) << 52);

/// Orientation of three points, if it can be told.
pub(crate) fn orient2d_scaled(a: Point2, b: Point2, c: Point2) -> Option<Sign> {
    let (Rows { rows: [u, v], .. }, swapped) = rows([a, b, c])?;
    let (value, size) = orient_terms(u, v);
    outside_of(turned(value, swapped), ORIENT_BOUND * size + FLOOR)
}

/// In-circle test of four points, if it can be told.
pub(crate) fn in_circle_scaled(a: Point2, b: Point2, c: Point2, d: Point2) -> Option<Sign> {
    let (Rows { rows, powers }, swapped) = rows([a, b, c, d])?;
    let lift = |k: usize| powers[k] * (rows[k][0] * rows[k][0] + rows[k][1] * rows[k][1]);
    let (value, size) = circle_terms(rows, [lift(0), lift(1), lift(2)]);
    outside_of(turned(value, swapped), IN_CIRCLE_BOUND * size + FLOOR)
}

/// Orientation of four points in space, if it can be told.
pub(crate) fn orient3d_scaled(a: Point3, b: Point3, c: Point3, d: Point3) -> Option<Sign> {
    let (Rows { rows, .. }, swapped) = rows([a, b, c, d])?;
    let (value, size) = orient3d_terms(rows);
    outside_of(turned(-value, swapped), ORIENT3D_BOUND * size + FLOOR)
}

/// In-sphere test of five points, if it can be told.
pub(crate) fn in_sphere_scaled(a: Point3, b: Point3, c: Point3, d: Point3, e: Point3) -> Option<Sign> {
    let (Rows { rows, powers }, swapped) = rows([a, b, c, d, e])?;
    let lift = |k: usize| powers[k] * rows[k].iter().map(|x| x * x).sum::<f64>();
    let (value, size) = sphere_terms(rows, [lift(0), lift(1), lift(2), lift(3)]);
    outside_of(turned(-value, swapped), IN_SPHERE_BOUND * size + FLOOR)
}

fn turned(value: f64, swapped: bool) -> f64 {
    if swapped { -value } else { value }
}

/// The rows of a determinant, the largest number in each from 1 to 2, and what each was divided by, relative to the largest.
struct Rows<const D: usize, const R: usize> {
    rows: [[f64; D]; R],
    powers: [f64; R],
}

/// The rows of the differences of N points from one of them, and whether that was swapped with the last. `None` where a
/// difference overflows, or two points are equal.
fn rows<const D: usize, const N: usize, const R: usize>(
    mut points: [[f64; D]; N],
) -> Option<(Rows<D, R>, bool)> {
    const { assert!(R + 1 == N) };
    let size = |p: [f64; D], q: [f64; D]| (0..D).fold(0.0_f64, |m, k| m.max((p[k] - q[k]).abs()));
    let (mut origin, mut nearest) = (N - 1, f64::INFINITY);
    for i in 0..N {
        for j in 0..i {
            let distance = size(points[i], points[j]);
            // Not among the last: any of the two will do, and the last needs no swap.
            if distance < nearest {
                (origin, nearest) = (i, distance);
            }
        }
    }
    points.swap(origin, N - 1);
    let mut exponents = [0; R];
    let mut rows = [[0.0; D]; R];
    for k in 0..R {
        let difference: [f64; D] = std::array::from_fn(|axis| points[k][axis] - points[N - 1][axis]);
        let largest = difference.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        if !(largest > 0.0 && largest.is_finite()) {
            return None;
        }
        exponents[k] = exponent(largest);
        rows[k] = difference.map(|x| divided(x, exponents[k]));
    }
    let largest = exponents.iter().fold(i32::MIN, |m, &e| m.max(e));
    let powers = exponents.map(|e| if largest - e < 1000 { power(e - largest) } else { 0.0 });
    Some((Rows { rows, powers }, origin != N - 1))
}

/// The exponent of a positive finite number.
fn exponent(x: f64) -> i32 {
    let biased = (x.to_bits() >> 52) as i32;
    // A subnormal number is its bits, in steps of 2^-1074.
    if biased == 0 { x.to_bits().ilog2() as i32 - 1074 } else { biased - 1023 }
}

/// 2^e of a normal number.
fn power(e: i32) -> f64 {
    f64::from_bits(((1023 + e) as u64) << 52)
}

/// x / 2^e, in two steps, because 2^-e need not be a number.
fn divided(x: f64, e: i32) -> f64 {
    let half = -e / 2;
    x * power(half) * power(-e - half)
}
