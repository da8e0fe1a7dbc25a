//! The output of divide and conquer: the edge records and hull links of a run of positions.

use crate::ids::{EdgeId, Place, TriangleId};
use crate::mesh::triangles::HalfEdge;
use crate::plane::layer::kernel::{Kernel, NearestSites, Site};
use crate::tally::Merges;
use crate::weight::Weight;

/// The memory of the points at some positions. Vertices are positions in the order until the very end.
pub(super) struct Builder<'a, K: Kernel = NearestSites> {
    pub(super) points: &'a [[f64; 2]],
    /// Their weights, if the kernel knows weights.
    weights: &'a [K::Weight],
    pub(super) counters: Merges,
    /// The first position.
    start: usize,
    /// The records of the triangles 2 start and on.
    edges: &'a mut [HalfEdge],
    /// For each strict corner of a hull the ghost of the hull edge that leaves it.
    leaving: &'a mut [TriangleId],
}

impl<'a, K: Kernel> Builder<'a, K> {
    /// For as many positions as `leaving` is long.
    pub(super) fn new(
        points: &'a [[f64; 2]],
        weights: &'a [K::Weight],
        start: usize,
        edges: &'a mut [HalfEdge],
        leaving: &'a mut [TriangleId],
    ) -> Self {
        Self { points, weights, counters: Merges::default(), start, edges, leaving }
    }

    /// Builders of the positions before another one and from it on. The two triangles between them are with the first.
    pub(super) fn split(&mut self, middle: usize) -> [Builder<'_, K>; 2] {
        let (points, weights, start) = (self.points, self.weights, self.start);
        let (left_edges, right_edges) = self.edges.split_at_mut(8 * (middle - start));
        let (left_leaving, right_leaving) = self.leaving.split_at_mut(middle - start);
        [
            Builder::new(points, weights, start, left_edges, left_leaving),
            Builder::new(points, weights, middle, right_edges, right_leaving),
        ]
    }

    /// A builder of the same positions over other points, which lie like these. It counts from zero.
    pub(super) fn over<'b>(&'b mut self, points: &'b [[f64; 2]]) -> Builder<'b, K> {
        Builder::new(points, self.weights, self.start, self.edges, self.leaving)
    }

    #[inline]
    fn record(&self, e: EdgeId) -> &HalfEdge {
        &self.edges[e.index() - 8 * self.start]
    }

    #[inline]
    fn record_mut(&mut self, e: EdgeId) -> &mut HalfEdge {
        &mut self.edges[e.index() - 8 * self.start]
    }

    /// The records of some triangles in a row.
    #[inline]
    pub(super) fn records(&mut self, first: TriangleId, count: usize) -> &mut [HalfEdge] {
        let at = first.edge(0).index() - 8 * self.start;
        &mut self.edges[at..at + 4 * count]
    }

    /// The corners of the triangle that is the ghost of hull edge u -> v.
    #[inline]
    pub(super) fn set_ghost_corners(&mut self, ghost: TriangleId, u: Place, v: Place) {
        let records = self.records(ghost, 1);
        records[0].origin = v;
        records[1].origin = u;
        records[2].origin = Place::GHOST;
    }

    #[inline]
    pub(super) fn link(&mut self, e: EdgeId, f: EdgeId) {
        self.record_mut(e).twin = f;
        self.record_mut(f).twin = e;
    }

    #[inline]
    pub(super) fn twin(&self, e: EdgeId) -> EdgeId {
        self.record(e).twin
    }

    #[inline]
    pub(super) fn tail(&self, e: EdgeId) -> Place {
        self.record(e).origin
    }

    #[inline]
    pub(super) fn set_tail(&mut self, e: EdgeId, v: Place) {
        self.record_mut(e).origin = v;
    }

    /// The ghost of the hull edge that leaves a corner of a hull.
    #[inline]
    pub(super) fn leaving(&self, v: Place) -> TriangleId {
        self.leaving[v.index() - self.start]
    }

    #[inline]
    pub(super) fn set_leaving(&mut self, v: Place, ghost: TriangleId) {
        self.leaving[v.index() - self.start] = ghost;
    }

    /// The ghost of the hull edge after that of `ghost`, counter-clockwise.
    #[inline]
    pub(super) fn next_ghost(&self, ghost: TriangleId) -> TriangleId {
        self.twin(ghost.edge(2)).triangle()
    }

    /// The ghost of the hull edge before that of `ghost`.
    #[inline]
    pub(super) fn previous_ghost(&self, ghost: TriangleId) -> TriangleId {
        self.twin(ghost.edge(1)).triangle()
    }

    #[inline]
    pub(super) fn point(&self, v: Place) -> [f64; 2] {
        self.points[v.index()]
    }

    #[inline]
    pub(super) fn site(&self, v: Place) -> Site<K> {
        (self.points[v.index()], K::Weight::at(self.weights, v))
    }
}
