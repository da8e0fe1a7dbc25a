//! Segments that cross are split, in rounds, until nothing crosses.
//!
//! First all edges are cut at the vertices inside of them. A round finds all crossings of the edges that there are then; rounds
//! each, computed exactly from its two edges, once to the nearest coordinates; and replaces every edge at once by the chain of
//! vertices on it, in their order. What is on an edge: the rounded crossings of it; where it passes through the cell of any
//! rounded crossing, that is through points that are rounded to it, that one; and if it is crossed itself, all vertices through
//! whose cells it passes. Without the cells, edges that nearly coincide would cross again and again: it is snap rounding on the
//! grid of all numbers.
//!
//! *It ends*: every vertex of a chain is a point of the edge, rounded, and rounding is monotone, so a chain is monotone in x and
//! in y inside of the box of its edge. With an inner vertex each link has both extents at most those of the edge, and one of
//! them less: it is shorter. Where two edges cross, the rounded point is no end of both, since they would share it, so at least
//! one of them is replaced by shorter ones. All vertices are coordinates of `f64` in the bounding box; so lengths are from a
//! finite set, and the multiset of them goes down in every round (Dershowitz & Manna, "Proving termination with multiset
//! orderings", CACM 1979). Mostly one round does it.
//!
//! *It is canonical*: a round is a function of the set of edges. Vertices of the input never move, and a chain strays from its
//! edge by at most half a unit in the last place of its coordinates in each round. Every segment keeps a chain of its own, so
//! where chains collapse on each other the number of segments on an edge, which even-odd filling counts, is right.
//!
//! Sources: Hobby, "Practical segment intersection with finite precision output", CGTA 1999; Guibas & Marimont, "Rounding
//! arrangements dynamically", IJCGA 1998.
//!
//! Cost: a round follows every edge twice through the triangulation (see `crossings` and `band`).

use std::cmp::Ordering;
use std::collections::BTreeMap;

use delone_predicates::{lexicographic, orient2d};

use super::band::Bands;
use super::crossings::{self, Crossing, Met};
use super::segments::SegmentId;
use super::{ConstraintReport2, build};
use crate::ids::VertexId;
use crate::plane::Delaunay2;
use crate::sorting;

/// Segments without crossings.
pub(super) struct Split {
    /// The points, those added last.
    pub(super) points: Vec<[f64; 2]>,
    /// The pieces of all segments, each between two vertices.
    pub(super) pieces: Vec<[VertexId; 2]>,
    /// The chains of segments that were split at a crossing.
    pub(super) bent: BTreeMap<SegmentId, Vec<VertexId>>,
    pub(super) counts: ConstraintReport2,
}

type Ends = [VertexId; 2];

fn sorted([v, w]: Ends) -> Ends {
    [v.min(w), v.max(w)]
}

/// Splits segments until nothing crosses.
pub(super) fn resolve(mut points: Vec<[f64; 2]>, segments: &[Ends]) -> Split {
    let given = points.len();
    let mut chains: Vec<Vec<VertexId>> = segments.iter().map(|ends| ends.to_vec()).collect();
    let mut is_bent = vec![false; segments.len()];
    let mut counts = ConstraintReport2::default();
    loop {
        let links = || chains.iter().flat_map(|chain| chain.windows(2).map(|w| [w[0], w[1]]));
        let mut edges: Vec<Ends> = links().map(sorted).filter(|[v, w]| v != w).collect();
        edges.sort_unstable();
        edges.dedup();
        let constrain = |points: &Vec<[f64; 2]>| {
            build::constrained(points.clone(), &build::indices(&edges), &mut ConstraintReport2::default())
        };
        let (graph, _, refused) = constrain(&points);
        let met = crossings::meet(&graph, &edges, &refused);
        if met.crossings.is_empty() {
            counts.added_points = points.len() - given;
            let pieces = links().collect();
            let bent = chains.into_iter().zip(is_bent).enumerate();
            let bent =
                bent.filter(|(_, (_, is_bent))| *is_bent).map(|(s, (chain, _))| (SegmentId::new(s), chain));
            return Split { points, pieces, bent: bent.collect(), counts };
        }
        if !met.through.is_empty() {
            // First all edges are cut at the vertices on them: which pieces a segment was given in does not show.
            let on = On::exactly(&graph, &edges, &met);
            chains.iter_mut().for_each(|chain| _ = on.extend(chain));
            continue;
        }
        counts.crossings += met.crossings.len();
        counts.rounds += 1;
        let rounded = round(&graph, &edges, &met, &mut points);
        let (graph, _, _) = constrain(&points);
        let on = On::new(&graph, &edges, &met, &rounded);
        for (chain, is_bent) in chains.iter_mut().zip(&mut is_bent) {
            *is_bent |= on.extend(chain);
        }
    }
}

