//! Each vertex and those nearest to it, in any dimension.
//!
//! The k + 1 nearest vertices are the k nearest and a neighbor of one of them (`locate/nearest.rs`), so they are found one by
//! one among the neighbors of those before.
//!
//! Cost: O(k log k) comparisons a vertex where degrees are bounded.

use std::cmp::Ordering;

use delone_predicates::{Length, compare_lengths};

use super::net::{Met, Net};
use crate::ids::Place;

/// The edges, some of them twice.
pub(super) fn edges<const D: usize>(net: &Net<D>, k: usize) -> Vec<[Place; 2]> {
    net.gather(|ranks| {
        let mut search = Search { waiting: Vec::new(), met: Met::new() };
        let mut edges = Vec::new();
        for v in ranks {
            search.run(net, v, k, |w| edges.push([v, w]));
        }
        edges
    })
}

/// Buffers.
struct Search {
    /// The furthest first.
    waiting: Vec<(Length, u32)>,
    met: Met,
}

impl Search {
    /// Calls for the vertices nearest to one.
    fn run<const D: usize>(&mut self, net: &Net<D>, v: u32, k: usize, mut each: impl FnMut(u32)) {
        let q = *net.point(v);
        let order = |one: (Length, u32), other: (Length, u32)| -> Ordering {
            let exact = || {
                let [a, b] = [one.1, other.1].map(|v| *net.point(v));
                compare_lengths([q, a], [q, b]).then_with(|| a.partial_cmp(&b).expect("finite"))
            };
            one.0.compare(other.0).unwrap_or_else(exact)
        };
        self.waiting.clear();
        self.met.clear();
        self.met.insert(v);
        let mut last = v;
        for found in 0..k {
            for &w in net.neighbors(last) {
                if !self.met.insert(w) {
                    continue;
                }
                let item = (Length::between(&q, net.point(w)), w);
                let at = self.waiting.partition_point(|&other| order(other, item).is_gt());
                // No more than are wanted are kept.
                if at > 0 || self.waiting.len() < k - found {
                    self.waiting.insert(at, item);
                    if self.waiting.len() > k - found {
                        self.waiting.remove(0);
                    }
                }
            }
            let Some((_, nearest)) = self.waiting.pop() else { break };
            each(nearest);
            last = nearest;
        }
    }
}
