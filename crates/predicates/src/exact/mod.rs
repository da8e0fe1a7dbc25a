//! Stage two: the sign of the real-number expression, whatever it takes.
//!
//! In the plane three ways, the cheapest that holds: [`integers`] when the coordinates fit 61 bits on a common scale
//! (nearly all real data: grids, centimetres, coordinates of similar size), expansions of the `robust` crate
//! when no product can leave the exponent range, [`big`] integers for the rest.
//!
//! In space integers too: of 60 bits ([`space`]), of 120 ([`wide`]), [`big`] ones. What needs no dimension has one form
//! for both ([`lengths`]). Lines of the plane and where they meet have a file of their own (`line/exact.rs`), and so have
//! points with weights ([`power`]).
//!
//! Before big integers, floating point is asked once more, scaled so that nothing leaves the range (`filter/scaled.rs`).
//!
//! In the plane all three evaluate the base-and-apex form (see `pencil`): with l = a, r = b, the orientation of a, b, c is
//! `(c - a) x (c - b)`, and the in-circle determinant of a, b, c, d is `dot_c cross_d - dot_d cross_c`.

pub(crate) mod big;
pub(crate) mod big_int;
pub(crate) mod integers;
pub(crate) mod lengths;
pub(crate) mod power;
mod space;
pub(crate) mod wide;

use std::cmp::Ordering;

use crate::counters::{Predicate, Stage, count};
use crate::filter::{in_circle_scaled, in_sphere_scaled, orient2d_scaled, orient3d_scaled};
use crate::{Point2, Point3, Sign};

pub(crate) fn orient2d(a: Point2, b: Point2, c: Point2) -> Sign {
    // The sign of a difference is never wrong, and neither is that of a difference of products whose signs differ.
    let difference = |p: Point2, axis: usize| Sign::of(&p[axis], &c[axis]);
    let left = difference(a, 0) * difference(b, 1);
    let right = difference(a, 1) * difference(b, 0);
    if left != right || left.is_zero() {
        count(Predicate::Orient2d, Stage::Signs);
        return Sign::of(&left, &right);
    }
    let coordinates = [a[0], a[1], b[0], b[1], c[0], c[1]];
    if let Some(sign) = integers::orient2d(&coordinates) {
        count(Predicate::Orient2d, Stage::Integers);
        return sign;
    }
    if expansions_hold(&coordinates) {
        count(Predicate::Orient2d, Stage::Expansions);
        return Sign::of(&robust::orient2d(coord(a), coord(b), coord(c)), &0.0);
    }
    if let Some(sign) = orient2d_scaled(a, b, c) {
        count(Predicate::Orient2d, Stage::Scaled);
        return sign;
    }
    count(Predicate::Orient2d, Stage::Big);
    big::orient2d(&coordinates)
}

pub(crate) fn in_circle(a: Point2, b: Point2, c: Point2, d: Point2) -> Sign {
    let coordinates = [a[0], a[1], b[0], b[1], c[0], c[1], d[0], d[1]];
    if let Some(sign) = integers::in_circle(&coordinates) {
        count(Predicate::InCircle, Stage::Integers);
        return sign;
    }
    if expansions_hold(&coordinates) {
        count(Predicate::InCircle, Stage::Expansions);
        return Sign::of(&robust::incircle(coord(a), coord(b), coord(c), coord(d)), &0.0);
    }
    if let Some(sign) = in_circle_scaled(a, b, c, d) {
        count(Predicate::InCircle, Stage::Scaled);
        return sign;
    }
    count(Predicate::InCircle, Stage::Big);
    big::in_circle(&coordinates)
}

pub(crate) fn compare_distances(q: Point2, a: Point2, b: Point2) -> Ordering {
    let coordinates = [q[0], q[1], a[0], a[1], b[0], b[1]];
    integers::compare_distances(&coordinates).unwrap_or_else(|| big::compare_distances(&coordinates))
}

pub(crate) fn compare_with_radius(q: Point2, a: Point2, radius: f64) -> Ordering {
    // The radius is the distance of (radius, 0) from the origin, on the common scale.
    let coordinates = [q[0], q[1], a[0], a[1], radius, 0.0];
    integers::compare_with_radius(&coordinates).unwrap_or_else(|| big::compare_with_radius(&coordinates))
}

