//! The mean of a few numbers, correctly rounded: so that no order of theirs shows.

use crate::exact::{big, decode};

/// Bits of the integers that numbers become on a common scale: those of four sum up to three more at most.
const ALIGNED_BITS: u32 = 120;

/// Exponents of results that are neither subnormal nor too large, whatever 128 bits they are of.
const NORMAL_EXPONENTS: std::ops::RangeInclusive<i32> = -1000..=800;

/// The mean of two, three or four finite numbers: the `f64` nearest to it, ties to even.
///
/// O(1).
///
/// ```
/// use delone_predicates::mean;
/// assert_eq!(mean([1.0, 2.0, 6.0]), 3.0);
/// assert_eq!(mean([0.1, 1e16, -1e16]), 0.1 / 3.0);
/// assert_eq!(mean([f64::MAX; 4]), f64::MAX);
/// ```
#[must_use]
pub fn mean<const N: usize>(numbers: [f64; N]) -> f64 {
    const { assert!(2 <= N && N <= 4, "a mean is of two to four numbers") };
    in_machine_integers(&numbers).unwrap_or_else(|| in_big_integers(&numbers))
}

fn in_machine_integers<const N: usize>(numbers: &[f64; N]) -> Option<f64> {
    let parts = numbers.map(decode);
    let scale = parts.iter().map(|part| part.1).min().unwrap_or_default();
    let mut sum = 0_i128;
    for (mantissa, exponent) in parts.into_iter().filter(|part| part.0 != 0) {
        let shift = (exponent - scale).unsigned_abs();
        let bits = u64::BITS - mantissa.unsigned_abs().leading_zeros();
        if shift > ALIGNED_BITS - bits {
            return None;
        }
        sum += i128::from(mantissa) << shift;
    }
    if sum == 0 {
        return Some(0.0);
    }
    let magnitude = sum.unsigned_abs();
    let shift = magnitude.leading_zeros();
    let exponent = scale - shift as i32;
    if !NORMAL_EXPONENTS.contains(&exponent) {
        return None;
    }
    let (numerator, count) = (magnitude << shift, N as u128);
    // The last bit stands for all that follow: there are more than a hundred before it.
    let quotient = (numerator / count) | u128::from(numerator % count != 0);
    // In two steps, because the first power alone may be subnormal.
    let value = quotient as f64 * 2f64.powi(exponent / 2) * 2f64.powi(exponent - exponent / 2);
    Some(if sum < 0 { -value } else { value })
}

fn in_big_integers(numbers: &[f64]) -> f64 {
    let (integers, scale) = big::integers(numbers);
    let count = big::integers(&[numbers.len() as f64]);
    big::quotient(&integers.into_iter().sum(), &(count.0[0].clone() << count.1.unsigned_abs()), scale)
}

#[cfg(test)]
mod tests {
    use delone_generators::Random;

    use super::{in_big_integers, in_machine_integers, mean};

    /// Numbers of any size and of like sizes, and results half way between two numbers.
    #[test]
    fn both_ways_agree() {
        let mut random = Random::new(11);
        let mut decided = 0;
        for round in 0..20_000 {
            let spread = [0, 3, 40, 900][round % 4];
            let mut number = || {
                let exponent = (random.unit() * f64::from(2 * spread + 1)) as i32 - spread;
                (random.unit() - 0.5) * 2f64.powi(exponent)
            };
            let numbers = [number(), number(), number(), number()];
            let [a, b, c, _] = numbers;
            for (found, expected) in [
                (in_machine_integers(&numbers), in_big_integers(&numbers)),
                (in_machine_integers(&[a, b, c]), in_big_integers(&[a, b, c])),
                (in_machine_integers(&[a, b]), in_big_integers(&[a, b])),
            ] {
                decided += usize::from(found.is_some());
                assert!(found.is_none_or(|found| found.to_bits() == expected.to_bits()), "{numbers:?}");
            }
            assert_eq!(mean([a, b]).to_bits(), (a.midpoint(b) + 0.0).to_bits());
        }
        assert!(decided > 40_000, "{decided}");
    }

    #[test]
    fn extremes() {
        let least = 5e-324;
        assert_eq!(mean([least, 0.0]), 0.0);
        assert_eq!(mean([3.0 * least, 0.0]), 2.0 * least);
        assert_eq!(mean([f64::MAX, f64::MAX, -f64::MAX]), f64::MAX / 3.0);
        assert_eq!(mean([f64::MAX, 1e-300]), f64::MAX / 2.0);
        assert_eq!(mean([-0.0, -0.0]).to_bits(), 0);
        assert_eq!(mean([1.0, -1.0, 2.0, -2.0]).to_bits(), 0);
        // Half of the last place is rounded to even.
        let next = 1.0 + f64::EPSILON;
        assert_eq!((mean([1.0, next]), mean([next, next + f64::EPSILON])), (1.0, next + f64::EPSILON));
    }
}
