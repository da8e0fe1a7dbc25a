//! Insertion of a point, whatever the dimension so far.
//!
//! Cost: the walk from the hint, and the cavity (see `cavity`).

use delone_predicates::orient2d;

use super::cavity::Cavity;
use super::ground::Plane;
use super::line::{self, OnLine};
use crate::ids::{TriangleId, VertexId};
use crate::locate::walk::walk;
use crate::mesh::{Dimension, Mesh};

/// A triangulation under construction; `points` holds the coordinates of all that are or will be vertices.
pub(super) struct Inserter<'a> {
    pub(super) mesh: Mesh,
    points: &'a [[f64; 2]],
    cavity: Cavity,
    /// Known once and for good: a set never loses a dimension while it grows.
    spans_plane: bool,
    /// Conflict tests made.
    pub(super) tests: u64,
}

/// What became of an inserted point.
pub(super) enum Inserted {
    /// It is a vertex now.
    Vertex,
    /// It equals this vertex.
    Duplicate(VertexId),
}

impl<'a> Inserter<'a> {
    pub(super) fn new(points: &'a [[f64; 2]]) -> Self {
        let mesh = Mesh::empty(points.len());
        Self { mesh, points, cavity: Cavity::default(), spans_plane: false, tests: 0 }
    }

    /// Makes the point `v` a vertex. The walk starts at `hint`, a vertex, if there is one already.
    pub(super) fn insert(&mut self, v: VertexId, hint: VertexId) -> Inserted {
        let q = self.points[v.index()];
        if self.spans_plane {
            let start = self.mesh.incident[hint.index()].triangle();
            return self.insert_in_plane(v, start);
        }
        match self.mesh.dimension() {
            Dimension::Empty => {
                self.mesh.lone = Some(v);
                self.mesh.vertex_count = 1;
                Inserted::Vertex
            }
            Dimension::Point if q == self.points[hint.index()] => Inserted::Duplicate(hint),
            Dimension::Point => {
                line::begin(&mut self.mesh, v);
                Inserted::Vertex
            }
            Dimension::Line => self.insert_beside_line(v, hint),
            Dimension::Plane => unreachable!("spans_plane is set when the plane is reached"),
        }
    }

    fn insert_in_plane(&mut self, v: VertexId, start: TriangleId) -> Inserted {
        let q = self.points[v.index()];
        let seed = walk(&Plane { mesh: &self.mesh, points: self.points }, start, q);
        let equal = |w: &VertexId| !w.is_ghost() && self.points[w.index()] == q;
        if let Some(w) = self.mesh.corners(seed).into_iter().find(equal) {
            return Inserted::Duplicate(w);
        }
        self.fill(v, seed);
        Inserted::Vertex
    }

    /// Inserts into a line, on it or off it. Off it, the ghosts on one side of the line are in conflict, and
    /// joining the point to them makes the plane.
    fn insert_beside_line(&mut self, v: VertexId, hint: VertexId) -> Inserted {
        let q = self.points[v.index()];
        let e = self.mesh.ghost_edge.next(); // along the line, the ghost on its left
        let [a, b] = [self.mesh.origin(e), self.mesh.destination(e)].map(|w| self.points[w.index()]);
        let side = orient2d(a, b, q);
        if !side.is_zero() {
            let seed = if side.is_positive() { e } else { self.mesh.twin(e) };
            self.fill(v, seed.triangle());
            self.spans_plane = true;
            return Inserted::Vertex;
        }
        match line::locate(&self.mesh, self.points, hint, q) {
            OnLine::Vertex(w) => return Inserted::Duplicate(w),
            OnLine::Segment(e) => line::split(&mut self.mesh, e, v),
            OnLine::End(end) => line::extend(&mut self.mesh, end, v),
        }
        Inserted::Vertex
    }

    fn fill(&mut self, v: VertexId, seed: TriangleId) {
        self.tests += self.cavity.insert(&mut self.mesh, self.points, v, seed);
    }

    /// Lets `new` stand where `old` stood: the same point under another index.
    pub(super) fn rename(&mut self, old: VertexId, new: VertexId) {
        let star: Vec<_> = self.mesh.star(old).collect();
        for e in star {
            self.mesh.edges[e.index()].origin = new;
        }
        self.mesh.incident.swap(old.index(), new.index());
        if self.mesh.lone == Some(old) {
            self.mesh.lone = Some(new);
        }
    }
}
