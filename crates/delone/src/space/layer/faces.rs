//! Faces of each dimension: tetrahedra, facets, edges, and the facets of the hull.
//!
//! Cost: O(1) for each that is met, ghosts and both sides of a facet counted; edges O(d log d) for a vertex of degree d.

use super::Layer;
use super::kernel::Lift;
use crate::ids::{FacetId, Place, TetrahedronId, VertexId};
use crate::mesh::Dimension;

impl<W: Lift> Layer<W> {
    /// The finite tetrahedra. None below space.
    pub(in crate::space) fn tetrahedra(&self) -> impl Iterator<Item = TetrahedronId> + '_ {
        let spanned = self.scaffold.is_empty();
        self.mesh.cells().filter(move |&t| spanned && !self.mesh.is_ghost(t))
    }

    /// The finite facets, each from one of its two sides; of coplanar points the triangles.
    pub(in crate::space) fn facets(&self) -> impl Iterator<Item = FacetId> + '_ {
        let (mesh, dimension) = (&self.mesh, self.dimension());
        let wanted = move |f: &FacetId| match dimension {
            // From the smaller of two finite sides.
            Dimension::Space => {
                let g = mesh.twin(*f);
                *f < g || mesh.is_ghost(g.tetrahedron())
            }
            Dimension::Plane => self.is_scaffold(mesh.cells[f.tetrahedron().index()].corners[f.corner()]),
            _ => false,
        };
        let finite = mesh.cells().filter(|&t| !mesh.is_ghost(t));
        finite.flat_map(|t| [0, 1, 2, 3].map(|k| t.facet(k))).filter(wanted)
    }

    /// The facets of the hull, counter-clockwise seen from outside; of coplanar points each triangle once, of less none.
    pub(in crate::space) fn hull_facets(&self) -> impl Iterator<Item = [VertexId; 3]> + Send + '_ {
        let (mesh, dimension) = (&self.mesh, self.dimension());
        let ghosts = mesh.cells().filter(move |&t| dimension == Dimension::Space && mesh.is_ghost(t));
        let outer = ghosts.map(|t| mesh.facet_corners(t.facet(3)));
        let flat = (dimension == Dimension::Plane).then(|| self.facets()).into_iter().flatten();
        outer.chain(flat.map(|f| mesh.facet_corners(f)))
    }

    /// The edges, each once, of whatever the points span.
    pub(in crate::space) fn edges(&self) -> impl Iterator<Item = [VertexId; 2]> + '_ {
        let mut star = Vec::new();
        self.mesh.inhabited().flat_map(move |p| {
            let mut joined = self.joined_to(p, &mut star);
            joined.retain(|&q| q > p);
            let [v] = [self.mesh.name(p)];
            joined.into_iter().map(move |q| [v, self.mesh.name(q)])
        })
    }

    /// The vertices joined to one; none to a scaffold point.
    pub(in crate::space) fn joined_to(&self, p: Place, star: &mut Vec<TetrahedronId>) -> Vec<Place> {
        let mut joined = Vec::new();
        if !self.is_scaffold(p) {
            self.neighbors(p, star, &mut joined);
        }
        joined
    }
}
