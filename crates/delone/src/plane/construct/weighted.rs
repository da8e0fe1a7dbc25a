//! Divide and conquer for sites with weights: what is hidden comes loose in the merges, and its triangles stay unused.
//!
//! Source: the merge of `merge.rs` with the changes that weights need. Cost: O(n log n).

use super::divide_and_conquer::build;
use crate::ids::Place;
use crate::mesh::Mesh2;
use crate::order::morton::{self, Sorted};
use crate::parallel;
use crate::plane::layer::kernel::Power;
use crate::points::survey;
use crate::tally::Merges;

/// The regular triangulation of sites with weights, the heaviest of those at one point, with vertices at their positions in Morton
/// order. Positions that are hidden have no star.
pub(in crate::plane) struct Weighted {
    pub(in crate::plane) mesh: Mesh2,
    /// By position.
    pub(in crate::plane) points: Vec<[f64; 2]>,
    pub(in crate::plane) weights: Vec<f64>,
    /// The indices of the sites at all positions.
    pub(in crate::plane) indices: Vec<u32>,
    /// Other sites at the points of these, with their positions.
    pub(in crate::plane) coincident: Vec<(u32, Place)>,
    pub(in crate::plane) counters: Merges,
}

/// See [`Weighted`].
pub(in crate::plane) fn weighted(points: &[[f64; 2]], weights: &[f64]) -> Weighted {
    let Sorted { points: ordered, mut indices, cuts, boxes, duplicates } =
        morton::sort(points, &survey(points).0);
    let coincident = heaviest_take_positions(&mut indices, duplicates, weights);
    let ordered_weights = parallel::collect(indices.len(), |k| weights[indices[k] as usize]);
    let (edges, counters) = build::<Power>(&ordered, &ordered_weights, &cuts, &boxes);
    let n = ordered.len();
    let mut mesh = Mesh2 { edges, vertex_count: n, ..Mesh2::empty(0) };
    mesh.lone = if n == 1 { Some(Place::new(0)) } else { None };
    mesh.number_vertices::<true>(n, |position| position);
    mesh.forget_unused();
    Weighted { mesh, points: ordered, weights: ordered_weights, indices, coincident, counters }
}

/// Of sites at one point the heaviest, and of these the first, takes the position; the others are returned.
fn heaviest_take_positions(
    indices: &mut [u32],
    duplicates: Vec<(u32, u32)>,
    weights: &[f64],
) -> Vec<(u32, Place)> {
    if duplicates.is_empty() {
        return Vec::new();
    }
    let mut positions = parallel::filled(Place::GHOST, weights.len());
    indices.iter().enumerate().for_each(|(k, &i)| positions[i as usize] = Place::new(k));
    let stands_before = |i: u32, j: u32| {
        let (w, v) = (weights[i as usize], weights[j as usize]);
        w > v || (w == v && i < j)
    };
    let place = |(other, first): (u32, u32)| {
        let position = positions[first as usize];
        let there = &mut indices[position.index()];
        let mut lighter = other;
        if stands_before(other, *there) {
            lighter = std::mem::replace(there, other);
        }
        (lighter, position)
    };
    duplicates.into_iter().map(place).collect()
}
