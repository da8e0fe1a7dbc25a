//! Exact signs in space in machine integers, for coordinates that fit 60 bits on a common scale.
//!
//! Differences fit 61 bits and a sign, minors of two columns 123, minors of three 186, squared lengths 124, and
//! the in-sphere determinant 312. A minor of three columns is kept as two sums, `high` 2^64 + `low`, whose parts need
//! no carries; the determinant as five words, each gathered in 128 bits, with one carry at the end.

use std::cmp::Ordering;

use super::to_integers;
use crate::Sign;

/// The coordinates as integers on a common scale, if they fit.
#[inline]
fn align<const N: usize>(coordinates: &[f64; N]) -> Option<[i64; N]> {
    to_integers(coordinates, 60)
}

/// A vector, with its squared length.
#[derive(Clone, Copy)]
struct Vector {
    x: i64,
    y: i64,
    z: i64,
}

impl Vector {
    #[inline]
    fn between(p: &[i64], from: &[i64], to: usize) -> Self {
        Self { x: p[3 * to] - from[0], y: p[3 * to + 1] - from[1], z: p[3 * to + 2] - from[2] }
    }

    #[inline]
    fn square(self) -> u128 {
        let square = |x: i64| u128::from(x.unsigned_abs()) * u128::from(x.unsigned_abs());
        square(self.x) + square(self.y) + square(self.z)
    }
}

/// The minor of two columns.
#[inline]
fn minor(u: Vector, v: Vector) -> i128 {
    i128::from(u.x) * i128::from(v.y) - i128::from(v.x) * i128::from(u.y)
}

/// A sum of multiples of minors: `high` 2^64 + `low`.
#[derive(Clone, Copy)]
struct Three {
    high: i128,
    low: i128,
}

impl Three {
    #[inline]
    fn sum(terms: [(i64, i128); 3]) -> Self {
        let mut sum = Self { high: 0, low: 0 };
        for (factor, minor) in terms {
            sum.high += i128::from(factor) * (minor >> 64);
            sum.low += i128::from(factor) * i128::from(minor as u64);
        }
        sum
    }

    /// With the low part between 0 and 2^64.
    #[inline]
    fn carried(self) -> (i128, u64) {
        (self.high + (self.low >> 64), self.low as u64)
    }
}

/// A determinant being summed up: words of 64 bits, the lowest first, not yet carried.
struct Sum([i128; 5]);

impl Sum {
    /// Adds the product of a squared length and a minor, with a sign.
    #[inline]
    fn add(&mut self, lift: u128, minor: Three, negative: bool) {
        let minor = if negative { Three { high: -minor.high, low: -minor.low } } else { minor };
        let (high, low) = minor.carried();
        let words = [i128::from(low), i128::from(high as u64), high >> 64];
        for (j, factor) in [lift as u64, (lift >> 64) as u64].into_iter().enumerate() {
            for (i, word) in words.into_iter().enumerate() {
                // The top word is below 2^62 in magnitude, so the product is right as a signed one too.
                let product = if i < 2 {
                    (word as u128 * u128::from(factor)).cast_signed()
                } else {
                    word * i128::from(factor)
                };
                let carry = if i < 2 { (product.cast_unsigned() >> 64).cast_signed() } else { product >> 64 };
                self.0[i + j] += i128::from(product as u64);
                self.0[i + j + 1] += carry;
            }
        }
    }

    #[inline]
    fn sign(&self) -> Sign {
        let mut carry = 0;
        let mut rest = 0;
        for word in self.0 {
            let sum = word + carry;
            rest |= sum as u64;
            carry = sum >> 64;
        }
        if carry < 0 {
            Sign::Negative
        } else if carry > 0 || rest != 0 {
            Sign::Positive
        } else {
            Sign::Zero
        }
    }
}

/// Points a, b, c, d.
pub(super) fn orient3d(coordinates: &[f64; 12]) -> Option<Sign> {
    let p = align(coordinates)?;
    let from = &p[9..];
    let (a, b, c) =
        (Vector::between(&p, from, 0), Vector::between(&p, from, 1), Vector::between(&p, from, 2));
    let (high, low) = Three::sum([(a.z, minor(b, c)), (b.z, minor(c, a)), (c.z, minor(a, b))]).carried();
    // Seen from d.
    Some(if high < 0 {
        Sign::Positive
    } else if high > 0 || low > 0 {
        Sign::Negative
    } else {
        Sign::Zero
    })
}

