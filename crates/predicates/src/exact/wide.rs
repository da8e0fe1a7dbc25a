//! Exact signs in space for coordinates that fit 120 bits on a common scale: numbers of a few words of 64 bits.
//!
//! Differences take two words, minors of two columns four, of three columns six, squared lengths four, and the
//! in-sphere determinant ten. Reached where a coordinate is small beside the others, such as near an axis.

use super::decode;
use crate::Sign;

/// A number of N words, two's complement, the lowest first.
#[derive(Clone, Copy)]
pub(crate) struct Wide<const N: usize>([u64; N]);

impl<const N: usize> Wide<N> {
    pub(crate) fn plus(self, other: Self) -> Self {
        let (mut sum, mut carry) = (self.0, 0);
        for (word, more) in sum.iter_mut().zip(other.0) {
            let part = u128::from(*word) + u128::from(more) + carry;
            (*word, carry) = (part as u64, part >> 64);
        }
        Self(sum)
    }

    fn negative(self) -> Self {
        let (mut result, mut carry) = (self.0, true);
        for word in &mut result {
            (*word, carry) = (!*word).overflowing_add(u64::from(carry));
        }
        Self(result)
    }

    pub(crate) fn minus(self, other: Self) -> Self {
        self.plus(other.negative())
    }

    fn is_negative(self) -> bool {
        self.0[N - 1] >> 63 == 1
    }

    fn magnitude(self) -> Self {
        if self.is_negative() { self.negative() } else { self }
    }

    pub(crate) fn sign(self) -> Sign {
        if self.is_negative() {
            Sign::Negative
        } else if self.0.iter().all(|&word| word == 0) {
            Sign::Zero
        } else {
            Sign::Positive
        }
    }

    /// The product, in as many words as both have together.
    pub(crate) fn times<const M: usize, const P: usize>(self, other: Wide<M>) -> Wide<P> {
        debug_assert_eq!(P, N + M, "a product has room");
        let (x, y) = (self.magnitude(), other.magnitude());
        let mut product = [0; P];
        for i in 0..N {
            let mut carry = 0;
            for j in 0..M {
                let part = u128::from(x.0[i]) * u128::from(y.0[j]) + u128::from(product[i + j]) + carry;
                (product[i + j], carry) = (part as u64, part >> 64);
            }
            product[i + M] = carry as u64;
        }
        let product = Wide(product);
        if self.is_negative() == other.is_negative() { product } else { product.negative() }
    }
}

impl Wide<4> {
    pub(crate) fn sum_of_squares(numbers: [Wide<2>; 3]) -> Self {
        let [x, y, z] = numbers.map(|x| x.times(x));
        x.plus(y).plus(z)
    }
}

impl From<i128> for Wide<2> {
    fn from(number: i128) -> Self {
        Self([number as u64, (number >> 64) as u64])
    }
}

impl From<i64> for Wide<1> {
    fn from(number: i64) -> Self {
        Self([number.cast_unsigned()])
    }
}

/// Coordinates on their common scale, if they fit.
fn align<const N: usize>(coordinates: &[f64; N]) -> Option<[i128; N]> {
    let mut scale = i32::MAX;
    for x in coordinates {
        scale = scale.min(decode(*x).1);
    }
    let mut aligned = [0; N];
    for (out, x) in aligned.iter_mut().zip(coordinates) {
        let (mantissa, exponent) = decode(*x);
        if mantissa != 0 {
            let shift = (exponent - scale).unsigned_abs();
            if shift + (64 - mantissa.unsigned_abs().leading_zeros()) > 120 {
                return None;
            }
            *out = i128::from(mantissa) << shift;
        }
    }
    Some(aligned)
}

type Vector = [Wide<2>; 3];

fn between(p: &[i128], from: usize, to: usize) -> Vector {
    [0, 1, 2].map(|k| Wide::from(p[3 * to + k] - p[3 * from + k]))
}

fn minor(u: &Vector, v: &Vector) -> Wide<4> {
    u[0].times(v[1]).minus(v[0].times(u[1]))
}

fn three(u: &Vector, v: &Vector, w: &Vector) -> Wide<6> {
    let sum = u[2].times(minor(v, w)).minus(v[2].times(minor(u, w)));
    sum.plus(w[2].times(minor(u, v)))
}

fn square(u: &Vector) -> Wide<4> {
    u[0].times(u[0]).plus(u[1].times(u[1])).plus(u[2].times(u[2]))
}

/// Points a, b, c, d.
pub(super) fn orient3d(coordinates: &[f64; 12]) -> Option<Sign> {
    let p = align(coordinates)?;
    let (u, v, w) = (between(&p, 0, 1), between(&p, 0, 2), between(&p, 0, 3));
    Some(three(&u, &v, &w).sign())
}

/// Points a, b, c, d, e.
pub(super) fn in_sphere(coordinates: &[f64; 15]) -> Option<Sign> {
    let p = align(coordinates)?;
    let (a, b) = (between(&p, 4, 0), between(&p, 4, 1));
    let (c, d) = (between(&p, 4, 2), between(&p, 4, 3));
    let lifted = |lift: &Vector, minor: Wide<6>| -> Wide<10> { square(lift).times(minor) };
    let positive = lifted(&c, three(&a, &b, &d)).plus(lifted(&a, three(&b, &c, &d)));
    let other = lifted(&d, three(&a, &b, &c)).plus(lifted(&b, three(&a, &c, &d)));
    Some(positive.minus(other).sign())
}

#[cfg(test)]
mod tests {
    use super::{Wide, align};
    use crate::Sign;

    #[test]
    fn products_of_the_largest_factors() {
        let largest = Wide([u64::MAX, u64::MAX >> 1]);
        let square: Wide<4> = largest.times(largest);
        // (2^127 - 1)^2 = 2^254 - 2^128 + 1
        assert_eq!(square.0, [1, 0, u64::MAX, u64::MAX >> 2]);
        let other: Wide<4> = largest.times(largest.negative());
        assert_eq!(other.plus(square).sign(), Sign::Zero);
        assert_eq!((other.sign(), square.sign()), (Sign::Negative, Sign::Positive));
    }

    #[test]
    fn aligning_refuses_more_than_120_bits() {
        assert_eq!(align(&[1.0, 2f64.powi(119)]), Some([1, 1 << 119]));
        assert_eq!(align(&[1.0, 2f64.powi(120)]), None);
        assert_eq!(align(&[1e-300, 1e300]), None);
        assert_eq!(align(&[0.0, 0.0]), Some([0, 0]));
    }
}
