//! Does the circle of a triangle, or the sphere of a tetrahedron, stay inside of a box? "Certainly", or "perhaps not".
//!
//! As for [`crate::keeps_clear`], those who ask lose only time if a circle is not seen to stay inside, so there is no exact
//! stage: floating point with a proven bound.
//!
//! Let m be the largest difference of a coordinate, u = 2^-53, the first corner the origin, b and c the others. The center is
//! N / D with N = (c_y b.b - b_y c.c, b_x c.c - c_x b.b) and D = 2 (b x c), so |N| <= 4 m^3 and |D| <= 4 m^2. Differences are off by u of
//! themselves. A product of two is off by 3 u m^2, hence D by 2 (2 . 3 + 2) u m^2 = 16 u m^2 and b.b, at most 2 m^2, by
//! 8 u m^2; one of its products with a coordinate by (8 + 2 + 2) u m^3, hence N by (2 . 12 + 4) u m^3 = 28 u m^3.
//! So a coordinate c of the center is off by (28 m + 16 |c|) u m^2 / |D| and by u |c| for the quotient, which |D| <= 4 m^2 makes
//! e <= u (32 m + 20 |c|) m^2 / |D| in all: the 4 are for terms of the second order, small while |D| >= 2^-30 m^2.
//! The radius, at least as great as |c|, is off by sqrt(2) e + 2 u of itself, the distance s of a side by u |s|; their sum
//! with c by less than 3 e + 8 u (radius + |s|). The comparison allows 4 e and 16 u.
//!
//! In space the center is that of [`crate::keeps_clear`], a coordinate off by e <= u (256 m + 128 |c|) m^3 / |D|. The radius is
//! off by sqrt(3) e + 3 u of itself; the sum with c and a side by less than 2.8 e + 8 u (radius + |s|), because the two
//! subtractions lose 4 u radius + u |s| and the side itself u |s|. As a corner is m away, radius >= m / 2, so with
//! |D| >= 2^-30 m^3 all e are below 1e-4 radius: what is computed stands for what it is in the bound, and 4 e and 16 u are enough.

use crate::clear::{FLAT, SIZES, Sphere, UNIT, sphere};
use crate::{Point2, Point3};

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
    let center = [(c[1] * bb - b[1] * cc) / det, (b[0] * cc - c[0] * bb) / det];
    let radius = (center[0] * center[0] + center[1] * center[1]).sqrt();
    let off = 4.0 * UNIT * (32.0 * size + 20.0 * radius) * square / det.abs();
    // False where a distance is no number or too large for one.
    let is_beyond = |gap: f64, side: f64| gap > off + 16.0 * UNIT * (radius + side.abs());
    (0..2).all(|k| {
        let (below, above) = (low[k] - a[k], high[k] - a[k]);
        (low[k] == f64::NEG_INFINITY || is_beyond(center[k] - radius - below, below))
            && (high[k] == f64::INFINITY || is_beyond(above - center[k] - radius, above))
    })
}

/// Whether the closed ball of the sphere through four points is certainly in the inside of a box, whose sides may be
/// infinite: nothing is beyond these. The answer `false` says nothing; it is rare where the sphere stays away from
/// all sides by a millionth of its radius. O(1).
///
/// ```
/// use delone_predicates::stays_within3;
///
/// // Around (1, 1, 1), radius 1.73.
/// let corners = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 2.0]];
/// assert!(stays_within3(corners, [-0.75, -0.75, -0.75], [2.75, 2.75, f64::INFINITY]));
/// assert!(!stays_within3(corners, [-0.7, -0.75, -0.75], [2.75, 2.75, f64::INFINITY]));
/// assert!(!stays_within3(corners, [-0.75, -0.75, -0.75], [2.75, 2.7, f64::INFINITY]));
/// ```
#[must_use]
#[inline]
pub fn stays_within3(corners: [Point3; 4], low: Point3, high: Point3) -> bool {
    if low == [f64::NEG_INFINITY; 3] && high == [f64::INFINITY; 3] {
        return true;
    }
    let Some(Sphere { center, radius, off }) = sphere(corners) else { return false };
    let off = 4.0 * off;
    // False where a distance is no number or too large for one.
    let is_beyond = |gap: f64, side: f64| gap > off + 16.0 * UNIT * (radius + side.abs());
    (0..3).all(|k| {
        let (below, above) = (low[k] - corners[0][k], high[k] - corners[0][k]);
        (low[k] == f64::NEG_INFINITY || is_beyond(center[k] - radius - below, below))
            && (high[k] == f64::INFINITY || is_beyond(above - center[k] - radius, above))
    })
}