/// Rounds crossings, and adds those that are no vertices yet to the points, in lexicographic order. Gives the vertex of each.
fn round(graph: &Delaunay2, edges: &[Ends], met: &Met, points: &mut Vec<[f64; 2]>) -> Vec<VertexId> {
    let place = |c: &Crossing| crossings::place(graph, edges[c.first as usize], edges[c.second as usize]);
    let places: Vec<[f64; 2]> = met.crossings.iter().map(place).collect();
    // By place: an old vertex before a new one that equals it.
    let mut known: Vec<([f64; 2], Option<VertexId>)> = places.iter().map(|&p| (p, None)).collect();
    known.extend(graph.vertices().map(|v| (graph.point(v), Some(v))));
    sorting::by(&mut known, |p, q| lexicographic(p.0, q.0).then_with(|| q.1.cmp(&p.1)));
    known.dedup_by(|later, earlier| later.0 == earlier.0);
    for (p, vertex) in &mut known {
        vertex.get_or_insert_with(|| {
            points.push(*p);
            VertexId::new(points.len() - 1)
        });
    }
    let vertex_at = |p: &[f64; 2]| {
        let at = known.binary_search_by(|entry| lexicographic(entry.0, *p));
        at.ok().and_then(|at| known[at].1).expect("a vertex now")
    };
    places.iter().map(vertex_at).collect()
}

/// A vertex inside of an edge of this round; those of an edge are in order from its lesser end.
struct On<'a> {
    graph: &'a Delaunay2,
    edges: &'a [Ends],
    inner: Vec<(u32, VertexId)>,
}

impl<'a> On<'a> {
    /// The vertices strictly inside of edges.
    fn exactly(graph: &'a Delaunay2, edges: &'a [Ends], met: &Met) -> Self {
        let on = met.through.clone();
        Self::sorted(graph, edges, on)
    }

    fn new(graph: &'a Delaunay2, edges: &'a [Ends], met: &Met, rounded: &[VertexId]) -> Self {
        let mut on: Vec<(u32, VertexId)> = Vec::new();
        let mut crosses = vec![false; edges.len()];
        for (c, &v) in met.crossings.iter().zip(rounded) {
            for e in [c.first, c.second] {
                crosses[e as usize] = true;
                on.push((e, v));
            }
        }
        // That a segment goes through the cells of its own crossings is known.
        on.sort_unstable();
        let own = on.clone();
        let mut hot = rounded.to_vec();
        hot.sort_unstable();
        let mut places: Vec<[f64; 2]> = hot.iter().map(|&v| graph.point(v)).collect();
        sorting::by(&mut places, |p, q| lexicographic(*p, *q));
        let is_near = |ends: Ends| {
            let [a, b] = ends.map(|v| graph.point(v));
            let start = places.partition_point(|p| p[0] < a[0].min(b[0]));
            let in_range = places[start..].iter().take_while(|p| p[0] <= a[0].max(b[0]));
            in_range.into_iter().any(|p| a[1].min(b[1]) <= p[1] && p[1] <= a[1].max(b[1]))
        };
        // Nothing else can be on an edge that is not crossed and has no rounded crossing in its box.
        let looked_at = edges.iter().enumerate().filter(|&(e, &ends)| crosses[e] || is_near(ends));
        let mut bands = Bands::new(graph);
        for (e, &ends) in looked_at {
            let is_own = |v: &VertexId| own.binary_search(&(e as u32, *v)).is_ok();
            let is_wanted = |v: &VertexId| !is_own(v) && (crosses[e] || hot.binary_search(v).is_ok());
            on.extend(bands.touched(ends, is_wanted).into_iter().map(|v| (e as u32, v)));
        }
        Self::sorted(graph, edges, on)
    }

    fn sorted(graph: &'a Delaunay2, edges: &'a [Ends], mut on: Vec<(u32, VertexId)>) -> Self {
        on.retain(|&(e, v)| !edges[e as usize].contains(&v));
        let along = |e: u32, v: VertexId, w: VertexId| {
            let [a, b] = edges[e as usize].map(|v| graph.point(v));
            let (p, q) = (graph.point(v), graph.point(w));
            let axis = |k: usize| {
                let order = p[k].total_cmp(&q[k]);
                if p[k] == q[k] {
                    Ordering::Equal
                } else if b[k] < a[k] {
                    order.reverse()
                } else {
                    order
                }
            };
            axis(0).then_with(|| axis(1))
        };
        sorting::by(&mut on, |p, q| p.0.cmp(&q.0).then_with(|| along(p.0, p.1, q.1)));
        on.dedup();
        Self { graph, edges, inner: on }
    }

    /// Whether a vertex is off the line of its edge.
    fn is_off(&self, (e, v): (u32, VertexId)) -> bool {
        let [a, b] = self.edges[e as usize].map(|v| self.graph.point(v));
        !orient2d(a, b, self.graph.point(v)).is_zero()
    }

    /// Replaces each link of a chain. Returns whether it bends anywhere.
    fn extend(&self, chain: &mut Vec<VertexId>) -> bool {
        let mut is_bent = false;
        let mut longer = vec![chain[0]];
        for link in chain.windows(2) {
            let ends = [link[0], link[1]];
            if let Ok(e) = self.edges.binary_search(&sorted(ends)) {
                let start = self.inner.partition_point(|on| (on.0 as usize) < e);
                let end = self.inner.partition_point(|on| (on.0 as usize) <= e);
                let inner = &self.inner[start..end];
                is_bent = is_bent || inner.iter().any(|&on| self.is_off(on));
                if ends[0] < ends[1] {
                    longer.extend(inner.iter().map(|on| on.1));
                } else {
                    longer.extend(inner.iter().rev().map(|on| on.1));
                }
            }
            longer.push(ends[1]);
        }
        *chain = longer;
        is_bent
    }
}
