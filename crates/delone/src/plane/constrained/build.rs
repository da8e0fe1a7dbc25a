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
use super::force::Laid;
use super::overlaps::{Overlaps, sorted};
use super::segments::Segments;
use super::{Constrained2, ConstraintReport2, split};
use crate::error::Error;
use crate::ids::{EdgeId, MAX_POINTS, Place, VertexId};
use crate::mesh::Mesh2;
use crate::mesh::triangles::channel::Channel;
use crate::order::plane::deal;
use crate::parallel;
use crate::plane::layer::Layer;
use crate::plane::{Delaunay2, construct};
use crate::points::{Position2, check_count, check_finite};
use crate::prefetch::prefetch;
use crate::sorting;

/// The treatment of two segments that cross.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Crossings {
    /// It is an error: a crossing may be a mistake in the data, and to split it moves geometry a little.
    #[default]
    Refuse,
    /// All that cross are split at the crossing, computed exactly and rounded once to the nearest coordinates, in rounds
    /// until nothing crosses. Vertices of the input stay where they are; the result is a function of the set of points and of
    /// the union of the segments.
    Split,
}

/// The ends of a segment, and its number.
type Numbered = ([Place; 2], u32);

/// Seed of the order of segments; the result does not depend on it.
const ANY_SEED: u64 = 1;
/// Segments between the one that is inserted and those whose ends, and whose stars, are prefetched.
const PREFETCH_DISTANCES: [usize; 2] = [16, 8];
/// Positions that are asked for along with an end.
const WINDOW: usize = 256;

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
    ///
    /// ```
    /// use delone::Constrained2;
    ///
    /// let points = [[0, 0], [4, 0], [4, 4], [0, 4], [1, 2]];
    /// let c = Constrained2::from_parts(&points, &[[0, 2]])?; // a segment by the indices of its ends
    /// assert_eq!(c.constraints().count(), 1);
    /// assert!(Constrained2::from_parts(&points, &[[0, 2], [1, 3]]).is_err()); // these cross
    /// # Ok::<(), delone::Error>(())
    /// ```
    #[doc(alias = "bulk_load_cdt")]
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

    /// Constructs the triangulation from coordinates that it may keep.
    pub(in crate::plane) fn assemble(
        points: Vec<[f64; 2]>,
        segments: &[[usize; 2]],
        crossings: Crossings,
    ) -> Result<Self, Error> {
        check_count(segments.len(), MAX_POINTS)?;
        let mut report = ConstraintReport2::default();
        let count = points.len();
        for (segment, ends) in segments.iter().enumerate() {
            if let Some(&index) = ends.iter().find(|&&index| index >= count) {
                return Err(Error::NoSuchPoint { segment, index, count });
            }
        }
        check_finite(points.iter().copied())?;
        let (mut graph, ends, refused) = constrained(points, segments, &mut report);
        let mut bent = BTreeMap::new();
        if !refused.is_empty() {
            if crossings == Crossings::Refuse {
                return Err(refusal(&graph, &ends, &refused));
            }
            let split = split::resolve(graph, &ends, refused);
            (graph, bent, report) = (split.graph, split.bent, split.report);
        }
        Ok(Self::of(graph, Segments::new(ends, bent), report))
    }

    /// Triangulates finite points and segments between them; `None` if some cross, without a search for which.
    pub(crate) fn if_uncrossed(points: Vec<[f64; 2]>, segments: &[[usize; 2]]) -> Option<Self> {
        let mut report = ConstraintReport2::default();
        let (graph, ends, refused) = constrained(points, segments, &mut report);
        refused.is_empty().then(|| Self::of(graph, Segments::new(ends, BTreeMap::new()), report))
    }

    fn of(graph: Delaunay2, segments: Segments, report: ConstraintReport2) -> Self {
        Self {
            graph,
            segments,
            cover: OnceLock::new(),
            has_chains: report.through_vertices > 0 || report.rounds > 0,
            report,
            channel: Channel::default(),
        }
    }
}

/// The ends of segments as indices of points.
pub(super) fn indices(segments: &[[VertexId; 2]]) -> Vec<[usize; 2]> {
    segments.iter().map(|ends| ends.map(VertexId::index)).collect()
}

