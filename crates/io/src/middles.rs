//! The middles of the edges of a mesh: the further nodes of its triangles if these are of second order.
//!
//! They are numbered after all points, by the ends of their edges in order. Each coordinate is rounded once. O(n log n).

use delone::{Coordinates, Corners, Triangulation, VertexId};

use crate::Mesh;

/// The edges of all triangles that are not left out, with their markers.
#[derive(Debug)]
pub(crate) struct Middles {
    edges: Vec<([VertexId; 2], i64)>,
    /// The places of middles that are on arcs, by the number of their edge.
    on_arcs: Vec<(usize, [f64; 2])>,
    /// The number of the first middle.
    first: usize,
}

impl Middles {
    pub(crate) fn of<T: Triangulation>(mesh: &Mesh<T>) -> Self {
        // Points on a line have edges that no triangle has.
        let has_cells = mesh.simplex_count() > 0;
        let edges = mesh.marked_edges().filter(|_| has_cells);
        let mut edges: Vec<_> = edges.map(|(ends, marker)| (ordered(ends), marker)).collect();
        edges.sort_unstable();
        let number = |ends: [VertexId; 2]| edges.binary_search_by_key(&ordered(ends), |edge| edge.0).ok();
        let on_arcs = mesh.arc_middles.iter();
        let on_arcs = on_arcs.filter_map(|&(ends, place)| Some((number(ends)?, place))).collect();
        Self { edges, on_arcs, first: mesh.points.len() }
    }

    /// The middles of a triangle: of its corners 1 and 2, 2 and 3, 3 and 1.
    pub(crate) fn of_triangle(&self, corners: impl Corners) -> [usize; 3] {
        let corner = |k: usize| corners.as_ref()[k];
        [[0, 1], [1, 2], [2, 0]].map(|[i, j]| self.of_edge([corner(i), corner(j)]))
    }

    /// The middle of an edge of a triangle.
    pub(crate) fn of_edge(&self, ends: [VertexId; 2]) -> usize {
        let ends = ordered(ends);
        self.first + self.edges.partition_point(|edge| edge.0 < ends)
    }

    /// Points, and the middles after them.
    pub(crate) fn points<P: Coordinates>(&self, points: &[P]) -> Vec<P> {
        let between = self.edges.iter().map(|(ends, _)| {
            let [mut middle, other] = ends.map(|v| points[v.index()]);
            middle.as_mut().iter_mut().zip(other.as_ref()).for_each(|(x, y)| *x = x.midpoint(*y));
            middle
        });
        let mut all: Vec<P> = points.iter().copied().chain(between).collect();
        for &(number, place) in &self.on_arcs {
            let middle = all[self.first + number].as_mut();
            middle.iter_mut().zip(place).for_each(|(x, own)| *x = own);
        }
        all
    }

    /// Rows of values of the points, those that are not there 0, and the means of two after them.
    pub(crate) fn values(&self, width: usize, values: &[f64]) -> Vec<f64> {
        let value = |i: usize, k: usize| values.get(i * width + k).copied().unwrap_or_default();
        let given = (0..self.first).flat_map(|i| (0..width).map(move |k| (i, i, k)));
        let means =
            self.edges.iter().flat_map(|&([v, w], _)| (0..width).map(move |k| (v.index(), w.index(), k)));
        given.chain(means).map(|(i, j, k)| value(i, k).midpoint(value(j, k))).collect()
    }

    /// Markers of the points, those that are not there 0, and the markers of the edges after them.
    pub(crate) fn markers(&self, markers: &[i64]) -> Vec<i64> {
        let given = (0..self.first).map(|i| markers.get(i).copied().unwrap_or_default());
        given.chain(self.edges.iter().map(|edge| edge.1)).collect()
    }
}

/// The ends of an edge, the lesser first.
pub(crate) fn ordered([v, w]: [VertexId; 2]) -> [VertexId; 2] {
    [v.min(w), v.max(w)]
}
