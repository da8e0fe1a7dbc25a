//! Decisions in space for points of one box, by the filter of that box and by the points where it cannot tell.

mod power;

pub use power::SiteRef;

use std::ops::{Add, Mul, Sub};

use crate::lanes::Lanes;

use crate::filter::Filter3;
use crate::perturb::in_sphere_perturbed;
use crate::{Point3, Sign};

impl Filter3 {
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
        let [ex, ey, ez] = e.map(Lanes::splat);
        let from_e = |k: usize| {
            let pair = |axis: usize| Lanes::new([p[k][axis], q[k][axis]]);
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
