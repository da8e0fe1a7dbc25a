//! The cavity of a new point: the triangles whose circles contain it, refilled as a star.
//!
//! Source: Bowyer, "Computing Dirichlet tessellations", and Watson, "Computing the n-dimensional Delaunay
//! tessellation", The Computer Journal 1981. With the canonical in-circle test the cavity is that of points in
//! general position: connected, without an inner vertex, and star-shaped around the new point.
//!
//! Cost: O(k) for k triangles in the cavity, about four on average over random insertions; nothing is
//! allocated once the buffers have grown.

use delone_predicates::{Sign, in_circle, orient2d, strictly_between};

use crate::ids::{EdgeId, TriangleId, VertexId};
use crate::mesh::{HalfEdge, Mesh};

/// Buffers that are kept between insertions.
#[derive(Clone, Debug, Default)]
pub(super) struct Cavity {
    /// Triangles of the cavity.
    triangles: Vec<TriangleId>,
    /// Its border, counter-clockwise: where each edge starts, and its twin outside.
    border: Vec<(VertexId, EdgeId)>,
    /// Edges still to be crossed.
    pending: Vec<EdgeId>,
    /// For each triangle the round in which it was last put into a cavity.
    marks: Vec<u32>,
    round: u32,
}

/// Whether the circle of a triangle contains `q`. That of a ghost is the half-plane beyond its hull edge, with
/// the inside of the edge.
fn conflicts(mesh: &Mesh, points: &[[f64; 2]], t: TriangleId, q: [f64; 2]) -> bool {
    let corners = mesh.corners(t);
    let point = |v: VertexId| points[v.index()];
    match corners.iter().position(|v| v.is_ghost()) {
        None => {
            let [a, b, c] = corners.map(point);
            in_circle(a, b, c, q).is_positive()
        }
        Some(k) => {
            let (v, u) = (point(corners[(k + 1) % 3]), point(corners[(k + 2) % 3]));
            match orient2d(v, u, q) {
                Sign::Positive => true,
                Sign::Zero => strictly_between(u, v, q),
                Sign::Negative => false,
            }
        }
    }
}

impl Cavity {
    /// Makes `v` a vertex: removes the triangles in conflict with its point, starting from `seed`, one of
    /// them, and joins `v` to their border. Returns the number of conflict tests.
    pub(super) fn insert(
        &mut self,
        mesh: &mut Mesh,
        points: &[[f64; 2]],
        v: VertexId,
        seed: TriangleId,
    ) -> u64 {
        let tests = self.find(mesh, points, points[v.index()], seed);
        self.refill(mesh, v);
        tests
    }

    /// Collects the triangles in conflict, depth first in counter-clockwise order, so that the border comes in
    /// its cyclic order.
    fn find(&mut self, mesh: &Mesh, points: &[[f64; 2]], q: [f64; 2], seed: TriangleId) -> u64 {
        self.round += 1;
        self.marks.resize(mesh.slot_count(), 0);
        self.triangles.clear();
        self.border.clear();
        self.enter(seed);
        self.pending.extend([2, 1, 0].map(|k| seed.edge(k)));
        let mut tests = 0;
        while let Some(e) = self.pending.pop() {
            let outside = mesh.twin(e);
            let t = outside.triangle();
            if self.marks[t.index()] == self.round {
                continue;
            }
            tests += 1;
            if conflicts(mesh, points, t, q) {
                self.enter(t);
                self.pending.extend([outside.previous(), outside.next()]);
            } else {
                self.border.push((mesh.origin(e), outside));
            }
        }
        tests
    }

    fn enter(&mut self, t: TriangleId) {
        self.marks[t.index()] = self.round;
        self.triangles.push(t);
    }

    /// Joins `v` to every edge of the border. There are two more of them than triangles removed.
    fn refill(&mut self, mesh: &mut Mesh, v: VertexId) {
        debug_assert_eq!(
            self.border.len(),
            self.triangles.len() + 2,
            "a cavity is a disk without inner vertex"
        );
        for _ in 0..2 {
            self.triangles.push(TriangleId::new(mesh.slot_count()));
            mesh.edges.extend([HalfEdge::UNUSED; 4]);
        }
        let n = self.border.len();
        for i in 0..n {
            let (t, following) = (self.triangles[i], self.triangles[(i + 1) % n]);
            let ((a, outside), (b, _)) = (self.border[i], self.border[(i + 1) % n]);
            for (k, corner) in [a, b, v].into_iter().enumerate() {
                mesh.edges[t.edge(k).index()].origin = corner;
            }
            mesh.link(t.edge(0), outside);
            mesh.link(t.edge(1), following.edge(2));
            if a.is_ghost() {
                mesh.ghost_edge = t.edge(0);
            } else {
                mesh.incident[a.index()] = t.edge(0);
            }
        }
        mesh.incident[v.index()] = self.triangles[0].edge(2);
        mesh.vertex_count += 1;
    }
}
