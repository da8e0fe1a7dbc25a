//! Removal of a vertex: its star becomes a hole, refilled with the triangulation of the vertices around it. Small holes inside
//! of the hull are filled facet by facet (`wrap`), others by triangulating those vertices apart (`hole`).
//!
//! Source: Devillers & Teillaud, "Perturbations and vertex removal in a 3D Delaunay triangulation", SODA 2003.
//!
//! With weights this gives the triangulation of the others that were vertices; those that the removed one hid are inserted by the
//! owner.
//!
//! Cost for a star of d tetrahedra, 27 on average: O(d^2) tests of four products where it is small and the filling is of size O(d);
//! O(d log d) expected above that, if the triangulation of its link is of size O(d).

use super::Layer;
use super::hole::Hole;
use super::kernel::Lift;
use super::wrap::Wrap;
use crate::ids::{Place, TetrahedronId};
use crate::mesh::Dimension;
use crate::tally::Tally;

/// The outcome for the hole that a star left.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Filled {
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
        self.mesh.star(v, &mut hole.cells);
        let (filled, created) = if Wrap::suits(&self.mesh, &hole.cells) {
            let mut wrap = self.wrap.take().unwrap_or_default();
            let filled = wrap.fill(self, v, &hole.cells).map_or(Filled::NoRoom, |()| Filled::All);
            let created = wrap.count();
            self.wrap = Some(wrap);
            (filled, created)
        } else {
            let mut fill = self.fill.take().unwrap_or_default();
            let filled = self.fill_apart(v, &mut hole, &mut fill);
            self.fill = Some(fill);
            (filled, hole.inside.len())
        };
        if filled == Filled::All {
            tally.destroyed(hole.cells.len());
            tally.created(created);
        }
        self.hole = hole;
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

    /// Removes the star of a vertex, which the hole holds, and fills it with what its other vertices are triangulated to. Nothing
    /// has changed if it is not filled.
    pub(super) fn fill_apart(&mut self, v: Place, hole: &mut Hole, fill: &mut Self) -> Filled {
        let mesh = &self.mesh;
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
