//! Exact signs in space in machine integers, for coordinates that fit 61 bits on a common scale.
//!
//! Differences fit 62 bits and a sign, minors of two columns 125, minors of three 189, squared lengths 126, and
//! the in-sphere determinant 318: numbers of three and of five words are made of products of single ones.

use super::integers::align;
use crate::Sign;

/// A number of N words, two's complement, the lowest first.
type Words<const N: usize> = [u64; N];

fn add<const N: usize>(x: Words<N>, y: Words<N>) -> Words<N> {
    let mut sum = [0; N];
    let mut carry = false;
    for i in 0..N {
        let (part, first) = x[i].overflowing_add(y[i]);
        let (part, second) = part.overflowing_add(u64::from(carry));
        sum[i] = part;
        carry = first | second;
    }
    sum
}

fn negative<const N: usize>(x: Words<N>) -> Words<N> {
    let mut one = [0; N];
    one[0] = 1;
    add(x.map(|word| !word), one)
}

/// `x` times `y`, where the product fits N words and `y` is not negative.
fn times<const M: usize, const N: usize>(x: Words<M>, y: [u64; 2]) -> Words<N> {
    let is_negative = x[M - 1] >> 63 == 1;
    let magnitude = if is_negative { negative(x) } else { x };
    let mut product = [0; N];
    for (j, factor) in y.into_iter().enumerate() {
        let mut carry = 0;
        for (i, word) in magnitude.into_iter().enumerate().filter(|(i, _)| i + j < N) {
            let part = u128::from(word) * u128::from(factor) + u128::from(product[i + j]) + u128::from(carry);
            product[i + j] = part as u64;
            carry = (part >> 64) as u64;
        }
        if M + j < N {
            product[M + j] = carry;
        }
    }
    if is_negative { negative(product) } else { product }
}

fn sign<const N: usize>(x: Words<N>) -> Sign {
    if x[N - 1] >> 63 == 1 {
        Sign::Negative
    } else if x == [0; N] {
        Sign::Zero
    } else {
        Sign::Positive
    }
}

/// `x` times the minor, in three words.
fn scaled(x: i64, minor: i128) -> Words<3> {
    let product = times::<2, 3>([minor as u64, (minor >> 64) as u64], [x.unsigned_abs(), 0]);
    if x < 0 { negative(product) } else { product }
}

/// The minors of two columns of two vectors.
fn minor(u: [i64; 3], v: [i64; 3]) -> i128 {
    i128::from(u[0]) * i128::from(v[1]) - i128::from(v[0]) * i128::from(u[1])
}

fn square([x, y, z]: [i64; 3]) -> [u64; 2] {
    let sum = [x, y, z].into_iter().map(|x| u128::from(x.unsigned_abs()).pow(2)).sum::<u128>();
    [sum as u64, (sum >> 64) as u64]
}

/// Points a, b, c, d.
pub(super) fn orient3d(coordinates: &[f64; 12]) -> Option<Sign> {
    let p = align(coordinates)?;
    let from_last = |i: usize| [0, 1, 2].map(|k| p[3 * i + k] - p[9 + k]);
    let [a, b, c] = [0, 1, 2].map(from_last);
    let det = add(add(scaled(a[2], minor(b, c)), scaled(b[2], minor(c, a))), scaled(c[2], minor(a, b)));
    // Seen from d.
    Some(-sign(det))
}

/// Points a, b, c, d, e.
pub(super) fn in_sphere(coordinates: &[f64; 15]) -> Option<Sign> {
    let p = align(coordinates)?;
    let from_last = |i: usize| [0, 1, 2].map(|k| p[3 * i + k] - p[12 + k]);
    let [a, b, c, d] = [0, 1, 2, 3].map(from_last);
    let [ab, bc, cd, da, ac, bd] = [(a, b), (b, c), (c, d), (d, a), (a, c), (b, d)].map(|(u, v)| minor(u, v));
    let sum = |x, y, z| add(add(x, y), z);
    let abc = sum(scaled(a[2], bc), scaled(b[2], -ac), scaled(c[2], ab));
    let bcd = sum(scaled(b[2], cd), scaled(c[2], -bd), scaled(d[2], bc));
    let cda = sum(scaled(c[2], da), scaled(d[2], ac), scaled(a[2], cd));
    let dab = sum(scaled(d[2], ab), scaled(a[2], bd), scaled(b[2], da));
    let lifted = |v: [i64; 3], minor: Words<3>| times::<3, 5>(minor, square(v));
    let positive = add(lifted(c, dab), lifted(a, bcd));
    let other = add(lifted(d, abc), lifted(b, cda));
    Some(sign(add(positive, negative(other))))
}

#[cfg(test)]
mod tests {
    use super::{add, negative, scaled, sign, times};
    use crate::Sign;

    #[test]
    fn products_of_the_largest_factors() {
        let largest = (1_i128 << 125) - 1;
        assert_eq!(scaled(-(1 << 62), largest), negative(scaled(1 << 62, largest)));
        assert_eq!(scaled(1 << 62, -largest), negative(scaled(1 << 62, largest)));
        let x = [5, 0, 0];
        assert_eq!(times::<3, 5>(x, [7, 0]), [35, 0, 0, 0, 0]);
        assert_eq!(times::<3, 5>(negative(x), [7, 1]), negative([35, 5, 0, 0, 0]));
        let all = [u64::MAX, u64::MAX, u64::MAX >> 3];
        let product: [u64; 5] = times(all, [u64::MAX, u64::MAX >> 2]);
        assert_eq!(sign(product), Sign::Positive);
        assert_eq!(add(product, negative(product)), [0; 5]);
        // (2^189 - 1)(2^126 - 1) = 2^315 - 2^189 - 2^126 + 1
        let mut expected = [1, 0, 0, 0, 1 << 59];
        expected = add(expected, negative([0, 0, 1 << 61, 0, 0]));
        expected = add(expected, negative([0, 1 << 62, 0, 0, 0]));
        assert_eq!(product, expected);
    }
}
