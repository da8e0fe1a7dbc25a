//! Numbers that weights are computed in: `f64`, and twice its precision where that is not enough.
//!
//! Source: Dekker, "A floating-point technique for extending the available precision", 1971. Double the precision costs some twenty
//! operations for one.

use std::fmt::Debug;
use std::ops::{Add, AddAssign, Div, Mul, Sub};

/// A number.
pub(super) trait Real:
    Copy
    + Debug
    + Default
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + AddAssign
{
    /// a - b, times a power of two.
    fn difference(a: f64, b: f64, power: f64) -> Self;
    /// Rounded.
    fn value(self) -> f64;

    fn one() -> Self {
        Self::difference(1.0, 0.0, 1.0)
    }
}

impl Real for f64 {
    #[inline]
    fn difference(a: f64, b: f64, power: f64) -> Self {
        (a - b) * power
    }

    #[inline]
    fn value(self) -> f64 {
        self
    }
}

/// The sum of two floats, the second at most half of the last place of the first.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Double(f64, f64);

/// a + b, and what was rounded off.
fn sum(a: f64, b: f64) -> Double {
    let s = a + b;
    let t = s - a;
    Double(s, (a - (s - t)) + (b - t))
}

/// a| >= |b|.|The sum of two numbers with |a| >= |b|.|a| >= |b|.
fn sum_of_ordered(a: f64, b: f64) -> Double {
    let s = a + b;
    Double(s, b - (s - a))
}

/// a b, and what was rounded off.
fn product(a: f64, b: f64) -> Double {
    let split = |x: f64| {
        let c = 134_217_729.0 * x;
        let high = c - (c - x);
        (high, x - high)
    };
    let p = a * b;
    let ((a1, a2), (b1, b2)) = (split(a), split(b));
    Double(p, a2 * b2 - (((p - a1 * b1) - a2 * b1) - a1 * b2))
}

impl Real for Double {
    fn difference(a: f64, b: f64, power: f64) -> Self {
        let Double(high, low) = sum(a, -b);
        Double(high * power, low * power)
    }

    fn value(self) -> f64 {
        self.0 + self.1
    }
}

impl Add for Double {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let high = sum(self.0, other.0);
        let low = sum(self.1, other.1);
        let Double(high, rest) = sum_of_ordered(high.0, high.1 + low.0);
        sum_of_ordered(high, rest + low.1)
    }
}

impl Sub for Double {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + Double(-other.0, -other.1)
    }
}

impl Mul for Double {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let Double(high, low) = product(self.0, other.0);
        sum_of_ordered(high, low + (self.0 * other.1 + self.1 * other.0))
    }
}

impl Div for Double {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        let first = self.0 / other.0;
        let rest = self - other * Double(first, 0.0);
        let second = rest.0 / other.0;
        let rest = rest - other * Double(second, 0.0);
        sum_of_ordered(first, second) + Double(rest.0 / other.0, 0.0)
    }
}

impl AddAssign for Double {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

/// The dot product of two vectors.
#[inline]
pub(super) fn dot<R: Real>(a: [R; 3], b: [R; 3]) -> R {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The cross product.
#[inline]
pub(super) fn cross<R: Real>(a: [R; 3], b: [R; 3]) -> [R; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// a - b.
#[inline]
pub(super) fn minus<R: Real>(a: [R; 3], b: [R; 3]) -> [R; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Integers of fifty bits, whose sums and products are known.
    #[test]
    fn twice_the_precision_is_exact_where_that_suffices() {
        let mut random = crate::order::random::SplitMix(3);
        let mut next = || i128::from(random.next() >> 14) - (1 << 49);
        let double = |a: i128| {
            let high = a as f64;
            Double(high, (a - high as i128) as f64)
        };
        let whole = |d: Double| d.0 as i128 + d.1 as i128;
        for _ in 0..10_000 {
            let (a, b, c) = (next(), next(), next());
            let (x, y, z) = (double(a), double(b), double(c));
            assert_eq!(whole(x * y), a * b);
            assert_eq!(whole(x * y + z), a * b + c);
            assert_eq!(whole(x * y - y * z), a * b - b * c);
            let quotient = x / y;
            let left = (x - quotient * y).value().abs();
            assert!(b == 0 || left <= (a as f64).abs() * 2f64.powi(-100), "{a} / {b}: {left}");
            assert_eq!(whole(Double::difference(a as f64, b as f64, 1.0)), a - b);
        }
    }
}
