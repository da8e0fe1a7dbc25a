//! The answer of a predicate.

use std::ops::{Mul, Neg};

/// The sign of a real number, known exactly.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Sign {
    /// Less than zero: right turn, outside.
    Negative = -1,
    /// Exactly zero: collinear, cocircular.
    Zero = 0,
    /// Greater than zero: left turn, inside.
    Positive = 1,
}

impl Sign {
    /// The sign of `value` compared with zero, for anything ordered: `Sign::of(&-3, &0)` is negative.
    pub fn of<T: PartialOrd>(value: &T, zero: &T) -> Self {
        if value > zero {
            Self::Positive
        } else if value < zero {
            Self::Negative
        } else {
            Self::Zero
        }
    }

    /// `true` for [`Sign::Positive`].
    #[inline]
    pub fn is_positive(self) -> bool {
        self == Self::Positive
    }

    /// `true` for [`Sign::Negative`].
    #[inline]
    pub fn is_negative(self) -> bool {
        self == Self::Negative
    }

    /// `true` for [`Sign::Zero`].
    #[inline]
    pub fn is_zero(self) -> bool {
        self == Self::Zero
    }
}

impl Neg for Sign {
    type Output = Self;

    fn neg(self) -> Self {
        match self {
            Self::Negative => Self::Positive,
            Self::Zero => Self::Zero,
            Self::Positive => Self::Negative,
        }
    }
}

impl Mul for Sign {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        match self {
            Self::Negative => -other,
            Self::Zero => Self::Zero,
            Self::Positive => other,
        }
    }
}
