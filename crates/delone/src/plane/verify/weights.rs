//! Judging triangles of points with weights.
//!
//! Triangles that are regular pair by pair are the lower hull of their lifted corners. Every other site has to be above it: it is
//! located in the canonical triangulation of the corners, which is the same surface, and proved first.

use delone_predicates::{Sign, in_power_circle, in_power_circle_with_ties};

use super::{Objection2, check_coverage, check_disk, check_overlap, check_pairs, oriented, sides};
use crate::error::Error;
use crate::plane::regular::Regular2;
use crate::points::{check_finite, check_weights};
use crate::verdict::Verdict;

/// Judges whether `triangles`, corners as indices of `points` in either orientation, are a regular triangulation of points with
/// weights. Of equal sites any may be the corner.
///
/// A site that may or may not be a corner, because it is on a plane of the others when lifted, counts as a tie: the canonical
/// triangulation has it.
///
/// Cost: O(n log n).
///
/// # Errors
/// The first objection; [`Objection2::Points`] for numbers that are not finite, and unless there is a weight for each point.
///
/// ```
/// use delone::verify::verify_weighted2;
///
/// let points = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0], [2.0, 2.0]];
/// let triangles = [[0, 1, 2], [0, 2, 3]];
/// assert!(verify_weighted2(&points, &[9.0, 9.0, 9.0, 9.0, 0.5], &triangles).is_ok());
/// let objection = verify_weighted2(&points, &[9.0, 9.0, 9.0, 9.0, 3.0], &triangles).unwrap_err();
/// assert_eq!(objection.to_string(), "point 4 is not a corner of any triangle, and the others do not hide it");
/// ```
pub fn verify_weighted2(
    points: &[[f64; 2]],
    weights: &[f64],
    triangles: &[[u64; 3]],
) -> Result<Verdict, Objection2> {
    if points.len() != weights.len() {
        return Err(Error::Length { expected: points.len(), found: weights.len() }.into());
    }
    check_finite(points.iter().copied())?;
    check_weights(weights)?;
    let (triangles, negative) = oriented(points, triangles)?;
    if triangles.is_empty() {
        check_coverage(points, &triangles)?;
        let duplicates = Regular2::from_parts(points, weights)?.duplicates().count();
        return Ok(Verdict { other_ties: 0, negative, duplicates, hull: 0 });
    }
    let sides = sides(&triangles);
    check_overlap(&sides)?;
    let site = |i: usize| (points[i], weights[i]);
    let other_ties = check_pairs(&triangles, &sides, &[], |[a, b, c], d| {
        let [a, b, c, d] = [a, b, c, d].map(site);
        (in_power_circle_with_ties(a, b, c, d), move || in_power_circle(a, b, c, d))
    });
    let other_ties =
        other_ties.map_err(|[triangle, neighbor, point]| Objection2::Power { triangle, neighbor, point })?;
    let hull = check_disk(points, &triangles, &sides)?;
    let mut verdict = Verdict { other_ties, negative, duplicates: 0, hull };
    let mut is_corner = vec![false; points.len()];
    triangles.as_flattened().iter().for_each(|&corner| is_corner[corner] = true);
    let corners: Vec<_> = (0..points.len()).filter(|&i| is_corner[i]).map(site).collect();
    let surface = Regular2::from_sites(&corners)?;
    if surface.check().is_err() || surface.vertex_count() != corners.len() {
        return Err(Objection2::Cover);
    }
    for i in (0..points.len()).filter(|&i| !is_corner[i]) {
        match surface.side(site(i)) {
            (Sign::Positive, _) => {}
            (Sign::Zero, Some(_)) => verdict.duplicates += 1,
            (Sign::Zero, None) => verdict.other_ties += 1,
            (Sign::Negative, _) => return Err(Objection2::Surfaces(i)),
        }
    }
    Ok(verdict)
}
