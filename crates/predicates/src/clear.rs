//! Does the sphere of a tetrahedron keep clear of a box? "Certainly", or "perhaps not".
//!
//! Callers lose only time if a clear sphere is not recognized, so there is no exact stage: floating point with
//! a proven bound.
//!
//! Let m be the largest difference of a coordinate, u = 2^-53, the first corner the origin. The center is N / D with
//! |N| <= 18 m^4 and |D| <= 12 m^3; rounding puts N off by at most 220 u m^4 and D by 100 u m^3, so while
//! |D| >= 2^-30 m^3 a coordinate c of the center is off by e <= u (256 m + 128 |c|) m^3 / |D|. Distance and radius are
//! then off by less than 2 e + 16 u of themselves each.
//!
//! With weights, of which any two corners differ by at most v: |N| <= 18 m^2 (m^2 + v), off by at most 240 u m^2 (m^2 + v), and
//! e <= u (256 (m + v / m) + 128 |c|) m^3 / |D|. The power sphere keeps clear of sites in the box that weigh w at most, if
//! the square of the distance is greater than that of the radius of the first corner by more than w, less that corner's weight.
//! Where both are off by less than f the squares differ by (distance - radius - 2 f)(distance + radius) - f^2 at least.

use crate::{Point3, Site};

pub(crate) const UNIT: f64 = f64::EPSILON / 2.0;
/// Flatter tetrahedra, with this share of their size to the third, have spheres that nobody knows.
pub(crate) const FLAT: f64 = 1.0 / (1 << 30) as f64;
/// No product overflows or loses bits by being small for differences from 2^-200 to 2^200.
pub(crate) const SIZES: std::ops::Range<f64> = 6.2e-61..1.6e60;

/// Whether the sphere through four points certainly has no point of a box inside of it or on it. The answer `false` says
/// nothing; it is rare where the sphere is far from the box by a millionth of its radius. O(1).
///
/// ```
/// use delone_predicates::keeps_clear;
///
/// let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
/// assert!(keeps_clear(corners, [1.5, 0.0, 0.0], [2.0, 1.0, 1.0]));
/// assert!(!keeps_clear(corners, [1.2, 0.0, 0.0], [2.0, 1.0, 1.0]));
/// ```
#[must_use]
#[inline]
pub fn keeps_clear(corners: [Point3; 4], low: Point3, high: Point3) -> bool {
    let Some(Sphere { center, radius, off }) = sphere(corners) else { return false };
    let from = |p: Point3| [0, 1, 2].map(|k| p[k] - corners[0][k]);
    let (low, high) = (from(low), from(high));
    let beside = [0, 1, 2].map(|k| (low[k] - center[k]).max(center[k] - high[k]).max(0.0));
    let distance = dot(beside, beside).sqrt();
    distance - radius > 4.0 * off + 32.0 * UNIT * (distance + radius)
}

/// The sphere of four points, from the first of them.
pub(crate) struct Sphere {
    pub(crate) center: Point3,
    pub(crate) radius: f64,
    /// How much each coordinate of the center may be off, terms of the second order left out.
    pub(crate) off: f64,
}

/// The sphere of four points; `None` if they are too flat, or too near or far, for a bound.
#[inline]
pub(crate) fn sphere([a, b, c, d]: [Point3; 4]) -> Option<Sphere> {
    let from = |p: Point3| [p[0] - a[0], p[1] - a[1], p[2] - a[2]];
    let (b, c, d) = (from(b), from(c), from(d));
    let size = b.into_iter().chain(c).chain(d).fold(0.0_f64, |m, x| m.max(x.abs()));
    if !SIZES.contains(&size) {
        return None;
    }
    let (cd, db, bc) = (cross(c, d), cross(d, b), cross(b, c));
    let det = 2.0 * dot(b, cd);
    let cube = size * size * size;
    if det.abs() < FLAT * cube {
        return None;
    }
    let (bb, cc, dd) = (dot(b, b), dot(c, c), dot(d, d));
    let center = [0, 1, 2].map(|k| (bb * cd[k] + cc * db[k] + dd * bc[k]) / det);
    let radius = dot(center, center).sqrt();
    let off = UNIT * (256.0 * size + 128.0 * radius) * cube / det.abs();
    Some(Sphere { center, radius, off })
}

/// Tests the power sphere of four sites, and sites in the box that weigh at most `most`: whether certainly none of
/// these is below the hyperplane through the lifted corners or on it. O(1).
///
/// ```
/// use delone_predicates::keeps_clear_of_sites;
///
/// let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|p| (p, 0.5));
/// // A square of the distance of 1, beside a square of the radius of 0.25 once the weight is taken away.
/// assert!(keeps_clear_of_sites(corners, [1.5, 0.0, 0.0], [2.0, 1.0, 1.0], 0.7));
/// assert!(!keeps_clear_of_sites(corners, [1.5, 0.0, 0.0], [2.0, 1.0, 1.0], 0.8));
/// ```
#[must_use]
pub fn keeps_clear_of_sites([a, b, c, d]: [Site<3>; 4], low: Point3, high: Point3, most: f64) -> bool {
    let from = |p: Point3| [p[0] - a.0[0], p[1] - a.0[1], p[2] - a.0[2]];
    let heavier = [b, c, d].map(|site| site.1 - a.1);
    let [b, c, d] = [b, c, d].map(|site| from(site.0));
    let size = b.into_iter().chain(c).chain(d).fold(0.0_f64, |m, x| m.max(x.abs()));
    let spread = heavier.iter().fold(0.0_f64, |m, w| m.max(w.abs()));
    if !SIZES.contains(&size) || spread > SIZES.end * SIZES.end {
        return false;
    }
    let (cd, db, bc) = (cross(c, d), cross(d, b), cross(b, c));
    let det = 2.0 * dot(b, cd);
    let cube = size * size * size;
    if det.abs() < FLAT * cube {
        return false;
    }
    let lifts = [dot(b, b) - heavier[0], dot(c, c) - heavier[1], dot(d, d) - heavier[2]];
    let center = [0, 1, 2].map(|k| (lifts[0] * cd[k] + lifts[1] * db[k] + lifts[2] * bc[k]) / det);
    let (low, high) = (from(low), from(high));
    let beside = [0, 1, 2].map(|k| (low[k] - center[k]).max(center[k] - high[k]).max(0.0));
    let (distance, radius) = (dot(beside, beside).sqrt(), dot(center, center).sqrt());
    let both = distance + radius;
    let off = UNIT * (256.0 * (size + spread / size) + 128.0 * radius) * cube / det.abs();
    let off = 2.0 * off + 32.0 * UNIT * both;
    let (apart, lost, needed) = ((distance - radius - 2.0 * off) * both, off * off, most - a.1);
    // False where something is no number.
    apart - lost - needed > 8.0 * UNIT * (apart.abs() + lost + needed.abs())
}

fn cross(p: Point3, q: Point3) -> Point3 {
    [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]
}

fn dot(p: Point3, q: Point3) -> f64 {
    p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
}
