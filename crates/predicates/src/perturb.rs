//! The canonical rule, on one page.
//!
//! The in-circle test is an orientation test of the points lifted to the paraboloid z = x^2 + y^2. Raise the
//! lexicographically largest point by an infinitesimal e1, the second largest by a much smaller e2, and so
//! on (Devillers & Teillaud, "Perturbations for Delaunay and weighted Delaunay 3D triangulations", CGTA
//! 2011). When the determinant is zero its sign becomes that of the first non-zero coefficient, taken in the
//! order e1, e2, ...; the coefficient of a point is, up to sign, the orientation of the other three.
//!
//! Four distinct cocircular points have no collinear triple, so the first coefficient always decides.

use crate::{Point2, Sign, lexicographic, orient2d};

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
