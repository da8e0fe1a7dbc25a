//! The filters for points with weights: the in-circle and in-sphere determinants with lifts less a difference of weights.
//!
//! One more rounding than without weights, and the squared length plus the difference of weights is the size of a lift.

use super::space::{SPHERE_CEILING, SPHERE_FLOOR, sphere_terms};
use super::{CIRCLE_CEILING, CIRCLE_FLOOR, Filter3, Grid, U, circle_terms, outside_of};
use crate::{Sign, Site};

/// 11u times its permanent.
pub(super) const POWER_CIRCLE_BOUND: f64 = (11.0 + 112.0 * U) * U;
/// 17u times its permanent.
pub(super) const POWER_SPHERE_BOUND: f64 = (17.0 + 256.0 * U) * U;

/// A site seen from another one: the difference of their points, the lift and the size of its terms.
#[inline]
fn seen<const D: usize>((p, w): Site<D>, (q, v): Site<D>) -> ([f64; D], f64, f64) {
    let row: [f64; D] = std::array::from_fn(|axis| p[axis] - q[axis]);
    let (square, weight) = (row.iter().map(|x| x * x).sum::<f64>(), w - v);
    (row, square - weight, square + weight.abs())
}

/// Power test in the plane if floating point can tell.
#[inline]
pub(crate) fn in_power_circle_filter(a: Site<2>, b: Site<2>, c: Site<2>, d: Site<2>) -> Option<Sign> {
    let [a, b, c] = [a, b, c].map(|site| seen(site, d));
    let rows = [a.0, b.0, c.0];
    let (det, _) = circle_terms(rows, [a.1, b.1, c.1]);
    let (_, permanent) = circle_terms(rows, [a.2, b.2, c.2]);
    if a.2 + b.2 + c.2 < CIRCLE_CEILING {
        outside_of(det, POWER_CIRCLE_BOUND * permanent + CIRCLE_FLOOR)
    } else {
        None
    }
}

/// Power test in space if floating point can tell.
pub(crate) fn in_power_sphere_filter([a, b, c, d, e]: [Site<3>; 5]) -> Option<Sign> {
    let [a, b, c, d] = [a, b, c, d].map(|site| seen(site, e));
    let rows = [a.0, b.0, c.0, d.0];
    let (det, _) = sphere_terms(rows, [a.1, b.1, c.1, d.1]);
    let (_, permanent) = sphere_terms(rows, [a.2, b.2, c.2, d.2]);
    if a.2 + b.2 + c.2 + d.2 < SPHERE_CEILING {
        // Positive where e is above.
        outside_of(-det, POWER_SPHERE_BOUND * permanent + SPHERE_FLOOR)
    } else {
        None
    }
}

impl Filter3 {
    /// As [`Self::for_box`], but for points with weights that differ by at most `spread`. The grid must hold the square roots
    /// of what all weights are multiples of, or be `None`.
    pub fn for_sites(extent: [f64; 3], spread: f64, grid: Option<Grid>) -> Self {
        let volume = extent[0] * extent[1] * extent[2];
        let lift: f64 = extent.iter().map(|side| side * side).sum::<f64>() + spread;
        let fits = lift < SPHERE_CEILING;
        if let Some(step) = grid.filter(|_| fits).map(|grid| grid.step) {
            let [x, y, z] = extent.map(|side| (side / step).max(1.0));
            if 24.0 * x * y * z * (x * x + y * y + z * z + spread / step / step) < 4e15 {
                return Self { orient: 0.0, sphere: 0.0, exact: true };
            }
        }
        let sphere = 24.1 * POWER_SPHERE_BOUND * volume * lift + SPHERE_FLOOR;
        let sphere = if fits { sphere } else { f64::INFINITY };
        Self { sphere, exact: false, ..Self::for_box(extent, None) }
    }
}
