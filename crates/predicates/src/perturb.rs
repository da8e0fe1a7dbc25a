//! The canonical rule, on one page.
//!
//! The in-circle test is an orientation test of the points lifted to the paraboloid z = x^2 + y^2. Raise the
//! lexicographically largest point by an infinitesimal e1, the second largest by a much smaller e2, and so
//! on (Devillers & Teillaud, "Perturbations for Delaunay and weighted Delaunay 3D triangulations", CGTA
//! 2011). When the determinant is zero its sign becomes that of the first non-zero coefficient, taken in the
//! order e1, e2, ...; the coefficient of a point is, up to sign, the orientation of the other three.
//!
//! Four distinct cocircular points have no collinear triple, so the first coefficient always decides. In space four of
//! five cospherical points may be coplanar, and with weights three of four in the plane collinear: then the next one is asked.
//!
//! With weights a site above the lower hull of the others is no vertex. The perturbation hides no site: let lifted points be
//! coplanar, taken from the smallest on. Each lies outside of the hull of those before it, so each becomes a vertex. An order by
//! index would hide some.

use crate::{Point2, Point3, Sign, lexicographic, orient2d};

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

/// The rule for points with weights, whose determinant is zero though one of them may be on the line of two others.
pub(crate) fn in_power_circle_perturbed([a, b, c, d]: [Point2; 4]) -> Sign {
    let mut descending = [(a, 0), (b, 1), (c, 2), (d, 3)];
    descending.sort_unstable_by(|p, q| lexicographic(q.0, p.0));
    let coefficients = descending.map(|(_, k)| match k {
        0 => orient2d(d, b, c),
        1 => orient2d(a, d, c),
        2 => orient2d(a, b, d),
        _ => -orient2d(a, b, c),
    });
    coefficients.into_iter().find(|sign| !sign.is_zero()).unwrap_or(Sign::Zero)
}

/// The sign of the perturbed in-sphere determinant of five points whose determinant is zero, by an orientation test that is
/// exact for them.
#[inline]
pub(crate) fn in_sphere_perturbed(
    points: [Point3; 5],
    orient3d: impl Fn(Point3, Point3, Point3, Point3) -> Sign,
) -> Sign {
    let [a, b, c, d, e] = points;
    first_coefficient(points.each_ref(), |highest| match highest {
        4 => -orient3d(a, b, c, d), // e is raised: out of the sphere of the others
        0 => orient3d(e, b, c, d),  // a is raised: e is inside exactly if it can take a's place
        1 => orient3d(a, e, c, d),
        2 => orient3d(a, b, e, d),
        _ => orient3d(a, b, c, e),
    })
}

/// The first coefficient that is not zero, of those of five points by number, in the descending order of the points.
#[inline]
pub(crate) fn first_coefficient(points: [&Point3; 5], coefficient: impl Fn(usize) -> Sign) -> Sign {
    #[expect(clippy::needless_bitwise_bool, reason = "on grids, processors cannot predict these branches")]
    let before = |p: &Point3, q: &Point3| {
        (p[0] < q[0]) | (p[0] == q[0]) & ((p[1] < q[1]) | (p[1] == q[1]) & (p[2] < q[2]))
    };
    let mut raised = [false; 5];
    for _ in 0..5 {
        let higher =
            |i: usize, j: usize| if !raised[j] & (raised[i] | before(points[i], points[j])) { j } else { i };
        let highest = (1..5).fold(0, higher);
        raised[highest] = true;
        let coefficient = coefficient(highest);
        if !coefficient.is_zero() {
            return coefficient;
        }
    }
    Sign::Zero
}
