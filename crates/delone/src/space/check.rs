//! Geometric validity, proved with exact predicates alone.
//!
//! A three-dimensional sphere of tetrahedra (`mesh::tetrahedra`) is the canonical Delaunay triangulation of its vertices
//! if every finite tetrahedron is in positive order, the hull is convex at every edge, and no facet has the vertex
//! across it inside the sphere of its tetrahedron (Delaunay's lemma: local implies global, for the perturbed points
//! too). Cost: O(n log n).

use delone_predicates::{in_sphere, orient3d};

use super::Delaunay3;
use crate::ids::{Duplicate, FacetId, Place, TetrahedronId, VertexId};
use crate::mesh::tetrahedra::Flaw3 as MeshFlaw;
use crate::mesh::{Dimension, tetrahedra};

/// What is wrong with a triangulation of space, one sentence each.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Flaw3 {
    /// It is no closed manifold.
    #[error(transparent)]
    Mesh(#[from] tetrahedra::Flaw3),
    /// A finite tetrahedron is turned over or flat.
    #[error("tetrahedron {0:?} is not in positive order")]
    Orientation(TetrahedronId),
    /// The hull is not convex at an edge of a facet.
    #[error("the hull is not convex at facet {0:?}")]
    Hull(FacetId),
    /// A facet is not locally Delaunay under the canonical rule.
    #[error("the vertex across facet {0:?} is inside the sphere of its tetrahedron")]
    Delaunay(FacetId),
    /// The vertices span more than is said.
    #[error("vertex {0:?} is outside of what the others span")]
    Span(VertexId),
    /// A point is called the duplicate of a vertex that was given later, or is no vertex.
    #[error("point {} is no duplicate of vertex {:?}", .0.point, .0.vertex)]
    Duplicate(Duplicate),
    /// The number of vertices is not what it is said to be.
    #[error("{0} vertices are there, not as many as are counted")]
    Count(usize),
}

impl Delaunay3 {
    /// Proves that this is the canonical Delaunay triangulation of its vertices, or returns the first flaw found.
    /// O(n log n), and independent of how it was built and changed.
    pub fn check(&self) -> Result<(), Flaw3> {
        let (layer, mesh) = (&self.base, &self.base.mesh);
        mesh.check()?;
        let point = |p: Place| layer.points[p.index()];
        for t in mesh.cells() {
            let cell = mesh.cells[t.index()];
            let ends = |f: FacetId| mesh.cells[f.tetrahedron().index()].corners[f.corner()];
            if mesh.is_ghost(t) {
                let [a, b, c] = [0, 1, 2].map(|k| point(cell.corners[k]));
                for k in 0..3 {
                    // The facet of the hull beside this one, and its corner that they do not share.
                    let beyond = point(ends(cell.across[k]));
                    let side = orient3d(a, b, c, beyond);
                    let inner = mesh.cells[cell.across[3].tetrahedron().index()].corners.map(point);
                    let [p, q, r, s] = inner;
                    if side.is_positive() || (side.is_zero() && in_sphere(p, q, r, s, beyond).is_positive()) {
                        return Err(Flaw3::Hull(t.facet(k)));
                    }
                }
                continue;
            }
            let [a, b, c, d] = cell.corners.map(point);
            if !orient3d(a, b, c, d).is_positive() {
                return Err(Flaw3::Orientation(t));
            }
            for k in 0..4 {
                let across = ends(cell.across[k]);
                if !across.is_ghost() && in_sphere(a, b, c, d, point(across)).is_positive() {
                    return Err(Flaw3::Delaunay(t.facet(k)));
                }
            }
        }
        self.check_span()?;
        self.check_vertices()
    }

    /// All vertices are in the span; the scaffold is off it.
    fn check_span(&self) -> Result<(), Flaw3> {
        let layer = &self.base;
        let outside = |p: &Place| !layer.is_scaffold(*p) && !layer.is_in_span(layer.points[p.index()]);
        if self.dimension() < Dimension::Space
            && let Some(p) = layer.mesh.inhabited().find(outside)
        {
            return Err(Flaw3::Span(layer.mesh.name(p)));
        }
        Ok(())
    }

    /// Names and places are each other's, every name is a vertex or a duplicate, and the vertices are as many as said.
    fn check_vertices(&self) -> Result<(), Flaw3> {
        let mesh = &self.base.mesh;
        let count = mesh.inhabited().filter(|p| !self.base.is_scaffold(*p)).count();
        if count != mesh.vertex_count || mesh.vertices().count() != count {
            return Err(Flaw3::Count(count));
        }
        for p in mesh.inhabited().filter(|p| !self.base.is_scaffold(*p)) {
            if mesh.place(mesh.name(p)) != Some(p) {
                return Err(Flaw3::Mesh(MeshFlaw::Incident(mesh.name(p))));
            }
        }
        let wrong = |d: &Duplicate| {
            mesh.contains(VertexId::new(d.point)) || !mesh.contains(d.vertex) || d.vertex.index() >= d.point
        };
        self.duplicates().find(wrong).map_or(Ok(()), |d| Err(Flaw3::Duplicate(d)))
    }
}
