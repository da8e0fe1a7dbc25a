//! The convex hull in the plane.
//!
//! Source: Andrew, "Another efficient algorithm for convex hulls in two dimensions", IPL 1979; points inside of the
//! octagon of extreme points are thrown away first (Akl & Toussaint, "A fast convex hull algorithm", IPL 1978).
//!
//! Cost: O(n) for points spread over an area, O(n log n) at worst.

use delone_predicates::{lexicographic, orient2d};

use super::merge;
use crate::error::Error;
use crate::mesh::Dimension;
use crate::points::{Position2, check_finite};

/// The convex hull of points of the plane.
///
/// ```
/// use delone::Hull2;
///
/// let hull = Hull2::from_points(&[[0, 0], [1, 1], [2, 0], [2, 2], [0, 2], [1, 0]])?;
/// assert_eq!(hull.corners(), [0, 2, 3, 4]);
/// assert_eq!(hull.facets().next(), Some([0, 2]));
/// # Ok::<(), delone::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Hull2 {
    corners: Vec<usize>,
}

impl Hull2 {
    /// Finds the hull. Of equal points the first stands for all. Exact. O(n log n), O(n) for points spread over an area.
    ///
    /// # Errors
    /// [`Error::NotFinite`] names the first NaN or infinite coordinate.
    pub fn from_points<P: Position2>(points: &[P]) -> Result<Self, Error> {
        let points = P::all(points);
        check_finite(points.iter().copied())?;
        Ok(Self { corners: corners(&points) })
    }

    /// The hull without corners that only rounding has made: those within a length of the hull of the others, the nearest first, are left
    /// out, if all that were left out stay within the length of what is left. `points` are those of the hull, and `length` is in
    /// coordinate units: [`crate::MERGE_AUTO`] times the largest coordinate is a length of rounding.
    ///
    /// O(n log n) for n corners, times a few rounds.
    ///
    /// # Errors
    /// [`Error::Parameter`] for a length that is negative, not finite, or not below the width of the hull, which would be flat then.
    ///
    /// ```
    /// use delone::Hull2;
    ///
    /// let points = [[0.0, 0.0], [1.0, -1e-16], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]];
    /// let hull = Hull2::from_points(&points)?;
    /// assert_eq!(hull.corners().len(), 5);
    /// assert_eq!(hull.merged(&points, 1e-12)?.corners(), [0, 2, 3, 4]);
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn merged<P: Position2>(&self, points: &[P], length: f64) -> Result<Self, Error> {
        crate::joining::check(length)?;
        if self.dimension() < Dimension::Plane || length == 0.0 {
            return Ok(self.clone());
        }
        let corners = merge::left(&P::all(points), &self.corners, length);
        let range = "less than the width of the hull, which is flat within this";
        let corners = corners.ok_or(Error::Parameter { name: "merge", value: length, range })?;
        Ok(Self { corners })
    }

    /// What the points span: a hull of less than the plane has no facets.
    pub fn dimension(&self) -> Dimension {
        match self.corners.len() {
            0 => Dimension::Empty,
            1 => Dimension::Point,
            2 => Dimension::Line,
            _ => Dimension::Plane,
        }
    }

    /// The corners as indices of points: counter-clockwise from the lexicographically smallest, none on the line of its
    /// neighbours. Two for points on a line, one for equal points.
    pub fn corners(&self) -> &[usize] {
        &self.corners
    }

    /// The sides, counter-clockwise. None for less than the plane.
    pub fn facets(&self) -> impl Iterator<Item = [usize; 2]> + '_ {
        let is_spanned = self.dimension() == Dimension::Plane;
        let next = self.corners.iter().cycle().skip(1);
        self.corners.iter().zip(next).filter(move |_| is_spanned).map(|(&v, &w)| [v, w])
    }
}

/// The corners of the hull of finite points.
pub(crate) fn corners(points: &[[f64; 2]]) -> Vec<usize> {
    let mut order = outer(points);
    order.sort_unstable_by(|&i, &j| lexicographic(points[i], points[j]).then(i.cmp(&j)));
    order.dedup_by(|later, first| points[*later] == points[*first]);
    if order.len() < 3 {
        return order;
    }
    let mut hull: Vec<usize> = Vec::new();
    // Below from left to right, then above from right to left.
    for upper in [false, true] {
        let start = hull.len();
        let mut push = |i: usize| {
            while let [.., a, b] = hull[start..] {
                if orient2d(points[a], points[b], points[i]).is_positive() {
                    break;
                }
                hull.pop();
            }
            hull.push(i);
        };
        for k in 0..order.len() {
            push(order[if upper { order.len() - 1 - k } else { k }]);
        }
        // It begins the other half.
        hull.pop();
    }
    hull
}

/// The points that are not strictly inside of the octagon of the extreme points in eight directions.
fn outer(points: &[[f64; 2]]) -> Vec<usize> {
    /// Below this number sorting is as fast.
    const FEW: usize = 64;
    if points.len() < FEW {
        return (0..points.len()).collect();
    }
    let directions = [[1., 0.], [1., 1.], [0., 1.], [-1., 1.], [-1., 0.], [-1., -1.], [0., -1.], [1., -1.]];
    let reach = |p: [f64; 2], [x, y]: [f64; 2]| p[0] / 2.0 * x + p[1] / 2.0 * y;
    let extreme = |direction: [f64; 2]| {
        let further = |p: &[f64; 2], q: &[f64; 2]| reach(*p, direction).total_cmp(&reach(*q, direction));
        points.iter().copied().max_by(further).unwrap_or_default()
    };
    // Rounded or not, these are points: what is left of every side of their polygon is inside of their hull.
    let mut octagon = directions.map(extreme).to_vec();
    octagon.dedup();
    let next = octagon.iter().cycle().skip(1);
    let sides: Vec<_> = octagon.iter().zip(next).filter(|(a, b)| a != b).collect();
    let inside = |q: [f64; 2]| sides.iter().all(|&(&a, &b)| orient2d(a, b, q).is_positive());
    (0..points.len()).filter(|&i| sides.is_empty() || !inside(points[i])).collect()
}
