//! A k-d tree of hints: the fastest start of a walk.
//!
//! Source: Bentley, "Multidimensional binary search trees used for associative searching", CACM 1975, split at
//! medians. The tree has no pointers and holds no points: a leaf stands for about four vertices and remembers an edge
//! near them. A hint may grow old; it may not be wrong, because the walk decides.
//!
//! Eight leaves share a cache line with the splits between them, and the splits above are a hundredth of the
//! vertices' own memory, so a query in a large set costs one cache miss before the walk. The splits inside a line
//! are rounded, which a hint can bear.
//!
//! Cost: a query O(log n) comparisons, then a walk of O(1) expected triangles; four bytes a vertex. Building O(n log
//! n); the owner builds anew whenever the number of vertices has doubled or walks have become long, which is O(log
//! n) amortized over insertions. Removal costs nothing: hints that point at nothing are passed over.

use super::tally::Tally;
use super::{Ground, Start, Strategy, Walk};
use crate::ids::{EdgeId, Place};

/// Vertices a leaf.
const LEAF: usize = 4;
/// Leaves a line.
const LEAVES: usize = 8;

/// A subtree of eight leaves.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
struct Line {
    /// For each inner node, from the root at 1, the coordinate that splits it, at one less.
    splits: [f32; LEAVES - 1],
    /// For each leaf an edge near its vertices.
    hints: [EdgeId; LEAVES],
}

/// The tree over the vertices there were when it was built.
#[derive(Clone, Debug, Default)]
pub(crate) struct Tree {
    /// For each inner node above the lines, from the root at 1, the coordinate that splits it. Axes alternate.
    splits: Vec<f64>,
    lines: Vec<Line>,
}

impl Tree {
    /// Builds the tree over all vertices.
    pub(crate) fn build<G: Ground>(ground: &G) -> Self {
        let mesh = ground.mesh();
        let mut places: Vec<u32> = mesh.inhabited().map(|p| p.index() as u32).collect();
        if places.len() < LEAF * LEAVES {
            return Self::default();
        }
        let count = (places.len() / (LEAF * LEAVES)).next_power_of_two();
        let line = Line { splits: [0.0; LEAVES - 1], hints: [EdgeId::NONE; LEAVES] };
        let mut tree = Self { splits: vec![0.0; count], lines: vec![line; count] };
        tree.split(ground, &mut places, 1, 0);
        tree
    }

    fn split<G: Ground>(&mut self, ground: &G, places: &mut [u32], node: usize, axis: usize) {
        let (lines, middle) = (self.lines.len(), places.len() / 2);
        if node >= lines * LEAVES {
            if let Some(&place) = places.get(middle) {
                let leaf = node - lines * LEAVES;
                self.lines[leaf / LEAVES].hints[leaf % LEAVES] = ground.mesh().incident[place as usize];
            }
            return;
        }
        let coordinate = |p: u32| G::coordinate(ground.point(Place::new(p as usize)), axis);
        if middle > 0 {
            places.select_nth_unstable_by(middle, |&i, &j| coordinate(i).total_cmp(&coordinate(j)));
            let value = coordinate(places[middle]);
            if node < lines {
                self.splits[node] = value;
            } else {
                let depth = (node / lines).ilog2();
                let (line, inner) = ((node >> depth) - lines, node & ((1 << depth) - 1) | 1 << depth);
                self.lines[line].splits[inner - 1] = value as f32;
            }
        }
        let (low, high) = places.split_at_mut(middle);
        let axis = (axis + 1) % G::DIMENSIONS;
        self.split(ground, low, 2 * node, axis);
        self.split(ground, high, 2 * node + 1, axis);
    }

    /// What it takes.
    pub(crate) fn bytes(&self) -> usize {
        size_of_val(&*self.splits) + size_of_val(&*self.lines)
    }

    /// The line and the leaf in it that a point belongs to.
    #[inline]
    fn leaf<G: Ground>(&self, q: G::Point) -> (usize, usize) {
        let lines = self.lines.len();
        let (mut node, mut axis) = (1, 0);
        let turn = |axis: usize| if axis + 1 == G::DIMENSIONS { 0 } else { axis + 1 };
        while node < lines {
            node = 2 * node + usize::from(G::coordinate(q, axis) >= self.splits[node]);
            axis = turn(axis);
        }
        let line = &self.lines[node - lines];
        let mut inner = 1;
        while inner < LEAVES {
            inner = 2 * inner + usize::from(G::coordinate(q, axis) as f32 >= line.splits[inner - 1]);
            axis = turn(axis);
        }
        (node - lines, inner - LEAVES)
    }
}

impl<G: Ground> Strategy<G> for Tree {
    #[inline]
    fn start<T: Tally>(&self, ground: &G, q: G::Point, _: &mut T) -> Start {
        if self.lines.is_empty() {
            return Start::Anywhere;
        }
        let mesh = ground.mesh();
        let alive = |hint: &EdgeId| *hint != EdgeId::NONE && mesh.is_triangle(hint.triangle());
        let (line, leaf) = self.leaf::<G>(q);
        let hint = self.lines[line].hints[leaf];
        ground.fetch(hint);
        if alive(&hint) {
            return Start::Edge(hint, Walk::Visibility);
        }
        // After removals a hint may point at nothing; one near it will do.
        let lines = [line, line ^ 1, line ^ 2, line ^ 3];
        let mut near = lines.into_iter().filter_map(|line| self.lines.get(line)).flat_map(|line| line.hints);
        near.find(alive).map_or(Start::Anywhere, |hint| Start::Edge(hint, Walk::Visibility))
    }

    #[inline]
    fn inserted(&mut self, ground: &G, v: Place) {
        if !self.lines.is_empty() {
            let (line, leaf) = self.leaf::<G>(ground.point(v));
            self.lines[line].hints[leaf] = ground.mesh().incident[v.index()];
        }
    }

    fn removing(&mut self, _: &G, _: Place) {}

    fn rearranged(&mut self, ground: &G, _: &[Place]) {
        *self = Self::build(ground);
    }
}
