//! Proof that this is the canonical regular triangulation of all its sites.
//!
//! Tetrahedra are proved as without weights: lifted, no vertex across a facet is below the hyperplane of its tetrahedron. A site
//! that is no vertex is proved by the tetrahedron above which it lies: it is above that hyperplane, or equals a corner.
//!
//! Cost: O(n log n), and a walk for each site that is no vertex.

use delone_predicates::{Sign, Site, in_power_sphere_with_ties};

use super::Regular3;
use crate::ids::VertexId;
use crate::regular::RegularFlaw;
use crate::space::check::{Flaw3, check_geometry};
use crate::space::layer::kernel::Lift;

impl Regular3 {
    /// The side of what is spanned, lifted, that a site is on: positive above. Zero has the vertex that it equals, if there is one.
    pub(in crate::space) fn side(&self, site: Site<3>) -> (Sign, Option<VertexId>) {
        if !self.base.is_in_span(site.0) {
            return (Sign::Negative, None);
        }
        let t = self.cell_at(site.0);
        if let Some(v) = self.base.vertex_at(t, site.0) {
            return (Sign::of(&self.base.weights[v.index()], &site.1), Some(self.mesh().name(v)));
        }
        if self.mesh().is_ghost(t) {
            return (Sign::Negative, None);
        }
        let [a, b, c, d] = self.mesh().cells[t.index()].corners.map(|p| self.base.site(p));
        (-in_power_sphere_with_ties(a, b, c, d, site), None)
    }

    /// Proves that this is the canonical regular triangulation of all its sites, or returns the first flaw found.
    pub fn check(&self) -> Result<(), RegularFlaw<Flaw3>> {
        check_geometry(&self.base)?;
        for (v, place) in self.hidden_sites.all() {
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
            if self.hidden_sites.is_hidden(v) != equal.is_none() || equal.is_some_and(|w| w > v) {
                return Err(RegularFlaw::Duplicate(v));
            }
        }
        Ok(())
    }
}
