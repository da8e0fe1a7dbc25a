//! Which of two segments is longer, in the plane and in space: filter, exact. Equal is an answer.

use std::cmp::Ordering;

use crate::distance::compared;
use crate::exact;

/// The squared length of a segment as floating point has it: what many are sorted by before exact arithmetic is asked.
///
/// It is wrong by at most 5u of itself (a difference, twice; a product; two sums), or by what underflow loses.
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
pub struct Length(f64);

impl Length {
    /// Of the segment between two points.
    #[inline]
    pub fn between<const D: usize>(a: &[f64; D], b: &[f64; D]) -> Self {
        let mut sum = 0.0;
        for k in 0..D {
            let x = b[k] - a[k];
            sum += x * x;
        }
        Self(sum)
    }

    /// The number, infinite where it is too large, and never NaN.
    #[inline]
    pub fn squared(self) -> f64 {
        self.0
    }

    /// Which segment is longer, if floating point can tell.
    #[inline]
    pub fn compare(self, other: Self) -> Option<Ordering> {
        compared(self.0, other.0)
    }
}

/// Compares the lengths of two segments, in up to three dimensions: `Less` if the first is shorter.
///
/// Exact for every finite input. O(1).
///
/// ```
/// use std::cmp::Ordering;
/// use delone_predicates::compare_lengths;
/// assert_eq!(compare_lengths([[1.0, 1.0], [4.0, 5.0]], [[0.0, 0.0], [0.0, 5.0]]), Ordering::Equal);
/// assert_eq!(compare_lengths([[0.0, 0.0], [1.0, 1e-200]], [[3.0, 7.0], [4.0, 7.0]]), Ordering::Greater);
/// ```
#[inline]
pub fn compare_lengths<const D: usize>(one: [[f64; D]; 2], other: [[f64; D]; 2]) -> Ordering {
    let [left, right] = [one, other].map(|[a, b]| Length::between(&a, &b));
    left.compare(right).unwrap_or_else(|| exact::lengths::compare(one, other))
}
