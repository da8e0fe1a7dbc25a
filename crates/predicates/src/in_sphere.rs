//! In-sphere test of five points: filter, exact, perturb.

use crate::filter::in_sphere_filter;
use crate::perturb::in_sphere_perturbed;
use crate::{Point3, Sign, exact, orient3d};

/// Whether `e` lies inside the sphere through `a`, `b`, `c`, `d`: positive when inside, negative when outside, for
/// four points with positive [`crate::orient3d`] (the sign flips when it is negative).
///
/// Five distinct cospherical points never give zero: the tie is broken by the canonical perturbation, as in the
/// plane (see [`crate::in_circle`]), with up to four levels. Zero is returned only when all five are coplanar. The
/// five points must be distinct: no sign is promised for equal ones.
///
/// Exact for every finite input. O(1).
///
/// ```
/// use delone_predicates::{Sign, in_sphere};
/// let (a, b, c, d) = ([0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]);
/// assert_eq!(in_sphere(a, b, c, d, [0.5, 0.5, 0.5]), Sign::Positive);
/// assert_eq!(in_sphere(a, b, c, d, [1.0, 1.0, 1.0]), Sign::Negative); // cospherical, and the largest
/// ```
pub fn in_sphere(a: Point3, b: Point3, c: Point3, d: Point3, e: Point3) -> Sign {
    in_sphere_filter(a, b, c, d, e).unwrap_or_else(|| in_sphere_exact(a, b, c, d, e))
}

/// Tells on which side of a sphere a point is, without the perturbation: zero for cospherical points.
pub fn in_sphere_with_ties(a: Point3, b: Point3, c: Point3, d: Point3, e: Point3) -> Sign {
    in_sphere_filter(a, b, c, d, e).unwrap_or_else(|| exact::in_sphere(a, b, c, d, e))
}

#[cold]
#[inline(never)]
fn in_sphere_exact(a: Point3, b: Point3, c: Point3, d: Point3, e: Point3) -> Sign {
    match exact::in_sphere(a, b, c, d, e) {
        Sign::Zero => in_sphere_perturbed([a, b, c, d, e], orient3d),
        sign => sign,
    }
}
