//! What surrounds a point of the plane: the triangles whose circles hold it.

use super::Delaunay2;
use super::layer::kernel::{Kernel, NearestSites};
use crate::around::{Around, Surround};
use crate::error::Error;
use crate::ids::TriangleId;
use crate::locate::Start;
use crate::points::finite;
use crate::triangulation::Found;

/// Walks from a hint that are longer cost more than the search for a better one.
const NEAR: usize = 12;

impl Surround for Delaunay2 {
    fn find_near(&self, near: Option<TriangleId>, q: [f64; 2]) -> Result<Found<TriangleId>, Error> {
        let q = finite(q)?;
        let near = near.filter(|&t| self.mesh().is_triangle(t));
        let spot = near.and_then(|t| self.base.spot_within(Start::Hint(t.edge(0), 0), q, NEAR, &mut ()));
        let spot = spot.map_or_else(|| self.spot(q, &mut ()).spot, |found| found.0);
        Ok(self.found(self.base.classify(spot, q)))
    }

    fn surround(
        &self,
        near: Option<TriangleId>,
        q: [f64; 2],
        around: &mut Around<Self>,
    ) -> Result<Found<TriangleId>, Error> {
        let found = self.find_near(near, q)?;
        around.clear();
        if let (Some(seed), 2..) = (found.simplex, found.face().len()) {
            self.dig(seed, q, around);
        }
        Ok(found)
    }
}

impl Delaunay2 {
    /// Depth first in counter-clockwise order, so that the border comes in its cyclic order. No vertex is inside of the cavity: no
    /// triangle is met twice.
    fn dig(&self, seed: TriangleId, q: [f64; 2], around: &mut Around<Self>) {
        let (mesh, points) = (&self.base.mesh, &self.base.points);
        around.cavity.push(seed);
        around.pending.extend([2, 1, 0].map(|k| (seed, k)));
        while let Some((t, k)) = around.pending.pop() {
            let outside = mesh.twin(t.edge(k));
            let corners = [mesh.tail(outside), mesh.head(outside), mesh.tip(outside)];
            if NearestSites::conflicts(corners, |k| (points[corners[k].index()], ()), (q, ())) {
                if corners[2].is_ghost() {
                    return around.stop_at_hull();
                }
                let entered = outside.triangle();
                around.cavity.push(entered);
                let k = outside.corner();
                around.pending.extend([(entered, (k + 2) % 3), (entered, (k + 1) % 3)]);
                continue;
            }
            let facet = [corners[1], corners[0]].map(|p| mesh.name(p));
            let beyond = if corners[2].is_ghost() { mesh.twin(outside) } else { outside };
            around.border.push((facet, beyond.triangle()));
        }
    }
}
