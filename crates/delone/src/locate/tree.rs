//! A k-d tree of hints: the fastest start of a walk.
//!
//! Source: Bentley, "Multidimensional binary search trees used for associative searching", CACM 1975, split at
//! medians. The tree is two arrays, without pointers, and holds no points: a leaf stands for about four
//! vertices and remembers an edge near them. A hint may grow old; it may not be wrong, because the walk decides.
//!
//! Cost: a query O(log n) comparisons in three bytes a vertex, which stay in the cache, then a walk of O(1)
//! expected triangles. Building O(n log n); the owner builds anew whenever the number of vertices has doubled or
//! walks have become long, which is O(log n) amortized over insertions.

use super::tally::Tally;
use super::{Ground, Start, Strategy, Walk};
use crate::ids::{EdgeId, Place};

/// Vertices a leaf.
const LEAF: usize = 4;
/// Below this number of vertices any start is near.
const SMALL: usize = 32;

/// The tree over the vertices there were when it was built.
#[derive(Clone, Debug, Default)]
pub(crate) struct Tree {
    /// For each inner node, from the root at 1, the coordinate that splits it. Axes alternate.
    splits: Vec<f64>,
    /// For each leaf an edge near its vertices.
    hints: Vec<EdgeId>,
}

impl Tree {
    /// Builds the tree over all vertices.
    pub(crate) fn build<G: Ground>(ground: &G) -> Self {
        let mesh = ground.mesh();
        let mut places: Vec<u32> = mesh.inhabited().map(|p| p.index() as u32).collect();
        if places.len() < SMALL {
            return Self::default();
        }
        let leaves = (places.len() / LEAF).next_power_of_two();
        let mut tree = Self { splits: vec![0.0; leaves], hints: vec![EdgeId::NONE; leaves] };
        tree.split(ground, &mut places, 1, 0);
        tree
    }

    fn split<G: Ground>(&mut self, ground: &G, places: &mut [u32], node: usize, axis: usize) {
        let leaves = self.hints.len();
        let middle = places.len() / 2;
        if node >= leaves {
            self.hints[node - leaves] = ground.mesh().incident[places[middle] as usize];
            return;
        }
        let coordinate = |p: u32| G::coordinate(ground.point(Place::new(p as usize)), axis);
        places.select_nth_unstable_by(middle, |&i, &j| coordinate(i).total_cmp(&coordinate(j)));
        self.splits[node] = coordinate(places[middle]);
        let (low, high) = places.split_at_mut(middle);
        let axis = (axis + 1) % G::DIMENSIONS;
        self.split(ground, low, 2 * node, axis);
        self.split(ground, high, 2 * node + 1, axis);
    }

    #[inline]
    fn leaf<G: Ground>(&self, q: G::Point) -> usize {
        let leaves = self.hints.len();
        let (mut node, mut axis) = (1, 0);
        while node < leaves {
            node = 2 * node + usize::from(G::coordinate(q, axis) >= self.splits[node]);
            axis = if axis + 1 == G::DIMENSIONS { 0 } else { axis + 1 };
        }
        node - leaves
    }
}

impl<G: Ground> Strategy<G> for Tree {
    #[inline]
    fn start<T: Tally>(&self, ground: &G, q: G::Point, _: &mut T) -> Start {
        if self.hints.is_empty() {
            return Start::Anywhere;
        }
        let mesh = ground.mesh();
        let leaf = self.leaf::<G>(q);
        // After removals a hint may point at nothing; one of its neighbours will do.
        for at in [leaf, leaf ^ 1, leaf ^ 2] {
            let hint = self.hints.get(at).copied().unwrap_or(EdgeId::NONE);
            if hint != EdgeId::NONE && mesh.is_triangle(hint.triangle()) {
                return Start::Edge(hint, Walk::Visibility);
            }
        }
        Start::Anywhere
    }

    #[inline]
    fn inserted(&mut self, ground: &G, v: Place) {
        if !self.hints.is_empty() {
            let leaf = self.leaf::<G>(ground.point(v));
            self.hints[leaf] = ground.mesh().incident[v.index()];
        }
    }

    fn removing(&mut self, ground: &G, v: Place) {
        if !self.hints.is_empty() {
            // An edge of the link outlives the vertex on its other side.
            let leaf = self.leaf::<G>(ground.point(v));
            let mesh = ground.mesh();
            self.hints[leaf] = match mesh.incident[v.index()] {
                EdgeId::NONE => EdgeId::NONE,
                spoke => mesh.twin(spoke.next()),
            };
        }
    }

    fn rearranged(&mut self, ground: &G, _: &[Place]) {
        *self = Self::build(ground);
    }
}
