//! The common traits of triangulations for the plane.

use std::ops::Range;

use super::check::Flaw2;
use super::{Delaunay2, Hints2, Location2};
use crate::error::Error;
use crate::ids::{Duplicate, EdgeId, Inserted, TriangleId, VertexId};
use crate::locate::Locate;
use crate::mesh::Dimension;
use crate::order::HintOrder;
use crate::points::finite;
use crate::tally::Tally;
use crate::triangulation::{Ask, Change, Found, Imprecise, Triangulation};

impl Triangulation for Delaunay2 {
    type Point = [f64; 2];
    type Simplex = TriangleId;
    type Corners = [VertexId; 3];
    type Facet = [VertexId; 2];
    type Flaw = Flaw2;

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
        self.mesh().place(v).map(|place| self.base.points[place.index()])
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
        self.mesh().across(t, k)
    }

    fn simplices_at(&self, v: VertexId) -> Vec<TriangleId> {
        self.mesh().finite_star(v)
    }

    fn hull_facets(&self) -> impl Iterator<Item = [VertexId; 2]> + Send + '_ {
        self.hull_facets()
    }

    fn check(&self) -> Result<(), Flaw2> {
        self.check()
    }
}

impl Delaunay2 {
    /// The result of a location, in vertices.
    pub(super) fn found(&self, location: Location2) -> Found<TriangleId> {
        let mesh = self.mesh();
        let finite = |edges: &mut dyn Iterator<Item = EdgeId>| {
            edges.map(EdgeId::triangle).find(|&t| !mesh.is_ghost(t))
        };
        let ends = |e| [mesh.origin(e), mesh.destination(e)];
        match location {
            Location2::Triangle(t) => Found::on(&mesh.corners(t), Some(t)),
            Location2::Edge(e) => Found::on(&ends(e), finite(&mut [e, mesh.twin(e)].into_iter())),
            Location2::Vertex(v) => Found::on(&[v], finite(&mut mesh.star(v))),
            Location2::Outside(e) => Found::beyond(&ends(e)),
            Location2::LowerDimensional(_) => Found::beyond(&[]),
        }
    }
}

impl Ask for Delaunay2 {
    fn find_observed<O: Tally>(&self, q: [f64; 2], observer: &mut O) -> Result<Found<TriangleId>, Error> {
        Ok(self.found(self.locate_observed(q, observer)?))
    }

    fn nearest_observed<O: Tally>(&self, q: [f64; 2], observer: &mut O) -> Result<Option<VertexId>, Error> {
        let place = self.nearest_place(finite(q)?, observer);
        Ok(place.map(|place| self.base.mesh.name(place)))
    }

    // Said here again, so that it is compiled with this crate and not in each that calls it.
    fn find(&self, q: [f64; 2]) -> Result<Found<TriangleId>, Error> {
        self.find_observed(q, &mut ())
    }

    fn k_nearest(&self, q: [f64; 2], k: usize) -> Result<Vec<VertexId>, Error> {
        self.k_nearest(q, k)
    }

    fn within(&self, q: [f64; 2], radius: f64) -> Result<Vec<VertexId>, Error> {
        self.within(q, radius)
    }
}

impl Change for Delaunay2 {
    fn from_vec(points: Vec<[f64; 2]>) -> Result<Self, Error> {
        Self::from_vec(points)
    }

    fn set_strategy(&mut self, locate: Locate) -> Result<(), Error> {
        self.set_strategy(locate)
    }

    fn insert_observed<O: Tally>(&mut self, p: [f64; 2], observer: &mut O) -> Result<Inserted, Error> {
        self.insert_finite(finite(p)?, observer)
    }

    fn remove_observed<O: Tally>(&mut self, v: VertexId, observer: &mut O) -> Result<(), Error> {
        self.remove_vertex(v, observer)
    }

    fn move_to(&mut self, v: VertexId, p: [f64; 2]) -> Result<(), Error> {
        self.move_to(v, p)
    }

    fn extend(&mut self, points: &[[f64; 2]], seed: u64) -> Result<Range<usize>, Error> {
        self.extend(points, seed)
    }
}

impl Imprecise for Hints2 {
    type Triangulation = Delaunay2;

    fn from_centers(centers: &[[f64; 2]], order: HintOrder) -> Result<Self, Error> {
        Self::from_points(centers, order)
    }

    fn triangulate(&mut self, instance: &[[f64; 2]]) -> Result<&Delaunay2, Error> {
        self.triangulate(instance)
    }

    fn triangulate_observed<O: Tally>(
        &mut self,
        instance: &[[f64; 2]],
        observer: &mut O,
    ) -> Result<&Delaunay2, Error> {
        self.insert::<_, _, false>(instance, observer)
    }

    fn current(&self) -> &Delaunay2 {
        self.current()
    }

    fn gave_up(&self) -> bool {
        self.gave_up()
    }
}
