//! Proof that this is the canonical regular triangulation of all its sites.
//!
//! Tetrahedra are proved as without weights: lifted, no vertex across a facet is below the hyperplane of its tetrahedron. A site
//! that is no vertex is proved by the tetrahedron above which it lies: it is above that hyperplane, or equals a corner.
//!
//! Cost: O(n log n), and a walk for each site that is no vertex.

use super::Regular3;
use crate::ids::VertexId;
use crate::space::check::{Flaw3, check_geometry};
use crate::space::layer::kernel::Lift;

/// What is wrong with a regular triangulation of space, one sentence each.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum RegularFlaw3 {
    /// The tetrahedra are not the regular ones of the vertices.
    #[error(transparent)]
    Triangulation(#[from] Flaw3),
    /// A site is called hidden and is below the tetrahedra.
    #[error("site {} is no vertex, and none of the others hides it", .0.index())]
    Hidden(VertexId),
    /// A site is called the duplicate of a vertex that it does not equal, or is not called that of the one that it equals.
    #[error("site {} is said to be another one's duplicate and is not, or the other way round", .0.index())]
    Duplicate(VertexId),
}

impl Regular3 {
    /// Proves that this is the canonical regular triangulation of all its sites, or returns the first flaw found.
    pub fn check(&self) -> Result<(), RegularFlaw3> {
        check_geometry(&self.base)?;
        for (v, place) in self.under.all() {
            let site = self.base.site(place);
            if !self.base.is_in_span(site.0) {
                return Err(RegularFlaw3::Hidden(v));
            }
            let t = self.cell_at(site.0);
            let there = self.base.vertex_at(t, site.0);
            let is_above = there.map_or_else(
                || {
                    let corners = self.mesh().cells[t.index()].corners;
                    !self.mesh().is_ghost(t) && !f64::is_in_sphere(corners.map(|p| self.base.site(p)), site)
                },
                |w| self.base.weights[w.index()] >= site.1,
            );
            if !is_above {
                return Err(RegularFlaw3::Hidden(v));
            }
            let equal = there.filter(|w| self.base.weights[w.index()] == site.1).map(|w| self.mesh().name(w));
            if self.under.is_hidden(v) != equal.is_none() || equal.is_some_and(|w| w > v) {
                return Err(RegularFlaw3::Duplicate(v));
            }
        }
        Ok(())
    }
}
