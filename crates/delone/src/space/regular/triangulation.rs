//! The common traits of triangulations for regular ones; files and pictures stand on them.

use std::ops::Range;

use super::Regular3;
use crate::error::Error;
use crate::ids::{Duplicate, Inserted, TetrahedronId, VertexId};
use crate::mesh::Dimension;
use crate::regular::{RegularFlaw, Reweighed};
use crate::space::check::Flaw3;
use crate::tally::Counters;
use crate::triangulation::{Regular, Triangulation};

impl Triangulation for Regular3 {
    type Point = [f64; 3];
    type Simplex = TetrahedronId;
    type Corners = [VertexId; 4];
    type Facet = [VertexId; 3];
    type Flaw = RegularFlaw<Flaw3>;

    fn dimension(&self) -> Dimension {
        self.dimension()
    }

    fn ids_given(&self) -> usize {
        self.ids_given()
    }

    fn vertex_count(&self) -> usize {
        self.vertex_count()
    }

    fn vertices(&self) -> impl Iterator<Item = VertexId> + '_ {
        self.vertices()
    }

    fn position(&self, v: VertexId) -> Option<[f64; 3]> {
        self.site(v).map(|site| site.0)
    }

    fn duplicates(&self) -> impl Iterator<Item = Duplicate> + '_ {
        self.duplicates()
    }

    fn edges(&self) -> impl Iterator<Item = [VertexId; 2]> + '_ {
        self.edges()
    }

    fn simplices(&self) -> impl Iterator<Item = TetrahedronId> + Send + '_ {
        self.base.tetrahedra()
    }

    fn index(&self, t: TetrahedronId) -> usize {
        t.index()
    }

    fn slot_count(&self) -> usize {
        self.mesh().slot_count()
    }

    fn corners(&self, t: TetrahedronId) -> [VertexId; 4] {
        self.mesh().corners(t)
    }

    fn across(&self, t: TetrahedronId, k: usize) -> Option<TetrahedronId> {
        self.mesh().across(t, k)
    }

    fn simplices_at(&self, v: VertexId) -> Vec<TetrahedronId> {
        let mut star = Vec::new();
        if let Some(place) = self.mesh().place(v).filter(|_| self.dimension() == Dimension::Space) {
            self.mesh().star(place, &mut star);
            star.retain(|&t| !self.mesh().is_ghost(t));
        }
        star
    }

    fn hull_facets(&self) -> impl Iterator<Item = [VertexId; 3]> + Send + '_ {
        self.base.hull_facets()
    }

    fn check(&self) -> Result<(), RegularFlaw<Flaw3>> {
        self.check()
    }
}

impl Regular for Regular3 {
    fn from_parts(points: &[[f64; 3]], weights: &[f64]) -> Result<Self, Error> {
        Self::from_parts(points, weights)
    }

    fn with_seed(points: &[[f64; 3]], weights: &[f64], seed: u64) -> Result<Self, Error> {
        Self::with_seed(points, weights, seed)
    }

    fn counters(&self) -> Counters {
        self.counters()
    }

    fn site(&self, v: VertexId) -> Option<([f64; 3], f64)> {
        self.site(v)
    }

    fn hidden(&self) -> impl Iterator<Item = VertexId> + '_ {
        self.hidden()
    }

    fn insert(&mut self, point: [f64; 3], weight: f64) -> Result<Inserted, Error> {
        self.insert(point, weight)
    }

    fn remove(&mut self, v: VertexId) -> Result<(), Error> {
        self.remove(v)
    }

    fn set_weight(&mut self, v: VertexId, weight: f64) -> Result<(), Error> {
        self.set_weight(v, weight)
    }

    fn set_weights(&mut self, weights: &[f64]) -> Result<Reweighed, Error> {
        self.set_weights(weights)
    }

    fn extend(&mut self, sites: &[([f64; 3], f64)], seed: u64) -> Result<Range<usize>, Error> {
        self.extend(sites, seed)
    }

    fn nearest(&self, q: [f64; 3]) -> Result<Option<VertexId>, Error> {
        self.nearest(q)
    }

    fn k_nearest(&self, q: [f64; 3], k: usize) -> Result<Vec<VertexId>, Error> {
        self.k_nearest(q, k)
    }

    fn within(&self, q: [f64; 3], power: f64) -> Result<Vec<VertexId>, Error> {
        self.within(q, power)
    }
}
