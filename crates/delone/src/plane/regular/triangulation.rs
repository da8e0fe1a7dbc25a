//! The common traits of triangulations for regular ones; files and pictures stand on them.

use std::ops::Range;

use super::Regular2;
use crate::error::Error;
use crate::ids::{Duplicate, Inserted, TriangleId, VertexId};
use crate::mesh::Dimension;
use crate::plane::check::Flaw2;
use crate::regular::{RegularFlaw, Reweighed};
use crate::tally::Counters;
use crate::triangulation::{Regular, Triangulation};

impl Triangulation for Regular2 {
    type Point = [f64; 2];
    type Simplex = TriangleId;
    type Corners = [VertexId; 3];
    type Facet = [VertexId; 2];
    type Flaw = RegularFlaw<Flaw2>;

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

    fn position(&self, v: VertexId) -> Option<[f64; 2]> {
        self.site(v).map(|site| site.0)
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
        self.mesh().across(t, k)
    }

    fn simplices_at(&self, v: VertexId) -> Vec<TriangleId> {
        self.mesh().finite_star(v)
    }

    fn hull_facets(&self) -> impl Iterator<Item = [VertexId; 2]> + Send + '_ {
        self.mesh().hull_facets()
    }

    fn check(&self) -> Result<(), RegularFlaw<Flaw2>> {
        self.check()
    }
}

impl Regular for Regular2 {
    fn from_parts(points: &[[f64; 2]], weights: &[f64]) -> Result<Self, Error> {
        Self::from_parts(points, weights)
    }

    fn with_seed(points: &[[f64; 2]], weights: &[f64], seed: u64) -> Result<Self, Error> {
        Self::with_seed(points, weights, seed)
    }

    fn counters(&self) -> Counters {
        self.counters()
    }

    fn site(&self, v: VertexId) -> Option<([f64; 2], f64)> {
        self.site(v)
    }

    fn hidden(&self) -> impl Iterator<Item = VertexId> + '_ {
        self.hidden()
    }

    fn insert(&mut self, point: [f64; 2], weight: f64) -> Result<Inserted, Error> {
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

    fn extend(&mut self, sites: &[([f64; 2], f64)], seed: u64) -> Result<Range<usize>, Error> {
        self.extend(sites, seed)
    }

    fn nearest(&self, q: [f64; 2]) -> Result<Option<VertexId>, Error> {
        self.nearest(q)
    }

    fn k_nearest(&self, q: [f64; 2], k: usize) -> Result<Vec<VertexId>, Error> {
        self.k_nearest(q, k)
    }

    fn within(&self, q: [f64; 2], power: f64) -> Result<Vec<VertexId>, Error> {
        self.within(q, power)
    }
}
