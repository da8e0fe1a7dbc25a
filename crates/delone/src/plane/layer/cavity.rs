//! The cavity of a new point: the triangles whose circles contain it, refilled as a star.
//!
//! Source: Bowyer, "Computing Dirichlet tessellations", and Watson, "Computing the n-dimensional Delaunay
//! tessellation", The Computer Journal 1981. With the canonical in-circle test the cavity is that of points in
//! general position: connected, without an inner vertex, and star-shaped around the new point.
//!
//! Cost: O(k) for k triangles in the cavity, about four on average over random insertions; nothing is
//! allocated once the buffers have grown.

use delone_predicates::{Sign, in_circle, orient2d, strictly_between};

use crate::ids::{EdgeId, Place, TriangleId};
use crate::mesh::Mesh2;
use crate::prefetch::prefetch;
use crate::tally::Tally;

/// Buffers that are kept between insertions.
#[derive(Clone, Debug, Default)]
pub(in crate::plane) struct Cavity {
    /// Triangles of the cavity.
    triangles: Vec<TriangleId>,
    /// Its border, counter-clockwise: where each edge starts, and its twin outside.
    border: Vec<(Place, EdgeId)>,
    pending: Vec<(EdgeId, Place)>,
}

/// Whether the circle of a triangle contains `q`; or, for furthest sites, does not. That of a ghost is the
/// half-plane beyond its hull edge, with the inside of the edge. `point` gives the point of each corner that is not
/// the ghost.
#[inline]
pub(in crate::plane) fn conflicts<const FURTHEST: bool>(
    corners: [Place; 3],
    point: impl Fn(usize) -> [f64; 2],
    q: [f64; 2],
) -> bool {
    let beyond = |v: [f64; 2], u: [f64; 2]| match orient2d(v, u, q) {
        Sign::Positive => true,
        Sign::Zero => strictly_between(u, v, q),
        Sign::Negative => false,
    };
    if corners[0].is_ghost() {
        beyond(point(1), point(2))
    } else if corners[1].is_ghost() {
        beyond(point(2), point(0))
    } else if corners[2].is_ghost() {
        beyond(point(0), point(1))
    } else {
        in_circle(point(0), point(1), point(2), q).is_positive() != FURTHEST
    }
}

impl Cavity {
    /// Makes `v` a vertex: removes the triangles in conflict with its point, starting from `seed`, one of
    /// them, and joins `v` to their border.
    #[inline]
    pub(in crate::plane) fn insert<T: Tally>(
        &mut self,
        mesh: &mut Mesh2,
        points: &[[f64; 2]],
        v: Place,
        seed: TriangleId,
        tally: &mut T,
    ) {
        self.find::<_, false>(mesh, points, points[v.index()], seed, tally);
        tally.destroyed(self.triangles.len());
        tally.created(self.border.len());
        self.refill(mesh, v, seed);
    }

    /// What the last insertion did: its new triangles, the first of which were those of the cavity but for the last
    /// two; and for each new triangle the border edge of the cavity that it stands on: where it starts, and its
    /// twin outside.
    pub(in crate::plane) fn last(&self) -> (&[TriangleId], &[(Place, EdgeId)]) {
        (&self.triangles, &self.border)
    }

    /// The same among furthest-site triangles, whose circles contain all points. The point is beyond the hull.
    pub(in crate::plane) fn insert_furthest(
        &mut self,
        mesh: &mut Mesh2,
        points: &[[f64; 2]],
        v: Place,
        seed: TriangleId,
    ) {
        self.find::<_, true>(mesh, points, points[v.index()], seed, &mut ());
        self.refill(mesh, v, seed);
    }

    /// Collects the triangles in conflict, depth first in counter-clockwise order, so that the border comes in
    /// its cyclic order.
    fn find<T: Tally, const FURTHEST: bool>(
        &mut self,
        mesh: &mut Mesh2,
        points: &[[f64; 2]],
        q: [f64; 2],
        seed: TriangleId,
        tally: &mut T,
    ) {
        self.triangles.clear();
        self.border.clear();
        self.enter(mesh, seed);
        self.pending.extend([2, 1, 0].map(|k| look(mesh, points, seed.edge(k))));
        while let Some((outside, tip)) = self.pending.pop() {
            let t = outside.triangle();
            if mesh.is_marked(t) {
                continue;
            }
            tally.in_circle();
            let corners = [mesh.tail(outside), mesh.head(outside), tip];
            if conflicts::<FURTHEST>(corners, |k| points[corners[k].index()], q) {
                self.enter(mesh, t);
                self.pending.extend([outside.previous(), outside.next()].map(|e| look(mesh, points, e)));
            } else {
                self.border.push((corners[1], outside));
            }
        }
    }

    fn enter(&mut self, mesh: &mut Mesh2, t: TriangleId) {
        mesh.mark(t, true);
        self.triangles.push(t);
    }

    /// Joins `v` to every edge of the border. There are two more of them than triangles removed.
    fn refill(&mut self, mesh: &mut Mesh2, v: Place, near: TriangleId) {
        debug_assert_eq!(
            self.border.len(),
            self.triangles.len() + 2,
            "a cavity is a disk without inner vertex"
        );
        for _ in 0..2 {
            self.triangles.push(mesh.new_triangle(near));
        }
        let n = self.border.len();
        for i in 0..n {
            let (t, following) = (self.triangles[i], self.triangles[(i + 1) % n]);
            let ((a, outside), (b, _)) = (self.border[i], self.border[(i + 1) % n]);
            mesh.set_corners(t, [a, b, v]);
            mesh.link(t.edge(0), outside);
            mesh.link(t.edge(1), following.edge(2));
            mesh.remember(t.edge(0));
            mesh.mark(t, false);
        }
        mesh.incident[v.index()] = self.triangles[0].edge(2);
        mesh.vertex_count += 1;
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
