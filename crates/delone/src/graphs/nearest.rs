//! Each vertex and those nearest to it, in any dimension.
//!
//! The k + 1 nearest vertices are the k nearest and a neighbour of one of them (`locate/nearest.rs`), so they are found one by
//! one among the neighbours of those before.
//!
//! Cost: O(k log k) comparisons a vertex where degrees are bounded.

use std::cmp::Ordering;

use delone_predicates::{Length, compare_lengths};

use super::net::{Met, Net, in_parts};
use crate::ids::Place;

/// The edges, some of them twice.
pub(super) fn edges<const D: usize>(net: &Net<D>, k: usize) -> Vec<[Place; 2]> {
    let part = |places: &[Place]| {
        let mut search = Search::default();
        let mut edges = Vec::new();
        for &v in places {
            search.run(net, v, k, |w| edges.push([v.min(w), v.max(w)]));
        }
        edges.sort_unstable();
        edges.dedup();
        edges
    };
    in_parts(&net.places, part).concat()
}

/// Buffers.
#[derive(Default)]
struct Search {
    /// The furthest first.
    waiting: Vec<(Length, Place)>,
    met: Met,
}

impl Search {
    /// Calls for the vertices nearest to one.
    fn run<const D: usize>(&mut self, net: &Net<D>, v: Place, k: usize, mut each: impl FnMut(Place)) {
        let q = net.point(v);
        let order = |(one, a): (Length, Place), (two, b): (Length, Place)| -> Ordering {
            let [a, b] = [a, b].map(|v| net.point(v));
            let exact = || compare_lengths([q, a], [q, b]).then_with(|| a.partial_cmp(&b).expect("finite"));
            one.compare(two).unwrap_or_else(exact)
        };
        self.waiting.clear();
        self.met.clear();
        self.met.insert(v);
        let mut last = v;
        for _ in 0..k {
            for &w in net.neighbors(last) {
                if self.met.insert(w) {
                    let item = (Length::between(&q, &net.points[w.index()]), w);
                    let at = self.waiting.partition_point(|&other| order(other, item).is_gt());
                    self.waiting.insert(at, item);
                }
            }
            let Some((_, nearest)) = self.waiting.pop() else { break };
            each(nearest);
            last = nearest;
        }
    }
}
