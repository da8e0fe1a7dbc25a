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
//! Cost: a round follows every edge that is crossed through the triangulation (see `crossings`), searches for the vertices near every
//! edge (see `cells`), and triangulates anew.

use std::collections::BTreeMap;

use delone_predicates::{lexicographic, orient2d, segment_rounds_to};

use super::cells::Cells;
use super::crossings::{self, Met};
use super::segments::SegmentId;
use super::{ConstraintReport2, build};
use crate::ids::VertexId;
use crate::parallel;
use crate::plane::Delaunay2;

/// Segments without crossings.
pub(super) struct Split {
    /// The points, those added last, with the pieces of all segments as constraints.
    pub(super) graph: Delaunay2,
    /// The chains of segments that were split at a crossing.
    pub(super) bent: BTreeMap<SegmentId, Vec<VertexId>>,
    pub(super) report: ConstraintReport2,
}

type Ends = [VertexId; 2];

fn sorted([v, w]: Ends) -> Ends {
    [v.min(w), v.max(w)]
}

/// Splits segments until nothing crosses. Those that are not refused are constraints of the triangulation.
pub(super) fn resolve(mut graph: Delaunay2, segments: &[Ends], mut refused: Vec<u32>) -> Split {
    let given = graph.points().len();
    let mut chains: Vec<Vec<VertexId>> = segments.iter().map(|ends| ends.to_vec()).collect();
    let mut pieces = segments.to_vec();
    let mut is_bent = vec![false; segments.len()];
    let (mut crossing_count, mut rounds) = (0, 0);
    let mut report = ConstraintReport2::default();
    while !refused.is_empty() {
        let edges = sorted_and_distinct(pieces.iter().copied().map(sorted).filter(|[v, w]| v != w));
        let edge = |&s: &u32| edges.binary_search(&sorted(pieces[s as usize])).expect("an edge") as u32;
        let met = crossings::meet(&graph, &edges, &sorted_and_distinct(refused.iter().map(edge)));
        let mut points = graph.points().to_vec();
        let on = if met.through.is_empty() {
            crossing_count += met.crossings.len();
            rounds += 1;
            let rounded = round(&graph, &edges, &met, &mut points);
            On::rounded(&graph, &points, &edges, &met, &rounded)
        } else {
            // First all edges are cut at the vertices on them: which pieces a segment was given in does not show.
            On::sorted(&points, &edges, met.through)
        };
        drop(graph);
        for (chain, is_bent) in chains.iter_mut().zip(&mut is_bent) {
            *is_bent |= on.extend(chain);
        }
        pieces = chains.iter().flat_map(|chain| chain.windows(2).map(|w| [w[0], w[1]])).collect();
        report = ConstraintReport2::default();
        (graph, _, refused) = build::constrained(points, &build::indices(&pieces), &mut report);
    }
    report.crossings = crossing_count;
    report.rounds = rounds;
    report.added_points = graph.points().len() - given;
    let bent = chains.into_iter().zip(is_bent).enumerate().filter(|(_, (_, is_bent))| *is_bent);
    Split { graph, bent: bent.map(|(s, (chain, _))| (SegmentId::new(s), chain)).collect(), report }
}

fn sorted_and_distinct<T: Ord>(items: impl Iterator<Item = T>) -> Vec<T> {
    let mut items: Vec<T> = items.collect();
    items.sort_unstable();
    items.dedup();
    items
}

