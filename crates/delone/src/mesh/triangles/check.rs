//! Combinatorial validity: is this a sphere of triangles around its vertices and the ghost?
//!
//! Cost: O(n).

use super::Mesh2;
use crate::ids::{EdgeId, Place, TriangleId, VertexId};

/// A flaw of a mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum MeshFlaw2 {
    /// The count of triangles contradicts Euler's relation.
    #[error("{vertices} vertices need {} triangles with ghosts, not {triangles}", (2 * vertices).saturating_sub(2))]
    Euler {
        /// Vertices, the ghost not counted.
        vertices: usize,
        /// Triangles, ghosts included.
        triangles: usize,
    },
    /// The twin of an edge's twin is not the edge.
    #[error("the twin of edge {0:?} is not mutual")]
    Twin(EdgeId),
    /// An edge and its twin do not join the same vertices.
    #[error("edge {0:?} and its twin join different vertices")]
    Ends(EdgeId),
    /// A triangle has a corner twice.
    #[error("triangle {0:?} has a corner twice")]
    Corners(TriangleId),
    /// A corner is no vertex of the mesh.
    #[error("corner {0:?} of triangle {1:?} is no vertex")]
    Stranger(VertexId, TriangleId),
    /// The edge remembered for a vertex does not leave it.
    #[error("the edge remembered for vertex {0:?} does not leave it")]
    Incident(VertexId),
    /// The triangles around a vertex are not one cycle.
    #[error("the star of vertex {0:?} is not one cycle")]
    Star(VertexId),
    /// Not every triangle can be reached from the first one.
    #[error("the triangles are not connected")]
    Connected,
}

impl Mesh2 {
    /// Checks twins, corners, stars, connectedness and Euler's relation: together they prove a sphere.
    /// Returns the first flaw found.
    pub fn check(&self) -> Result<(), MeshFlaw2> {
        let n = self.inhabited().count();
        let triangles = self.triangle_count();
        if n != self.vertex_count || triangles != (2 * n).saturating_sub(2) {
            return Err(MeshFlaw2::Euler { vertices: n, triangles });
        }
        if n < 2 {
            return Ok(());
        }
        self.check_edges()?;
        self.check_stars()?;
        self.check_connected()
    }

    fn check_edges(&self) -> Result<(), MeshFlaw2> {
        for e in self.directed_edges() {
            let twin = self.twin(e);
            let mutual =
                twin.index() < self.edges.len() && twin.corner() < 3 && twin != e && self.twin(twin) == e;
            if !mutual {
                return Err(MeshFlaw2::Twin(e));
            }
            if self.tail(twin) != self.head(e) || self.tail(e) != self.head(twin) {
                return Err(MeshFlaw2::Ends(e));
            }
            let corners @ [a, b, c] = self.places(e.triangle());
            if a == b || b == c || c == a {
                return Err(MeshFlaw2::Corners(e.triangle()));
            }
            if let Some(v) = corners.into_iter().find(|&v| !v.is_ghost() && !self.is_vertex(v)) {
                return Err(MeshFlaw2::Stranger(self.name(v), e.triangle()));
            }
        }
        Ok(())
    }

    /// Each vertex is left by as many edges as its star has: all of them are one cycle.
    fn check_stars(&self) -> Result<(), MeshFlaw2> {
        let mut degrees = vec![0_usize; self.incident.len()];
        let mut ghost_degree = 0;
        for e in self.directed_edges() {
            match self.tail(e) {
                Place::GHOST => ghost_degree += 1,
                v => degrees[v.index()] += 1,
            }
        }
        let cycle = |first: EdgeId, limit: usize| {
            std::iter::successors(Some(first), |&e| Some(self.spin(e)).filter(|&e| e != first))
                .take(limit + 1)
                .count()
        };
        for v in self.inhabited() {
            let first = self.incident[v.index()];
            if first.index() >= self.edges.len() || self.tail(first) != v {
                return Err(MeshFlaw2::Incident(self.name(v)));
            }
            if cycle(first, degrees[v.index()]) != degrees[v.index()] {
                return Err(MeshFlaw2::Star(self.name(v)));
            }
        }
        let first = self.ghost_edge;
        if first.index() >= self.edges.len() || !self.tail(first).is_ghost() {
            return Err(MeshFlaw2::Incident(VertexId::GHOST));
        }
        if cycle(first, ghost_degree) != ghost_degree {
            return Err(MeshFlaw2::Star(VertexId::GHOST));
        }
        Ok(())
    }

    fn check_connected(&self) -> Result<(), MeshFlaw2> {
        let mut seen = vec![false; self.slot_count()];
        let mut pending = vec![self.ghost_edge.triangle()];
        let mut count = 0;
        while let Some(t) = pending.pop() {
            if !std::mem::replace(&mut seen[t.index()], true) {
                count += 1;
                pending.extend(self.adjacent(t));
            }
        }
        if count == self.triangle_count() { Ok(()) } else { Err(MeshFlaw2::Connected) }
    }
}
