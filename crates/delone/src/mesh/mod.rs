//! Topology of a triangulated plane, closed by a ghost vertex; no coordinates.
//!
//! # The language
//!
//! A directed edge `e` leaves `origin(e)`, ends at `destination(e)` and has its triangle on the left.
//! `e.next()` and `e.previous()` turn counter-clockwise around the triangle, `twin(e)` is the same edge in
//! the other direction, `spin(e)` the next edge counter-clockwise with the same origin. The *star* of a
//! vertex is the edges that leave it.
//!
//! ```text
//!            c                      spin(e) = twin(e.previous())
//!           / \
//!  previous/   \ next               triangle = (origin(e), origin(e.next()), origin(e.previous()))
//!         /     \
//!        a ----> b
//!            e
//! ```
//!
//! # The ghost vertex
//!
//! Every hull edge is shared by a finite triangle and a *ghost* triangle, whose third corner is the vertex
//! at infinity, [`VertexId::GHOST`]. The surface is a sphere, without border cases: n vertices have exactly
//! 2n - 2 triangles, ghosts included. Collinear vertices are a flat sphere of ghosts alone, two for each
//! segment; one vertex, or none, has no triangle.

pub mod check;
mod iterate;

pub use iterate::{Hull, Star};

use crate::ids::{EdgeId, TriangleId, VertexId};

/// The dimension of a set of points.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Dimension {
    /// No point.
    Empty,
    /// One point.
    Point,
    /// All points on one line.
    Line,
    /// The plane: there is a triangle.
    Plane,
}

/// A directed edge: where it starts, and the same edge the other way round.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct HalfEdge {
    pub(crate) origin: VertexId,
    pub(crate) twin: EdgeId,
}

impl HalfEdge {
    /// What the fourth record of a triangle holds, and the records of a triangle not built yet.
    pub(crate) const UNUSED: Self = Self { origin: VertexId::GHOST, twin: EdgeId::NONE };
}

/// A triangulation's topology: 32 bytes a triangle (three edges, and one record to align them), 4 bytes a
/// vertex.
#[derive(Clone, Debug)]
pub struct Mesh {
    /// Four records a triangle, the fourth unused.
    pub(crate) edges: Vec<HalfEdge>,
    /// For each index an edge that leaves the vertex; [`EdgeId::NONE`] for an index that is no vertex.
    pub(crate) incident: Vec<EdgeId>,
    /// An edge that leaves the ghost vertex; none below two vertices.
    pub(crate) ghost_edge: EdgeId,
    pub(crate) vertex_count: usize,
    /// The only vertex, when there is one.
    pub(crate) lone: Option<VertexId>,
}

impl Mesh {
    /// No vertex, with room for indices below `indices`.
    pub(crate) fn empty(indices: usize) -> Self {
        Self {
            edges: Vec::new(),
            incident: vec![EdgeId::NONE; indices],
            ghost_edge: EdgeId::NONE,
            vertex_count: 0,
            lone: None,
        }
    }

    /// The vertex that an edge leaves.
    #[inline]
    pub fn origin(&self, e: EdgeId) -> VertexId {
        self.edges[e.index()].origin
    }

    /// The vertex at which an edge ends.
    #[inline]
    pub fn destination(&self, e: EdgeId) -> VertexId {
        self.origin(e.next())
    }

    /// The corner of the edge's triangle that is not on the edge.
    #[inline]
    pub fn apex(&self, e: EdgeId) -> VertexId {
        self.origin(e.previous())
    }

    /// The same edge in the other direction, of the triangle on the other side.
    #[inline]
    pub fn twin(&self, e: EdgeId) -> EdgeId {
        self.edges[e.index()].twin
    }

    /// The next edge counter-clockwise with the same origin.
    #[inline]
    pub fn spin(&self, e: EdgeId) -> EdgeId {
        self.twin(e.previous())
    }

    /// The three corners, counter-clockwise; one of them is the ghost vertex in a ghost triangle.
    #[inline]
    pub fn corners(&self, t: TriangleId) -> [VertexId; 3] {
        let first = t.edge(0).index();
        let record = &self.edges[first..first + 3];
        [record[0].origin, record[1].origin, record[2].origin]
    }

    /// The triangles across edges 0, 1 and 2 of a triangle.
    pub fn adjacent(&self, t: TriangleId) -> [TriangleId; 3] {
        [0, 1, 2].map(|k| self.twin(t.edge(k)).triangle())
    }

    /// Whether a corner of the triangle is the vertex at infinity.
    #[inline]
    pub fn is_ghost(&self, t: TriangleId) -> bool {
        self.corners(t).contains(&VertexId::GHOST)
    }

    /// Whether this index is a vertex: the index of a point that is no duplicate.
    pub fn contains(&self, v: VertexId) -> bool {
        self.lone == Some(v) || self.incident.get(v.index()).is_some_and(|&e| e != EdgeId::NONE)
    }

    /// The number of vertices, the ghost not counted.
    pub fn vertex_count(&self) -> usize {
        self.vertex_count
    }

    /// The number of triangles, ghosts included: 2n - 2 for n >= 1 vertices.
    pub fn slot_count(&self) -> usize {
        self.edges.len() / 4
    }

    /// What the vertices span. O(1).
    pub fn dimension(&self) -> Dimension {
        match self.vertex_count {
            0 => Dimension::Empty,
            1 => Dimension::Point,
            // Twins across a hull edge are both ghosts only where there is no inside. A triangulated plane
            // has no such pair, a line nothing else.
            _ => {
                let hull_edge = self.ghost_edge.next();
                if self.is_ghost(self.twin(hull_edge).triangle()) {
                    Dimension::Line
                } else {
                    Dimension::Plane
                }
            }
        }
    }

    /// Makes two directed edges twins of each other.
    #[inline]
    pub(crate) fn link(&mut self, e: EdgeId, f: EdgeId) {
        self.edges[e.index()].twin = f;
        self.edges[f.index()].twin = e;
    }
}