#[cold]
#[inline(never)]
pub(crate) fn compare_line_with_radius(q: Point2, [a, b]: [Point2; 2], radius: f64) -> Ordering {
    big::compare_line_with_radius(&[q[0], q[1], a[0], a[1], b[0], b[1], radius])
}

#[cold]
pub(crate) fn compare_distances3(q: Point3, a: Point3, b: Point3) -> Ordering {
    let mut coordinates = [0.0; 9];
    coordinates.copy_from_slice([q, a, b].as_flattened());
    space::compare_distances(&coordinates).unwrap_or_else(|| big::compare_distances3(&coordinates))
}

#[cold]
pub(crate) fn compare_with_radius3(q: Point3, a: Point3, radius: f64) -> Ordering {
    let mut coordinates = [0.0; 9];
    coordinates.copy_from_slice([q, a, [radius, 0.0, 0.0]].as_flattened());
    space::compare_with_radius(&coordinates).unwrap_or_else(|| big::compare_with_radius3(&coordinates))
}

pub(crate) fn angle(o: Point2, a: Point2, b: Point2) -> Sign {
    let coordinates = [a[0], a[1], b[0], b[1], o[0], o[1]];
    integers::angle(&coordinates).unwrap_or_else(|| big::angle(&coordinates))
}

pub(crate) fn center_side(o: Point2, a: Point2, b: Point2, p: Point2) -> Sign {
    let coordinates = [o[0], o[1], a[0], a[1], b[0], b[1], p[0], p[1]];
    integers::center_side(&coordinates).unwrap_or_else(|| big::center_side(&coordinates))
}

pub(crate) fn center_direction(o: Point2, a: Point2, b: Point2) -> [Sign; 2] {
    let coordinates = [o[0], o[1], a[0], a[1], b[0], b[1]];
    integers::center_direction(&coordinates).unwrap_or_else(|| big::center_direction(&coordinates))
}

pub(crate) fn circumcenter(a: Point2, b: Point2, c: Point2) -> Option<Point2> {
    big::circumcenter(&[a[0], a[1], b[0], b[1], c[0], c[1]])
}

#[cold]
#[inline(never)]
pub(crate) fn orient3d(a: Point3, b: Point3, c: Point3, d: Point3) -> Sign {
    let mut coordinates = [0.0; 12];
    coordinates.copy_from_slice([a, b, c, d].as_flattened());
    let integers = || space::orient3d(&coordinates).or_else(|| wide::orient3d(&coordinates));
    let scaled = || orient3d_scaled(a, b, c, d);
    integers().or_else(scaled).unwrap_or_else(|| big::orient3d(&coordinates))
}

pub(crate) fn in_sphere(a: Point3, b: Point3, c: Point3, d: Point3, e: Point3) -> Sign {
    let mut coordinates = [0.0; 15];
    coordinates.copy_from_slice([a, b, c, d, e].as_flattened());
    let integers = || space::in_sphere(&coordinates).or_else(|| wide::in_sphere(&coordinates));
    let scaled = || in_sphere_scaled(a, b, c, d, e);
    integers().or_else(scaled).unwrap_or_else(|| big::in_sphere(&coordinates))
}

#[cold]
pub(crate) fn side_in_plane(a: Point3, b: Point3, c: Point3, q: Point3) -> Sign {
    let mut coordinates = [0.0; 12];
    coordinates.copy_from_slice([a, b, c, q].as_flattened());
    big::side_in_plane(&coordinates)
}

fn coord(p: Point2) -> robust::Coord<f64> {
    robust::Coord { x: p[0], y: p[1] }
}

/// Whether expansion arithmetic of degree four can neither overflow nor underflow: every coordinate is zero
/// or has a magnitude between 2^-142 and 2^200 (Shewchuk 1997, §2.1: the product of four tails must stay
/// normal).
fn expansions_hold(coordinates: &[f64]) -> bool {
    const LOW: f64 = f64::from_bits((1023 - 142) << 52);
    const HIGH: f64 = f64::from_bits((1023 + 200) << 52);
    coordinates.iter().all(|x| *x == 0.0 || (LOW..=HIGH).contains(&x.abs()))
}

/// Coordinates up to this one are too small to be scaled by one number.
const TINY: f64 = 1e-270;

