//! Numbers known to about a hundred bits with a bound of their error: an unevaluated sum of two `f64` and a radius around it.
//!
//! Source: sums and products without error of Knuth and of Dekker ("A floating-point technique for extending the available
//! precision", Numerische Mathematik 18, 1971). What an operation leaves out is bounded here, with u = 2^-53, |low| <= u |high|
//! in every number, and 16 u^2 as the allowance:
//!
//! - a sum: the sum of the low parts is rounded (2 u^2 of |a| + |b|), and so is that with the error of the sum of the high parts (2
//!   u^2, and terms of u^3), the last sum is without error: less than 5 u^2 (|a| + |b|);
//! - a product p of the high parts: two products with a low part are rounded (u^2 each), and their sum (2 u^2), and that with the
//!   error of p (3 u^2); the product of the low parts is left out (u^2): with terms of u^3 less than 9 u^2 |p|.
//!
//! Radii are sums and products of at most a dozen `f64` that are not negative, off by less than 2^-40 of themselves, by which they
//! are enlarged; and by 2^-1000, more than all that underflow can take away. Overflow makes a radius infinite or NaN.

use std::ops::{Add, Div, Mul, Sub};

use crate::lanes::Lanes;

/// A number that can be added, subtracted and multiplied.
pub(crate) trait Number: Clone {
    fn plus(&self, other: &Self) -> Self;
    fn minus(&self, other: &Self) -> Self;
    fn times(&self, other: &Self) -> Self;

    fn square(&self) -> Self {
        self.times(self)
    }
}

/// One number, or several at once.
pub(crate) trait Lane:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    fn all(x: f64) -> Self;
    fn magnitude(self) -> Self;
}

impl Lane for f64 {
    #[inline]
    fn all(x: f64) -> Self {
        x
    }

    #[inline]
    fn magnitude(self) -> Self {
        self.abs()
    }
}

impl Lane for Lanes {
    #[inline]
    fn all(x: f64) -> Self {
        Self::splat(x)
    }

    #[inline]
    fn magnitude(self) -> Self {
        self.abs()
    }
}

/// 16 u^2.
pub(crate) const ALLOWANCE: f64 = 4.0 * f64::EPSILON * f64::EPSILON;
const ENLARGED: f64 = 1.0 + 1.0 / (1_u64 << 40) as f64;
/// 2^-1000.
const UNDERFLOW: f64 = f64::from_bits(23 << 52);

/// See the module.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ball<L> {
    pub(crate) high: L,
    pub(crate) low: L,
    pub(crate) radius: L,
}

/// Half of a unit in the last place of 1.
pub(crate) const U: f64 = f64::EPSILON / 2.0;

/// A sum and its error.
#[inline]
pub(crate) fn two_sum<L: Lane>(a: L, b: L) -> (L, L) {
    let sum = a + b;
    let of_b = sum - a;
    let of_a = sum - of_b;
    (sum, (a - of_a) + (b - of_b))
}

/// Two halves of at most 26 bits.
#[inline]
fn split<L: Lane>(x: L) -> (L, L) {
    let far = x * L::all(134_217_729.0);
    let high = far - (far - x);
    (high, x - high)
}

/// A product and its error.
#[inline]
pub(crate) fn two_product<L: Lane>(a: L, b: L) -> (L, L) {
    let product = a * b;
    let ((a, x), (b, y)) = (split(a), split(b));
    (product, x * y - (((product - a * b) - x * b) - a * y))
}

impl<L: Lane> Ball<L> {
    /// The difference of two numbers, without error.
    #[inline]
    pub(crate) fn difference(a: L, b: L) -> Self {
        let (high, low) = two_sum(a, L::all(0.0) - b);
        Self { high, low, radius: L::all(0.0) }
    }

    /// Multiplied by a power of two.
    #[inline]
    pub(crate) fn scaled(self, factor: f64) -> Self {
        let factor = L::all(factor);
        let radius = self.radius * factor + L::all(UNDERFLOW);
        Self { high: self.high * factor, low: self.low * factor, radius }
    }
}

impl<L: Lane> Number for Ball<L> {
    #[inline]
    fn plus(&self, other: &Self) -> Self {
        let (sum, error) = two_sum(self.high, other.high);
        let (high, low) = two_sum(sum, error + (self.low + other.low));
        let size = self.high.magnitude() + other.high.magnitude();
        let radius = self.radius + other.radius + size * L::all(ALLOWANCE);
        Self { high, low, radius: radius * L::all(ENLARGED) + L::all(UNDERFLOW) }
    }

    #[inline]
    fn minus(&self, other: &Self) -> Self {
        let zero = L::all(0.0);
        self.plus(&Self { high: zero - other.high, low: zero - other.low, radius: other.radius })
    }

    #[inline]
    fn times(&self, other: &Self) -> Self {
        let (product, error) = two_product(self.high, other.high);
        let rest = error + (self.high * other.low + self.low * other.high);
        let high = product + rest;
        let low = rest - (high - product);
        let (a, b) = (self.high.magnitude(), other.high.magnitude());
        let inherited = a * other.radius + self.radius * (b + other.radius);
        let radius = inherited + product.magnitude() * L::all(ALLOWANCE);
        Self { high, low, radius: radius * L::all(ENLARGED) + L::all(UNDERFLOW) }
    }
}

impl<L: Lane> Ball<L> {
    pub(crate) fn exactly(high: L) -> Self {
        Self { high, low: L::all(0.0), radius: L::all(0.0) }
    }

    /// The quotient by a number that is not negative.
    ///
    /// With one division: the inverse has an error of u, so the first part has 2 u and the correction, of at most 5 u, 4 u of itself; so both
    /// are off by less than 32 u^2 of the quotient. And (n + x) / (d + y) is off from n / d by at most (x + q y) / (d - y). Where y is not
    /// small beside d, the radius is not beside q, so that nothing is known; and it is not a number where d is zero.
    #[inline]
    pub(crate) fn over(&self, other: &Self) -> Self {
        let inverse = L::all(1.0) / other.high;
        let quotient = self.high * inverse;
        let product = other.times(&Self::exactly(quotient));
        let rest = (self.high - product.high) + (self.low - product.low);
        let (high, low) = two_sum(quotient, rest * inverse);
        // The radius of the product is that of the divisor, as often as the quotient, and its own error.
        let moved = (self.radius + product.radius) * inverse.magnitude();
        let radius = moved + quotient.magnitude() * L::all(2.0 * ALLOWANCE);
        Self { high, low, radius: radius * L::all(ENLARGED * ENLARGED) + L::all(UNDERFLOW) }
    }

    /// The least and the greatest number that a number in the ball may be rounded to.
    #[inline]
    pub(crate) fn bounds(&self) -> [L; 2] {
        // The sums with the low part are rounded.
        let margin = self.radius * L::all(ENLARGED) + self.low.magnitude() * L::all(f64::EPSILON);
        [self.high + (self.low - margin), self.high + (self.low + margin)]
    }
}

impl Ball<f64> {
    /// The sum of two numbers, whose real one is off by at most a radius.
    #[inline]
    pub(crate) fn around_sum(a: f64, b: f64, radius: f64) -> Self {
        let (high, low) = two_sum(a, b);
        Self { high, low, radius }
    }

    /// The number that all numbers in the ball are rounded to, if it is one. No negative zero.
    #[inline]
    pub(crate) fn nearest(&self) -> Option<f64> {
        let [least, most] = self.bounds();
        (least == most).then_some(most + 0.0)
    }
}
