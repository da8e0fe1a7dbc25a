//! What a regular triangulation has in common with others: files and pictures are made of that.

use super::Regular3;
use super::check::RegularFlaw3;
use crate::ids::{Duplicate, TetrahedronId, VertexId};
use crate::mesh::Dimension;
use crate::triangulation::Triangulation;

impl Triangulation for Regular3 {
    type Point = [f64; 3];
    type Simplex = TetrahedronId;
    type Corners = [VertexId; 4];
    type Facet = [VertexId; 3];
    type Flaw = RegularFlaw3;

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
        let next = self.mesh().twin(t.facet(k)).tetrahedron();
        Some(next).filter(|&t| !self.mesh().is_ghost(t))
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

    fn check(&self) -> Result<(), RegularFlaw3> {
        self.check()
    }
}
