//! The filters in space: orientation of four points, in-sphere test of five.
//!
//! The same analysis as in the plane. With extents X, Y, Z and L = X^2 + Y^2 + Z^2, the permanent of an orientation is
//! at most 6 XYZ, that of an in-sphere determinant 24 XYZ L.

use std::ops::{Add, Mul, Sub};

use wide::f64x2;

use super::{Grid, U, outside_of};
use crate::perturb::in_sphere_perturbed;
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
    orient: f64,
    sphere: f64,
    /// Arithmetic inside of the box is exact: what the bound (zero) does not decide is zero.
    exact: bool,
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

    /// Like [`crate::orient3d`], for points in the box.
    #[inline]
    pub fn orient3d(&self, a: Point3, b: Point3, c: Point3, d: Point3) -> Sign {
        let (ax, ay, az) = (a[0] - d[0], a[1] - d[1], a[2] - d[2]);
        let (bx, by, bz) = (b[0] - d[0], b[1] - d[1], b[2] - d[2]);
        let (cx, cy, cz) = (c[0] - d[0], c[1] - d[1], c[2] - d[2]);
        let det = az * (bx * cy - cx * by) + bz * (cx * ay - ax * cy) + cz * (ax * by - bx * ay);
        if det < -self.orient {
            Sign::Positive
        } else if det > self.orient {
            Sign::Negative
        } else if self.exact {
            Sign::Zero
        } else {
            crate::orient3d::orient3d_near(a, b, c, d)
        }
    }

    /// A facet of a positively oriented tetrahedron that `q` is strictly beyond, as the number of the corner opposite to it;
    /// `None` if there is none, and `q` is inside or on the border. All points are in the box.
    ///
    /// Of several facets it is most often the one that spans the largest volume with `q`. The four orientations share
    /// their minors, and cost as much as two.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "a walk asks nothing else, and a call costs an eighth of it")]
    pub fn facet_towards(&self, corners: [&Point3; 4], q: &Point3) -> Option<usize> {
        let from_q = |k: usize| [corners[k][0] - q[0], corners[k][1] - q[1], corners[k][2] - q[2]];
        let [abc, bcd, cda, dab] = volumes(from_q(0), from_q(1), from_q(2), from_q(3));
        let beyond = [-bcd, cda, -dab, abc];
        let further = |i: usize, j: usize| if beyond[j] > beyond[i] { j } else { i };
        let furthest = further(further(0, 1), further(2, 3));
        if beyond[furthest] > self.orient {
            Some(furthest)
        } else if beyond[furthest] < -self.orient {
            None
        } else {
            self.facet_near(corners, q)
        }
    }

    #[cold]
    #[inline(never)]
    fn facet_near(&self, [a, b, c, d]: [&Point3; 4], q: &Point3) -> Option<usize> {
        let is_beyond = |&[u, v, w]: &[&Point3; 3]| self.orient3d(*u, *v, *w, *q).is_negative();
        [[b, d, c], [a, c, d], [a, d, b], [a, b, c]].iter().position(is_beyond)
    }

    /// [`Self::in_sphere`] of two quadruples at once, which takes little longer than of one. By reference: copies of points
    /// are written in other pieces than they are read, and reading waits for that.
    #[inline]
    pub fn in_spheres(&self, [p, q]: [[&Point3; 4]; 2], e: &Point3) -> [Sign; 2] {
        let [ex, ey, ez] = e.map(f64x2::splat);
        let from_e = |k: usize| {
            let pair = |axis: usize| f64x2::new([p[k][axis], q[k][axis]]);
            [pair(0) - ex, pair(1) - ey, pair(2) - ez]
        };
        let [first, second] = sphere_determinant(from_e(0), from_e(1), from_e(2), from_e(3)).to_array();
        // One branch, which hardly ever goes the other way; which side it is is chance, and is not branched on.
        if first.abs() > self.sphere && second.abs() > self.sphere {
            [first, second].map(|det| if det < 0.0 { Sign::Positive } else { Sign::Negative })
        } else {
            [self.side_of_sphere(first, p, e), self.side_of_sphere(second, q, e)]
        }
    }

    /// Like [`crate::in_sphere`], for points in the box.
    #[inline]
    pub fn in_sphere(&self, a: Point3, b: Point3, c: Point3, d: Point3, e: Point3) -> Sign {
        let from_e = |p: Point3| [p[0] - e[0], p[1] - e[1], p[2] - e[2]];
        let det = sphere_determinant(from_e(a), from_e(b), from_e(c), from_e(d));
        if det.abs() > self.sphere {
            if det < 0.0 { Sign::Positive } else { Sign::Negative }
        } else {
            self.side_of_sphere(det, [&a, &b, &c, &d], &e)
        }
    }

    /// The side that a determinant tells, or the points where it does not.
    #[cold]
    #[inline(never)]
    fn side_of_sphere(&self, det: f64, [a, b, c, d]: [&Point3; 4], e: &Point3) -> Sign {
        if det < -self.sphere {
            Sign::Positive
        } else if det > self.sphere {
            Sign::Negative
        } else if self.exact {
            in_sphere_perturbed([*a, *b, *c, *d, *e], |p, q, r, s| self.orient3d(p, q, r, s))
        } else {
            crate::in_sphere(*a, *b, *c, *d, *e)
        }
    }
}

/// The in-sphere determinant of four vectors from the fifth point: negative inside.
#[inline]
fn sphere_determinant<T>(a: [T; 3], b: [T; 3], c: [T; 3], d: [T; 3]) -> T
where
    T: Copy + Add<Output = T> + Sub<Output = T> + Mul<Output = T>,
{
    let [abc, bcd, cda, dab] = volumes(a, b, c, d);
    let lift = |[x, y, z]: [T; 3]| x * x + y * y + z * z;
    (lift(d) * abc - lift(c) * dab) + (lift(b) * cda - lift(a) * bcd)
}

/// The determinants of each three of four vectors: a, b, c; b, c, d; c, d, a; d, a, b.
#[inline]
fn volumes<T>(
    [ax, ay, az]: [T; 3],
    [bx, by, bz]: [T; 3],
    [cx, cy, cz]: [T; 3],
    [dx, dy, dz]: [T; 3],
) -> [T; 4]
where
    T: Copy + Add<Output = T> + Sub<Output = T> + Mul<Output = T>,
{
    let ab = ax * by - bx * ay;
    let bc = bx * cy - cx * by;
    let cd = cx * dy - dx * cy;
    let da = dx * ay - ax * dy;
    let ac = ax * cy - cx * ay;
    let bd = bx * dy - dx * by;
    [
        az * bc - bz * ac + cz * ab,
        bz * cd - cz * bd + dz * bc,
        cz * da + dz * ac + az * cd,
        dz * ab + az * bd + bz * da,
    ]
}
