//! Exact signs in arbitrary precision: the last resort, for tuples that span hundreds of binary orders.

use std::cmp::Ordering;

use super::big_int::BigInt;
use super::decode;
use crate::Sign;

type Vector = [BigInt; 2];

/// The points as big integers on their common scale.
fn align<const N: usize>(coordinates: &[f64; N]) -> Vec<Vector> {
    aligned(coordinates).0
}

/// The same, and the binary exponent of the scale.
fn aligned<const N: usize>(coordinates: &[f64; N]) -> (Vec<Vector>, i32) {
    let (flat, scale) = integers(coordinates);
    (flat.chunks_exact(2).map(|xy| [xy[0].clone(), xy[1].clone()]).collect(), scale)
}

/// Numbers as integers on their common scale, and its binary exponent.
pub(crate) fn integers(numbers: &[f64]) -> (Vec<BigInt>, i32) {
    let parts: Vec<_> = numbers.iter().map(|&x| decode(x)).collect();
    let scale = parts.iter().map(|part| part.1).min().unwrap_or(0);
    let integer = |(mantissa, exponent): (i64, i32)| match mantissa {
        0 => BigInt::ZERO,
        _ => BigInt::shifted(mantissa, (exponent - scale).unsigned_abs()),
    };
    (parts.into_iter().map(integer).collect(), scale)
}

/// The distance of the first point from the line through two others against a radius.
pub(crate) fn compare_line_with_radius(numbers: &[f64; 7]) -> Ordering {
    let (x, _) = integers(numbers);
    let from = |i: usize| [&x[i] - &x[2], &x[i + 1] - &x[3]];
    let (d, e) = (from(4), from(0));
    let area = &d[0] * &e[1] - &d[1] * &e[0];
    let length = &d[0] * &d[0] + &d[1] * &d[1];
    (&area * &area).cmp(&(&x[6] * &x[6] * length))
}

fn difference(q: &Vector, p: &Vector) -> Vector {
    [&q[0] - &p[0], &q[1] - &p[1]]
}

fn dot(u: &Vector, v: &Vector) -> BigInt {
    &u[0] * &v[0] + &u[1] * &v[1]
}

fn cross(u: &Vector, v: &Vector) -> BigInt {
    &u[0] * &v[1] - &u[1] * &v[0]
}

pub(super) fn orient2d(coordinates: &[f64; 6]) -> Sign {
    let p = align(coordinates);
    cross(&difference(&p[2], &p[0]), &difference(&p[2], &p[1])).sign()
}

pub(super) fn in_circle(coordinates: &[f64; 8]) -> Sign {
    let p = align(coordinates);
    let (ca, cb) = (difference(&p[2], &p[0]), difference(&p[2], &p[1]));
    let (da, db) = (difference(&p[3], &p[0]), difference(&p[3], &p[1]));
    (dot(&ca, &cb) * cross(&da, &db) - dot(&da, &db) * cross(&ca, &cb)).sign()
}

fn squared(q: &Vector, p: &Vector) -> BigInt {
    let d = difference(q, p);
    dot(&d, &d)
}

pub(super) fn compare_distances(coordinates: &[f64; 6]) -> Ordering {
    let p = align(coordinates);
    squared(&p[0], &p[1]).cmp(&squared(&p[0], &p[2]))
}

pub(super) fn compare_with_radius(coordinates: &[f64; 6]) -> Ordering {
    let p = align(coordinates);
    squared(&p[0], &p[1]).cmp(&dot(&p[2], &p[2]))
}

pub(super) fn angle(coordinates: &[f64; 6]) -> Sign {
    let p = align(coordinates);
    dot(&difference(&p[2], &p[0]), &difference(&p[2], &p[1])).sign()
}

pub(super) fn center_side(coordinates: &[f64; 8]) -> Sign {
    let p = align(coordinates);
    let [u, v, w] = [1, 2, 3].map(|i| difference(&p[i], &p[0]));
    (dot(&u, &u) * dot(&v, &w) - dot(&v, &v) * dot(&u, &w)).sign()
}

