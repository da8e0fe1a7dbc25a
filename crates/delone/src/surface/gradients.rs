//! Gradients at the vertices, from the values of their neighbours, for surfaces that are smooth at the vertices too.
//!
//! Source: Sibson, "A brief description of natural neighbour interpolation", 1981. The gradient fits the differences to the neighbours best,
//! each with its weight over the squared distance. The weights are those of Laplace, which the star of a vertex has without another
//! triangulation: the weighted differences of points are zero in sum, so gradients of linear functions and of spheres come out as they are.
//! On the hull all neighbours weigh the same. Cost: O(1) on average for each vertex.

use super::interpolator::check_values;
use super::natural::{compare, duals, three};
use crate::around::Surround;
use crate::error::Error;
use crate::ids::VertexId;
use crate::parallel;
use crate::sorting;

/// The gradients at all vertices, by the index of the vertex: values per unit of length along each axis. Zero for ids that are no
/// vertices, along directions in which there are no neighbours, and where a number would leave the range of `f64`.
///
/// # Errors
/// [`Error::Values`] if there are not as many values as ids of vertices.
///
/// ```
/// use delone::{Delaunay2, surface::gradients};
///
/// let d = Delaunay2::from_points(&[[0, 0], [4, 0], [0, 4], [1, 1]])?;
/// let slopes = gradients(&d, &[1.0, 9.0, 13.0, 6.0])?; // 1 + 2 x + 3 y
/// assert!(slopes.iter().all(|[x, y]| (x - 2.0).abs() < 1e-12 && (y - 3.0).abs() < 1e-12));
/// # Ok::<(), delone::Error>(())
/// ```
pub fn gradients<T: Surround>(d: &T, values: &[f64]) -> Result<Vec<T::Point>, Error> {
    check_values(d, values.len(), 1)?;
    let part = |range: std::ops::Range<usize>| {
        let mut star = Vec::new();
        range.map(|v| at(d, VertexId::new(v), values, &mut star)).collect::<Vec<_>>()
    };
    Ok(parallel::map(parallel::ranges(values.len()), part).concat())
}

/// Neighbours with their weights.
type Star = Vec<(VertexId, f64)>;

fn at<T: Surround>(d: &T, v: VertexId, values: &[f64], star: &mut Star) -> T::Point {
    let Some(p) = d.position(v) else { return T::Point::default() };
    weigh(d, v, star);
    let p = three(p);
    let mut matrix = [[0.0; 4]; 3];
    for &(w, weight) in star.iter() {
        let q = three(d.position(w).unwrap_or_default());
        let away = [0, 1, 2].map(|k| q[k] - p[k]);
        let square: f64 = away.iter().map(|x| x * x).sum();
        // Halves of the differences, which cannot overflow.
        let rise = (values[w.index()] / 2.0 - values[v.index()] / 2.0) * 2.0;
        for i in 0..3 {
            let part = weight * away[i] / square;
            (0..3).for_each(|j| matrix[i][j] += part * away[j]);
            matrix[i][3] += part * rise;
        }
    }
    let slope = solve(matrix);
    let mut gradient = T::Point::default();
    gradient.as_mut().copy_from_slice(&slope[..<T::Point as crate::triangulation::Coordinates>::COUNT]);
    gradient
}

/// The neighbours of a vertex, in the order of their points, with the weights of Laplace; with equal ones on the hull.
fn weigh<T: Surround>(d: &T, v: VertexId, star: &mut Star) {
    star.clear();
    let mut is_on_hull = false;
    for s in d.simplices_at(v) {
        let corners = d.corners(s);
        let corners = corners.as_ref();
        let points = [0, 1, 2, 3]
            .map(|k| corners.get(k).map_or([0.0; 3], |&w| three(d.position(w).unwrap_or_default())));
        // In space roundings depend on the order of corners, which in the plane only turns.
        let mut order = [0, 1, 2, 3];
        if corners.len() == 4 {
            sorting::by(&mut order, |&i, &j| compare(points[i], points[j]));
        }
        let sums = duals(&order.map(|k| points[k])[..corners.len()]);
        let rank = |corner: usize| order.iter().position(|&k| k == corner).unwrap_or_default();
        let own = corners.iter().position(|&w| w == v).unwrap_or_default();
        for (k, &w) in corners.iter().enumerate() {
            if k != own {
                star.push((w, sums[rank(own)][rank(k)]));
                is_on_hull |= d.across(s, k).is_none();
            }
        }
    }
    // Sums have the same bits whatever the triangulation was made of.
    let place = |v: VertexId| three(d.position(v).unwrap_or_default());
    sorting::by(star, |a, b| compare(place(a.0), place(b.0)).then(a.1.total_cmp(&b.1)));
    star.dedup_by(|next, kept| {
        let is_same = next.0 == kept.0;
        kept.1 += if is_same { next.1 } else { 0.0 };
        is_same
    });
    let are_weights = star.iter().all(|weight| weight.1 > -f64::INFINITY && weight.1.is_finite());
    for (_, weight) in star.iter_mut() {
        *weight = if is_on_hull || !are_weights { 1.0 } else { weight.max(0.0) };
    }
}

/// Solves three linear equations whose matrix is symmetric and has no negative eigenvalue; along directions that they say nothing of,
/// the solution is zero.
fn solve(mut m: [[f64; 4]; 3]) -> [f64; 3] {
    let largest = (0..3).map(|k| m[k][k]).fold(0.0, f64::max);
    let mut order = [0, 1, 2];
    let mut rank = 0;
    for step in 0..3 {
        let pivot = (step..3)
            .max_by(|&i, &j| m[order[i]][order[i]].total_cmp(&m[order[j]][order[j]]))
            .unwrap_or(step);
        order.swap(step, pivot);
        let p = order[step];
        // What is left of it is rounded off.
        if m[p][p] <= largest * 1e-13 || !m[p][p].is_finite() {
            break;
        }
        rank += 1;
        for &i in &order[step + 1..] {
            let factor = m[i][p] / m[p][p];
            (0..4).for_each(|j| m[i][j] -= factor * m[p][j]);
        }
    }
    let mut solution = [0.0; 3];
    for step in (0..rank).rev() {
        let p = order[step];
        let known: f64 = order[step + 1..rank].iter().map(|&j| m[p][j] * solution[j]).sum();
        solution[p] = (m[p][3] - known) / m[p][p];
    }
    if solution.iter().all(|x| x.is_finite()) { solution } else { [0.0; 3] }
}
