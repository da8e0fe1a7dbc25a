//! Proof that this is the canonical regular triangulation of all its sites.
//!
//! Tetrahedra are proved as without weights: lifted, no vertex across a facet is below the hyperplane of its tetrahedron. A site
//! that is no vertex is proved by the tetrahedron above which it lies: it is above that hyperplane, or equals a corner.
//!
//! Cost: O(n log n), and a walk for each site that is no vertex.

use super::Regular3;
use crate::regular::RegularFlaw;
use crate::space::check::{Flaw3, check_geometry};
use crate::space::layer::kernel::Lift;

impl Regular3 {
    /// Proves that this is the canonical regular triangulation of all its sites, or returns the first flaw found.
    pub fn check(&self) -> Result<(), RegularFlaw<Flaw3>> {
        check_geometry(&self.base)?;
        for (v, place) in self.under.all() {
            let site = self.base.site(place);
            if !self.base.is_in_span(site.0) {
                return Err(RegularFlaw::Hidden(v));
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
                return Err(RegularFlaw::Hidden(v));
            }
            let equal = there.filter(|w| self.base.weights[w.index()] == site.1).map(|w| self.mesh().name(w));
            if self.under.is_hidden(v) != equal.is_none() || equal.is_some_and(|w| w > v) {
                return Err(RegularFlaw::Duplicate(v));
            }
        }
        Ok(())
    }
}
