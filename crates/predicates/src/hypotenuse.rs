//! The length of a vector of the plane, the same on every machine.
//!
//! Mathematical libraries of systems differ in the last bit of `hypot`. Sums, products and square roots are those of IEEE 754 everywhere: the
//! root of the sum of squares is corrected once by its remainder, which is known to twice the digits (Borges, "An improved algorithm for
//! hypot(a, b)", 2019). O(1), without tables.

use crate::ball::{two_product, two_sum};

/// A part of the longer side that adds less than half a unit in the last place to it: 2^-27.
const LOST: f64 = 1.0 / (1 << 27) as f64;

/// Sides of this and more are scaled, so that no square overflows; a power of two, and twice it is far below 2^512.
const LONG: f64 = f64::from_bits((1023 + 500) << 52);

/// Sides of less are scaled, so that no part of a square underflows: a square has 106 bits.
const SHORT: f64 = f64::from_bits((1023 - 450) << 52);

/// By this much: 2^600.
const SCALE: f64 = f64::from_bits((1023 + 600) << 52);

/// The length of the vector (x, y): the hypotenuse of a right triangle with these sides.
///
/// The nearest float to the exact length, but for a chance of 2^-50 or so that it is the next one; the same on every machine, of whatever signs,
/// and in both orders. Infinite where the length is beyond the range of numbers or a side is infinite; else NaN if a side is.
///
/// ```
/// use delone_predicates::hypotenuse;
/// assert_eq!(hypotenuse(3.0, -4.0), 5.0);
/// let far = 2.0_f64.powi(1000);
/// assert_eq!(hypotenuse(3.0 * far, 4.0 * far), 5.0 * far);
/// assert_eq!(hypotenuse(5e-324, 0.0), 5e-324);
/// ```
#[inline]
#[must_use]
pub fn hypotenuse(x: f64, y: f64) -> f64 {
    let (x, y) = (x.abs(), y.abs());
    if x.is_infinite() || y.is_infinite() {
        return f64::INFINITY;
    }
    let (long, short) = if x < y { (y, x) } else { (x, y) };
    if short <= long * LOST {
        // In one operation, so that NaN stays.
        return long + short;
    }
    if long >= LONG {
        return middle(long / SCALE, short / SCALE) * SCALE;
    }
    if short < SHORT {
        return middle(long * SCALE, short * SCALE) / SCALE;
    }
    middle(long, short)
}

/// Of sides whose squares neither overflow nor underflow.
#[inline]
fn middle(long: f64, short: f64) -> f64 {
    let (square, square_rest) = two_product(long, long);
    let (other, other_rest) = two_product(short, short);
    let (sum, sum_rest) = two_sum(square, other);
    let root = sum.sqrt();
    let (near, near_rest) = two_product(root, root);
    // The first difference is exact: both are within a few units in the last place.
    let rest = (sum - near) + (sum_rest + ((square_rest + other_rest) - near_rest));
    root + rest / (2.0 * root)
}

#[cfg(test)]
mod tests {
    use delone_generators::Random;

    use super::hypotenuse;

    /// Twice the distance of a root's square from the exact sum, compared with its neighbors' middles: whole numbers.
    fn is_nearest(x: u64, y: u64, root: f64) -> bool {
        let exact = 16 * (u128::from(x) * u128::from(x) + u128::from(y) * u128::from(y));
        // In eighths: roots from 2^51 to 2^53 are multiples of a half or of one.
        let middle = |next: f64| ((4.0 * root) as u128).midpoint((4.0 * next) as u128);
        let (low, high) = (middle(root.next_down()), middle(root.next_up()));
        (low * low..=high * high).contains(&exact)
    }

    #[test]
    fn lengths_are_the_nearest_numbers() {
        let mut random = Random::new(4);
        for _ in 0..200_000 {
            let mut side = || (1 << 51) + random.below(1 << 51) as u64;
            let (x, y) = (side(), side());
            let y = y >> random.below(20);
            let root = hypotenuse(x as f64, y as f64);
            assert!(root >= (1_u64 << 51) as f64 && is_nearest(x, y, root), "{x} {y} {root}");
        }
    }

    #[test]
    fn orders_signs_and_powers_of_two_change_nothing_else() {
        let mut random = Random::new(5);
        for _ in 0..20_000 {
            let mut side = || random.unit() * 2.0_f64.powi(random.below(60) as i32 - 30);
            let (x, y) = (side(), side());
            let length = hypotenuse(x, y);
            assert_eq!(length, hypotenuse(y, -x));
            for power in [-900, -400, 400, 900] {
                let factor = 2.0_f64.powi(power);
                assert_eq!(length * factor, hypotenuse(x * factor, y * factor));
            }
        }
    }

    #[test]
    fn ends_of_the_range() {
        let (largest, least) = (f64::MAX, f64::from_bits(1));
        assert_eq!(hypotenuse(largest, largest), f64::INFINITY);
        assert_eq!(hypotenuse(largest, 1.0), largest);
        assert_eq!(hypotenuse(least, 0.0), least);
        assert_eq!(hypotenuse(3.0 * least, 4.0 * least), 5.0 * least);
        assert_eq!(hypotenuse(0.0, -0.0), 0.0);
        assert_eq!(hypotenuse(f64::NAN, f64::NEG_INFINITY), f64::INFINITY);
        assert!(hypotenuse(f64::NAN, 1.0).is_nan() && hypotenuse(1.0, f64::NAN).is_nan());
        assert_eq!(hypotenuse(f64::MAX / 1.5, f64::MAX / 2.0).to_bits(), (f64::MAX / 12.0 * 10.0).to_bits());
    }
}
