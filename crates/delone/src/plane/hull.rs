//! The convex hull of points of the plane.

use super::Position2;
use crate::error::{Error, check_finite};
use crate::hull::planar;

/// The corners of the convex hull as indices of points: counter-clockwise from the lexicographically smallest, none
/// on the line of its neighbours, and of equal points the first. Two for points on a line, one for equal points.
/// Exact. O(n log n), O(n) for points spread over an area.
///
/// # Errors
/// [`Error::NotFinite`] names the first NaN or infinite coordinate.
///
/// ```
/// let points = [[0.0, 0.0], [1.0, 1.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0], [1.0, 0.0]];
/// assert_eq!(delone::convex_hull(&points)?, [0, 2, 3, 4]);
/// # Ok::<(), delone::Error>(())
/// ```
pub fn convex_hull<P: Position2>(points: &[P]) -> Result<Vec<usize>, Error> {
    let points: Vec<[f64; 2]> = points.iter().map(Position2::xy).collect();
    check_finite(points.iter().copied())?;
    Ok(planar::corners(&points))
}
