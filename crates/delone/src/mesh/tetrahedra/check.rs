//! Combinatorial validity of a mesh of tetrahedra: a closed three-dimensional manifold, a sphere.
//!
//! Cost: O(n log n).

use super::Mesh3;
use crate::ids::{FacetId, Place, TetrahedronId, VertexId};

/// A flaw of a mesh of tetrahedra.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum MeshFlaw3 {
    /// A facet is not glued to one that is glued to it, with the same corners.
    #[error("facet {0:?} is not glued to its like")]
    Glue(FacetId),
    /// The ghost is not the last corner, or a corner is there twice.
    #[error("the corners of tetrahedron {0:?} are not in order")]
    Corners(TetrahedronId),
    /// A vertex does not know a tetrahedron of its own.
    #[error("vertex {0:?} is not a corner of its tetrahedron")]
    Incident(VertexId),
    /// The tetrahedra around a vertex are not a ball, or those of the whole no sphere.
    #[error("vertices, edges, facets and tetrahedra do not add up: {0}")]
    Euler(i64),
    /// The tetrahedra around a vertex are more than one ball.
    #[error("the tetrahedra at vertex {0:?} hang together only there")]
    Star(VertexId),
}

impl Mesh3 {
    /// Whether this is a closed manifold, or the first flaw found. O(n log n).
    pub fn check(&self) -> Result<(), MeshFlaw3> {
        let (mut cells, mut of_vertex) = (0, vec![0_usize; self.incident.len() + 1]);
        for t in self.cells() {
            cells += 1;
            let corners = self.cells[t.index()].corners;
            let twice = (0..4).any(|i| (0..i).any(|j| corners[i] == corners[j]));
            if twice || corners[..3].iter().any(|p| p.is_ghost()) {
                return Err(MeshFlaw3::Corners(t));
            }
            for p in corners {
                of_vertex[p.index().min(self.incident.len())] += 1;
            }
            for f in [0, 1, 2, 3].map(|k| t.facet(k)) {
                let g = self.twin(f);
                if g == FacetId::NONE || !self.is_cell(g.tetrahedron()) || self.twin(g) != f || g == f {
                    return Err(MeshFlaw3::Glue(f));
                }
                let ([a, b, c], back) = (self.facet_places(f), self.facet_places(g));
                if ![[a, c, b], [c, b, a], [b, a, c]].contains(&back) {
                    return Err(MeshFlaw3::Glue(f));
                }
            }
        }
        let mut star = Vec::new();
        let (mut vertices, mut edge_ends) = (0, 0_i64);
        for p in self.inhabited() {
            vertices += 1;
            let t = self.incident[p.index()];
            if !self.is_cell(t) || !self.cells[t.index()].corners.contains(&p) {
                return Err(MeshFlaw3::Incident(self.name(p)));
            }
            self.star(p, &mut star);
            if star.len() != of_vertex[p.index()] {
                return Err(MeshFlaw3::Star(self.name(p)));
            }
            // The link of a vertex is a sphere of triangles: f = 2v - 4.
            let mut link: Vec<Place> = star.iter().flat_map(|t| self.cells[t.index()].corners).collect();
            link.sort_unstable();
            link.dedup();
            let degree = link.len() as i64 - 1;
            if star.len() as i64 != 2 * degree - 4 {
                return Err(MeshFlaw3::Euler(star.len() as i64 - 2 * degree + 4));
            }
            edge_ends += degree;
        }
        if cells == 0 {
            return Ok(());
        }
        // V - E + F - T = 0 with F = 2 T, four times over; the edges are met from their finite ends alone, and the
        // ghost has half as many as its tetrahedra, and two.
        let at_ghost = of_vertex[self.incident.len()] as i64;
        let euler = 4 * (vertices + 1) - (2 * edge_ends + at_ghost + 4) + 4 * cells;
        if euler == 0 { Ok(()) } else { Err(MeshFlaw3::Euler(euler)) }
    }
}
