//! Does the circle of a triangle stay inside of a box? "Certainly", or "perhaps not".
//!
//! As for [`crate::keeps_clear`], those who ask lose only time if a circle is not seen to stay inside, so there is no exact
//! stage: floating point with a proven bound.
//!
//! Let m be the largest difference of a coordinate, u = 2^-53, the first corner the origin, b and c the others. The centre is
//! N / D with N = (c_y b.b - b_y c.c, b_x c.c - c_x b.b) and D = 2 (b x c), so |N| <= 4 m^3 and |D| <= 4 m^2. Differences are off by u of
//! themselves. A product of two is off by 3 u m^2, hence D by 2 (2 . 3 + 2) u m^2 = 16 u m^2 and b.b, at most 2 m^2, by
//! 8 u m^2; one of its products with a coordinate by (8 + 2 + 2) u m^3, hence N by (2 . 12 + 4) u m^3 = 28 u m^3.
//! So a coordinate c of the centre is off by (28 m + 16 |c|) u m^2 / |D| and by u |c| for the quotient, which |D| <= 4 m^2 makes
//! e <= u (32 m + 20 |c|) m^2 / |D| in all: the 4 are for terms of the second order, small while |D| >= 2^-30 m^2.
//! The radius, at least as great as |c|, is off by sqrt(2) e + 2 u of itself, the distance s of a side by u |s|; their sum
//! with c by less than 3 e + 8 u (radius + |s|). The comparison allows 4 e and 16 u.

use crate::Point2;
use crate::clear::{FLAT, SIZES, UNIT};

/// Whether the closed disk of the circle through three points is certainly in the inside of a box, whose sides may be
/// infinite: nothing is beyond these. The answer `false` says nothing; it is rare where the circle stays away from
/// all sides by a millionth of its radius. O(1).
///
/// ```
/// use delone_predicates::stays_within;
///
/// let corners = [[0.0, 0.0], [2.0, 0.0], [0.0, 2.0]]; // around (1, 1), radius 1.41
/// assert!(stays_within(corners, [-0.5, -0.5], [2.5, f64::INFINITY]));
/// assert!(!stays_within(corners, [-0.4, -0.5], [2.5, f64::INFINITY]));
/// assert!(!stays_within(corners, [-0.5, -0.5], [2.4, f64::INFINITY]));
/// ```
#[must_use]
#[inline]
pub fn stays_within([a, b, c]: [Point2; 3], low: Point2, high: Point2) -> bool {
    if low == [f64::NEG_INFINITY; 2] && high == [f64::INFINITY; 2] {
        return true;
    }
    let from = |p: Point2| [p[0] - a[0], p[1] - a[1]];
    let (b, c) = (from(b), from(c));
    let size = b.into_iter().chain(c).fold(0.0_f64, |m, x| m.max(x.abs()));
    if !SIZES.contains(&size) {
        return false;
    }
    let det = 2.0 * (b[0] * c[1] - b[1] * c[0]);
    let square = size * size;
    if det.abs() < FLAT * square {
        return false;
    }
    let (bb, cc) = (b[0] * b[0] + b[1] * b[1], c[0] * c[0] + c[1] * c[1]);
    let centre = [(c[1] * bb - b[1] * cc) / det, (b[0] * cc - c[0] * bb) / det];
    let radius = (centre[0] * centre[0] + centre[1] * centre[1]).sqrt();
    let off = 4.0 * UNIT * (32.0 * size + 20.0 * radius) * square / det.abs();
    // False where a distance is no number or too large for one.
    let is_beyond = |gap: f64, side: f64| gap > off + 16.0 * UNIT * (radius + side.abs());
    (0..2).all(|k| {
        let (below, above) = (low[k] - a[k], high[k] - a[k]);
        (low[k] == f64::NEG_INFINITY || is_beyond(centre[k] - radius - below, below))
            && (high[k] == f64::INFINITY || is_beyond(above - centre[k] - radius, above))
    })
}
