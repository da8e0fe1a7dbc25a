//! The common traits of triangulations for constrained ones.

use super::Constrained2;
use super::check::ConstrainedFlaw2;
use crate::error::Error;
use crate::ids::{Duplicate, TriangleId, VertexId};
use crate::mesh::Dimension;
use crate::points::finite;
use crate::tally::Tally;
use crate::triangulation::{Ask, Found, Triangulation};

impl Triangulation for Constrained2 {
    type Point = [f64; 2];
    type Simplex = TriangleId;
    type Corners = [VertexId; 3];
    type Facet = [VertexId; 2];
    type Flaw = ConstrainedFlaw2;

    fn dimension(&self) -> Dimension {
        self.dimension()
    }

    fn ids_given(&self) -> usize {
        self.points().len()
    }

    fn vertex_count(&self) -> usize {
        self.vertex_count()
    }

    fn vertices(&self) -> impl Iterator<Item = VertexId> + '_ {
        self.vertices()
    }

    fn position(&self, v: VertexId) -> Option<[f64; 2]> {
        self.graph.position(v)
    }

    fn duplicates(&self) -> impl Iterator<Item = Duplicate> + '_ {
        self.duplicates()
    }

    fn edges(&self) -> impl Iterator<Item = [VertexId; 2]> + '_ {
        self.edges()
    }

    fn simplices(&self) -> impl Iterator<Item = TriangleId> + Send + '_ {
        self.mesh().triangles()
    }

    fn simplex_count(&self) -> usize {
        self.triangle_count()
    }

    fn index(&self, t: TriangleId) -> usize {
        t.index()
    }

    fn slot_count(&self) -> usize {
        self.mesh().slot_count()
    }

    fn corners(&self, t: TriangleId) -> [VertexId; 3] {
        self.mesh().corners(t)
    }

    fn across(&self, t: TriangleId, k: usize) -> Option<TriangleId> {
        self.graph.across(t, k)
    }

    fn simplices_at(&self, v: VertexId) -> Vec<TriangleId> {
        self.graph.simplices_at(v)
    }

    fn hull_facets(&self) -> impl Iterator<Item = [VertexId; 2]> + Send + '_ {
        self.hull_facets()
    }

    fn check(&self) -> Result<(), ConstrainedFlaw2> {
        self.check()
    }
}

impl Ask for Constrained2 {
    fn find_observed<O: Tally>(&self, q: [f64; 2], observer: &mut O) -> Result<Found<TriangleId>, Error> {
        self.graph.find_observed(q, observer)
    }

    fn nearest_observed<O: Tally>(&self, q: [f64; 2], observer: &mut O) -> Result<Option<VertexId>, Error> {
        let found = self.search(finite(q)?, Ok(1), observer);
        Ok(found.first().map(|&v| self.mesh().name(v)))
    }

    fn k_nearest(&self, q: [f64; 2], k: usize) -> Result<Vec<VertexId>, Error> {
        self.k_nearest(q, k)
    }

    fn within(&self, q: [f64; 2], radius: f64) -> Result<Vec<VertexId>, Error> {
        self.within(q, radius)
    }
}
