//! Judging tetrahedra of points with weights: as in the plane (`plane/verify/weights.rs`).

use delone_predicates::{Sign, in_power_sphere, in_power_sphere_with_ties};

use super::{Objection3, check_coverage, check_once, check_pairs, oriented, sides};
use crate::error::Error;
use crate::points::{check_in_space, check_weights};
use crate::space::regular::Regular3;
use crate::verdict::Verdict;

/// Judges whether `tetrahedra`, corners as indices of `points` in either order, are a regular triangulation of points with
/// weights. Of equal sites any may be the corner.
///
/// A site that may or may not be a corner, because it is on a hyperplane of the others when lifted, counts as a tie: the canonical
/// triangulation has it.
///
/// Cost: O(n log n) where the triangulation is of size O(n).
///
/// # Errors
/// The first objection; [`Objection3::Points`] for numbers that are not finite, and unless there is a weight for each point.
///
/// ```
/// use delone::verify::verify_weighted3;
///
/// let points = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0], [0.0, 0.0, 4.0], [1.0, 1.0, 1.0]];
/// assert!(verify_weighted3(&points, &[12.0, 12.0, 12.0, 12.0, 0.5], &[[0, 1, 2, 3]]).is_ok());
/// let objection = verify_weighted3(&points, &[12.0, 12.0, 12.0, 12.0, 11.0], &[[0, 1, 2, 3]]).unwrap_err();
/// assert_eq!(objection.to_string(), "point 4 is not a corner of any tetrahedron, and the others do not hide it");
/// ```
pub fn verify_weighted3(
    points: &[[f64; 3]],
    weights: &[f64],
    tetrahedra: &[[u64; 4]],
) -> Result<Verdict, Objection3> {
    if points.len() != weights.len() {
        return Err(Error::Length { expected: points.len(), found: weights.len() }.into());
    }
    check_in_space(points)?;
    check_weights(weights)?;
    let (tetrahedra, negative) = oriented(points, tetrahedra)?;
    if tetrahedra.is_empty() {
        check_coverage(points, &tetrahedra)?;
        let duplicates = Regular3::from_parts(points, weights)?.duplicates().count();
        return Ok(Verdict { other_ties: 0, negative, duplicates, hull: 0 });
    }
    let sides = sides(&tetrahedra)?;
    let site = |i: usize| (points[i], weights[i]);
    let other_ties = check_pairs(&tetrahedra, &sides, |[a, b, c, d], e| {
        let [a, b, c, d, e] = [a, b, c, d, e].map(site);
        (in_power_sphere_with_ties(a, b, c, d, e), move || in_power_sphere(a, b, c, d, e))
    });
    let power =
        |[tetrahedron, neighbor, point]: [usize; 3]| Objection3::Power { tetrahedron, neighbor, point };
    let other_ties = other_ties.map_err(power)?;
    let hull = check_once(points, &tetrahedra, &sides)?;
    let mut verdict = Verdict { other_ties, negative, duplicates: 0, hull };
    let mut is_corner = vec![false; points.len()];
    tetrahedra.as_flattened().iter().for_each(|&corner| is_corner[corner] = true);
    let corners: Vec<_> = (0..points.len()).filter(|&i| is_corner[i]).map(site).collect();
    let surface = Regular3::from_sites(&corners)?;
    if surface.check().is_err() || surface.vertex_count() != corners.len() {
        return Err(Objection3::Cover(0));
    }
    for i in (0..points.len()).filter(|&i| !is_corner[i]) {
        match surface.side(site(i)) {
            (Sign::Positive, _) => {}
            (Sign::Zero, Some(_)) => verdict.duplicates += 1,
            (Sign::Zero, None) => verdict.other_ties += 1,
            (Sign::Negative, _) => return Err(Objection3::Surfaces(i)),
        }
    }
    Ok(verdict)
}
