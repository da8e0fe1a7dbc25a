//! Power tests: the in-circle and in-sphere tests of points with weights. Filter, exact, perturb.
//!
//! A weight is the square of a radius, and may be negative. A site (p, w) is lifted to the height |p|^2 - w, so that the
//! difference of heights between a point and a plane through lifted sites is a power distance, and the sites whose lifted
//! points are corners of the lower hull are the vertices of the regular triangulation (Aurenhammer, "Power diagrams", SIAM
//! J. Comput. 1987). Ties are broken as without weights: by raising sites in the lexicographic order of their points, which
//! never hides one (`perturb`).

use std::cmp::Ordering;

use crate::exact::power as exact;
use crate::filter::{in_power_circle_filter, in_power_sphere_filter};
use crate::perturb::{in_power_circle_perturbed, in_sphere_perturbed};
use crate::{Point2, Sign, Site, orient3d, strictly_between};

/// Whether the lifted `d` is below the plane through the lifted `a`, `b`, `c`: positive when below (in conflict), negative
/// when above, for `a`, `b`, `c` counter-clockwise (the sign flips when they are clockwise).
///
/// With equal weights it is [`crate::in_circle`]. Ties are broken by the same perturbation; zero is returned only when all
/// four points are collinear. The points must be distinct, unless `d` is at one of the others with another weight.
///
/// Exact for every finite input. O(1).
///
/// ```
/// use delone_predicates::{Sign, in_power_circle};
/// let (a, b, c) = (([0.0, 0.0], 0.0), ([4.0, 0.0], 0.0), ([0.0, 4.0], 0.0));
/// assert_eq!(in_power_circle(a, b, c, ([5.0, 5.0], 0.0)), Sign::Negative); // out of the circle
/// assert_eq!(in_power_circle(a, b, c, ([5.0, 5.0], 11.0)), Sign::Positive); // its disk reaches far enough into it
/// assert_eq!(in_power_circle(a, b, c, ([1.0, 1.0], -7.0)), Sign::Negative); // in the circle, and hidden by the others
/// ```
#[inline]
pub fn in_power_circle(a: Site<2>, b: Site<2>, c: Site<2>, d: Site<2>) -> Sign {
    in_power_circle_filter(a, b, c, d).unwrap_or_else(|| in_power_circle_exact(a, b, c, d))
}

/// [`in_power_circle`] without the perturbation: zero for ties.
pub fn in_power_circle_with_ties(a: Site<2>, b: Site<2>, c: Site<2>, d: Site<2>) -> Sign {
    in_power_circle_filter(a, b, c, d).unwrap_or_else(|| exact::in_power_circle([a, b, c, d]))
}

#[cold]
#[inline(never)]
fn in_power_circle_exact(a: Site<2>, b: Site<2>, c: Site<2>, d: Site<2>) -> Sign {
    match exact::in_power_circle([a, b, c, d]) {
        Sign::Zero => in_power_circle_perturbed([a.0, b.0, c.0, d.0]),
        sign => sign,
    }
}

/// The power test one dimension lower, for three sites on a line of the plane: whether the lifted `q` is below the line through the
/// lifted `a` and `b`, at any place of it. Ties are broken by the same perturbation.
///
/// The points must be collinear and `a` and `b` distinct; zero is returned only where `q` is at one of them with its weight.
/// Exact for every finite input. O(1).
pub fn in_power_interval(a: Site<2>, b: Site<2>, q: Site<2>) -> Sign {
    match exact::in_power_interval(a, b, q) {
        Sign::Zero => raised_interval(a.0, b.0, q.0),
        sign => sign,
    }
}

/// Three collinear points whose lifted sites are collinear too: the largest is raised. If `q` is the largest, it lies above the line.
/// Otherwise the raised end puts `q` below the line between the ends, and above it beyond the other end.
fn raised_interval(a: Point2, b: Point2, q: Point2) -> Sign {
    if q == a || q == b {
        Sign::Zero
    } else if strictly_between(a, b, q) {
        Sign::Positive
    } else {
        Sign::Negative
    }
}

/// Whether the lifted `e` is below the hyperplane through the lifted `a`, `b`, `c`, `d`: positive when below (in conflict), for
/// four points with positive [`crate::orient3d`] (the sign flips when it is negative).
///
/// With equal weights it is [`crate::in_sphere`]; ties and equal points as in [`in_power_circle`].
///
/// Exact for every finite input. O(1).
#[inline]
pub fn in_power_sphere(a: Site<3>, b: Site<3>, c: Site<3>, d: Site<3>, e: Site<3>) -> Sign {
    in_power_sphere_filter([a, b, c, d, e]).unwrap_or_else(|| in_power_sphere_exact([a, b, c, d, e]))
}

/// [`in_power_sphere`] without the perturbation: zero for ties.
pub fn in_power_sphere_with_ties(a: Site<3>, b: Site<3>, c: Site<3>, d: Site<3>, e: Site<3>) -> Sign {
    in_power_sphere_filter([a, b, c, d, e]).unwrap_or_else(|| exact::in_power_sphere([a, b, c, d, e]))
}

#[cold]
#[inline(never)]
fn in_power_sphere_exact(sites: [Site<3>; 5]) -> Sign {
    match exact::in_power_sphere(sites) {
        Sign::Zero => in_sphere_perturbed(sites.map(|site| site.0), orient3d),
        sign => sign,
    }
}

/// The order of two sites by their power distance from a point, |q - p|^2 - w.
///
/// Exact for every finite input. O(1).
///
/// ```
/// use delone_predicates::compare_powers;
/// let q = [0.0, 0.0];
/// assert!(compare_powers(q, ([3.0, 0.0], 6.0), ([2.0, 0.0], 0.0)).is_lt());
/// assert!(compare_powers(q, ([3.0, 0.0], 5.0), ([0.0, 2.0], 0.0)).is_eq());
/// ```
pub fn compare_powers<const D: usize>(q: [f64; D], a: Site<D>, b: Site<D>) -> Ordering {
    exact::compare_powers(q, a, b)
}
