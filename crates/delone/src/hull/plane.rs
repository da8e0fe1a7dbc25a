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
    /// O(n log n) for n corners, and a little for each corner beside one that is left out. Distances are rounded upwards, so that lengths of a
    /// few last places leave nothing out.
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
        let corners = merge::left(&P::all(points), &self.corners, length, &mut ());
        let range = "less than the width of the hull, which is flat within this";
        let corners = corners.ok_or(Error::Parameter { name: "merge", value: length, range })?;
        Ok(Self { corners })
    }

    /// The dimension of the span of the points: a hull of less than the plane has no facets.
    pub fn dimension(&self) -> Dimension {
        match self.corners.len() {
            0 => Dimension::Empty,
            1 => Dimension::Point,
            2 => Dimension::Line,
            _ => Dimension::Plane,
        }
    }

    /// The corners as indices of points: counter-clockwise from the lexicographically smallest, none on the line of its
    /// neighbors. Two for points on a line, one for equal points.
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
    /// Points, below which none is pruned: sorting them all is as fast.
    const UNPRUNED_POINTS: usize = 64;
    if points.len() < UNPRUNED_POINTS {
        return (0..points.len()).collect();
    }
    // Rounded or not, these are points: what is left of every side of their polygon is inside of their hull.
    let extremes = extremes(points);
    let mut octagon = extremes.to_vec();
    octagon.dedup();
    let next = octagon.iter().cycle().skip(1);
    let sides: Vec<_> = octagon.iter().zip(next).filter(|(a, b)| a != b).collect();
    let inside = |q: [f64; 2]| sides.iter().all(|&(&a, &b)| orient2d(a, b, q).is_positive());
    // Most points are strictly inside of a box whose corners are in the octagon, which comparisons tell.
    let [_, ne, _, nw, _, sw, _, se] = extremes;
    let (low, high) = ([nw[0].max(sw[0]), sw[1].max(se[1])], [ne[0].min(se[0]), ne[1].min(nw[1])]);
    let corners = [low, [high[0], low[1]], high, [low[0], high[1]]];
    let holds = |q: [f64; 2]| sides.iter().all(|&(&a, &b)| !orient2d(a, b, q).is_negative());
    let is_box = low[0] < high[0] && low[1] < high[1] && corners.into_iter().all(holds);
    let boxed = |[x, y]: [f64; 2]| is_box && low[0] < x && x < high[0] && low[1] < y && y < high[1];
    let is_inside = |q| boxed(q) || (!sides.is_empty() && inside(q));
    (0..points.len()).filter(|&i| !is_inside(points[i])).collect()
}

/// The extreme points in eight directions, counter-clockwise from the right, each but for rounding.
fn extremes(points: &[[f64; 2]]) -> [[f64; 2]; 8] {
    // Sums of halves cannot overflow.
    let reaches = |p: [f64; 2]| {
        let [x, y] = p.map(|coordinate| coordinate / 2.0);
        [x, x + y, y, y - x, -x, -x - y, -y, x - y]
    };
    let first = points.first().copied().unwrap_or_default();
    let (mut found, mut furthest) = ([first; 8], reaches(first));
    for &p in points {
        for ((found, furthest), reach) in found.iter_mut().zip(&mut furthest).zip(reaches(p)) {
            if reach > *furthest {
                (*found, *furthest) = (p, reach);
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::{corners, outer};
    use delone_generators::Kind;
    use delone_predicates::orient2d;

    #[test]
    fn what_is_thrown_away_is_inside() {
        let mut thrown_away = 0;
        for (&kind, scale) in
            Kind::ALL.iter().flat_map(|kind| [1.0, 1e-200, 1e150].map(|scale| (kind, scale)))
        {
            let points: Vec<[f64; 2]> = kind.points(700, 3).iter().map(|p| p.map(|x| x * scale)).collect();
            let (hull, left) = (corners(&points), outer(&points));
            assert!(left.is_sorted() && hull.iter().all(|i| left.binary_search(i).is_ok()), "{kind:?}");
            for i in (0..points.len()).filter(|i| left.binary_search(i).is_err()) {
                let mut sides = hull.iter().zip(hull.iter().cycle().skip(1));
                let is_left = |(&a, &b)| orient2d(points[a], points[b], points[i]).is_positive();
                assert!(hull.len() > 2 && sides.all(is_left), "{kind:?} {:?}", points[i]);
                thrown_away += 1;
            }
        }
        assert!(thrown_away > 10_000);
    }
}