/// Points a, b, c, d, e.
pub(super) fn in_sphere(coordinates: &[f64; 15]) -> Option<Sign> {
    let p = align(coordinates)?;
    let from = &p[12..];
    let (a, b) = (Vector::between(&p, from, 0), Vector::between(&p, from, 1));
    let (c, d) = (Vector::between(&p, from, 2), Vector::between(&p, from, 3));
    let (ab, bc, cd) = (minor(a, b), minor(b, c), minor(c, d));
    let (da, ac, bd) = (minor(d, a), minor(a, c), minor(b, d));
    let mut sum = Sum([0; 5]);
    sum.add(d.square(), Three::sum([(a.z, bc), (b.z, -ac), (c.z, ab)]), true);
    sum.add(a.square(), Three::sum([(b.z, cd), (c.z, -bd), (d.z, bc)]), false);
    sum.add(b.square(), Three::sum([(c.z, da), (d.z, ac), (a.z, cd)]), true);
    sum.add(c.square(), Three::sum([(d.z, ab), (a.z, bd), (b.z, da)]), false);
    Some(sum.sign())
}

/// Points q, a, b: the distance of a from q against that of b.
pub(super) fn compare_distances(coordinates: &[f64; 9]) -> Option<Ordering> {
    let p = align(coordinates)?;
    let from = &p[..3];
    Some(Vector::between(&p, from, 1).square().cmp(&Vector::between(&p, from, 2).square()))
}

/// Points q, a, (radius, 0, 0): the distance of a from q against the radius.
pub(super) fn compare_with_radius(coordinates: &[f64; 9]) -> Option<Ordering> {
    let p = align(coordinates)?;
    let from = &p[..3];
    Some(Vector::between(&p, from, 1).square().cmp(&Vector { x: p[6], y: p[7], z: p[8] }.square()))
}

#[cfg(test)]
mod tests {
    use super::{Sum, Three, align};
    use crate::Sign;

    #[test]
    fn products_of_the_largest_factors() {
        let (z, minor) = ((1 << 61) - 1, (1_i128 << 123) - 1);
        let largest = Three::sum([(z, minor); 3]);
        let (high, low) = largest.carried();
        // 3 (2^61 - 1)(2^123 - 1), whose low word is 3 (1 - 2^61).
        assert_eq!(low, 3_u64.wrapping_mul((1_u64 << 61).wrapping_neg().wrapping_add(1)));
        assert_eq!(high >> 119, 5);
        let lift = (1_u128 << 124) - 1;
        let all = |negative: bool| {
            let mut sum = Sum([0; 5]);
            (0..4).for_each(|_| sum.add(lift, largest, negative));
            sum
        };
        assert_eq!(all(false).sign(), Sign::Positive);
        assert_eq!(all(true).sign(), Sign::Negative);
        let mut sum = all(false);
        (0..4).for_each(|_| sum.add(lift, largest, true));
        assert_eq!(sum.sign(), Sign::Zero);
        sum = all(false);
        (0..3).for_each(|_| sum.add(lift, largest, true));
        sum.add(lift - 1, largest, true);
        assert_eq!(sum.sign(), Sign::Positive);
        sum.add(2, largest, true);
        assert_eq!(sum.sign(), Sign::Negative);
    }

    #[test]
    fn aligning_refuses_more_than_60_bits() {
        assert_eq!(align(&[1.0, 2f64.powi(59)]), Some([1, 1 << 59]));
        assert_eq!(align(&[1.0, 2f64.powi(60)]), None);
        assert_eq!(align(&[0.0, 1e200]).map(|x| x[0]), Some(0));
        assert_eq!(align(&[1.0, 1e-300]), None);
        assert_eq!(align(&[f64::from_bits(1), 1.0]), None);
        assert_eq!(align(&[0.0, -0.0]), None);
        assert_eq!(align(&[f64::MAX, 1.0]), None);
    }
}
