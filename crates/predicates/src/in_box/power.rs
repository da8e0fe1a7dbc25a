//! Filters by boxes for points with weights.

use crate::lanes::Lanes;

use super::volumes;
use crate::filter::Filter3;
use crate::perturb::first_coefficient;
use crate::{Point3, Sign, Site, in_power_sphere};

/// A site of space whose point is not copied.
pub type SiteRef<'a> = (&'a Point3, f64);

impl Filter3 {
    /// [`Self::in_power_sphere`] of two quadruples at once.
    #[inline]
    pub fn in_power_spheres(&self, [p, q]: [[SiteRef<'_>; 4]; 2], e: SiteRef<'_>) -> [Sign; 2] {
        let at = e.0.map(Lanes::splat);
        let weight = Lanes::splat(e.1);
        let row = |k: usize| {
            let difference = |axis: usize| Lanes::new([p[k].0[axis], q[k].0[axis]]) - at[axis];
            [difference(0), difference(1), difference(2)]
        };
        let rows = [row(0), row(1), row(2), row(3)];
        let lift = |k: usize| {
            let [x, y, z] = rows[k];
            x * x + y * y + z * z - (Lanes::new([p[k].1, q[k].1]) - weight)
        };
        let [abc, bcd, cda, dab] = volumes(rows[0], rows[1], rows[2], rows[3]);
        let [first, second] = ((lift(3) * abc - lift(2) * dab) + (lift(1) * cda - lift(0) * bcd)).to_array();
        if first.abs() > self.sphere && second.abs() > self.sphere {
            [first, second].map(|det| if det < 0.0 { Sign::Positive } else { Sign::Negative })
        } else {
            [self.side_of_power_sphere(first, p, e), self.side_of_power_sphere(second, q, e)]
        }
    }

    /// Like [`crate::in_power_sphere`], for points in the box with weights of its spread.
    #[inline]
    pub fn in_power_sphere(&self, corners: [SiteRef<'_>; 4], e: SiteRef<'_>) -> Sign {
        let row = |k: usize| [0, 1, 2].map(|axis| corners[k].0[axis] - e.0[axis]);
        let rows = [row(0), row(1), row(2), row(3)];
        let lift = |k: usize| rows[k].iter().map(|x| x * x).sum::<f64>() - (corners[k].1 - e.1);
        let [abc, bcd, cda, dab] = volumes(rows[0], rows[1], rows[2], rows[3]);
        let det = (lift(3) * abc - lift(2) * dab) + (lift(1) * cda - lift(0) * bcd);
        self.side_of_power_sphere(det, corners, e)
    }

    /// The side that a determinant tells, or the points where it does not.
    fn side_of_power_sphere(&self, det: f64, [a, b, c, d]: [SiteRef<'_>; 4], e: SiteRef<'_>) -> Sign {
        if det < -self.sphere {
            Sign::Positive
        } else if det > self.sphere {
            Sign::Negative
        } else if self.exact {
            perturbed_on_grid([a.0, b.0, c.0, d.0, e.0])
        } else {
            let site = |(&point, weight): SiteRef<'_>| -> Site<3> { (point, weight) };
            in_power_sphere(site(a), site(b), site(c), site(d), site(e))
        }
    }
}

/// The sign of the perturbed determinant of five points among which arithmetic is exact: the coefficients are the minors of the
/// determinant, all at once.
fn perturbed_on_grid([a, b, c, d, e]: [&Point3; 5]) -> Sign {
    let from_e = |p: &Point3| [p[0] - e[0], p[1] - e[1], p[2] - e[2]];
    let [abc, bcd, cda, dab] = volumes(from_e(a), from_e(b), from_e(c), from_e(d));
    let coefficients = [bcd, -cda, dab, -abc, (abc - bcd) + (cda - dab)];
    first_coefficient([a, b, c, d, e], |k| Sign::of(&coefficients[k], &0.0))
}
