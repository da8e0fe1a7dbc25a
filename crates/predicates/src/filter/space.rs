//! The filters in space: orientation of four points, in-sphere test of five.
//!
//! The analysis follows that of the plane. With extents X, Y, Z and L = X^2 + Y^2 + Z^2, the permanent of an orientation is
//! at most 6 XYZ, that of an in-sphere determinant 24 XYZ L.

use super::{Grid, U, outside_of};
use crate::{Point3, Sign};

/// Orientation in space: 7u times its permanent.
pub(super) const ORIENT3D_BOUND: f64 = (7.0 + 56.0 * U) * U;
/// The in-sphere determinant: 16u times its permanent.
pub(super) const IN_SPHERE_BOUND: f64 = (16.0 + 224.0 * U) * U;
/// The largest sum of differences in z for which [`ORIENT3D_FLOOR`] is valid: 2^500.
pub(super) const ORIENT3D_CEILING: f64 = f64::from_bits((1023 + 500) << 52);
/// All errors by underflow in an orientation in space whose differences in z stay below 2^500: each of fewer than 16
/// roundings is off by at most 2^-1075 and is multiplied by at most 2^501.
pub(super) const ORIENT3D_FLOOR: f64 = f64::from_bits((1023 - 569) << 52);
/// The largest sum of squared differences for which [`SPHERE_FLOOR`] is valid: 2^200.
pub(super) const SPHERE_CEILING: f64 = f64::from_bits((1023 + 200) << 52);
/// All errors by underflow in an in-sphere test whose squared differences stay below 2^200: each of fewer than 128
/// roundings is off by at most 2^-1075, and is multiplied by at most 2^303, by a minor of three columns or by a
/// squared length and a difference.
pub(super) const SPHERE_FLOOR: f64 = f64::from_bits((1023 - 760) << 52);

/// Orientation of four points in space if floating point can tell.
#[inline]
pub(crate) fn orient3d_filter(a: Point3, b: Point3, c: Point3, d: Point3) -> Option<Sign> {
    let rows = [a, b, c].map(|p| [p[0] - d[0], p[1] - d[1], p[2] - d[2]]);
    let (det, permanent) = orient3d_terms(rows);
    if rows[0][2].abs() + rows[1][2].abs() + rows[2][2].abs() < ORIENT3D_CEILING {
        // Positive where d is below a, b, c.
        outside_of(-det, ORIENT3D_BOUND * permanent + ORIENT3D_FLOOR)
    } else {
        None
    }
}

/// A determinant of three rows, and its permanent.
#[inline]
pub(super) fn orient3d_terms([[ax, ay, az], [bx, by, bz], [cx, cy, cz]]: [Point3; 3]) -> (f64, f64) {
    let (bc, cb) = (bx * cy, cx * by);
    let (ca, ac) = (cx * ay, ax * cy);
    let (ab, ba) = (ax * by, bx * ay);
    let det = az * (bc - cb) + bz * (ca - ac) + cz * (ab - ba);
    let permanent = az.abs() * (bc.abs() + cb.abs())
        + bz.abs() * (ca.abs() + ac.abs())
        + cz.abs() * (ab.abs() + ba.abs());
    (det, permanent)
}

/// In-sphere test of five points if floating point can tell.
pub(crate) fn in_sphere_filter(a: Point3, b: Point3, c: Point3, d: Point3, e: Point3) -> Option<Sign> {
    let rows = [a, b, c, d].map(|p| [p[0] - e[0], p[1] - e[1], p[2] - e[2]]);
    let lifts @ [la, lb, lc, ld] = rows.map(|[x, y, z]| x * x + y * y + z * z);
    let (det, permanent) = sphere_terms(rows, lifts);
    if la + lb + lc + ld < SPHERE_CEILING {
        // Positive where e is outside.
        outside_of(-det, IN_SPHERE_BOUND * permanent + SPHERE_FLOOR)
    } else {
        None
    }
}

/// The in-sphere determinant of four rows and their squared lengths, and its permanent.
#[inline]
pub(super) fn sphere_terms([a, b, c, d]: [Point3; 4], [la, lb, lc, ld]: [f64; 4]) -> (f64, f64) {
    let minor = |u: Point3, v: Point3| {
        let (p, q) = (u[0] * v[1], v[0] * u[1]);
        (p - q, p.abs() + q.abs())
    };
    let [ab, bc, cd, da, ac, bd] = [(a, b), (b, c), (c, d), (d, a), (a, c), (b, d)].map(|(u, v)| minor(u, v));
    let abc = a[2] * bc.0 - b[2] * ac.0 + c[2] * ab.0;
    let bcd = b[2] * cd.0 - c[2] * bd.0 + d[2] * bc.0;
    let cda = c[2] * da.0 + d[2] * ac.0 + a[2] * cd.0;
    let dab = d[2] * ab.0 + a[2] * bd.0 + b[2] * da.0;
    let det = (ld * abc - lc * dab) + (lb * cda - la * bcd);
    let [az, bz, cz, dz] = [a, b, c, d].map(|p| p[2].abs());
    let permanent = ld * (az * bc.1 + bz * ac.1 + cz * ab.1)
        + lc * (dz * ab.1 + az * bd.1 + bz * da.1)
        + lb * (cz * da.1 + dz * ac.1 + az * cd.1)
        + la * (bz * cd.1 + cz * bd.1 + dz * bc.1);
    (det, permanent)
}

/// A static filter in space: error bounds that hold for all points of one box, computed once.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Filter3 {
    pub(crate) orient: f64,
    pub(crate) sphere: f64,
    /// Arithmetic inside of the box is exact: what the bound (zero) does not decide is zero.
    pub(crate) exact: bool,
}

impl Default for Filter3 {
    /// For no points at all.
    fn default() -> Self {
        Self::for_box([0.0; 3], None)
    }
}

impl Filter3 {
    /// For points whose coordinates differ by at most `extent`, axis by axis, all of them on `grid` if one is known.
    pub fn for_box(extent: [f64; 3], grid: Option<Grid>) -> Self {
        let volume = extent[0] * extent[1] * extent[2];
        let square: f64 = extent.iter().map(|side| side * side).sum();
        let fits = square < SPHERE_CEILING;
        if let Some(Grid { step }) = grid.filter(|_| fits) {
            let [x, y, z] = extent.map(|side| side / step);
            if 24.0 * x.max(1.0) * y.max(1.0) * z.max(1.0) * (x * x + y * y + z * z) < 4e15 {
                return Self { orient: 0.0, sphere: 0.0, exact: true };
            }
        }
        let bound = |value: f64| if fits { value } else { f64::INFINITY };
        Self {
            orient: bound(6.1 * ORIENT3D_BOUND * volume + ORIENT3D_FLOOR),
            sphere: bound(24.1 * IN_SPHERE_BOUND * volume * square + SPHERE_FLOOR),
            exact: false,
        }
    }
}