/// The coordinates times a power of two, if these are integers of so many bits. None if all coordinates are [`TINY`].
#[inline]
fn to_integers<const N: usize>(coordinates: &[f64; N], bits: i32) -> Option<[i64; N]> {
    let (mut largest, mut least) = (0.0_f64, f64::MAX);
    for x in coordinates {
        largest = largest.max(x.abs());
        least = least.min(if *x == 0.0 { f64::MAX } else { x.abs() });
    }
    let exponent = |x: f64| (x.to_bits() >> 52) as i32 - 1023;
    // What is that much smaller is below one, and products below the range would take a hundred times as long as others.
    if largest <= TINY || exponent(least) <= exponent(largest) - bits {
        return None;
    }
    let scale = f64::from_bits(((1022 + bits - exponent(largest)) as u64) << 52);
    let mut integers = [0; N];
    let mut exact = true;
    for (out, x) in integers.iter_mut().zip(coordinates) {
        // Exact, being a product with a power of two that is not below one.
        let scaled = x * scale;
        *out = scaled as i64;
        exact &= *out as f64 == scaled;
    }
    exact.then_some(integers)
}

/// A finite `f64` as `mantissa * 2^exponent` with an odd mantissa, or (0, i32::MAX) for zero.
pub(crate) fn decode(x: f64) -> (i64, i32) {
    if x == 0.0 {
        return (0, i32::MAX);
    }
    let bits = x.to_bits();
    let biased = (bits >> 52) as i32 & 0x7ff;
    let fraction = (bits & ((1 << 52) - 1)) as i64;
    let mantissa = if biased == 0 { fraction } else { fraction | 1 << 52 };
    let zeros = mantissa.trailing_zeros() as i32;
    let magnitude = mantissa >> zeros;
    (if x < 0.0 { -magnitude } else { magnitude }, biased.max(1) - 1075 + zeros)
}

#[cfg(test)]
mod tests {
    use super::{decode, expansions_hold, integers, space, wide};

    /// Operands that fit are not handed on to slower arithmetic.
    #[test]
    fn integers_take_what_fits() {
        let flat = [1.0, 2.0, 7.0, 3.0, 4.0, 9.0, 5.0, 8.0];
        let six = [1.0, 2.0, 7.0, 3.0, 4.0, 9.0];
        assert!(integers::orient2d(&six).is_some() && integers::in_circle(&flat).is_some());
        assert!(integers::compare_distances(&six).is_some() && integers::compare_with_radius(&six).is_some());
        assert!(integers::angle(&six).is_some() && integers::center_side(&flat).is_some());
        assert!(integers::center_direction(&six).is_some());
        let solid: [f64; 15] = std::array::from_fn(|i| ((i * i * i) % 17) as f64);
        let (nine, twelve) = (solid.first_chunk().expect("9 of 15"), solid.first_chunk().expect("12 of 15"));
        assert!(space::orient3d(twelve).is_some() && space::in_sphere(&solid).is_some());
        assert!(space::compare_distances(nine).is_some() && space::compare_with_radius(nine).is_some());
        let mut spread = solid;
        spread[1] = 2f64.powi(100);
        assert!(space::in_sphere(&spread).is_none() && wide::in_sphere(&spread).is_some());
        assert!(wide::orient3d(spread.first_chunk().expect("12 of 15")).is_some());
    }

    #[test]
    fn expansions_hold_within_their_range() {
        let (low, high) = (2f64.powi(-142), 2f64.powi(200));
        assert!(expansions_hold(&[0.0, -0.0, low, -low, 1.0, high, -high]));
        for x in [low / 2.0, -low / 2.0, 2.0 * high, -2.0 * high, 5e-324] {
            assert!(!expansions_hold(&[1.0, x]), "{x:e}");
        }
    }

    #[test]
    fn decoding_is_exact() {
        for x in [1.0, -3.0, 0.1, 1e308, -1e-308, f64::from_bits(1), f64::MAX, f64::MIN_POSITIVE, 6.0] {
            let (mantissa, exponent) = decode(x);
            assert_eq!(mantissa & 1, 1);
            // Two steps, because 2^exponent alone may be subnormal.
            let half = exponent / 2;
            assert_eq!(mantissa as f64 * 2f64.powi(half) * 2f64.powi(exponent - half), x);
        }
        assert_eq!(decode(-0.0).0, 0);
    }
}
