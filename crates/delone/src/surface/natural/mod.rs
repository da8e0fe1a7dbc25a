//! How much of the cell of a new point is taken from each of its neighbours: the weights of natural neighbour interpolation.
//!
//! Sources: Sibson, "A brief description of natural neighbour interpolation", 1981: the volume that the new cell takes from the cell of
//! each neighbour. Belikov et al., "The non-Sibsonian interpolation", 1997: the size of the facet between both cells over the
//! distance, which are the weights of the discrete Laplace operator.
//!
//! Both come from one number for each edge of each simplex: what the simplex has of the Voronoi facet that is dual to the edge, over
//! the length of the edge. It may be negative, as the circumcentre may be outside; sums over all simplices at an edge are not. The
//! simplices of the cavity have what cells were, those at the new point what they will be, and the difference is what is taken. No
//! circumcentre is computed in the plane, nothing depends on where the origin is, and what is computed is a rational function of
//! differences.
//!
//! Who is a neighbour is exact. Weights are rounded: beside the sum goes a bound of its error, and where that is too large all is done
//! again in twice the precision; where even that cannot tell, weights are linear. They are not negative and their sum is one, whatever is rounded.
//!
//! Cost: O(k log k) for k neighbours; in the plane some two divisions for each.

mod plane;
mod space;

use std::cmp::Ordering;

use super::real::{Double, Real};
use crate::around::Around;
use crate::ids::VertexId;
use crate::triangulation::{Coordinates, Triangulation};

/// What is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Measure {
    /// The size of facets over the distance.
    Laplace,
    /// The volume of what is taken.
    Sibson,
}

/// Errors up to this part of the sum are taken for none: 2^-36.
const GOOD: f64 = 1.455_191_522_836_685_2e-11;

/// The neighbours of a point by a small number each, in lexicographic order, and simplices between them.
#[derive(Clone, Debug, Default)]
pub(super) struct Cell {
    pub(super) ids: Vec<VertexId>,
    /// Their coordinates, zero beyond the dimension.
    points: Vec<[f64; 3]>,
    /// Both, to sort and to look for.
    by_id: Vec<([f64; 3], VertexId)>,
    cavity: Vec<[u32; 4]>,
    border: Vec<[u32; 3]>,
    plain: Local<f64>,
    double: Local<Double>,
}

/// Coordinates relative to the point, and what was summed for each neighbour.
#[derive(Clone, Debug, Default)]
struct Local<R> {
    at: Vec<[R; 3]>,
    shares: Vec<R>,
    /// A bound of the errors of all sums, in units of the last place.
    doubt: f64,
}

impl<R: Real> Local<R> {
    /// Adds a sum of parts times a factor; its error is so many units of the last place of the parts.
    #[inline]
    fn add<const N: usize>(&mut self, k: u32, parts: [R; N], factor: R, doubt: f64) {
        let (mut sum, mut size) = (R::default(), 0.0);
        for part in parts {
            sum += part;
            size += part.value().abs();
        }
        self.shares[k as usize] += sum * factor;
        self.doubt += size * factor.value().abs() * doubt;
    }

