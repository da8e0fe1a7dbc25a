//! The cavity of a new point: the triangles whose circles contain it, refilled as a star.
//!
//! Source: Bowyer, "Computing Dirichlet tessellations", and Watson, "Computing the n-dimensional Delaunay
//! tessellation", The Computer Journal 1981. With the canonical in-circle test the cavity is that of points in
//! general position: connected, without an inner vertex, and star-shaped around the new point.
//!
//! Triangles behind a fixed edge are not seen, and not in conflict. The cavity is what flips would make then: an edge is passed
//! only if the point is in the circle behind it, so the corner there makes a convex quadrilateral with it, and every border
//! edge is strictly seen from the point. Both sides of a fixed edge are never in it: its line would pass through the point.
//!
//! Cost: O(k) for k triangles in the cavity, about four on average over random insertions; nothing is
//! allocated once the buffers have grown.

use super::kernel::{Kernel, NearestSites, Site, Sites};
use crate::ids::{EdgeId, Place, TriangleId};
use crate::locate::conflict::{self, Beyond};
use crate::mesh::Mesh2;
use crate::mesh::triangles::surgery::BorderEdge;
use crate::prefetch::prefetch;
use crate::tally::Tally;

/// Buffers that are kept between insertions.
#[derive(Clone, Debug, Default)]
pub(crate) struct Cavity {
    /// Triangles of the cavity.
    triangles: Vec<TriangleId>,
    /// Its border, counter-clockwise: where each edge starts, and its twin outside.
    border: Vec<BorderEdge>,
    pending: Vec<(EdgeId, Place)>,
    /// The vertices inside of it, which the new one hides.
    hidden: Vec<Place>,
    /// Triangles of the cavity that its star did not take.
    spare: Vec<TriangleId>,
}

impl Cavity {
    /// Makes `v` a vertex: removes the triangles in conflict with its point, starting from `seed`, one of
    /// them, and joins `v` to their border.
    #[inline]
    pub(in crate::plane) fn insert<K: Kernel, T: Tally>(
        &mut self,
        mesh: &mut Mesh2,
        sites: Sites<'_, K>,
        v: Place,
        seed: TriangleId,
        tally: &mut T,
    ) {
        self.dig_observed(mesh, &sites, sites.at(v), seed, tally);
        tally.destroyed(self.triangles.len());
        tally.created(self.border.len());
        self.refill::<K>(mesh, v, seed);
    }

    /// Finds the triangles in conflict with a point that is no vertex yet, from one of them on; they are marked. [`Self::fill`] or
    /// [`Self::abandon`] must follow.
    pub(in crate::plane) fn dig(
        &mut self,
        mesh: &mut Mesh2,
        points: &[[f64; 2]],
        q: [f64; 2],
        seed: TriangleId,
    ) {
        self.dig_observed(mesh, &Sites::<NearestSites> { points, weights: &[] }, (q, ()), seed, &mut ());
    }

    /// The border of what was dug, counter-clockwise: where each edge starts, and its twin outside.
    pub(in crate::plane) fn border(&self) -> &[BorderEdge] {
        &self.border
    }

    /// Makes `v`, whose cavity was dug, a vertex. The kernel hides no sites.
    pub(crate) fn fill(&mut self, mesh: &mut Mesh2, v: Place) {
        self.refill::<NearestSites>(mesh, v, self.triangles[0]);
    }

    /// Leaves what was dug as it is.
    pub(in crate::plane) fn abandon(&self, mesh: &mut Mesh2) {
        self.triangles.iter().for_each(|&t| mesh.unmark(t));
    }

    /// The result of the last insertion: its new triangles, and for each the border edge that it stands on: its start, and its twin
    /// outside. Without hidden vertices, all but the last two reuse triangles of the cavity.
    pub(crate) fn last(&self) -> (&[TriangleId], &[BorderEdge]) {
        (&self.triangles, &self.border)
    }

    /// The vertices that the last insertion hid, and the triangles that it freed.
    pub(in crate::plane) fn swallowed(&self) -> (&[Place], &[TriangleId]) {
        (&self.hidden, &self.spare)
    }

