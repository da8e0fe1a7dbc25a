//! The rings of the border of a mesh of the plane.
//!
//! At a vertex where rings touch, each turns around the triangles on its left, so that no ring crosses another. O(n log n).

use std::collections::BTreeSet;

use delone::Triangulation;
use delone_predicates::{Sign, orient2d};

use crate::Mesh;

/// A ring with the mesh on its left, which begins at its least node.
pub(crate) struct Ring {
    /// Indices of points, each once unless the ring touches itself.
    pub(crate) nodes: Vec<usize>,
    /// Whether it is around the mesh, not around a hole.
    pub(crate) is_outer: bool,
}

/// The rings by their least nodes.
pub(crate) fn rings<T: Triangulation<Point = [f64; 2]>>(mesh: &Mesh<T>) -> Vec<Ring> {
    let t = mesh.triangulation;
    let mut is_met = BTreeSet::new();
    let mut rings = Vec::new();
    for s in mesh.simplices() {
        for k in (0..3).filter(|&k| mesh.across(s, k).is_none()) {
            let mut nodes = Vec::new();
            let (mut s, mut k) = (s, k);
            while is_met.insert((t.index(s), k)) {
                // The side goes from corner k + 1 to corner k + 2.
                nodes.push(t.corners(s).as_ref()[(k + 1) % 3].index());
                let end = t.corners(s).as_ref()[(k + 2) % 3];
                // The next one from there on is opposite to corner k + 1, here or in a triangle farther around.
                let mut next = (s, (k + 1) % 3);
                while let Some(other) = mesh.across(next.0, next.1) {
                    let corners = t.corners(other);
                    let at = corners.as_ref().iter().position(|&v| v == end).unwrap_or_default();
                    next = (other, (at + 2) % 3);
                }
                (s, k) = next;
            }
            if !nodes.is_empty() {
                let first = (0..nodes.len()).min_by_key(|&i| nodes[i]).unwrap_or_default();
                nodes.rotate_left(first);
                let is_outer = is_outer(&nodes, mesh.points);
                rings.push(Ring { nodes, is_outer });
            }
        }
    }
    rings.sort_by(|one, other| one.nodes.cmp(&other.nodes));
    rings
}

/// Whether a ring turns left at its least point.
fn is_outer(nodes: &[usize], points: &[[f64; 2]]) -> bool {
    let count = nodes.len();
    let least = (0..count).min_by(|&i, &j| {
        points[nodes[i]].partial_cmp(&points[nodes[j]]).unwrap_or(std::cmp::Ordering::Equal)
    });
    let at = least.unwrap_or_default();
    let [before, here, after] = [at + count - 1, at, at + 1].map(|i| points[nodes[i % count]]);
    orient2d(before, here, after) == Sign::Positive
}
