//! Proof that this is the canonical regular triangulation of all its sites.
//!
//! Triangles are proved as without weights: lifted, no vertex across an edge is below the plane of its triangle. A site that is
//! no vertex is proved by the triangle above which it lies: it is above that triangle's plane, or equals a corner.
//!
//! Cost: O(n), and a walk for each site that is no vertex.

use delone_predicates::{Sign, in_power_circle_with_ties};

use super::Regular2;
use crate::ids::VertexId;
use crate::plane::check::{Flaw2, check_geometry};
use crate::plane::layer::insert::Spot;
use crate::plane::layer::kernel::{Kernel, Power, Site};
use crate::regular::RegularFlaw;

impl Regular2 {
    /// The side of what is spanned, lifted, that a site is on: positive above. Zero has the vertex that it equals, if there is one.
    pub(in crate::plane) fn side(&self, site: Site<Power>) -> (Sign, Option<VertexId>) {
        match self.spot(site.0).0 {
            Spot::Vertex(v) => (Sign::of(&self.base.weights[v.index()], &site.1), Some(self.mesh().name(v))),
            Spot::Triangle(t) if !self.mesh().is_ghost(t) => {
                let [a, b, c] = self.base.mesh.places(t).map(|p| self.base.site(p));
                (-in_power_circle_with_ties(a, b, c, site), None)
            }
            _ => (Sign::Negative, None),
        }
    }

    /// Proves that this is the canonical regular triangulation of all its sites, or returns the first flaw found.
    pub fn check(&self) -> Result<(), RegularFlaw<Flaw2>> {
        self.mesh().check().map_err(Flaw2::from)?;
        check_geometry(&self.base)?;
        for (v, place) in self.hidden_sites.all() {
            let site = self.base.site(place);
            let (spot, _) = self.spot(site.0);
            let corners = |k: usize, t| self.base.site(self.base.mesh.places(t)[k]);
            let mut equal = None;
            let is_above = match spot {
                Spot::Vertex(w) => {
                    equal = Some(w).filter(|w| self.base.weights[w.index()] == site.1);
                    self.base.weights[w.index()] >= site.1
                }
                Spot::Segment(e) => {
                    let [a, b] = [self.base.mesh.tail(e), self.base.mesh.head(e)].map(|p| self.base.site(p));
                    !Power::contains_on_line(a, b, site)
                }
                Spot::Triangle(t) => {
                    !self.mesh().is_ghost(t)
                        && !Power::contains(corners(0, t), corners(1, t), corners(2, t), site)
                }
                _ => false,
            };
            if !is_above {
                return Err(RegularFlaw::Hidden(v));
            }
            let equal = equal.map(|w| self.mesh().name(w));
            if self.hidden_sites.is_hidden(v) != equal.is_none() || equal.is_some_and(|w| w > v) {
                return Err(RegularFlaw::Duplicate(v));
            }
        }
        Ok(())
    }
}
