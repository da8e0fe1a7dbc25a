//! Orientation of four points in space: filter, exact.

use crate::filter::orient3d_filter;
use crate::{Point3, Sign, exact, orient2d};

/// On which side of the plane through `a`, `b`, `c` the point `d` is: positive where `a`, `b`, `c` are seen
/// counter-clockwise. The sign of the determinant of b - a, c - a, d - a; zero if the four are coplanar.
///
/// Exact for every finite input. O(1).
///
/// ```
/// use delone_predicates::{Sign, orient3d};
/// let (a, b, c) = ([0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
/// assert_eq!(orient3d(a, b, c, [0.0, 0.0, 1e-300]), Sign::Positive);
/// assert_eq!(orient3d(a, b, c, [5.0, 7.0, 0.0]), Sign::Zero);
/// ```
#[inline]
pub fn orient3d(a: Point3, b: Point3, c: Point3, d: Point3) -> Sign {
    orient3d_filter(a, b, c, d).unwrap_or_else(|| exact::orient3d(a, b, c, d))
}

/// The orientation of points that are moved by infinitesimal steps: it is zero only where nothing moves off a line.
///
/// `d` is moved along x, much less along y, and much less again along z. What is given for `c` is its first point, moved by a part of
/// the way to the second, a much smaller part of that to the third, and so on; all that is much more than what `d` is moved.
///
/// Exact for every finite input. O(1) for each point.
///
/// ```
/// use delone_predicates::{Sign, orient3d_moved};
/// let (a, b, c) = ([0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]);
/// assert_eq!(orient3d_moved(a, b, &[c], [-1e-300, 0.0, 0.0]), Sign::Negative);
/// assert_eq!(orient3d_moved(a, b, &[c], [0.0, 5.0, 7.0]), Sign::Positive); // towards larger x
/// assert_eq!(orient3d_moved(a, b, &[c, [1.0, 0.0, 0.0]], [0.0, 5.0, 7.0]), Sign::Negative); // c is moved farther
/// ```
pub fn orient3d_moved(a: Point3, b: Point3, c: &[Point3], d: Point3) -> Sign {
    let sides = c.iter().map(|&c| orient3d(a, b, c, d));
    // The determinant grows with d as the normal of the plane points.
    let normals = (0..3).flat_map(|axis| {
        c.iter().map(move |&c| {
            let [a, b, c] = [a, b, c].map(|p| [p[(axis + 1) % 3], p[(axis + 2) % 3]]);
            orient2d(a, b, c)
        })
    });
    sides.chain(normals).find(|sign| !sign.is_zero()).unwrap_or(Sign::Zero)
}

/// [`orient3d`] out of line, for points where a static filter gave no answer.
#[cold]
#[inline(never)]
pub(crate) fn orient3d_near(a: Point3, b: Point3, c: Point3, d: Point3) -> Sign {
    orient3d(a, b, c, d)
}

/// Whether three points are on one line: seen along each axis they are.
///
/// Exact for every finite input. O(1).
///
/// ```
/// use delone_predicates::are_collinear3;
/// assert!(are_collinear3([0.0, 0.0, 0.0], [1.0, 2.0, 4.0], [-2.0, -4.0, -8.0]));
/// assert!(!are_collinear3([0.0, 0.0, 0.0], [1.0, 2.0, 4.0], [-2.0, -4.0, -8.000000000000002]));
/// ```
pub fn are_collinear3(a: Point3, b: Point3, c: Point3) -> bool {
    (0..3).all(|axis| {
        let [a, b, c] = [a, b, c].map(|p| [p[(axis + 1) % 3], p[(axis + 2) % 3]]);
        orient2d(a, b, c).is_zero()
    })
}
