//! The common traits of triangulations for space.

use std::ops::Range;

use super::check::Flaw3;
use super::{Delaunay3, Hints3, Location3};
use crate::error::Error;
use crate::ids::{Duplicate, FacetId, Inserted, TetrahedronId, VertexId};
use crate::locate::Locate;
use crate::mesh::Dimension;
use crate::order::HintOrder;
use crate::points::finite;
use crate::tally::Tally;
use crate::triangulation::{Ask, Change, Found, Imprecise, Triangulation};

impl Triangulation for Delaunay3 {
    type Point = [f64; 3];
    type Simplex = TetrahedronId;
    type Corners = [VertexId; 4];
    type Facet = [VertexId; 3];
    type Flaw = Flaw3;

    fn dimension(&self) -> Dimension {
        self.dimension()
    }

    fn ids_given(&self) -> usize {
        self.mesh().names.given()
    }

    fn vertex_count(&self) -> usize {
        self.vertex_count()
    }

    fn vertices(&self) -> impl Iterator<Item = VertexId> + '_ {
        self.vertices()
    }

    fn position(&self, v: VertexId) -> Option<[f64; 3]> {
        self.mesh().place(v).map(|place| self.base.points[place.index()])
    }

    fn duplicates(&self) -> impl Iterator<Item = Duplicate> + '_ {
        self.duplicates()
    }

    fn edges(&self) -> impl Iterator<Item = [VertexId; 2]> + '_ {
        self.edges()
    }

    fn simplices(&self) -> impl Iterator<Item = TetrahedronId> + Send + '_ {
        self.tetrahedron_ids()
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
        let mut star = self.tetrahedra_at(v);
        star.retain(|&t| !self.mesh().is_ghost(t));
        star
    }

    fn hull_facets(&self) -> impl Iterator<Item = [VertexId; 3]> + Send + '_ {
        self.hull_facets()
    }

    fn check(&self) -> Result<(), Flaw3> {
        self.check()
    }
}

impl Delaunay3 {
    /// The result of a location, in vertices.
    pub(super) fn found(&self, location: Location3) -> Found<TetrahedronId> {
        let mesh = self.mesh();
        let is_spanned = self.dimension() == Dimension::Space;
        match location {
            Location3::Tetrahedron(t) => Found::on(&mesh.corners(t), Some(t)),
            Location3::Facet(f) => {
                let is_finite = |t: &TetrahedronId| is_spanned && !mesh.is_ghost(*t);
                let sides = [f, mesh.twin(f)].map(FacetId::tetrahedron);
                Found::on(&mesh.facet_corners(f), sides.into_iter().find(is_finite))
            }
            Location3::Edge([v, w]) => {
                let around = |t: &TetrahedronId| mesh.corners(*t).contains(&w);
                Found::on(&[v, w], self.simplices_at(v).into_iter().find(around))
            }
            Location3::Vertex(v) => Found::on(&[v], self.simplices_at(v).first().copied()),
            Location3::Outside(f) => Found::beyond(&mesh.facet_corners(mesh.twin(f))),
            Location3::LowerDimensional(_) => Found::beyond(&[]),
        }
    }
}

impl Ask for Delaunay3 {
    fn find_observed<O: Tally>(&self, q: [f64; 3], observer: &mut O) -> Result<Found<TetrahedronId>, Error> {
        Ok(self.found(self.locate_observed(q, observer)?))
    }

    fn nearest_observed<O: Tally>(&self, q: [f64; 3], observer: &mut O) -> Result<Option<VertexId>, Error> {
        let place = self.nearest_place(finite(q)?, observer);
        Ok(place.map(|place| self.base.mesh.name(place)))
    }

    fn k_nearest(&self, q: [f64; 3], k: usize) -> Result<Vec<VertexId>, Error> {
        self.k_nearest(q, k)
    }

    fn within(&self, q: [f64; 3], radius: f64) -> Result<Vec<VertexId>, Error> {
        self.within(q, radius)
    }
}

impl Change for Delaunay3 {
    fn from_vec(points: Vec<[f64; 3]>) -> Result<Self, Error> {
        Self::from_vec(points)
    }

    fn set_strategy(&mut self, locate: Locate) -> Result<(), Error> {
        self.set_strategy(locate)
    }

    fn insert_observed<O: Tally>(&mut self, p: [f64; 3], observer: &mut O) -> Result<Inserted, Error> {
        self.insert_finite(finite(p)?, observer)
    }

    fn remove_observed<O: Tally>(&mut self, v: VertexId, observer: &mut O) -> Result<(), Error> {
        self.remove_vertex(v, observer)
    }

    fn move_to(&mut self, v: VertexId, p: [f64; 3]) -> Result<(), Error> {
        self.move_to(v, p)
    }

    fn extend(&mut self, points: &[[f64; 3]], seed: u64) -> Result<Range<usize>, Error> {
        self.extend(points, seed)
    }
}

impl Imprecise for Hints3 {
    type Triangulation = Delaunay3;

    fn from_centers(centers: &[[f64; 3]], order: HintOrder) -> Result<Self, Error> {
        Self::from_points(centers, order)
    }

    fn triangulate(&mut self, instance: &[[f64; 3]]) -> Result<&Delaunay3, Error> {
        self.triangulate(instance)
    }

    fn triangulate_observed<O: Tally>(
        &mut self,
        instance: &[[f64; 3]],
        observer: &mut O,
    ) -> Result<&Delaunay3, Error> {
        self.insert(instance, observer)
    }

    fn current(&self) -> &Delaunay3 {
        self.current()
    }

    fn gave_up(&self) -> bool {
        self.gave_up()
    }
}
