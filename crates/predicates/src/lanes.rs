//! Two numbers that are computed with at once.
//!
//! Optimizing compilers make one instruction of both on processors that have it (SSE2, NEON), which is what this type is for. Results are
//! the same everywhere.

use std::ops::{Add, Div, Mul, Sub};

/// Two numbers side by side.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lanes([f64; 2]);

impl Lanes {
    #[inline]
    pub(crate) fn new(both: [f64; 2]) -> Self {
        Self(both)
    }

    #[inline]
    pub(crate) fn to_array(self) -> [f64; 2] {
        self.0
    }

    /// One number in both lanes.
    #[inline]
    pub(crate) fn splat(x: f64) -> Self {
        Self([x, x])
    }

    #[inline]
    pub(crate) fn abs(self) -> Self {
        Self([self.0[0].abs(), self.0[1].abs()])
    }
}

macro_rules! operator {
    ($operator:ident, $method:ident, $symbol:tt) => {
        impl $operator for Lanes {
            type Output = Self;

            #[inline]
            fn $method(self, other: Self) -> Self {
                Self([self.0[0] $symbol other.0[0], self.0[1] $symbol other.0[1]])
            }
        }
    };
}

operator!(Add, add, +);
operator!(Sub, sub, -);
operator!(Mul, mul, *);
operator!(Div, div, /);

#[cfg(test)]
mod tests {
    use super::Lanes;

    #[test]
    fn lanes_compute_as_numbers_do() {
        let numbers = [0.0, -0.0, 1.0, -3.5, 0.1, 5e-324, -1e300, f64::MAX, f64::INFINITY, f64::NAN];
        let bits = |both: [f64; 2]| both.map(|x| if x.is_nan() { u64::MAX } else { x.to_bits() });
        for a in numbers {
            for b in numbers {
                let (p, q) = (Lanes::new([a, b]), Lanes::new([b, 2.0]));
                assert_eq!(bits((p + q).to_array()), bits([a + b, b + 2.0]));
                assert_eq!(bits((p - q).to_array()), bits([a - b, b - 2.0]));
                assert_eq!(bits((p * q).to_array()), bits([a * b, b * 2.0]));
                assert_eq!(bits((p / q).to_array()), bits([a / b, b / 2.0]));
                assert_eq!(bits(p.abs().to_array()), bits([a.abs(), b.abs()]));
                assert_eq!(bits(Lanes::splat(a).to_array()), bits([a, a]));
            }
        }
    }
}
