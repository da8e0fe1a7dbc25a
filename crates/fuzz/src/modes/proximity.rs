//! Proximity graphs against their definitions, and each as part of the next.

use delone::{Delaunay2, Delaunay3, Error, Graph, VertexId};
use delone_generators::Random;
use delone_oracle::graphs::{self, Pairs};

use crate::attack::{Attack, Judgement};
use crate::nasty;

/// In the plane.
pub(crate) struct Planar;

/// In space.
pub(crate) struct Spatial;

impl Attack for Planar {
    type Item = [f64; 2];

    fn make(random: &mut Random) -> Vec<[f64; 2]> {
        nasty::points(random, 24)
    }

    fn judge(points: &[[f64; 2]], seed: u64) -> Judgement {
        let d = Delaunay2::from_points(points).map_err(|error| error.to_string())?;
        judge(points, seed, d.edges(), |graph| d.graph(graph))
    }
}

impl Attack for Spatial {
    type Item = [f64; 3];

    fn make(random: &mut Random) -> Vec<[f64; 3]> {
        nasty::points(random, 18)
    }

    fn judge(points: &[[f64; 3]], seed: u64) -> Judgement {
        let d = Delaunay3::from_points(points).map_err(|error| error.to_string())?;
        judge(points, seed, d.edges(), |graph| d.graph(graph))
    }
}

fn judge<const D: usize>(
    points: &[[f64; D]],
    seed: u64,
    edges: impl Iterator<Item = [VertexId; 2]>,
    graph: impl Fn(Graph) -> Result<Vec<[VertexId; 2]>, Error>,
) -> Judgement {
    let mut random = Random::new(seed);
    let beta = [1.0 + random.unit(), 2.0, 1.0_f64.next_up(), 1.0 + nasty::power(&mut random, -60, 1000)]
        [random.below(4)];
    let k = random.below(points.len() + 2);
    let mut found = Vec::new();
    for (graph_of, expected) in [
        (Graph::SpanningTree, graphs::spanning_tree(points)),
        (Graph::RelativeNeighbors, graphs::relative_neighbors(points)),
        (Graph::Gabriel, graphs::gabriel(points)),
        (Graph::Beta(beta), graphs::beta_skeleton(points, beta)),
        (Graph::Nearest(k), graphs::nearest(points, k)),
    ] {
        let list = graph(graph_of).map_err(|error| error.to_string())?;
        let pairs = pairs(list.iter().copied());
        if pairs != expected {
            return Err(format!("{graph_of:?}: {pairs:?} instead of {expected:?}"));
        }
        if !list.is_sorted() || list.len() != pairs.len() {
            return Err(format!("{graph_of:?}: out of order: {list:?}"));
        }
        found.push(pairs);
    }
    found.truncate(3);
    found.push(pairs(edges));
    let is_nested = found.windows(2).all(|two| two[0].is_subset(&two[1]));
    if is_nested { Ok(()) } else { Err(format!("not nested: {found:?}")) }
}

fn pairs(edges: impl Iterator<Item = [VertexId; 2]>) -> Pairs {
    edges.map(|[v, w]| [v.index().min(w.index()), v.index().max(w.index())]).collect()
}
