//! Bulk construction in the plane. Every algorithm gives the same set of triangles.

mod divide_and_conquer;
mod leaf;
mod merge;

pub use divide_and_conquer::Counters;

use super::Duplicate;
use crate::mesh::Mesh;

pub(super) fn divide_and_conquer(points: &[[f64; 2]]) -> (Mesh, Vec<Duplicate>, Counters) {
    divide_and_conquer::triangulate(points)
}
