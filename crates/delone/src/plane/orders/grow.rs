//! The diagram of one order out of that of the order before: every region is a hole.
//!
//! A region of order k is where its k sites are the nearest. Inside of it the next order is the plain Voronoi diagram of all
//! other sites, and each of those that reaches in reaches the border, once. So around the border they are a polygon, and the
//! circles with just the k sites inside are its Delaunay triangles: for k = 1 the hole that is left when the site is
//! removed. Sites change along the border in two ways. At a circle with k - 1 sites inside the one outside changes: a corner of
//! the polygon. At one with k - 2 inside the one within changes: that circle is not seen by the next order.
//!
//! Triangles here are circles, each glued to three others as an order sees it. That with {a, b, c} on it and I inside is seen
//! twice. By order |I| + 1 as *new*: around it are the regions I + a, I + b, I + c, that of each corner with the corner. By
//! order |I| + 2 as *old*: around it are I + b + c, I + c + a, I + a + b, that of each corner without it. Either way the regions
//! are the stars of corners, and `spin` turns around them. Ghosts are half-planes, and regions with the ghost are none.
//!
//! Source: Lee, "On k-nearest neighbor Voronoi diagrams in the plane", IEEE Trans. Computers C-31, 1982, turned from
//! diagrams to triangles. Every decision is an in-circle test of four sites under the canonical rule.
//!
//! Cost: O(1) expected for each circle on evenly spread sites, nearly all polygons having three or four corners; O(d log d)
//! for a region with d neighbors at worst; O(k) more for the sites of a region.

use super::MAX_CIRCLES;
use crate::error::Error;
use crate::ids::{EdgeId, Place, TriangleId};
use crate::memory::room_for;
use crate::mesh::Mesh2;
use crate::plane::layer::Layer;
use crate::plane::layer::kernel::{NearestSites, Sites};
use crate::plane::layer::remove::Hole;

/// No region: that of a corner which the order does not see.
pub(super) const NO_REGION: u32 = u32::MAX;

/// The diagram of one order.
pub(super) struct Complex {
    pub(super) order: usize,
    /// Triangles are circles: first the old ones, then the new.
    pub(super) mesh: Mesh2,
    /// The number of old ones.
    pub(super) old: usize,
    /// For each edge the region that is the star of its origin.
    pub(super) region: Vec<u32>,
    /// For each region an edge of its star.
    pub(super) first: Vec<EdgeId>,
    /// For each region its sites.
    pub(super) sites: Vec<Place>,
}

impl Complex {
    /// The plain diagram: a region a vertex, and all circles new.
    fn plain(mesh: &Mesh2) -> Self {
        let mut complex = Self::empty(1, mesh.clone(), 0);
        complex.find_regions(|_, _| {});
        complex
    }

    fn empty(order: usize, mesh: Mesh2, old: usize) -> Self {
        let region = vec![NO_REGION; mesh.edges.len()];
        Self { order, mesh, old, region, first: Vec::new(), sites: Vec::new() }
    }

    /// The next order.
    ///
    /// # Errors
    /// [`Error::TooManyCircles`].
    pub(super) fn next(&self, points: &[[f64; 2]], hole: &mut Hole<NearestSites>) -> Result<Self, Error> {
        let mut mesh = Mesh2::empty(points.len());
        // A polygon has no more corners than its region has new circles, and two triangles less.
        let kept = self.mesh.slot_count() - self.old;
        mesh.edges = room_for(4 * (4 * kept).saturating_sub(2 * self.first.len()));
        for t in (self.old..self.mesh.slot_count()).map(TriangleId::new) {
            mesh.loose_triangle(self.mesh.places(t));
        }
        let old = mesh.slot_count();
        let sites = Sites { points, weights: &[] };
        // For each new circle the region whose sites are inside.
        let mut inside: Vec<u32> = Vec::new();
        for (region, &first) in self.first.iter().enumerate() {
            hole.border.clear();
            for e in self.mesh.star_from(first).filter(|e| self.is_new(*e)) {
                let side = e.next();
                let outside = TriangleId::new(side.triangle().index() - self.old).edge(side.corner());
                hole.border.push((self.mesh.tail(side), outside));
            }
            let count = hole.border.len() - 2;
            if mesh.slot_count() + count > MAX_CIRCLES {
                return Err(Error::TooManyCircles { most: MAX_CIRCLES, inside: self.order });
            }
            hole.triangles.clear();
            // The first one tells only what the hole lies in: where two sides meet nothing is filled.
            hole.triangles.push(TriangleId::new(0));
            hole.triangles.extend((0..count).map(|_| mesh.loose_triangle([Place::GHOST; 3])));
            inside.extend((0..count).map(|_| region as u32));
            hole.fill(&mut mesh, &sites, &mut ());
        }
        let mut next = Self::empty(self.order + 1, mesh, old);
        next.find_regions(|e, sites| {
            let t = e.triangle().index();
            let before = if t < old {
                // With one of the two others, of which the second comes too.
                let e = TriangleId::new(self.old + t).edge(e.next().corner());
                self.region[e.index()]
            } else {
                inside[t - old]
            };
            sites.extend_from_slice(self.sites_of(before as usize));
        });
        Ok(next)
    }

    /// Numbers the regions in the order of their first circles. A region is one of the order before, which `before` appends
    /// the sites of, and one site more.
    fn find_regions(&mut self, before: impl Fn(EdgeId, &mut Vec<Place>)) {
        let triangles = (0..self.mesh.slot_count()).map(TriangleId::new);
        for e in triangles.flat_map(|t| [0, 1, 2].map(|k| t.edge(k))) {
            let added = if self.is_new(e) { e } else { e.previous() };
            let is_one =
                !self.mesh.tail(added).is_ghost() && (self.is_new(e) || !self.mesh.tail(e.next()).is_ghost());
            if !is_one || self.region[e.index()] != NO_REGION {
                continue;
            }
            let region = self.first.len() as u32;
            self.first.push(e);
            before(e, &mut self.sites);
            self.sites.push(self.mesh.tail(added));
            for e in self.mesh.star_from(e) {
                self.region[e.index()] = region;
            }
        }
    }

    /// The sites of a region.
    pub(super) fn sites_of(&self, region: usize) -> &[Place] {
        &self.sites[region * self.order..][..self.order]
    }

    /// Whether the circle of an edge is new to this order.
    pub(super) fn is_new(&self, e: EdgeId) -> bool {
        e.triangle().index() >= self.old
    }
}

/// The layer that a diagram is grown on.
pub(super) fn grow(layer: &Layer, order: usize) -> Result<Complex, Error> {
    let mut complex = Complex::plain(&layer.mesh);
    let mut hole = Hole::default();
    while complex.order < order {
        complex = complex.next(&layer.points, &mut hole)?;
    }
    Ok(complex)
}
