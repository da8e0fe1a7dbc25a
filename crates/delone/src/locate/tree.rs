//! A k-d tree of hints: the fastest start of a walk.
//!
//! Source: Bentley, "Multidimensional binary search trees used for associative searching", CACM 1975, split at
//! medians. The tree holds no points: it is built over half of the vertices, evenly taken from the order in
//! which they are kept, and a leaf remembers an edge at its vertex. A hint may grow old; it may not be wrong,
//! because the walk decides.
//!
//! A query waits for memory. Three levels of the tree share a cache line, the lowest three share it with
//! their eight hints, and all lines above the lowest are a hundredth of the vertices' own memory. The eight lines
//! below a line are neighbors, and are asked for before the line itself has come: two levels arrive in the time of
//! one. The splits of the lowest lines are rounded, which a hint can bear.
//!
//! Cost: a query O(log n) comparisons, then a walk of O(1) expected triangles; four bytes a vertex. Building O(n log
//! n); the owner builds anew whenever the number of vertices has doubled or walks have become long, which is O(log
//! n) amortized over insertions. Removal costs nothing: hints that point at nothing are passed over.

use std::cmp::Ordering;

use super::{Ground, Start, Strategy};
use crate::ids::Place;
use crate::order::quantize::power_to_one;
use crate::parallel::filled;
use crate::prefetch::prefetch;
use crate::tally::Tally;

/// Vertices a leaf, of which one is looked at.
const LEAF: usize = 2;
/// Levels of the tree in a line.
const DEPTH: u32 = 3;
/// Leaves below a line.
const LEAVES: usize = 1 << DEPTH;
/// Levels of lines above the leaves that are prefetched; the levels above them stay in the cache.
const PREFETCHED_LEVELS: u32 = 3;

/// A subtree of inner nodes.
#[derive(Clone, Copy, Debug, Default)]
#[repr(C, align(64))]
struct Upper {
    /// For each node, from the root at 1, the coordinate that splits it, at one less.
    splits: [f64; LEAVES - 1],
}

/// A lowest subtree.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
struct Lowest<H> {
    /// As above.
    splits: [f32; LEAVES - 1],
    /// For each leaf a hint at its vertex.
    hints: [H; LEAVES],
}

/// The tree over the vertices there were when it was built. Axes alternate from level to level.
#[derive(Clone, Debug)]
pub(crate) struct Tree<H> {
    /// The lines above the lowest, level by level from the root.
    upper: Vec<Upper>,
    /// How many levels of lines these are.
    height: u32,
    /// How many levels of the tree are in the line of the root: what is left when the others have three.
    root: u32,
    lowest: Vec<Lowest<H>>,
    /// A power of two that brings all coordinates into the range of `f32`.
    scale: f64,
}

/// A node on the way down.
#[derive(Clone, Copy)]
struct Node {
    /// The level of lines, 0 at the root.
    level: u32,
    /// The line in that level.
    line: usize,
    /// The node in the line, from the root at 1.
    inner: usize,
    axis: usize,
}

/// The largest magnitude of a coordinate.
fn size<G: Ground>(sample: &[(G::Point, G::Hint)]) -> f64 {
    let coordinates =
        sample.iter().flat_map(|item| (0..G::DIMENSIONS).map(|axis| G::coordinate(item.0, axis)));
    coordinates.fold(0.0, |most, x| most.max(x.abs()))
}

impl<H: Copy + Send + Sync> Tree<H> {
    /// Builds the tree.
    pub(crate) fn build<G: Ground<Hint = H>>(ground: &G) -> Self {
        let sample = ground.inhabited().step_by(LEAF);
        let mut sample: Vec<_> = sample.map(|p| (ground.point(p), ground.hint(p))).collect();
        if sample.len() < LEAVES {
            return Self { upper: Vec::new(), height: 0, root: 0, lowest: Vec::new(), scale: 1.0 };
        }
        let levels = (sample.len() / LEAVES).ilog2();
        let height = levels.div_ceil(DEPTH);
        let lowest = Lowest { splits: [0.0; LEAVES - 1], hints: [G::NOWHERE; LEAVES] };
        let mut tree = Self {
            upper: Vec::new(),
            height,
            root: levels - DEPTH * height.saturating_sub(1),
            lowest: filled(lowest, 1 << levels),
            scale: power_to_one(size::<G>(&sample), &(1e-30..1e30)).unwrap_or(1.0),
        };
        tree.upper = filled(Upper::default(), tree.above(height));
        tree.split::<G>(&mut sample, Node { level: 0, line: 0, inner: 1, axis: 0 });
        tree
    }

    /// The number of lines on the levels above one.
    fn above(&self, level: u32) -> usize {
        match level {
            0 => 0,
            _ => 1 + ((1 << (DEPTH * (level - 1))) - 1) / (LEAVES - 1) * (1 << self.root),
        }
    }

