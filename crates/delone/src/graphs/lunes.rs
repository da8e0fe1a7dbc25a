//! Edges whose open lune is empty, among those of the Gabriel graph, in any dimension.
//!
//! Any vertex may be in a lune, not only neighbours of its ends. But the vertices in a ball are connected by edges between
//! them, and both ends are in the smallest ball around their lune: so what is in it is found from them, through vertices that are
//! not surely outside of that ball.
//!
//! Cost: an edge those vertices; a few where points are evenly spread, O(n) an edge in the worst case. Most edges that are none
//! of the graph are told by a neighbour.

use delone_predicates::{Lune, LunePlace};

use super::net::{Met, Net};
use crate::ids::Place;
use crate::parallel;

/// The edges among some whose lune is empty, for a finite `beta` above 1.
pub(super) fn edges<const D: usize>(net: &Net<D>, among: &[[Place; 2]], beta: f64) -> Vec<[Place; 2]> {
    let part = |range: std::ops::Range<usize>| {
        let mut search = Search { queue: Vec::new(), met: Met::new() };
        let is_in = |edge: &[Place; 2]| search.is_empty(net, net.ranks(*edge), beta);
        among[range].iter().copied().filter(is_in).collect::<Vec<_>>()
    };
    parallel::map(parallel::ranges(among.len()), part).concat()
}

/// Buffers.
struct Search {
    queue: Vec<u32>,
    met: Met,
}

impl Search {
    fn is_empty<const D: usize>(&mut self, net: &Net<D>, edge: [u32; 2], beta: f64) -> bool {
        let [a, b] = edge.map(|v| *net.point(v));
        let lune = Lune::new(a, b, beta);
        self.queue.clear();
        self.queue.extend(edge);
        self.met.clear();
        for v in edge {
            self.met.insert(v);
        }
        let mut k = 0;
        while let Some(&v) = self.queue.get(k) {
            k += 1;
            for &w in net.neighbors(v) {
                if self.met.insert(w) {
                    match lune.place(net.point(w)) {
                        LunePlace::Away => {}
                        LunePlace::Inside => return false,
                        LunePlace::Beside => self.queue.push(w),
                    }
                }
            }
        }
        true
    }
}
