//! Incremental construction in spatial order: walk from the previous point, refill its cavity.
//!
//! Independent of divide and conquer in everything but the predicates, so each judges the other. Source:
//! Amenta, Choi & Rote, "Incremental constructions con BRIO", SoCG 2003. Cost: O(n log n) expected for any
//! input, by the randomness of the order; on evenly spread points O(n) after sorting.

use crate::ids::VertexId;
use crate::mesh::Mesh;
use crate::order::brio;
use crate::plane::Duplicate;
use crate::plane::insert::{Inserted, Inserter};

/// Triangulates points, all finite and at most [`crate::MAX_POINTS`]. Also returns the number of conflict
/// tests.
pub(super) fn triangulate(points: &[[f64; 2]], seed: u64) -> (Mesh, Vec<Duplicate>, u64) {
    let mut inserter = Inserter::new(points);
    inserter.mesh.edges.reserve_exact(8 * points.len().saturating_sub(1));
    let mut duplicates = Vec::new();
    let mut hint = VertexId::GHOST; // not looked at by the first insertion
    for index in brio::order(points, seed) {
        let v = VertexId::new(index as usize);
        match inserter.insert(v, hint) {
            Inserted::Vertex => hint = v,
            Inserted::Duplicate(w) => {
                // The first of equal points given is their vertex.
                let (first, later) = (v.min(w), v.max(w));
                if later == w {
                    inserter.rename(w, v);
                }
                duplicates.push(Duplicate { point: later.index(), vertex: first });
                hint = first;
            }
        }
    }
    duplicates.sort_unstable_by_key(|duplicate| duplicate.point);
    // A vertex may have been renamed after a duplicate referred to it; it is a duplicate itself then, of a
    // smaller index and so already settled.
    for i in 0..duplicates.len() {
        let vertex = duplicates[i].vertex;
        if let Ok(earlier) = duplicates[..i].binary_search_by_key(&vertex.index(), |d| d.point) {
            duplicates[i].vertex = duplicates[earlier].vertex;
        }
    }
    (inserter.mesh, duplicates, inserter.tests)
}
