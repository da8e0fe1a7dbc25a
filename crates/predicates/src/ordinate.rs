//! The height of a line over a place, correctly rounded: where lines of longitude and latitude cross a meridian.

use crate::Point2;
use crate::exact::{big, big_int::BigInt};

/// The y at `x` of the line through `a` and through `b` moved by `shift` along x: the `f64` nearest to it. `None` for a line that is
/// vertical, and if y is too large for an `f64`.
///
/// The moved point need not have coordinates that are `f64`s. Exact for every finite input. O(1).
///
/// ```
/// use delone_predicates::ordinate;
/// // From 170 degrees of longitude to -170, which is 190.
/// assert_eq!(ordinate(180.0, [170.0, 1.0], [-170.0, 2.0], 360.0), Some(1.5));
/// assert_eq!(ordinate(0.0, [1.0, 0.0], [1.0, 5.0], 0.0), None);
/// ```
#[must_use]
pub fn ordinate(x: f64, a: Point2, b: Point2, shift: f64) -> Option<f64> {
    let (numbers, scale) = big::integers(&[x, a[0], a[1], b[0], b[1], shift]);
    let [x, ax, ay, bx, by, shift] = &numbers[..] else { return None };
    let bx = bx + shift;
    let width = &bx - ax;
    if width == BigInt::ZERO {
        return None;
    }
    let sum = ay * (&bx - x) + by * (x - ax);
    Some(big::quotient(&sum, &width, scale)).filter(|y| y.is_finite())
}

#[cfg(test)]
mod tests {
    use delone_generators::Random;

    use super::ordinate;
    use crate::{Line, Spot};

    /// Where the moved point has coordinates, it is the meeting of two lines; either end may be the moved one.
    #[test]
    fn it_is_the_meeting_with_a_vertical_line() {
        let mut random = Random::new(3);
        for round in 0..5_000 {
            let steps = [1.0, 0.125, 2f64.powi(-30), 2f64.powi(-500)][round % 4];
            let mut number = || (random.below(4096) as f64 - 2048.0) * steps;
            let (a, b, x) = ([number(), number()], [number(), number()], number());
            let shift = f64::from(1 << (round % 11)) * steps;
            let moved = [b[0] + shift, b[1]];
            if a[0] == moved[0] {
                continue;
            }
            let meeting = Spot::Meeting(Line::Through(a, moved), Line::Above(0, x));
            let expected = meeting.rounded().map(|p| p[1]);
            assert_eq!(ordinate(x, a, b, shift), expected, "{a:?} {b:?} {x} {shift}");
            assert_eq!(ordinate(x, moved, a, 0.0), expected, "{a:?} {b:?} {x} {shift}");
        }
    }

    #[test]
    fn small_parts_are_not_lost() {
        // The end at 360.00...01 is no f64, and the line is at 180 a little above the middle of 0 and 1.
        let y = ordinate(180.0, [0.0, 0.0], [1e-300, 1.0], 360.0);
        assert_eq!(y, Some(0.5));
        let next = ordinate(1.0, [0.0, 0.0], [1e-300, 1.0], 1.0);
        assert_eq!(next, Some(1.0));
        assert_eq!(ordinate(3.0, [0.0, -0.0], [1.0, 0.0], 0.0).map(f64::to_bits), Some(0));
        assert_eq!(ordinate(f64::MAX, [0.0, 0.0], [1.0, 2.0], 0.0), None);
        assert_eq!(ordinate(180.0, [179.0, 1.0], [-179.0, 1.0], 360.0), Some(1.0));
    }
}
