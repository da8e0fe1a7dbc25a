//! The points of a triangulation that equal an earlier one and are no vertices.

use std::collections::BTreeMap;

use crate::ids::{Duplicate, VertexId};

/// Duplicates, sorted by point. One is forgotten when its vertex goes or moves away.
#[derive(Clone, Debug, Default)]
pub(crate) struct Duplicates {
    found: Vec<Duplicate>,
    /// For each vertex that moved how many ids were given then: what was given before does not equal it any more.
    moved: BTreeMap<VertexId, usize>,
}

impl Duplicates {
    /// The duplicates of a construction.
    pub(crate) fn new(found: Vec<Duplicate>) -> Self {
        Self { found, moved: BTreeMap::new() }
    }

    /// All whose vertex is one, and where it was.
    pub(crate) fn iter(&self, is_vertex: impl Fn(VertexId) -> bool) -> impl Iterator<Item = Duplicate> {
        let stays = |d: &Duplicate| self.moved.get(&d.vertex).is_none_or(|&given| d.point >= given);
        self.found.iter().copied().filter(move |d| is_vertex(d.vertex) && stays(d))
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.found.is_empty()
    }

    pub(crate) fn clear(&mut self) {
        self.found.clear();
        self.moved.clear();
    }

    /// Another one. Those that come together are settled afterwards.
    pub(crate) fn push(&mut self, duplicate: Duplicate) {
        self.found.push(duplicate);
    }

    /// A vertex moves away, after so many ids were given.
    pub(crate) fn vertex_moves(&mut self, v: VertexId, given: usize) {
        if !self.found.is_empty() {
            self.moved.insert(v, given);
        }
    }

    /// Sorts, and lets each refer to a vertex.
    pub(crate) fn settle(&mut self) {
        settle(&mut self.found);
    }
}

/// Sorts duplicates and lets each refer to a vertex. One may have been renamed after a duplicate referred to it; it is a
/// duplicate itself then, of a smaller index and so already settled.
pub(crate) fn settle(duplicates: &mut [Duplicate]) {
    duplicates.sort_unstable_by_key(|duplicate| duplicate.point);
    for i in 0..duplicates.len() {
        let vertex = duplicates[i].vertex;
        if let Ok(earlier) = duplicates[..i].binary_search_by_key(&vertex.index(), |d| d.point) {
            duplicates[i].vertex = duplicates[earlier].vertex;
        }
    }
}
