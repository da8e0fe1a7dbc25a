//! Proximity graphs of the vertices: who is a neighbor of whom, by what is near an edge.
//!
//! On every set the spanning tree is part of the relative neighbors, these of the Gabriel graph, and that of the Delaunay
//! triangulation, because of what is open and what is closed: a vertex on the border of the disk with diameter ab is strictly
//! inside of the lune. So each is a function of the set alone, where both diagonals of a square would be edges of a Gabriel
//! graph with open disks, and no triangulation has both.
//!
//! Sources: Gabriel and Sokal 1969; Toussaint, "The relative neighborhood graph of a finite planar set", 1980, which
//! proves the inclusions in general position; Kirkpatrick and Radke 1985 for lunes of any size. A file each: `gabriel`,
//! `lunes` (what is inside of any lune), `tree`, `nearest`; `net` holds who is joined with whom.

mod gabriel;
mod lunes;
mod nearest;
mod net;
mod tree;

use std::cell::OnceCell;
use std::ops::Range;

use crate::error::Error;
use crate::ids::{Place, VertexId};
use crate::locate::nearest::Metric;
use crate::parallel;
#[cfg(test)]
pub(crate) use lunes::looks;
pub(crate) use net::Net;

/// A proximity graph of the vertices of a triangulation; in space disks are balls. For [`Delaunay2::graph`] and
/// [`Delaunay3::graph`].
///
/// Tree, relative neighbors, lunes from 2 down, Gabriel graph, Delaunay triangulation: each is part of the next, on every set.
///
/// [`Delaunay2::graph`]: crate::Delaunay2::graph
/// [`Delaunay3::graph`]: crate::Delaunay3::graph
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Graph {
    /// Pairs whose closed disk with both on a diameter holds no other vertex. O(n) in the plane.
    Gabriel,
    /// Pairs to which no vertex is nearer, strictly and from both, than they are to each other. After the Gabriel graph a
    /// search an edge of the vertices around its lune: O(n) on evenly spread points, O(n log n) on rows along the axes, O(n^2) where many
    /// vertices are on the borders of many lunes, or nearly.
    RelativeNeighbors,
    /// The Euclidean minimum spanning tree: pairs by length, and those of one length by the positions of the
    /// lexicographically smaller end and then of the other; each that closes no ring is in. O(n log n) after the Gabriel graph.
    SpanningTree,
    /// The skeleton of lunes: pairs whose lune holds no other vertex, the meeting of two disks of radius beta/2 times the
    /// distance, each with one of both on its border and its center on the ray from there through the other one.
    ///
    /// Beta is at least 1: below, a skeleton has edges that the triangulation has not. For 1 the lune is the disk with both on
    /// a diameter, and closed: the Gabriel graph. Above 1 it is open: 2 gives the relative neighbors, and a larger beta part of the
    /// edges of a smaller one. Cost as for these; with beta the lunes reach further.
    Beta(f64),
    /// Pairs of which one is among so many vertices nearest to the other. Of equally near ones the lexicographically smaller are
    /// taken, as everywhere. O(n k log k) on evenly spread points.
    Nearest(usize),
}

/// A triangulation as proximity graphs see it.
pub(crate) trait Sites<const D: usize>: Metric<Point = [f64; D]> + Sync {
    /// The coordinates, by place.
    fn points(&self) -> &[[f64; D]];

    /// The places in use, so that what is near each other is mostly near in the list.
    fn along_curve(&self) -> Vec<Place> {
        self.inhabited().collect()
    }

    /// The edges of the Gabriel graph, in no special order; of the net, which is made at the first call, if need be.
    fn gabriel<'a>(&self, net: &dyn Fn() -> &'a Net<D>) -> Vec<[Place; 2]> {
        gabriel::edges(net())
    }
}

/// The edges of a graph, each once.
pub(crate) fn edges<const D: usize>(sites: &impl Sites<D>, graph: Graph) -> Result<Vec<[Place; 2]>, Error> {
    if let Graph::Beta(beta) = graph
        && !(beta >= 1.0 && beta.is_finite())
    {
        return Err(Error::Parameter { name: "beta", value: beta, range: "from 1 on, and finite" });
    }
    let made = OnceCell::new();
    let net = || made.get_or_init(|| Net::of(sites));
    let gabriel = || sites.gabriel(&net);
    let lunes = |beta: f64| lunes::edges(net(), &gabriel(), beta);
    Ok(match graph {
        Graph::Beta(beta) if beta > 1.0 => lunes(beta),
        Graph::Gabriel | Graph::Beta(_) => gabriel(),
        Graph::RelativeNeighbors => lunes(2.0),
        Graph::SpanningTree => tree::edges(sites.points(), gabriel()),
        Graph::Nearest(k) => nearest::edges(net(), k),
    })
}

/// Pairs of places by the names of what is there, below `ids`: each from the smaller to the larger, sorted, none twice.
///
/// Pairs are put to their smaller ends, of which each thread has a range; then there is little to sort. O(n).
pub(crate) fn named(
    pairs: Vec<[Place; 2]>,
    ids: usize,
    name: impl Fn(Place) -> VertexId + Send + Sync,
) -> Vec<[VertexId; 2]> {
    let named = parallel::collect(pairs.len(), |i| {
        let [v, w] = pairs[i].map(&name);
        [v.min(w), v.max(w)]
    });
    drop(pairs);
    let ends =
        parallel::even_ends(ids, if parallel::parts(named.len()) > 1 { parallel::threads() } else { 1 });
    let starts = std::iter::once(0).chain(ends.iter().copied());
    let mut lists = parallel::map(starts.zip(&ends).collect(), |(from, &to)| sorted(&named, from..to));
    if lists.len() > 1 { lists.concat() } else { lists.pop().unwrap_or_default() }
}

/// The pairs whose smaller end is in a range, sorted, none twice.
fn sorted(pairs: &[[VertexId; 2]], range: Range<usize>) -> Vec<[VertexId; 2]> {
    let within = || pairs.iter().filter(|[v, _]| range.contains(&v.index()));
    // Where the other ends of each begin, and when all are there, where they end.
    let mut places = vec![0_usize; range.len() + 1];
    within().for_each(|[v, _]| places[v.index() - range.start + 1] += 1);
    let mut sum = 0;
    for place in &mut places {
        sum += *place;
        *place = sum;
    }
    let mut others = vec![VertexId::GHOST; sum];
    for [v, w] in within() {
        let place = &mut places[v.index() - range.start];
        others[*place] = *w;
        *place += 1;
    }
    let (mut sorted, mut from) = (Vec::with_capacity(sum), 0);
    for (v, to) in range.map(VertexId::new).zip(places) {
        let others = &mut others[std::mem::replace(&mut from, to)..to];
        others.sort_unstable();
        for (k, &w) in others.iter().enumerate() {
            if k == 0 || others[k - 1] != w {
                sorted.push([v, w]);
            }
        }
    }
    sorted
}
