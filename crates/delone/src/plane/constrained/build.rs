//! Points and segments to a constrained triangulation.
//!
//! The points first, by divide and conquer on all threads. Segments that are edges already are found on all threads and
//! fixed; the rest is forced in biased random rounds, each along a curve, so that k segments in n points take O(n log n + n
//! log^2 k) expected whatever they are.
//!
//! Source of the order: Shewchuk & Brown, CGTA 2015; Agarwal, Arge & Yi, "I/O-efficient construction of constrained Delaunay
//! triangulations", ESA 2005. A walk that begins at the end with fewer triangles makes hubs linear.

use std::collections::BTreeMap;
use std::sync::OnceLock;

use super::crossings::{self, Crossing};
use super::segments::{SegmentId, Segments};
use super::{Constrained2, ConstraintReport2, split};
use crate::error::Error;
use crate::ids::{EdgeId, MAX_POINTS, VertexId};
use crate::mesh::triangles::channel::Channel;
use crate::order::plane::insertion_order;
use crate::parallel;
use crate::plane::Delaunay2;
use crate::plane::layer::Layer;
use crate::points::{Position2, check_count};
use crate::prefetch::prefetch;

/// What happens where two segments cross.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Crossings {
    /// It is an error: a crossing may be a mistake in the data, and to split it moves geometry a little.
    #[default]
    Refuse,
    /// All that cross are split at the crossing, computed exactly and rounded once to the nearest coordinates, in rounds
    /// until nothing crosses. Vertices of the input stay where they are; the result is a function of the set of points and of
    /// the union of the segments.
    Split,
}

/// Seed of the order of segments; the result does not depend on it.
const ANY_SEED: u64 = 1;
/// Segments ahead whose ends are asked of memory, and whose stars then.
const AHEAD: [usize; 2] = [16, 8];

impl Constrained2 {
    /// The triangulation of no points.
    pub fn new() -> Self {
        Self::default()
    }

    /// Triangulates points and segments between them, given by the indices of their ends.
    ///
    /// O(n log n + n log^2 k) expected for n points and k segments; some 110 bytes a point above the input.
    ///
    /// # Errors
    /// [`Error::SegmentsCross`] if two segments cross at no vertex, [`Error::NoSuchPoint`] for an index that is none,
    /// [`Error::NotFinite`] and [`Error::TooManyPoints`] as [`Delaunay2::from_points`].
    pub fn from_parts<P: Position2>(points: &[P], segments: &[[usize; 2]]) -> Result<Self, Error> {
        Self::with_crossings(points, segments, Crossings::Refuse)
    }

    /// Triangulates points and segments, with a choice of what happens where segments cross.
    ///
    /// # Errors
    /// As [`Self::from_parts`]; segments that cross are none with [`Crossings::Split`].
    ///
    /// ```
    /// use delone::{Constrained2, Crossings};
    ///
    /// let (points, segments) = ([[0, 0], [2, 2], [0, 2], [2, 0]], [[0, 1], [2, 3]]);
    /// assert!(Constrained2::from_parts(&points, &segments).is_err());
    /// let c = Constrained2::with_crossings(&points, &segments, Crossings::Split)?;
    /// assert_eq!(c.points()[4], [1.0, 1.0]);
    /// assert_eq!(c.constraints().count(), 4);
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn with_crossings<P: Position2>(
        points: &[P],
        segments: &[[usize; 2]],
        crossings: Crossings,
    ) -> Result<Self, Error> {
        check_count(points.len(), MAX_POINTS)?;
        Self::assemble(parallel::collect(points.len(), |i| points[i].xy()), segments, crossings)
    }

    /// The same with coordinates that it may keep.
    pub(in crate::plane) fn assemble(
        points: Vec<[f64; 2]>,
        segments: &[[usize; 2]],
        crossings: Crossings,
    ) -> Result<Self, Error> {
        check_count(segments.len(), MAX_POINTS)?;
        let count = points.len();
        for (segment, ends) in segments.iter().enumerate() {
            if let Some(&index) = ends.iter().find(|&&index| index >= count) {
                return Err(Error::NoSuchPoint { segment, index, count });
            }
        }
        let mut graph = Delaunay2::from_vec(points)?;
        let ends = vertices(&graph, segments);
        let mut report = ConstraintReport2::default();
        let mut bent = BTreeMap::new();
        if constrain(&mut graph, &ends, &mut report).is_err() {
            if crossings == Crossings::Refuse {
                return Err(refusal(&graph, &ends));
            }
            let split = split::resolve(graph, &ends)?;
            (graph, bent, report) = (split.graph, split.bent, split.counts);
            let built = constrain(&mut graph, &split.pieces, &mut report);
            debug_assert!(built.is_ok(), "nothing crosses any more");
        }
        let mut c = Self {
            graph,
            segments: Segments::new(ends, bent),
            cover: OnceLock::new(),
            report,
            channel: Channel::default(),
        };
        c.count_overlaps();
        Ok(c)
    }