/// Triangulates points and makes segments constraints, but for those that cross one before them: these are refused. Gives the
/// ends of all segments as vertices too, and which are refused, in increasing order.
///
/// Until the end vertices are at their positions in Morton order, where their neighbors are near them in memory.
pub(super) fn constrained(
    points: Vec<[f64; 2]>,
    segments: &[[usize; 2]],
    report: &mut ConstraintReport2,
) -> (Delaunay2, Vec<[VertexId; 2]>, Vec<u32>) {
    let mut ordered = construct::in_order(&points);
    let positions = ordered.positions(points.len());
    let ends: Vec<[Place; 2]> = parallel::collect(segments.len(), |s| segments[s].map(|i| positions[i]));
    let mut layer = Layer::new(
        std::mem::replace(&mut ordered.mesh, Mesh2::empty(0)),
        std::mem::take(&mut ordered.points),
    );
    let refused = constrain(&mut layer, &ends, report);
    let index = |place: Place| VertexId::new(ordered.indices[place.index()] as usize);
    let ends = ends.into_iter().map(|ends| ends.map(index)).collect();
    ordered.mesh = layer.mesh;
    (Delaunay2::assemble(ordered.numbered(points)), ends, refused)
}

/// Makes segments constraints, but for those that cross one before them, which are returned in increasing order. Completes the
/// report.
pub(super) fn constrain(
    layer: &mut Layer,
    segments: &[[Place; 2]],
    report: &mut ConstraintReport2,
) -> Vec<u32> {
    let mut overlaps = Overlaps::default();
    let numbered = segments.iter().copied().zip(0..).filter(|(ends, _)| ends[0] != ends[1]);
    let mut rest: Vec<Numbered> = numbered.collect();
    report.zero_length = segments.len() - rest.len();
    let is_near = are_near(segments, layer.points.len());
    if !is_near {
        in_rounds(&mut rest);
    }
    if are_edges(layer, &rest) {
        rest = fix_edges(layer, &rest, &mut overlaps);
    }
    if is_near {
        in_rounds(&mut rest);
    }
    let mut channel = Channel::default();
    let mut refused = Vec::new();
    let mut met = Met::default();
    let mut ahead = Ahead::new(&rest);
    // The last segment, and what became of it: the same once more needs no look at its ends, which may be hubs.
    let mut last = ([Place::GHOST; 2], Became::Chain);
    for (i, &(ends, s)) in rest.iter().enumerate() {
        ahead.ways(layer, i);
        match last {
            (before, Became::Edge) if before == sorted(ends) => {
                overlaps.share(ends);
                continue;
            }
            (before, Became::Refused) if before == sorted(ends) => {
                refused.push(s);
                continue;
            }
            _ => {}
        }
        met.fresh.clear();
        met.fixed.clear();
        if lay_all(layer, ends, &mut channel, &mut overlaps, &mut met).is_err() {
            // What was fixed before it met the constraint is free again. Nobody needs that to be Delaunay.
            for &[a, b] in &met.fresh {
                let e = layer.mesh.edge_between(a, b);
                e.into_iter().for_each(|e| layer.mesh.set_fixed(e, false));
            }
            refused.push(s);
            last = (sorted(ends), Became::Refused);
            continue;
        }
        last = (sorted(ends), Became::Edge);
        met.fixed.iter().for_each(|&edge| overlaps.share(edge));
        let edges = met.fresh.iter().chain(&met.fixed);
        if edges.clone().all(|&[v, w]| [v, w] != ends && [w, v] != ends) {
            overlaps.add(&layer.points, s, ends, edges.copied());
            last.1 = Became::Chain;
        }
    }
    refused.sort_unstable();
    report.through_vertices = overlaps.through_vertices();
    overlaps.count(&layer.points, segments, report);
    refused
}

/// The outcome for a segment.
#[derive(Clone, Copy)]
enum Became {
    Edge,
    Chain,
    Refused,
}

/// The edges that a segment met, by their ends.
#[derive(Default)]
struct Met {
    fresh: Vec<[Place; 2]>,
    /// Constraints before; of a run the first and the last.
    fixed: Vec<[Place; 2]>,
}

/// Makes a segment a chain of fixed edges.
///
/// # Errors
/// A fixed edge that it crosses.
fn lay_all(
    layer: &mut Layer,
    [mut a, mut b]: [Place; 2],
    channel: &mut Channel,
    overlaps: &mut Overlaps,
    met: &mut Met,
) -> Result<(), EdgeId> {
    while a != b {
        let Laid { e, at_second, is_new } = layer.lay([a, b], channel)?;
        let edge = [layer.mesh.tail(e), layer.mesh.head(e)];
        (if is_new { &mut met.fresh } else { &mut met.fixed }).push(edge);
        let (near, far) = if at_second { (&mut b, a) } else { (&mut a, b) };
        let skipped = if is_new { None } else { overlaps.skip(&layer.points, edge, [*near, far]) };
        *near = skipped.unwrap_or(edge[1]);
    }
    Ok(())
}

/// Puts segments in a biased random order, each round by where the ends are in memory.
fn in_rounds(segments: &mut [Numbered]) {
    deal(segments, ANY_SEED, |round| sorting::by_key(round, |&(ends, s)| (sorted(ends), s)));
}

