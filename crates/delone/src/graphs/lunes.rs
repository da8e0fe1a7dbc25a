//! Edges whose open lune is empty, among those of the Gabriel graph, in any dimension.
//!
//! Any vertex may be in a lune, not only neighbours of its ends. But the vertices in a ball are connected by edges between
//! them, and both ends are in the smallest ball around their lune: so what is in it is found from them, through vertices that are
//! not surely outside of that ball.
//!
//! Cost: an edge those vertices; a few where points are evenly spread, O(n) an edge in the worst case. Most edges that are none
//! of the graph are told by a neighbour.

use delone_predicates::{Lune, LunePlace};

use super::net::{Met, Net, in_parts};
use crate::ids::Place;

/// The edges among some whose lune is empty, for a finite `beta` above 1.
pub(super) fn edges<const D: usize>(net: &Net<D>, among: Vec<[Place; 2]>, beta: f64) -> Vec<[Place; 2]> {
    let part = |edges: &[[Place; 2]]| {
        let mut search = Search::default();
        edges.iter().copied().filter(|&edge| search.is_empty(net, edge, beta)).collect::<Vec<_>>()
    };
    in_parts(&among, part).concat()
}

/// Buffers.
#[derive(Default)]
struct Search {
    queue: Vec<Place>,
    met: Met,
}

impl Search {
    fn is_empty<const D: usize>(&mut self, net: &Net<D>, edge: [Place; 2], beta: f64) -> bool {
        let [a, b] = edge.map(|v| net.point(v));
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
                match lune.place(&net.points[w.index()]) {
                    LunePlace::Away => {}
                    LunePlace::Inside => return false,
                    LunePlace::Beside => {
                        if self.met.insert(w) {
                            self.queue.push(w);
                        }
                    }
                }
            }
        }
        true
    }
}
