//! How much of the cell of a new point is taken from each of its neighbors: the weights of natural neighbor interpolation.
//!
//! Sources: Sibson, "A brief description of natural neighbor interpolation", 1981: the volume that the new cell takes from the cell of
//! each neighbor. Belikov et al., "The non-Sibsonian interpolation", 1997: the size of the facet between both cells over the
//! distance, which are the weights of the discrete Laplace operator.
//!
//! Both come from one number for each edge of each simplex: what the simplex has of the Voronoi facet that is dual to the edge, over
//! the length of the edge. It may be negative, as the circumcenter may be outside; sums over all simplices at an edge are not. The
//! simplices of the cavity have what cells were, those at the new point what they will be, and the difference is what is taken. No
//! circumcenter is computed in the plane, nothing depends on where the origin is, and what is computed is a rational function of
//! differences.
//!
//! Who is a neighbor is exact. Weights are rounded: beside the sum goes a bound of its error, and where that is too large all is done
//! again in twice the precision; where even that cannot tell, weights are linear. They are not negative and their sum is one, whatever is rounded.
//!
//! Cost: O(k log k) for k neighbors; in the plane some two divisions for each.

mod plane;
mod space;

use std::cmp::Ordering;

use super::real::{Real, minus};
use crate::around::Around;
use crate::ids::VertexId;
use crate::powers::power_below;
use crate::triangulation::{Coordinates, Triangulation};

/// The measure of a neighbor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Measure {
    /// The size of facets over the distance.
    Laplace,
    /// The volume of what is taken.
    Sibson,
}

/// Errors up to this part of the sum are taken for none: 2^-36.
const GOOD: f64 = 1.455_191_522_836_685_2e-11;

/// The neighbors of a point with their weights, in buffers that are kept.
#[derive(Clone, Debug, Default)]
pub(super) struct Cell {
    plane: plane::Cell,
    space: space::Cell,
}

impl Cell {
    /// The weights of the neighbors of a point, given what surrounds it; whether there are any, which simplices that are flat to twice
    /// the precision and coordinates beyond the range of numbers prevent. Everything is put in an order that depends on the points alone,
    /// so that sums have the same bits whatever the triangulation was made of.
    pub(super) fn weigh<T: Triangulation>(
        &mut self,
        d: &T,
        around: &Around<T>,
        q: T::Point,
        measure: Measure,
        weights: &mut Vec<(VertexId, f64)>,
    ) -> bool {
        if let [x, y] = *q.as_ref() {
            return self.plane.weigh(&around.ring, [x, y], measure, weights);
        }
        self.space.weigh(d, around, three(q), measure, weights)
    }
}

/// The lexicographic order of points.
pub(super) fn compare(a: [f64; 3], b: [f64; 3]) -> Ordering {
    match (0..3).find(|&k| a[k] != b[k]) {
        Some(k) if a[k] < b[k] => Ordering::Less,
        Some(_) => Ordering::Greater,
        None => Ordering::Equal,
    }
}

/// Coordinates as three of them.
pub(super) fn three<P: Coordinates>(p: P) -> [f64; 3] {
    let mut padded = [0.0; 3];
    padded[..P::COUNT].copy_from_slice(p.as_ref());
    padded
}

/// About the distance of two coordinates, which must neither overflow nor vanish.
#[inline]
pub(super) fn apart(a: f64, b: f64) -> f64 {
    if a.abs().max(b.abs()) > 1.0 { (a / 4.0 - b / 4.0).abs() } else { (a - b).abs() }
}

/// The factors of a distance, or of a quarter of it, before and after differences are taken, so that no power of it leaves the
/// range of numbers.
pub(super) fn scale(size: f64) -> [f64; 2] {
    let before = if size > 2f64.powi(1000) { 2f64.powi(-100) } else { 1.0 };
    let size = size * before;
    let after = if size > 2f64.powi(60) {
        1.0 / power_below(size)
    } else if size < 2f64.powi(-60) && size > 0.0 {
        (1.0 / power_below(size)).min(2f64.powi(1000))
    } else {
        1.0
    };
    [before, after]
}

/// Makes weights positive, with the sum one; whether they can be.
pub(super) fn normalize(weights: &mut [(VertexId, f64)]) -> bool {
    weights.iter_mut().for_each(|weight| weight.1 = weight.1.max(0.0));
    let total: f64 = weights.iter().map(|weight| weight.1).sum();
    if !(total > 0.0 && total.is_finite()) {
        return false;
    }
    weights.iter_mut().for_each(|weight| weight.1 /= total);
    true
}

/// The dual of the edge between each two corners of a simplex over its length, up to a factor that is the same for all simplices of the
/// dimension. NaN or infinite for what is flat to rounding.
pub(super) fn duals<R: Real>(points: &[[R; 3]]) -> [[R; 4]; 4] {
    let mut sums = [[R::default(); 4]; 4];
    let mut set = |i: usize, j: usize, dual: R| (sums[i][j], sums[j][i]) = (dual, dual);
    match *points {
        [a, b, c] => {
            let at = [a, b, c];
            for k in 0..3 {
                let (i, j) = ((k + 1) % 3, (k + 2) % 3);
                let [u, v] = [i, j].map(|i| minus(at[i], at[k]));
                set(i, j, (u[0] * v[0] + u[1] * v[1]) / (u[0] * v[1] - u[1] * v[0]));
            }
        }
        [a, b, c, d] => {
            let (duals, _) = space::duals([a, b, c, d]);
            space::EDGES.iter().zip(duals).for_each(|(&[i, j], dual)| set(i, j, dual));
        }
        _ => {}
    }
    sums
}