/// Whether half of some segments are edges, as far as a sample tells.
fn are_edges(layer: &Layer, segments: &[Numbered]) -> bool {
    const SAMPLE: usize = 256;
    let sample = segments.iter().step_by(segments.len() / SAMPLE + 1);
    let is_edge = |([a, b], _): &&Numbered| layer.mesh.edge_between(*a, *b).is_some();
    2 * sample.clone().filter(is_edge).count() >= sample.len()
}

/// Whether segments that follow each other are mostly near each other in memory, as along a polygon.
fn are_near(segments: &[[Place; 2]], places: usize) -> bool {
    const SAMPLE: usize = 1000;
    let step = segments.len() / SAMPLE + 1;
    let pairs = segments.windows(2).step_by(step).map(|w| w[0][0].index().abs_diff(w[1][0].index()));
    let far = pairs.filter(|&distance| distance > places / 64).count();
    10 * far * step < segments.len() || segments.len() < SAMPLE
}

/// Asks memory for what segments further on will read: the beginnings of their ends' stars, and what is at the positions from
/// their first ends on, which are mostly near the whole way.
struct Ahead<'a> {
    segments: &'a [Numbered],
    /// The positions before this one have been asked for.
    asked: usize,
}

impl<'a> Ahead<'a> {
    fn new(segments: &'a [Numbered]) -> Self {
        Self { segments, asked: 0 }
    }

    /// Where the ends of a segment are, if it is one.
    fn ends(&self, i: usize) -> Option<[usize; 2]> {
        self.segments.get(i).map(|(ends, _)| ends.map(Place::index))
    }

    /// Before segment `i` is looked at.
    #[inline]
    fn stars(&self, mesh: &Mesh2, i: usize) {
        for end in self.ends(i + PREFETCH_DISTANCES[0]).into_iter().flatten() {
            prefetch(&mesh.incident, end);
        }
        for end in self.ends(i + PREFETCH_DISTANCES[1]).into_iter().flatten() {
            prefetch(&mesh.edges, mesh.incident[end].index());
        }
    }

    /// Before segment `i` is forced, where each round goes along the positions.
    #[inline]
    fn ways(&mut self, layer: &Layer, i: usize) {
        self.stars(&layer.mesh, i);
        let Some([a, b]) = self.ends(i + PREFETCH_DISTANCES[1]) else { return };
        let (first, end) = (a.min(b).saturating_sub(WINDOW / 4), a.min(b) + WINDOW);
        if end < self.asked {
            self.asked = 0; // another round
        }
        for position in first.max(self.asked)..end {
            prefetch(&layer.mesh.edges, 8 * position);
            if position % 4 == 0 {
                prefetch(&layer.points, position);
            }
        }
        self.asked = end;
    }
}

/// Fixes those of some segments that are edges, and returns the others.
fn fix_edges(layer: &mut Layer, segments: &[Numbered], overlaps: &mut Overlaps) -> Vec<Numbered> {
    let ends = parallel::even_ends(segments.len(), parallel::parts(segments.len()));
    let starts = std::iter::once(0).chain(ends.iter().copied());
    let runs = starts.zip(ends.iter().copied()).map(|(start, end)| start..end).collect();
    let found = parallel::map(runs, |run: std::ops::Range<usize>| {
        let ahead = Ahead::new(segments);
        let mut last = ([Place::GHOST; 2], None);
        let edge = |i: usize| {
            ahead.stars(&layer.mesh, i);
            let [a, b] = sorted(segments[i].0);
            if last.0 != [a, b] {
                last = ([a, b], layer.mesh.edge_between(a, b));
            }
            last.1
        };
        run.map(edge).collect::<Vec<Option<EdgeId>>>()
    });
    let mut rest = Vec::new();
    for (&segment, edge) in segments.iter().zip(found.into_iter().flatten()) {
        let Some(e) = edge else {
            rest.push(segment);
            continue;
        };
        if layer.mesh.is_fixed(e) {
            overlaps.share(segment.0);
        }
        layer.mesh.set_fixed(e, true);
    }
    rest
}

/// The error that names the first of all crossings: by the points, so that it does not depend on the order of the input.
fn refusal(graph: &Delaunay2, segments: &[[VertexId; 2]], refused: &[u32]) -> Error {
    let found = crossings::meet(graph, segments, refused).crossings;
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
    let [one, other] = [first.first, first.second].map(|s| segments[s as usize].map(point));
    let near = crossings::place(one, other);
    Error::SegmentsCross {
        first: first.first as usize,
        second: first.second as usize,
        near,
        count: found.len(),
    }
}