/// Rounds crossings, and adds those that are no vertices yet to the points, in lexicographic order. Gives the vertex of each.
fn round(graph: &Delaunay2, edges: &[Ends], met: &Met, points: &mut Vec<[f64; 2]>) -> Vec<VertexId> {
    let (given, count) = (points.len(), met.crossings.len());
    let segment = |e: u32| edges[e as usize].map(|v| points[v.index()]);
    let place =
        |i: usize| crossings::place(segment(met.crossings[i].first), segment(met.crossings[i].second));
    let places: Vec<[f64; 2]> = parallel::collect(count, place);
    // By place: an old vertex before what equals it.
    let mut known: Vec<([f64; 2], usize)> = graph.vertices().map(|v| (graph.point(v), v.index())).collect();
    known.extend(places.into_iter().zip(given..));
    known.sort_unstable_by(|p, q| lexicographic(p.0, q.0).then(p.1.cmp(&q.1)));
    let mut rounded = vec![VertexId::GHOST; count];
    for at_one in known.chunk_by(|p, q| p.0 == q.0) {
        let (place, mut vertex) = at_one[0];
        if vertex >= given {
            vertex = points.len();
            points.push(place);
        }
        for crossing in at_one.iter().filter_map(|&(_, number)| number.checked_sub(given)) {
            rounded[crossing] = VertexId::new(vertex);
        }
    }
    rounded
}

/// A vertex inside of an edge of this round; those of an edge are in order from its lesser end.
struct On<'a> {
    points: &'a [[f64; 2]],
    edges: &'a [Ends],
    inner: Vec<(u32, VertexId)>,
}

impl<'a> On<'a> {
    /// The vertices through whose cells edges pass, if the edge is crossed or the vertex is a rounded crossing.
    fn rounded(
        graph: &Delaunay2,
        points: &'a [[f64; 2]],
        edges: &'a [Ends],
        met: &Met,
        rounded: &[VertexId],
    ) -> Self {
        let both = met.crossings.iter().zip(rounded).flat_map(|(c, &v)| [(c.first, v), (c.second, v)]);
        let crossed_at = sorted_and_distinct(both);
        let named = |v: VertexId| (points[v.index()], v);
        let hot = sorted_and_distinct(rounded.iter().copied());
        let mut hot = Cells::new(hot.into_iter().map(named).collect());
        let mut old = Cells::new(graph.vertices().map(named).collect());
        // That an edge goes through the cells of its own crossings is known.
        let mut last_crossed = vec![u32::MAX; points.len()];
        let (mut on, mut rest) = (Vec::new(), &crossed_at[..]);
        for (e, &ends) in (0..).zip(edges) {
            let (own, later) = rest.split_at(rest.iter().take_while(|on| on.0 == e).count());
            rest = later;
            own.iter().for_each(|on| last_crossed[on.1.index()] = e);
            let [a, b] = ends.map(|v| points[v.index()]);
            let mut each = |&(p, v): &([f64; 2], VertexId)| {
                if last_crossed[v.index()] != e && segment_rounds_to(a, b, p) {
                    on.push((e, v));
                }
            };
            hot.each_near([a, b], &mut each);
            if !own.is_empty() {
                old.each_near([a, b], &mut each);
            }
        }
        on.extend(crossed_at);
        Self::sorted(points, edges, on)
    }

    fn sorted(points: &'a [[f64; 2]], edges: &'a [Ends], on: Vec<(u32, VertexId)>) -> Self {
        let inside = on.into_iter().filter(|&(e, v)| !edges[e as usize].contains(&v));
        let mut inner = sorted_and_distinct(inside);
        for of_one in inner.chunk_by_mut(|p, q| p.0 == q.0) {
            let [a, b] = edges[of_one[0].0 as usize].map(|v| points[v.index()]);
            let along = |v: VertexId| {
                let p = points[v.index()];
                [0, 1].map(|k| if b[k] < a[k] { -p[k] } else { p[k] })
            };
            of_one.sort_unstable_by(|p, q| lexicographic(along(p.1), along(q.1)));
        }
        Self { points, edges, inner }
    }

    /// Whether a vertex is off the line of its edge.
    fn is_off(&self, (e, v): (u32, VertexId)) -> bool {
        let [a, b] = self.edges[e as usize].map(|v| self.points[v.index()]);
        !orient2d(a, b, self.points[v.index()]).is_zero()
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
