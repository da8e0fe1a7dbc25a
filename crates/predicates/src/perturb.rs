//! The canonical rule, on one page.
//!
//! The in-circle test is an orientation test of the points lifted to the paraboloid z = x^2 + y^2. Raise the
//! lexicographically largest point by an infinitesimal e1, the second largest by a much smaller e2, and so
//! on (Devillers & Teillaud, "Perturbations for Delaunay and weighted Delaunay 3D triangulations", CGTA
//! 2011). When the determinant is zero its sign becomes that of the first non-zero coefficient, taken in the
//! order e1, e2, ...; the coefficient of a point is, up to sign, the orientation of the other three.
//!
//! Four distinct cocircular points have no collinear triple, so the first coefficient always decides. In space four of
//! five cospherical points may be coplanar: then the next one is asked.

use crate::{Point2, Point3, Sign, lexicographic, lexicographic3, orient2d, orient3d};

/// The sign of the perturbed in-circle determinant of four points whose determinant is zero.
pub(crate) fn in_circle_perturbed(a: Point2, b: Point2, c: Point2, d: Point2) -> Sign {
    let larger = |p: Point2, q: Point2| if lexicographic(p, q).is_lt() { q } else { p };
    let highest = larger(larger(a, b), larger(c, d));
    if highest == d {
        -orient2d(a, b, c) // d is raised: out of the circle of a, b, c
    } else if highest == a {
        orient2d(d, b, c) // a is raised: d is inside exactly if it can take a's place
    } else if highest == b {
        orient2d(a, d, c)
    } else {
        orient2d(a, b, d)
    }
}

/// The sign of the perturbed in-sphere determinant of five points whose determinant is zero.
pub(crate) fn in_sphere_perturbed(a: Point3, b: Point3, c: Point3, d: Point3, e: Point3) -> Sign {
    let points = [a, b, c, d, e];
    let mut order = [0, 1, 2, 3, 4];
    order.sort_unstable_by(|&i, &j| lexicographic3(points[j], points[i]));
    let coefficient = |i: usize| match i {
        4 => -orient3d(a, b, c, d), // e is raised: out of the sphere of the others
        0 => orient3d(e, b, c, d),  // a is raised: e is inside exactly if it can take a's place
        1 => orient3d(a, e, c, d),
        2 => orient3d(a, b, e, d),
        _ => orient3d(a, b, c, e),
    };
    order.into_iter().map(coefficient).find(|sign| !sign.is_zero()).unwrap_or(Sign::Zero)
}