    /// Completes the report.
    fn count_overlaps(&mut self) {
        let mut distinct: Vec<[VertexId; 2]> =
            self.segments.iter().map(|(_, [v, w])| [v.min(w), v.max(w)]).collect();
        self.report.zero_length = self.segments.len() - distinct.len();
        if self.report.repeated == 0 {
            return; // no edge was fixed twice
        }
        let all = distinct.len();
        distinct.sort_unstable();
        distinct.dedup();
        self.report.repeated = all - distinct.len();
        let mut overlapping = vec![false; self.segments.len()];
        let ends = |s: SegmentId| self.segments.ends(s).map(|[v, w]| [v.min(w), v.max(w)]);
        let cover = self.cover();
        for edge in cover.edges() {
            let covering = cover.of(*edge);
            let first = covering[0].segment;
            if covering.iter().any(|c| ends(c.segment) != ends(first)) {
                covering.iter().for_each(|c| overlapping[c.segment.index()] = true);
            }
        }
        self.report.overlapping = overlapping.iter().filter(|&&overlaps| overlaps).count();
    }
}

/// The ends of segments as vertices.
fn vertices(graph: &Delaunay2, segments: &[[usize; 2]]) -> Vec<[VertexId; 2]> {
    let duplicates: Vec<_> = graph.duplicates().collect();
    let vertex = |i: usize| {
        let found = duplicates.binary_search_by_key(&i, |d| d.point);
        found.map_or(VertexId::new(i), |at| duplicates[at].vertex)
    };
    parallel::collect(segments.len(), |s| segments[s].map(vertex))
}

/// Makes segments constraints of a triangulation in which places are indices. A constraint that is crossed is the error.
/// Whether any edge was fixed twice is put into the report as repetition.
fn constrain(
    graph: &mut Delaunay2,
    segments: &[[VertexId; 2]],
    report: &mut ConstraintReport2,
) -> Result<(), EdgeId> {
    let rest = fix_edges(&mut graph.base, segments, report);
    let middle = |&s: &u32| {
        let [p, q] = segments[s as usize].map(|v| graph.base.points[v.index()]);
        [0, 1].map(|k| p[k] / 2.0 + q[k] / 2.0)
    };
    let middles: Vec<[f64; 2]> = rest.iter().map(middle).collect();
    let mut channel = Channel::default();
    for i in insertion_order(&middles, ANY_SEED) {
        let ends = segments[rest[i as usize] as usize].map(VertexId::same);
        let forced = graph.base.force(ends, &mut channel, |_, _| {})?;
        report.repeated += usize::from(forced.overlaps);
        report.through_vertices += usize::from(forced.through > 0);
    }
    Ok(())
}

/// Fixes the segments that are edges, and returns the others.
fn fix_edges(layer: &mut Layer, segments: &[[VertexId; 2]], report: &mut ConstraintReport2) -> Vec<u32> {
    let ends = parallel::even_ends(segments.len(), parallel::parts(segments.len()));
    let starts = std::iter::once(0).chain(ends.iter().copied());
    let runs = starts.zip(ends.iter().copied()).map(|(start, end)| start..end).collect();
    let found = parallel::map(runs, |run: std::ops::Range<usize>| {
        let mesh = &layer.mesh;
        let edge = |s: usize| {
            if let Some(&[a, _]) = segments.get(s + AHEAD[0]) {
                prefetch(&mesh.incident, a.index());
            }
            if let Some(&[a, _]) = segments.get(s + AHEAD[1]) {
                prefetch(&mesh.edges, mesh.incident[a.index()].index());
            }
            let [a, b] = segments[s].map(VertexId::same);
            if a == b { None } else { Some(mesh.edge_between(a, b).unwrap_or(EdgeId::NONE)) }
        };
        run.map(edge).collect::<Vec<Option<EdgeId>>>()
    });
    let mut rest = Vec::new();
    for (s, edge) in found.into_iter().flatten().enumerate() {
        match edge {
            None => {}
            Some(EdgeId::NONE) => rest.push(s as u32),
            Some(e) => {
                report.repeated += usize::from(layer.mesh.is_fixed(e));
                layer.mesh.set_fixed(e, true);
            }
        }
    }
    rest
}

/// The error that names the first of all crossings: by the points, so that it does not depend on the order of the input.
fn refusal(graph: &Delaunay2, segments: &[[VertexId; 2]]) -> Error {
    let found = crossings::between(graph, segments);
    let point = |v: VertexId| graph.points()[v.index()];
    let key = |s: u32| {
        let [v, w] = segments[s as usize].map(point);
        if v <= w { [v, w] } else { [w, v] }
    };
    let keys = |c: &Crossing| {
        let [first, second] = [key(c.first), key(c.second)];
        if first <= second { [first, second] } else { [second, first] }
    };
    let less = |a: &&Crossing, b: &&Crossing| {
        keys(a).partial_cmp(&keys(b)).expect("finite").then((a.first, a.second).cmp(&(b.first, b.second)))
    };
    let first = found.iter().min_by(less).expect("one was found");
    let near = crossings::place(graph, segments[first.first as usize], segments[first.second as usize]);
    Error::SegmentsCross {
        first: first.first as usize,
        second: first.second as usize,
        near,
        count: found.len(),
    }
}
