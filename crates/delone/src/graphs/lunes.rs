//! Edges whose open lune is empty, among those of the Gabriel graph, in any dimension.
//!
//! Any vertex may be in a lune, not only neighbors of its ends. But the vertices in a ball are connected by edges between
//! them, and both ends are in the smallest ball around their lune: so what is in it is found from them, through vertices that are
//! not surely outside of that ball. Where these are many, as between two rows that are far apart, a tree of boxes over the
//! vertices leaves out those outside of the lune itself.
//!
//! Cost: an edge a few vertices where points are evenly spread; most edges that are none of the graph are told by a neighbor.
//! Otherwise O(log n) between rows along the axes, O(sqrt n) between others that are as far apart as they are long, and O(n) where
//! many are on the lune's border, or nearly.

use std::ops::Range;
use std::sync::OnceLock;

use delone_predicates::{Lune, LunePlace};

use super::net::{Met, Net};
use crate::ids::Place;
use crate::parallel;
use crate::points::Bounds;

/// The edges among some whose lune is empty, for a finite `beta` above 1.
pub(super) fn edges<const D: usize>(net: &Net<D>, among: &[[Place; 2]], beta: f64) -> Vec<[Place; 2]> {
    let boxes = OnceLock::new();
    let part = |range: Range<usize>| {
        let mut search = Search { queue: Vec::new(), met: Met::new(), looked: 0 };
        let is_in = |edge: &[Place; 2]| search.is_empty(net, &boxes, net.ranks(*edge), beta);
        among[range].iter().copied().filter(is_in).collect::<Vec<_>>()
    };
    parallel::map(parallel::ranges(among.len()), part).concat()
}

/// Buffers.
struct Search {
    queue: Vec<u32>,
    met: Met,
    /// How many vertices and boxes have been looked at.
    looked: usize,
}

impl Search {
    /// Vertices that a search visits one by one; after these it asks the boxes of the tree.
    const UNBOXED_VERTICES: usize = 64;

    fn is_empty<const D: usize>(
        &mut self,
        net: &Net<D>,
        boxes: &OnceLock<Boxes<D>>,
        edge: [u32; 2],
        beta: f64,
    ) -> bool {
        let [a, b] = edge.map(|v| *net.point(v));
        let lune = Lune::new(a, b, beta);
        self.queue.clear();
        self.queue.extend(edge);
        self.met.clear();
        for v in edge {
            self.met.insert(v);
        }
        let (mut k, most) = (0, self.looked + Self::UNBOXED_VERTICES);
        while let Some(&v) = self.queue.get(k) {
            k += 1;
            for &w in net.neighbors(v) {
                if self.met.insert(w) {
                    self.looked += 1;
                    match lune.place(net.point(w)) {
                        LunePlace::Away => {}
                        LunePlace::Inside => return false,
                        LunePlace::Beside => self.queue.push(w),
                    }
                    if self.looked > most {
                        return !boxes.get_or_init(|| Boxes::of(&net.points)).any_inside(&lune, self);
                    }
                }
            }
        }
        true
    }
}

/// A k-d tree of the vertices, split at medians across the longest sides.
struct Boxes<const D: usize> {
    /// Leaf by leaf, of which each has as many, or one more.
    points: Vec<[f64; D]>,
    /// Boxes around them, from the root at 1; those in box k are 2k and 2k + 1. The first is not used.
    nodes: Vec<Bounds<D>>,
}

impl<const D: usize> Boxes<D> {
    /// Vertices a leaf, at most.
    const LEAF: usize = 8;

    fn of(points: &[[f64; D]]) -> Self {
        let leaves = points.len().div_ceil(Self::LEAF).next_power_of_two();
        let mut boxes = Self { points: points.to_vec(), nodes: vec![Bounds::default(); 2 * leaves] };
        for node in 1..2 * leaves {
            let range = boxes.range(node);
            let middle = boxes.range(2 * node).end - range.start;
            let some = &mut boxes.points[range];
            let bounds = Bounds::of(some.iter().copied());
            boxes.nodes[node] = bounds;
            if node < leaves {
                let side = |k: &usize| bounds.high[*k] / 2.0 - bounds.low[*k] / 2.0;
                let axis = (0..D).max_by(|k, l| side(k).total_cmp(&side(l))).unwrap_or(0);
                if middle < some.len() {
                    some.select_nth_unstable_by(middle, |p, q| p[axis].total_cmp(&q[axis]));
                }
            }
        }
        boxes
    }

    /// The vertices in a box.
    fn range(&self, node: usize) -> Range<usize> {
        let row = 1 << node.ilog2();
        let end = |boxes: usize| (boxes as u64 * self.points.len() as u64 / row as u64) as usize;
        end(node - row)..end(node - row + 1)
    }

    /// Whether a vertex is inside of a lune.
    fn any_inside(&self, lune: &Lune<D>, search: &mut Search) -> bool {
        let pending = &mut search.queue;
        pending.clear();
        pending.push(1);
        while let Some(node) = pending.pop() {
            search.looked += 1;
            let Bounds { low, high } = &self.nodes[node as usize];
            if lune.is_clear_of(low, high) {
                continue;
            }
            if 2 * (node as usize) < self.nodes.len() {
                pending.extend([2 * node, 2 * node + 1]);
                continue;
            }
            let some = &self.points[self.range(node as usize)];
            search.looked += some.len();
            if some.iter().any(|p| lune.place(p) == LunePlace::Inside) {
                return true;
            }
        }
        false
    }
}

/// How many looks the lunes of some edges take one after the other, and how many of them are empty. Asked of boxes alone they are the
/// same ones.
#[cfg(test)]
pub(crate) fn looks<const D: usize>(net: &Net<D>, among: &[[Place; 2]], beta: f64) -> (usize, usize) {
    let boxes = OnceLock::new();
    let mut search = Search { queue: Vec::new(), met: Met::new(), looked: 0 };
    let empty = |edge: &&[Place; 2]| search.is_empty(net, &boxes, net.ranks(**edge), beta);
    let found: Vec<_> = among.iter().filter(empty).collect();
    let looked = search.looked;
    let boxes = Boxes::of(&net.points);
    let empty = |edge: &&[Place; 2]| {
        let [a, b] = net.ranks(**edge).map(|v| *net.point(v));
        !boxes.any_inside(&Lune::new(a, b, beta), &mut search)
    };
    assert!(among.iter().filter(empty).eq(found.iter().copied()), "boxes and neighbors differ");
    (looked, found.len())
}
