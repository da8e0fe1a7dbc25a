//! Who takes part in a fit where the neighbors of a vertex do not tell enough: their neighbors too, and theirs, until there are many.
//!
//! Cost: O(1), for the stars of at most [`MOST_NEIGHBORS`] vertices.

use super::super::natural::{compare, three};
use crate::around::Surround;
use crate::ids::VertexId;
use crate::sorting;

/// A set of which so many neighbors tell nothing is thin as a whole.
const MOST_NEIGHBORS: usize = 128;

/// The neighbors of a vertex, and theirs.
pub(super) struct Wide {
    neighbors: Vec<VertexId>,
    /// Whose neighbors are not among them yet.
    ring: Vec<VertexId>,
}

impl Wide {
    /// The neighbors alone.
    pub(super) fn new(neighbors: Vec<VertexId>) -> Self {
        Self { ring: neighbors.clone(), neighbors }
    }

    /// In the order of their points.
    pub(super) fn neighbors(&self) -> &[VertexId] {
        &self.neighbors
    }

    /// Adds the neighbors of those around a vertex; whether there are any, and not too many before.
    pub(super) fn widen<T: Surround>(&mut self, d: &T, v: VertexId) -> bool {
        if self.neighbors.len() > MOST_NEIGHBORS {
            return false;
        }
        let mut found = Vec::new();
        for &w in &self.ring {
            d.simplices_at(w).into_iter().for_each(|s| found.extend_from_slice(d.corners(s).as_ref()));
        }
        found.sort_unstable();
        found.dedup();
        found.retain(|w| *w != v && !self.neighbors.contains(w));
        self.neighbors.extend_from_slice(&found);
        self.ring = found;
        let at = |w: VertexId| three(d.position(w).unwrap_or_default());
        sorting::by(&mut self.neighbors, |&a, &b| compare(at(a), at(b)));
        !self.ring.is_empty()
    }
}
