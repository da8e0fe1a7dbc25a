//! Edges that are free again are flipped until everything is Delaunay but for constraints.
//!
//! Source: Lawson, "Software for C1 surface interpolation", 1977. Every flip lowers the surface of the lifted points, so it
//! ends, and where it ends is canonical.
//!
//! Cost: O(1) for each flip, of which there are O(k^2) at worst where k triangles change.

use delone_predicates::in_circle;

use crate::ids::EdgeId;
use crate::plane::layer::Layer;

impl Layer {
    /// Flips edges that are neither fixed nor Delaunay, starting from some that may be.
    pub(in crate::plane) fn legalize(&mut self, pending: Vec<EdgeId>) {
        self.legalize_observed(pending, |_, _| ());
    }

    /// Tells of each flip, by the edge that is new and its twin.
    pub(in crate::plane) fn legalize_observed(
        &mut self,
        mut pending: Vec<EdgeId>,
        mut flipped: impl FnMut(EdgeId, EdgeId),
    ) {
        while let Some(e) = pending.pop() {
            if !self.is_illegal(e) {
                continue;
            }
            let twin = self.mesh.twin(e);
            self.mesh.flip(e);
            flipped(e, twin);
            // The sides of the quadrilateral stay with the two triangles.
            pending.extend([e.next(), e.previous(), twin.next(), twin.previous()]);
        }
    }

    /// Whether an edge is free, and the far corner is inside of the circle of its triangle.
    fn is_illegal(&self, e: EdgeId) -> bool {
        let mesh = &self.mesh;
        let corners = [mesh.tail(e), mesh.head(e), mesh.tip(e), mesh.tip(mesh.twin(e))];
        if mesh.is_fixed(e) || corners.iter().any(|v| v.is_ghost()) {
            return false;
        }
        let [a, b, c, d] = corners.map(|v| self.points[v.index()]);
        in_circle(a, b, c, d).is_positive()
    }
}
