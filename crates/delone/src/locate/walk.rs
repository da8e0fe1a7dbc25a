//! The visibility walk: cross any edge that separates the triangle from the goal.
//!
//! Source: Devillers, Pion & Teillaud, "Walking in a triangulation", IJFCS 2002. In a Delaunay triangulation
//! the walk cannot visit a triangle twice, because each step goes to a circle of smaller power, so it ends
//! without randomness. Cost: O(sqrt n) triangles on evenly spread points, O(n) at worst; from a near start,
//! O(1). One or two orientation tests a triangle.

use super::Ground;
use crate::ids::{TriangleId, VertexId};

/// Walks from `start` to the finite triangle that contains `q` in its inside or on its border, or else to the
/// ghost triangle of a hull edge that `q` is strictly beyond. The triangulation must span the plane.
pub(crate) fn walk<G: Ground>(ground: &G, start: TriangleId, q: G::Query) -> TriangleId {
    let mesh = ground.mesh();
    // A ghost has one finite edge; start inside of it.
    let mut from = match mesh.corners(start).iter().position(|v| v.is_ghost()) {
        Some(k) => mesh.twin(start.edge(k).next()),
        None => start.edge(0),
    };
    if ground.is_beyond(from, q) {
        from = mesh.twin(from);
        if mesh.apex(from) == VertexId::GHOST {
            return from.triangle();
        }
    }
    loop {
        // `q` is not beyond `from`: it came from there.
        let (next, previous) = (from.next(), from.previous());
        let crossed = if ground.is_beyond(next, q) {
            next
        } else if ground.is_beyond(previous, q) {
            previous
        } else {
            return from.triangle();
        };
        from = mesh.twin(crossed);
        if mesh.apex(from) == VertexId::GHOST {
            return from.triangle();
        }
    }
}
