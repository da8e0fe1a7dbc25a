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
    left.compare(right).unwrap_or_else(|| {
        if are_alike(one, other) { Ordering::Equal } else { exact::lengths::compare(one, other) }
    })
}

/// Whether two segments surely have the same length, because they are as long along each axis, or along another one: as in
/// lattices, where most lengths are compared with equal ones.
fn are_alike<const D: usize>(one: [[f64; D]; 2], other: [[f64; D]; 2]) -> bool {
    let extents = |[a, b]: [[f64; D]; 2]| {
        let mut extents: [f64; D] = std::array::from_fn(|k| exact_difference(a[k], b[k]).abs());
        extents.sort_unstable_by(f64::total_cmp);
        extents
    };
    // NaN equals nothing.
    extents(one) == extents(other)
}

/// A difference, or NaN if it rounds (Knuth's error of a sum, TAOCP 2, §4.2.2).
fn exact_difference(a: f64, b: f64) -> f64 {
    let x = a - b;
    let from_a = a - x;
    let error = (a - (x + from_a)) + (from_a - b);
    if error == 0.0 { x } else { f64::NAN }
}

#[cfg(test)]
mod tests {
    use super::{are_alike, exact_difference};

    #[test]
    fn differences_that_round_are_none() {
        for (a, b) in [(3.0, 5.5), (0.0, 1e-300), (1e300, 1e300), (f64::from_bits(1), -7e-320), (0.1, 0.15)] {
            assert_eq!(exact_difference(a, b), a - b, "{a} {b}");
        }
        for (a, b) in [(1.0, 1e-17), (0.1, -0.7), (1e300, 1.0), (f64::MAX, -f64::MAX), (-1e-30, 1e-5)] {
            assert!(exact_difference(a, b).is_nan(), "{a} {b}");
        }
        assert!(are_alike([[0.0, 1.0, 5.0], [2.0, 0.0, 1.0]], [[7.0, 7.0, 7.0], [3.0, 9.0, 8.0]]));
        assert!(!are_alike([[0.0, 3.0], [4.0, 0.0]], [[0.0, 0.0], [0.0, 5.0]]), "it is not plain");
        assert!(!are_alike([[0.0, 1e-17], [0.0, 1.0]], [[0.0, 1e-17], [0.0, 1.0]]));
    }
}
