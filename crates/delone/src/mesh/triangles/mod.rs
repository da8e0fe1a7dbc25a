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
//!
//! # Places
//!
//! Inside, a vertex is known by its *place*, where its star and its coordinates are kept; outside, by its
//! [`VertexId`]. `names` translates, `slots` finds free triangles near others, `layout` brings order into memory.

pub(crate) mod channel;
mod check;
mod iterate;
mod layout;
mod line;
pub(crate) mod surgery;
mod tags;

pub use check::MeshFlaw2;
pub use iterate::{Hull, Star};
pub(crate) use layout::{Room, with_spare};

use bytemuck::Zeroable;

use crate::ids::{EdgeId, Place, TriangleId, VertexId};
use crate::mesh::{Dimension, Names, Slots};

/// A directed edge: where it starts, and the same edge the other way round.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Zeroable)]
pub(crate) struct HalfEdge {
    pub(crate) origin: Place,
    pub(crate) twin: EdgeId,
}

impl HalfEdge {
    /// The fourth record of a triangle without mark and tags, and all records of a triangle not built yet.
    pub(crate) const UNUSED: Self = Self { origin: Place::GHOST, twin: EdgeId::NONE };
}

/// A triangulation's topology: 32 bytes a triangle (three edges, and one record to align them), 4 bytes a
/// vertex.
#[derive(Clone, Debug)]
pub struct Mesh2 {
    /// Four records a triangle; the fourth holds its mark and its tags. In a free triangle all are unused.
    pub(crate) edges: Vec<HalfEdge>,
    /// For each place an edge that leaves its vertex; [`EdgeId::NONE`] where there is no vertex.
    pub(crate) incident: Vec<EdgeId>,
    /// An edge that leaves the ghost vertex; none below two vertices.
    pub(crate) ghost_edge: EdgeId,
    pub(crate) vertex_count: usize,
    /// The only vertex, when there is one.
    pub(crate) lone: Option<Place>,
    /// Whether any edge was ever fixed, or any triangle put into a domain: if not, there is nothing to carry along.
    pub(crate) is_tagged: bool,
    /// Which triangles are free.
    pub(crate) free: Slots,
    /// None while vertices are at the places of their indices.
    pub(crate) names: Option<Names>,
}

/// From outside, by vertex.
impl Mesh2 {
    /// The vertex that an edge leaves.
    #[inline]
    pub fn origin(&self, e: EdgeId) -> VertexId {
        self.name(self.tail(e))
    }

    /// The vertex at which an edge ends.
    #[inline]
    pub fn destination(&self, e: EdgeId) -> VertexId {
        self.name(self.head(e))
    }

    /// The corner of the edge's triangle that is not on the edge.
    #[inline]
    pub fn apex(&self, e: EdgeId) -> VertexId {
        self.name(self.tip(e))
    }

    /// The twin: the edge in the other direction, of the triangle on the other side.
    ///
    /// ```
    /// use delone::Delaunay2;
    ///
    /// let d = Delaunay2::from_points(&[[0, 0], [4, 0], [0, 4]])?;
    /// let mesh = d.mesh();
    /// assert!(mesh.undirected_edges().all(|e| mesh.origin(mesh.twin(e)) == mesh.destination(e)));
    /// # Ok::<(), delone::Error>(())
    /// ```
    #[doc(alias("mirror_edge", "rev", "opposite"))]
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
        self.places(t).map(|p| self.name(p))
    }

    /// The triangles across edges 0, 1 and 2 of a triangle.
    #[doc(alias("neighbors", "neighbours"))]
    pub fn adjacent(&self, t: TriangleId) -> [TriangleId; 3] {
        [0, 1, 2].map(|k| self.twin(t.edge(k)).triangle())
    }

    /// Whether a corner of the triangle is the vertex at infinity.
    #[doc(alias = "is_infinite")]
    #[inline]
    pub fn is_ghost(&self, t: TriangleId) -> bool {
        self.places(t).contains(&Place::GHOST)
    }

    /// Whether this is a vertex: neither the index of a duplicate nor one that was removed or never given.
    pub fn contains(&self, v: VertexId) -> bool {
        self.place(v).is_some()
    }

    /// The number of vertices, the ghost not counted.
    pub fn vertex_count(&self) -> usize {
        self.vertex_count
    }

    /// The number of triangles, ghosts included: 2n - 2 for n >= 1 vertices.
    pub fn triangle_count(&self) -> usize {
        self.slot_count() - self.free.free()
    }

    /// One more than the largest index of a triangle. Indices of removed triangles are used again.
    pub fn slot_count(&self) -> usize {
        self.edges.len() / 4
    }

    /// The dimension of the span of the vertices. O(1).
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
}