    /// The node below another one.
    fn child(&self, node: Node, high: bool, dimensions: usize) -> Node {
        let axis = if node.axis + 1 == dimensions { 0 } else { node.axis + 1 };
        let inner = 2 * node.inner + usize::from(high);
        let width = if node.level == 0 && self.height > 0 { 1 << self.root } else { LEAVES };
        if inner < width {
            Node { inner, axis, ..node }
        } else {
            Node { level: node.level + 1, line: node.line * width + inner - width, inner: 1, axis }
        }
    }

    /// Splits points, with their hints, at the medians below a node.
    fn split<G: Ground<Hint = H>>(&mut self, sample: &mut [(G::Point, H)], node: Node) {
        let middle = sample.len() / 2;
        if node.level > self.height {
            // Below the lowest lines: the line is the number of the leaf.
            if let Some(&(_, hint)) = sample.get(middle) {
                self.lowest[node.line / LEAVES].hints[node.line % LEAVES] = hint;
            }
            return;
        }
        let coordinate = |item: &(G::Point, H)| G::coordinate(item.0, node.axis);
        sample.select_nth_unstable_by(middle, |a, b| {
            coordinate(a).partial_cmp(&coordinate(b)).unwrap_or(Ordering::Equal) // coordinates are finite
        });
        let value = coordinate(&sample[middle]);
        if node.level == self.height {
            self.lowest[node.line].splits[node.inner - 1] = (value * self.scale) as f32;
        } else {
            let line = self.above(node.level) + node.line;
            self.upper[line].splits[node.inner - 1] = value;
        }
        let (low, high) = sample.split_at_mut(middle);
        self.split::<G>(low, self.child(node, false, G::DIMENSIONS));
        self.split::<G>(high, self.child(node, true, G::DIMENSIONS));
    }

    /// Memory in bytes.
    pub(crate) fn bytes(&self) -> usize {
        size_of_val(&*self.upper) + size_of_val(&*self.lowest)
    }

    /// The lowest line and the leaf in it that a point belongs to.
    #[inline]
    fn leaf<G: Ground<Hint = H>>(&self, q: G::Point) -> (usize, usize) {
        let turn = |axis: usize| if axis + 1 == G::DIMENSIONS { 0 } else { axis + 1 };
        let (mut line, mut first, mut axis) = (0, 0, 0);
        let (mut depth, mut width) = (self.root, 1);
        for level in 1..=self.height {
            let below = line << depth..(line + 1) << depth;
            if level == self.height {
                below.for_each(|k| prefetch(&self.lowest, k));
            } else if level + PREFETCHED_LEVELS > self.height {
                below.for_each(|k| prefetch(&self.upper, first + width + k));
            }
            let splits = &self.upper[first + line].splits;
            let mut inner = 1;
            for _ in 0..depth {
                inner = 2 * inner + usize::from(G::coordinate(q, axis) >= splits[inner - 1]);
                axis = turn(axis);
            }
            line = (line << depth) + inner - (1 << depth);
            first += width;
            width <<= depth;
            depth = DEPTH;
        }
        let splits = &self.lowest[line].splits;
        let mut inner = 1;
        for _ in 0..DEPTH {
            inner =
                2 * inner + usize::from((G::coordinate(q, axis) * self.scale) as f32 >= splits[inner - 1]);
            axis = turn(axis);
        }
        (line, inner - LEAVES)
    }
}

impl<G: Ground> Strategy<G> for Tree<G::Hint> {
    #[inline]
    fn start<T: Tally>(&self, ground: &G, q: G::Point, _: &mut T) -> Start<G::Hint> {
        if self.lowest.is_empty() {
            return Start::Anywhere;
        }
        let alive = |hint: &G::Hint| *hint != G::NOWHERE && ground.is_alive(*hint);
        let (line, leaf) = self.leaf::<G>(q);
        let number = (line * LEAVES + leaf) as u32;
        let hint = self.lowest[line].hints[leaf];
        ground.prefetch_around(hint);
        if alive(&hint) {
            return Start::Hint(hint, number);
        }
        // After removals a hint may point at nothing; one near it will do.
        let lines = [line, line ^ 1, line ^ 2, line ^ 3];
        let mut near = lines.into_iter().filter_map(|line| self.lowest.get(line)).flat_map(|line| line.hints);
        near.find(alive).map_or(Start::Anywhere, |hint| Start::Hint(hint, number))
    }

    #[inline]
    fn inserted<T: Tally>(&mut self, ground: &G, v: Place, start: Start<G::Hint>, _: &mut T) {
        if self.lowest.is_empty() {
            return;
        }
        let (line, leaf) = match start {
            Start::Hint(_, number) => (number as usize / LEAVES, number as usize % LEAVES),
            _ => self.leaf::<G>(ground.point(v)),
        };
        self.lowest[line].hints[leaf] = ground.hint(v);
    }

    fn removing<T: Tally>(&mut self, _: &G, _: Place, _: &mut T) {}

    fn rearranged(&mut self, ground: &G, _: &[Place]) {
        *self = Self::build(ground);
    }
}