pub(super) fn center_direction(coordinates: &[f64; 6]) -> [Sign; 2] {
    let p = align(coordinates);
    let (u, v) = (difference(&p[1], &p[0]), difference(&p[2], &p[0]));
    let (uu, vv) = (dot(&u, &u), dot(&v, &v));
    [(&uu * &v[1] - &vv * &u[1]).sign(), (&vv * &u[0] - &uu * &v[0]).sign()]
}

fn squared3(p: &[BigInt], i: usize, j: usize) -> BigInt {
    (0..3).map(|k| &p[3 * i + k] - &p[3 * j + k]).map(|x| &x * &x).sum()
}

pub(super) fn compare_distances3(coordinates: &[f64; 9]) -> Ordering {
    let (p, _) = integers(coordinates);
    squared3(&p, 0, 1).cmp(&squared3(&p, 0, 2))
}

pub(super) fn compare_with_radius3(coordinates: &[f64; 9]) -> Ordering {
    let (p, _) = integers(coordinates);
    squared3(&p, 0, 1).cmp(&(&p[6] * &p[6]))
}

pub(super) fn orient3d(coordinates: &[f64; 12]) -> Sign {
    let (p, _) = integers(coordinates);
    let from_first = |i: usize| [0, 1, 2].map(|k| &p[3 * i + k] - &p[k]);
    let [u, v, w] = [1, 2, 3].map(from_first);
    let minor = |i: usize, j: usize| &v[i] * &w[j] - &v[j] * &w[i];
    (&u[0] * minor(1, 2) - &u[1] * minor(0, 2) + &u[2] * minor(0, 1)).sign()
}

pub(super) fn in_sphere(coordinates: &[f64; 15]) -> Sign {
    let (p, _) = integers(coordinates);
    let from_last = |i: usize| [0, 1, 2].map(|k| &p[3 * i + k] - &p[12 + k]);
    let [a, b, c, d] = [0, 1, 2, 3].map(from_last);
    let minor = |u: &[BigInt; 3], v: &[BigInt; 3]| &u[0] * &v[1] - &v[0] * &u[1];
    let three = |u: &[BigInt; 3], v: &[BigInt; 3], w: &[BigInt; 3]| {
        &u[2] * minor(v, w) - &v[2] * minor(u, w) + &w[2] * minor(u, v)
    };
    let lift = |u: &[BigInt; 3]| u.iter().map(|x| x * x).sum::<BigInt>();
    // Positive where e is inside, and d above a, b, c.
    let positive = lift(&c) * three(&a, &b, &d) + lift(&a) * three(&b, &c, &d);
    (positive - lift(&d) * three(&a, &b, &c) - lift(&b) * three(&a, &c, &d)).sign()
}

/// Points a, b, c, q: |b - a|^2 (c - a).(q - a) against (b - a).(c - a) (b - a).(q - a).
pub(super) fn side_in_plane(coordinates: &[f64; 12]) -> Sign {
    let (p, _) = integers(coordinates);
    let [u, v, w] = [1, 2, 3].map(|i| [0, 1, 2].map(|k| &p[3 * i + k] - &p[k]));
    let dot = |u: &[BigInt; 3], v: &[BigInt; 3]| (0..3).map(|k| &u[k] * &v[k]).sum::<BigInt>();
    (dot(&u, &u) * dot(&v, &w) - dot(&u, &v) * dot(&u, &w)).sign()
}

/// The point at the same distance from three points, correctly rounded; a coordinate that no `f64` can hold is
/// infinite. None for collinear points.
pub(super) fn circumcenter(coordinates: &[f64; 6]) -> Option<[f64; 2]> {
    let (p, scale) = aligned(coordinates);
    let (b, c) = (difference(&p[1], &p[0]), difference(&p[2], &p[0]));
    let (bb, cc) = (dot(&b, &b), dot(&c, &c));
    let denominator = cross(&b, &c) << 1;
    if denominator == BigInt::ZERO {
        return None;
    }
    let x = &p[0][0] * &denominator + (&c[1] * &bb - &b[1] * &cc);
    let y = &p[0][1] * &denominator + (&b[0] * &cc - &c[0] * &bb);
    Some([x, y].map(|numerator| quotient(&numerator, &denominator, scale)))
}