    fn begin(&mut self, q: [f64; 3], points: &[[f64; 3]], [before, after]: [f64; 2]) {
        self.at.clear();
        let relative = |p: &[f64; 3]| [0, 1, 2].map(|k| R::difference(p[k] * before, q[k] * before, after));
        self.at.extend(points.iter().map(relative));
        self.shares.clear();
        self.shares.resize(points.len(), R::default());
        self.doubt = 0.0;
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

/// Turns the least number to the front.
fn turn(numbers: &mut [u32]) {
    let least = (0..numbers.len()).min_by_key(|&k| numbers[k]).unwrap_or_default();
    numbers.rotate_left(least);
}

/// Coordinates as three of them.
pub(super) fn three<P: Coordinates>(p: P) -> [f64; 3] {
    let mut padded = [0.0; 3];
    padded[..P::COUNT].copy_from_slice(p.as_ref());
    padded
}

impl Cell {
    /// Takes what surrounds a point of a triangulation. Everything is put in an order that depends on the points alone, so that sums have
    /// the same bits whatever the triangulation was made of.
    pub(super) fn take<T: Triangulation>(&mut self, d: &T, around: &Around<T>) {
        let is_plane = T::Point::COUNT == 2;
        let Self { ids, points, by_id, cavity, border, .. } = self;
        if is_plane {
            // The border goes around once.
            ids.clear();
            ids.extend(around.border().iter().filter_map(|(facet, _)| facet.as_ref().first()));
        } else {
            around.neighbors(ids);
        }
        by_id.clear();
        by_id.extend(ids.iter().map(|&v| (three(d.position(v).unwrap_or_default()), v)));
        by_id.sort_unstable_by(|a, b| compare(a.0, b.0));
        points.clear();
        points.extend(by_id.iter().map(|known| known.0));
        ids.clear();
        ids.extend(by_id.iter().map(|known| known.1));
        let is_small = ids.len() <= 16;
        if !is_small {
            by_id.iter_mut().enumerate().for_each(|(k, known)| known.0[0] = k as f64);
            by_id.sort_unstable_by_key(|known| known.1);
        }
        let number = |v: VertexId| {
            if is_small {
                return ids.iter().position(|&id| id == v).unwrap_or_default() as u32;
            }
            by_id.binary_search_by_key(&v, |known| known.1).map_or(0, |k| by_id[k].0[0] as u32)
        };
        cavity.clear();
        cavity.extend(around.cavity().iter().map(|&s| {
            let corners = d.corners(s);
            let corners = corners.as_ref();
            let mut numbers = [0, 1, 2, 3].map(|k| corners.get(k).map_or(0, |&v| number(v)));
            if is_plane {
                turn(&mut numbers[..3]);
            } else {
                numbers.sort_unstable();
            }
            numbers
        }));
        cavity.sort_unstable();
        border.clear();
        border.extend(around.border().iter().map(|(facet, _)| {
            let corners = facet.as_ref();
            let mut numbers = [0, 1, 2].map(|k| corners.get(k).map_or(0, |&v| number(v)));
            if !is_plane {
                turn(&mut numbers);
            }
            numbers
        }));
        border.sort_unstable();
    }

    /// The weights of the neighbours, by their number; whether there are any, which simplices that are flat to twice the precision and
    /// coordinates beyond the range of numbers prevent.
    pub(super) fn weigh<P: Coordinates>(
        &mut self,
        q: P,
        measure: Measure,
        weights: &mut Vec<(VertexId, f64)>,
    ) -> bool {
        let q = three(q);
        let size = self.points.iter().flat_map(|p| (0..3).map(|k| (p[k] / 4.0 - q[k] / 4.0).abs()));
        let scale = scale(size.fold(0.0, f64::max));
        let Self { ids, points, cavity, border, plain, double, .. } = self;
        sum::<_, P>(plain, q, points, scale, (cavity, border), measure);
        let total: f64 = plain.shares.iter().sum();
        weights.clear();
        // In units of the last place of f64, whose half is 2^-53.
        if total > 0.0 && plain.doubt * f64::EPSILON <= GOOD * total {
            weights.extend(ids.iter().copied().zip(plain.shares.iter().copied()));
        } else {
            sum::<_, P>(double, q, points, scale, (cavity, border), measure);
            let total: f64 = double.shares.iter().map(|share| share.value()).sum();
            if !(double.doubt * f64::EPSILON * f64::EPSILON <= GOOD * total) {
                return false;
            }
            weights.extend(ids.iter().copied().zip(double.shares.iter().map(|share| share.value())));
        }
        normalize(weights)
    }
}

fn sum<R: Real, P: Coordinates>(
    local: &mut Local<R>,
    q: [f64; 3],
    points: &[[f64; 3]],
    scale: [f64; 2],
    (cavity, border): (&[[u32; 4]], &[[u32; 3]]),
    measure: Measure,
) {
    local.begin(q, points, scale);
    if P::COUNT == 2 {
        plane::sum(local, cavity, border, measure);
    } else {
        space::sum(local, cavity, border, measure);
    }
}

/// What a quarter of a distance is to be multiplied with, before and after differences are taken, so that no power of it leaves the
/// range of numbers.
pub(super) fn scale(size: f64) -> [f64; 2] {
    let before = if size > 2f64.powi(1000) { 2f64.powi(-100) } else { 1.0 };
    let size = size * before;
    let after = if size > 2f64.powi(60) {
        2f64.powi(-(size.log2() as i32))
    } else if size < 2f64.powi(-60) && size > 0.0 {
        2f64.powi((-size.log2() as i32).min(1000))
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
pub(super) fn duals(points: &[[f64; 3]]) -> [[f64; 4]; 4] {
    let mut sums = [[0.0; 4]; 4];
    let mut set = |i: usize, j: usize, dual: f64| (sums[i][j], sums[j][i]) = (dual, dual);
    match *points {
        [a, b, c] => {
            let at = [a, b, c];
            for k in 0..3 {
                let (i, j) = ((k + 1) % 3, (k + 2) % 3);
                let [u, v] = [i, j].map(|i| [0, 1, 2].map(|axis| at[i][axis] - at[k][axis]));
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
