//! What a regular triangulation has in common with others: files and pictures are made of that.

use super::Regular2;
use super::check::RegularFlaw2;
use crate::ids::{Duplicate, EdgeId, TriangleId, VertexId};
use crate::mesh::Dimension;
use crate::triangulation::Triangulation;

impl Triangulation for Regular2 {
    type Point = [f64; 2];
    type Simplex = TriangleId;
    type Corners = [VertexId; 3];
    type Facet = [VertexId; 2];
    type Flaw = RegularFlaw2;

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
        let next = self.mesh().twin(t.edge(k).next()).triangle();
        Some(next).filter(|&t| !self.mesh().is_ghost(t))
    }

    fn simplices_at(&self, v: VertexId) -> Vec<TriangleId> {
        let mesh = self.mesh();
        mesh.star(v).map(EdgeId::triangle).filter(|&t| !mesh.is_ghost(t)).collect()
    }

    fn hull_facets(&self) -> impl Iterator<Item = [VertexId; 2]> + Send + '_ {
        let is_spanned = self.dimension() == Dimension::Plane;
        let (ends, starts) = (self.mesh().hull().skip(1), self.mesh().hull());
        let closing = self.mesh().hull().take(1);
        starts.zip(ends.chain(closing)).filter(move |_| is_spanned).map(|(v, w)| [v, w])
    }

    fn check(&self) -> Result<(), RegularFlaw2> {
        self.check()
    }
}