/// `numerator / denominator * 2^scale`, rounded once unless it is subnormal.
pub(crate) fn quotient(numerator: &BigInt, denominator: &BigInt, scale: i32) -> f64 {
    /// Bits of the quotient that are computed; the last one stands for all that follow.
    const BITS: i64 = 80;
    /// The exponent of the least number.
    const LEAST: i64 = -1074;
    /// From so many bits below it on a quotient is subnormal.
    const SUBNORMAL: i64 = BITS + 1 - 53;
    let is_negative = numerator.sign() * denominator.sign() == Sign::Negative;
    let (n, d) = (numerator.clone().magnitude(), denominator.clone().magnitude());
    let shift = BITS - (n.bits() - d.bits());
    let power = shift.unsigned_abs() as u32;
    let (n, d) = if shift >= 0 { (n << power, d) } else { (n, d << power) };
    let (whole, is_more) = n.divided(&d);
    let whole = whole | u128::from(is_more);
    let mut exponent = i64::from(scale) - shift;
    let mut value = if let cut @ (SUBNORMAL..) = LEAST - exponent {
        // Where steps are wider than those of 53 bits, rounding to these first would be once too often.
        exponent = 0;
        f64::from_bits(shortened(whole, cut))
    } else {
        whole as f64
    };
    if is_negative {
        value = -value;
    }
    // In steps, because the power of two itself may be out of range.
    while exponent != 0 && value != 0.0 && value.is_finite() {
        let step = exponent.clamp(-1000, 1000);
        value *= 2f64.powi(step as i32);
        exponent -= step;
    }
    // No negative zero.
    value + 0.0
}

/// A number of at most 81 bits without its last ones, rounded to the nearest, ties to even.
fn shortened(whole: u128, bits: i64) -> u64 {
    if bits > 100 {
        return 0;
    }
    let (kept, rest, half) = (whole >> bits, whole & ((1 << bits) - 1), 1 << (bits - 1));
    (kept + u128::from(rest > half || (rest == half && kept % 2 == 1))) as u64
}

#[cfg(test)]
mod tests {
    use super::{BigInt, quotient};

    /// Two thirds of the least normal number, and what is next to half of a step.
    #[test]
    fn subnormal_quotients_are_rounded_once() {
        let third = |n: i64| quotient(&BigInt::from(n), &BigInt::from(3), -1074);
        assert_eq!(third(1 << 53), f64::from_bits(((1 << 53) + 1) / 3));
        assert_eq!([1, 2, 3, 4, 5].map(third), [0, 1, 1, 1, 2].map(f64::from_bits));
        let halves = |n: i64| quotient(&BigInt::from(n), &BigInt::from(2), -1074);
        assert_eq!([1, 3, 5].map(halves), [0, 2, 2].map(f64::from_bits));
        // 2^60 + 1 of 2^61 steps are more than half of one.
        let half = BigInt::from((1 << 60) + 1);
        assert_eq!(quotient(&-half, &(BigInt::from(1) << 61), -1074), -f64::from_bits(1));
        assert_eq!(quotient(&BigInt::from(1), &BigInt::from(1), -4000), 0.0);
    }

    /// 81 bits that are half a step of a number and one more, and then a remainder: up, and not to the even one.
    #[test]
    fn quotients_are_rounded_once() {
        let whole = (BigInt::from(1) << 80) + BigInt::from(1 << 27);
        for (more, expected) in [(0, 2f64.powi(80)), (1, 2f64.powi(80) + 2f64.powi(28))] {
            let numerator = (&whole + BigInt::from(more)) * BigInt::from(3);
            assert_eq!(quotient(&numerator, &BigInt::from(3), 0), expected);
            let above = 2f64.powi(80) + 2f64.powi(28);
            assert_eq!(quotient(&(&numerator + BigInt::from(1)), &BigInt::from(3), 0), above);
            assert_eq!(quotient(&-(numerator + BigInt::from(1)), &BigInt::from(3), 0), -above);
        }
    }
}
