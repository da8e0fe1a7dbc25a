//! Stage one: intervals of floating point that hold the real number, whatever was rounded.

use std::cmp::Ordering;

use super::{Number, Terms};
use crate::Sign;

/// Both ends finite, or all numbers.
#[derive(Clone, Copy, Debug)]
pub(super) struct Interval {
    low: f64,
    high: f64,
}

const ALL: Interval = Interval { low: f64::NEG_INFINITY, high: f64::INFINITY };

impl Interval {
    /// Widens bounds by the half step of rounding to nearest, or to all numbers where something left the range.
    fn outwards(low: f64, high: f64) -> Self {
        if low.is_finite() && high.is_finite() {
            Self { low: low.next_down(), high: high.next_up() }
        } else {
            ALL
        }
    }

    /// The hull of four numbers; all numbers if one is infinite or NaN.
    fn around(numbers: [f64; 4]) -> Self {
        if !numbers.iter().all(|x| x.is_finite()) {
            return ALL;
        }
        let [a, b, c, d] = numbers;
        Self::outwards(a.min(b).min(c.min(d)), a.max(b).max(c.max(d)))
    }

    pub(super) fn over(&self, other: &Self) -> Self {
        if other.low <= 0.0 && other.high >= 0.0 {
            return ALL;
        }
        Self::around([
            self.low / other.low,
            self.low / other.high,
            self.high / other.low,
            self.high / other.high,
        ])
    }

    /// The square root of a number that is not negative.
    fn root(&self) -> Self {
        Self::outwards(self.low.max(0.0).sqrt(), self.high.max(0.0).sqrt())
    }

    /// The intersection of two intervals that contain the same number.
    fn and(&self, other: &Self) -> Self {
        Self { low: self.low.max(other.low), high: self.high.min(other.high) }
    }

    pub(super) fn compare(&self, other: &Self) -> Option<Ordering> {
        if self.high < other.low {
            Some(Ordering::Less)
        } else if self.low > other.high {
            Some(Ordering::Greater)
        } else {
            None
        }
    }
}

impl From<f64> for Interval {
    fn from(x: f64) -> Self {
        Self { low: x, high: x }
    }
}

impl Number for Interval {
    fn plus(&self, other: &Self) -> Self {
        Self::outwards(self.low + other.low, self.high + other.high)
    }

    fn minus(&self, other: &Self) -> Self {
        Self::outwards(self.low - other.high, self.high - other.low)
    }

    fn times(&self, other: &Self) -> Self {
        Self::around([
            self.low * other.low,
            self.low * other.high,
            self.high * other.low,
            self.high * other.high,
        ])
    }

    fn sign(&self) -> Option<Sign> {
        if self.low > 0.0 {
            Some(Sign::Positive)
        } else if self.high < 0.0 {
            Some(Sign::Negative)
        } else if self.low == 0.0 && self.high == 0.0 {
            Some(Sign::Zero)
        } else {
            None
        }
    }
}

impl Terms<Interval> {
    /// The lower or the upper end, by both forms of the root of a quadratic: one of them is a sum without cancellation.
    pub(super) fn root(&self, is_low: bool) -> Interval {
        let (ab, surd) = (self.a.times(&self.b), self.q.times(&self.d).root());
        let (more, less) = (ab.plus(&surd), ab.minus(&surd));
        let (above, below) = if is_low { (more, less) } else { (less, more) };
        let last = self.a.times(&self.a).minus(&self.q);
        above.over(&self.m).and(&last.over(&below))
    }
}