/// From inside, by place.
impl Mesh2 {
    /// No vertex, with room for places below `places`.
    pub(crate) fn empty(places: usize) -> Self {
        Self {
            edges: Vec::new(),
            incident: vec![EdgeId::NONE; places],
            ghost_edge: EdgeId::NONE,
            vertex_count: 0,
            lone: None,
            is_tagged: false,
            free: Slots::default(),
            names: None,
        }
    }

    /// No vertex again, in the memory that there is. Names are left alone.
    pub(crate) fn restart(&mut self, places: usize) {
        self.edges.clear();
        self.incident.clear();
        self.incident.resize(places, EdgeId::NONE);
        (self.ghost_edge, self.lone, self.vertex_count) = (EdgeId::NONE, None, 0);
        self.free = Slots::default();
    }

    /// Memory of triangles and stars, in bytes.
    pub(crate) fn bytes(&self) -> usize {
        size_of_val(&*self.edges) + size_of_val(&*self.incident)
    }

    /// The vertex at a place.
    #[inline]
    pub(crate) fn name(&self, place: Place) -> VertexId {
        match &self.names {
            Some(names) if !place.is_ghost() => names.of(place),
            _ => place.same(),
        }
    }

    /// Where a vertex is, if it is one.
    #[inline]
    pub(crate) fn place(&self, v: VertexId) -> Option<Place> {
        match &self.names {
            Some(names) => names.place(v),
            None => Some(v.same()).filter(|&p| self.is_vertex(p)),
        }
    }

    /// Whether there is a vertex at a place.
    pub(crate) fn is_vertex(&self, place: Place) -> bool {
        self.lone == Some(place) || self.incident.get(place.index()).is_some_and(|&e| e != EdgeId::NONE)
    }

    /// The places in use, in increasing order.
    pub(crate) fn inhabited(&self) -> impl Iterator<Item = Place> + Clone + '_ {
        (0..self.incident.len()).map(Place::new).filter(|&p| self.is_vertex(p))
    }

    /// The names, made explicit at the first change.
    pub(crate) fn names(&mut self) -> &mut Names {
        if self.names.is_none() {
            self.names = Some(Names::identical(self.incident.len(), |p| self.is_vertex(p)));
        }
        self.names.as_mut().expect("just made")
    }

    /// Where an edge starts: the place of [`Self::origin`].
    #[inline]
    pub(crate) fn tail(&self, e: EdgeId) -> Place {
        self.edges[e.index()].origin
    }

    /// Where an edge ends: the place of [`Self::destination`].
    #[inline]
    pub(crate) fn head(&self, e: EdgeId) -> Place {
        self.tail(e.next())
    }

    /// The corner across an edge: the place of [`Self::apex`].
    #[inline]
    pub(crate) fn tip(&self, e: EdgeId) -> Place {
        self.tail(e.previous())
    }

    /// The places of the corners.
    #[inline]
    pub(crate) fn places(&self, t: TriangleId) -> [Place; 3] {
        let first = t.edge(0).index();
        let record = &self.edges[first..first + 3];
        [record[0].origin, record[1].origin, record[2].origin]
    }

    /// Whether there is a triangle with this index, and it is in use.
    pub(crate) fn is_triangle(&self, t: TriangleId) -> bool {
        self.edges.get(t.edge(0).index()).is_some_and(|record| record.twin != EdgeId::NONE)
    }
}
