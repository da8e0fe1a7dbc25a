//! Exact signs of degree two in up to three dimensions: lengths, angles and the balls of lunes. Integers where coordinates fit
//! 61 bits on a common scale: differences then fit 62, and sums of three products 126.

use std::cmp::Ordering;

use super::big;
use super::big_int::BigInt;
use super::decode;
use super::integers::{align_into, compare_products};
use crate::Sign;

/// The coordinates of up to four points in up to three dimensions; what is missing is zero.
fn flat<const D: usize, const N: usize>(points: [[f64; D]; N]) -> [f64; 12] {
    let mut flat = [0.0; 12];
    flat[..D * N].copy_from_slice(points.as_flattened());
    flat
}

/// The coordinates as integers on their common scale, if they fit.
fn aligned(flat: &[f64; 12]) -> Option<[i64; 12]> {
    let mut aligned = [0; 12];
    align_into(flat, &mut aligned)?;
    Some(aligned)
}

/// The scalar product of q - p and s - r, of the points with these numbers.
fn dot<const D: usize>(x: &[i64; 12], [p, q]: [usize; 2], [r, s]: [usize; 2]) -> i128 {
    let along = |from: usize, to: usize, k: usize| i128::from(x[D * to + k] - x[D * from + k]);
    (0..D).map(|k| along(p, q, k) * along(r, s, k)).sum()
}

fn big_dot<const D: usize>(x: &[BigInt], [p, q]: [usize; 2], [r, s]: [usize; 2]) -> BigInt {
    let along = |from: usize, to: usize, k: usize| &x[D * to + k] - &x[D * from + k];
    (0..D).map(|k| along(p, q, k) * along(r, s, k)).sum()
}

/// The length of one segment against that of another.
#[cold]
#[inline(never)]
pub(crate) fn compare<const D: usize>(one: [[f64; D]; 2], other: [[f64; D]; 2]) -> Ordering {
    let flat = flat([one[0], one[1], other[0], other[1]]);
    if let Some(x) = aligned(&flat) {
        return dot::<D>(&x, [0, 1], [0, 1]).cmp(&dot::<D>(&x, [2, 3], [2, 3]));
    }
    let (x, _) = big::integers(&flat);
    big_dot::<D>(&x, [0, 1], [0, 1]).cmp(&big_dot::<D>(&x, [2, 3], [2, 3]))
}

/// The sign of (a - o).(b - o).
#[cold]
#[inline(never)]
pub(crate) fn angle<const D: usize>(o: [f64; D], a: [f64; D], b: [f64; D]) -> Sign {
    let flat = flat([o, a, b]);
    if let Some(x) = aligned(&flat) {
        return Sign::of(&dot::<D>(&x, [0, 1], [0, 2]), &0);
    }
    let (x, _) = big::integers(&flat);
    big_dot::<D>(&x, [0, 1], [0, 2]).sign()
}

/// The sign of beta (p - a).(b - a) - |p - a|^2, for a finite beta above zero.
#[cold]
#[inline(never)]
pub(crate) fn ball<const D: usize>(a: [f64; D], b: [f64; D], p: [f64; D], beta: f64) -> Sign {
    let flat = flat([a, b, p]);
    let (mantissa, exponent) = decode(beta);
    // beta is the quotient of these.
    let factors = match exponent {
        0..=73 => Some((i128::from(mantissa) << exponent, 1)),
        -126..0 => Some((i128::from(mantissa), 1 << -exponent)),
        _ => None,
    };
    if let (Some(x), Some((numerator, denominator))) = (aligned(&flat), factors) {
        let (along, square) = (dot::<D>(&x, [0, 2], [0, 1]), dot::<D>(&x, [0, 2], [0, 2]));
        return compare_products(numerator, along, denominator, square);
    }
    let (x, _) = big::integers(&flat);
    let (along, square) = (big_dot::<D>(&x, [0, 2], [0, 1]), big_dot::<D>(&x, [0, 2], [0, 2]));
    let power = exponent.unsigned_abs();
    let (along, square) = if exponent < 0 { (along, square << power) } else { (along << power, square) };
    (along * BigInt::from(mantissa) - square).sign()
}

#[cfg(test)]
mod tests {
    use std::cmp::Ordering;

    use super::{aligned, angle, ball, compare, flat};
    use crate::Sign;

    /// The largest coordinates that are taken, at which sums of three products have 126 bits.
    #[test]
    fn the_largest_integers_fit() {
        let m = 2f64.powi(60);
        let (low, high) = ([-m, -m, -m], [m, m, m]);
        assert!(aligned(&flat([low, high, [1.0, 0.0, 0.0]])).is_some());
        assert_eq!(compare([low, high], [high, [-m, -m, 128.0 - m]]), Ordering::Greater);
        assert_eq!(compare([low, high], [high, low]), Ordering::Equal);
        assert_eq!(angle(low, high, high), Sign::Positive);
        assert_eq!(angle([0.0; 3], low, high), Sign::Negative);
        assert_eq!(ball(low, high, high, 1.0), Sign::Zero);
        assert_eq!(ball(low, high, high, 1.0 + f64::EPSILON), Sign::Positive);
        assert_eq!(ball(low, high, high, 2f64.powi(73) * 1.75), Sign::Positive);
    }

    /// Equal answers on both sides of the limit of integers.
    #[test]
    fn factors_of_any_size() {
        for power in [-1074, -1000, -127, -126, -53, -1, 0, 1, 73, 74, 200, 971] {
            let beta = f64::from_bits(((power + 1023).max(0) as u64) << 52).max(f64::from_bits(1));
            let (a, b) = ([1.0, 2.0], [3.0, 2.0]);
            let expected = |p: [f64; 2]| {
                let (along, square) = ((p[0] - a[0]) * 2.0, (p[0] - a[0]).powi(2) + (p[1] - a[1]).powi(2));
                Sign::of(&(beta * along), &square)
            };
            for p in [[3.0, 2.0], [1.0, 5.0], [2.0, 3.0], [-1.0, 2.0], [5.0, 2.0]] {
                assert_eq!(ball(a, b, p, beta), expected(p), "2^{power} {p:?}");
            }
            assert_eq!(ball(a, b, a, beta), Sign::Zero);
            assert_eq!(ball(a, b, [1.0, 2.0 + 2f64.powi(-50)], beta), Sign::Negative);
        }
    }
}
