//! Removal of a vertex: its star becomes a hole, refilled with the triangulation of the vertices around it.
//!
//! Source: Devillers & Teillaud, "Perturbations and vertex removal in a 3D Delaunay triangulation", SODA 2003.
//!
//! With weights this gives the triangulation of the others that were vertices; those that the removed one hid are inserted by the
//! owner.
//!
//! Cost: O(d log d) expected for a star of d tetrahedra, 27 on average, if the triangulation of its link is of size O(d).

use super::Layer;
use super::hole::Hole;
use super::kernel::Lift;
use crate::ids::{Place, TetrahedronId};
use crate::mesh::Dimension;
use crate::tally::Tally;

/// What became of the hole that a star left.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Filled {
    All,
    /// The other vertices span less than before.
    SpansLess,
    /// There would be too many tetrahedra.
    NoRoom,
}

impl<W: Lift> Layer<W> {
    /// Removes the vertex at a place, which is free then. `None`, and nothing has changed, if there is no room for what takes
    /// the place of its star.
    pub(in crate::space) fn remove<T: Tally>(&mut self, v: Place, tally: &mut T) -> Option<()> {
        if self.mesh.vertex_count == 1 {
            self.free_place(v);
            return self.rebuild(None);
        }
        let mut hole = std::mem::take(&mut self.hole);
        let mut fill = self.fill.take().unwrap_or_default();
        let filled = self.fill_star(v, &mut hole, &mut fill);
        if filled == Filled::All {
            tally.destroyed(hole.cells.len());
            tally.created(hole.inside.len());
        }
        (self.hole, self.fill) = (hole, Some(fill));
        match filled {
            Filled::NoRoom => None,
            Filled::All => {
                self.free_place(v);
                self.mesh.vertex_count -= 1;
                Some(())
            }
            Filled::SpansLess => {
                self.free_place(v);
                self.rebuild(None)
            }
        }
    }

    /// Removes the star of a vertex and fills the hole. Nothing has changed if it is not filled.
    fn fill_star(&mut self, v: Place, hole: &mut Hole, fill: &mut Self) -> Filled {
        let mesh = &self.mesh;
        mesh.star(v, &mut hole.cells);
        hole.set_vertices(self, Some(v), None);
        hole.triangulate(self, fill);
        // Across from the vertex.
        let link = |t: &TetrahedronId| {
            let cell = &mesh.cells[t.index()];
            t.facet(cell.corners.iter().position(|&p| p == v).unwrap_or_default())
        };
        if fill.dimension() < Dimension::Space {
            // All in one plane, and what is beyond it has no part in the hole; but one vertex from there turns
            // the plane's triangles into tetrahedra.
            let beyond = |t: &TetrahedronId| {
                let g = mesh.twin(link(t));
                let apex = mesh.cells[g.tetrahedron().index()].corners[g.corner()];
                (!apex.is_ghost() && !mesh.is_ghost(*t)).then_some(apex)
            };
            let Some(apex) = hole.cells.iter().find_map(beyond) else { return Filled::SpansLess };
            hole.set_vertices(self, Some(v), Some(apex));
            hole.triangulate(self, fill);
        }
        let facets: Vec<_> = hole.cells.iter().map(link).collect();
        hole.set_border(self, &facets);
        let fits = hole.find_inside(fill);
        debug_assert!(fits, "the filling has the border's facets");
        if hole.copy(self, fill).is_some() { Filled::All } else { Filled::NoRoom }
    }
}