    #[inline]
    fn dig_observed<K: Kernel, T: Tally>(
        &mut self,
        mesh: &mut Mesh2,
        sites: &Sites<'_, K>,
        q: Site<K>,
        seed: TriangleId,
        tally: &mut T,
    ) {
        self.find(mesh, sites.points, seed, |corners| {
            tally.in_circle();
            K::conflicts(corners, |k| sites.at(corners[k]), q)
        });
    }

    /// Collects and marks the triangles in conflict, from one of them on; their corners decide. [`Self::fill`] or [`Self::abandon`]
    /// must follow.
    #[inline]
    pub(crate) fn find(
        &mut self,
        mesh: &mut Mesh2,
        points: &[[f64; 2]],
        seed: TriangleId,
        mut conflicts: impl FnMut([Place; 3]) -> bool,
    ) {
        let Self { triangles, border, pending, .. } = self;
        triangles.clear();
        border.clear();
        mesh.mark(seed);
        triangles.push(seed);
        pending.extend([2, 1, 0].map(|k| look(mesh, points, seed.edge(k))));
        conflict::search(pending, |&(outside, tip)| {
            let t = outside.triangle();
            if mesh.is_marked(t) {
                return Beyond::Outside;
            }
            let corners = [mesh.tail(outside), mesh.head(outside), tip];
            if mesh.is_fixed(outside) || !conflicts(corners) {
                border.push((corners[1], outside));
                return Beyond::Outside;
            }
            mesh.mark(t);
            triangles.push(t);
            let [left, right] = [outside.previous(), outside.next()].map(|e| look(mesh, points, e));
            Beyond::Inside(right, [left])
        });
    }

    /// Joins `v` to every edge of the border. There are two more of them than triangles removed, and two less for each vertex
    /// inside.
    fn refill<K: Kernel>(&mut self, mesh: &mut Mesh2, v: Place, near: TriangleId) {
        if K::HIDES {
            self.hide(mesh);
        }
        debug_assert!(
            K::HIDES || self.border.len() == self.triangles.len() + 2,
            "a cavity is a disk without inner vertex"
        );
        while self.triangles.len() < self.border.len() {
            self.triangles.push(mesh.new_triangle(near));
        }
        mesh.fill_star(v, &self.border, &self.triangles);
        mesh.vertex_count += 1;
    }
}

impl Cavity {
    /// Takes the vertices inside of the cavity away, and what triangles its star will not need.
    fn hide(&mut self, mesh: &mut Mesh2) {
        self.hidden.clear();
        self.spare.clear();
        if self.border.len() == self.triangles.len() + 2 {
            return;
        }
        let mut around: Vec<Place> = self.border.iter().map(|edge| edge.0).collect();
        around.sort_unstable();
        self.hidden.extend(self.triangles.iter().flat_map(|&t| mesh.places(t)));
        self.hidden.sort_unstable();
        self.hidden.dedup();
        self.hidden.retain(|p| around.binary_search(p).is_err());
        debug_assert_eq!(
            self.triangles.len() + 2,
            self.border.len() + 2 * self.hidden.len(),
            "Euler's relation"
        );
        self.hidden.iter().for_each(|p| mesh.incident[p.index()] = EdgeId::NONE);
        mesh.vertex_count -= self.hidden.len();
        if self.triangles.len() > self.border.len() {
            self.spare.extend(self.triangles.drain(self.border.len()..));
            self.spare.iter().for_each(|&t| mesh.free_triangle(t));
        }
    }
}

/// The other side of an edge and the corner across it. What the test and the triangle's removal will read is asked of
/// memory as soon as it is known where it is: the corner's point and its edge, and the triangles further on.
#[inline]
fn look(mesh: &Mesh2, points: &[[f64; 2]], e: EdgeId) -> (EdgeId, Place) {
    let outside = mesh.twin(e);
    let tip = mesh.tip(outside);
    prefetch(points, tip.index());
    prefetch(&mesh.incident, tip.index());
    prefetch(&mesh.edges, mesh.twin(outside.next()).index());
    prefetch(&mesh.edges, mesh.twin(outside.previous()).index());
    (outside, tip)
}
