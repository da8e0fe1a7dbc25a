//! The pencil of spheres through three points, for searches of the point whose sphere is empty; [`crate::Pencil`] does the same
//! in the plane.
//!
//! For points a, b, c and a candidate p let b', c', p' be the differences to a, each with its square as a fourth entry. The
//! in-sphere determinant of a, b, c, p and q is that of the rows b', c', p', q'. The six minors of b' and c' are the
//! same for all candidates, and with those of p' a point q costs four products beside its square; a test of five points that knows
//! nothing costs forty. With weights the fourth entry is a power distance.
//!
//! Floating point answers or says that it cannot tell: by the bounds of [`Filter3`], whose constants cover these formulas
//! too.

use crate::filter::{Filter3, outside_of};
use crate::{Sign, Site};

/// Differences in x, y and z, and the square of their length less the difference of weights.
type Row = [f64; 4];

/// The spheres through three points, or all that are orthogonal to three sites.
#[derive(Clone, Copy, Debug)]
pub struct SpherePencil {
    origin: Site<3>,
    /// The minors of two rows in columns xy, xz, yz, xl, yl, zl.
    minors: [f64; 6],
}

/// One of them.
#[derive(Clone, Copy, Debug)]
pub struct Ball {
    origin: Site<3>,
    /// The factor of each entry of a row.
    factors: Row,
}

#[inline]
fn row((p, w): Site<3>, (o, v): Site<3>) -> Row {
    let [x, y, z] = [p[0] - o[0], p[1] - o[1], p[2] - o[2]];
    [x, y, z, x * x + y * y + z * z - (w - v)]
}

impl SpherePencil {
    /// The spheres through three points. Without weights all weights are zero.
    #[inline]
    pub fn new([a, b, c]: [Site<3>; 3]) -> Self {
        let (b, c) = (row(b, a), row(c, a));
        let minor = |i: usize, j: usize| b[i] * c[j] - b[j] * c[i];
        Self {
            origin: a,
            minors: [minor(0, 1), minor(0, 2), minor(1, 2), minor(0, 3), minor(1, 3), minor(2, 3)],
        }
    }

    /// [`crate::orient3d`] of the three points and another one, if floating point can tell and it is not zero. All are in the
    /// filter's box.
    #[inline]
    pub fn side(&self, q: Site<3>, filter: &Filter3) -> Option<Sign> {
        let [xy, xz, yz, ..] = self.minors;
        let [x, y, z, _] = row(q, self.origin);
        outside_of(xy * z - xz * y + yz * x, filter.orient)
    }

    /// The sphere that passes through one more point.
    #[inline]
    pub fn through(&self, p: Site<3>) -> Ball {
        let [xy, xz, yz, xl, yl, zl] = self.minors;
        let [x, y, z, l] = row(p, self.origin);
        Ball {
            origin: self.origin,
            factors: [
                yz * l - yl * z + zl * y,
                xl * z - xz * l - zl * x,
                xy * l - xl * y + yl * x,
                xz * y - xy * z - yz * x,
            ],
        }
    }
}

impl Ball {
    /// [`crate::in_power_sphere`] of the three sites, the fourth and another one, if floating point can tell and it is no tie. All
    /// are what the filter was made for.
    #[inline]
    pub fn side(&self, q: Site<3>, filter: &Filter3) -> Option<Sign> {
        let [x, y, z, l] = row(q, self.origin);
        let [fx, fy, fz, fl] = self.factors;
        outside_of((fx * x + fy * y) + (fz * z + fl * l), filter.sphere)
    }
}
