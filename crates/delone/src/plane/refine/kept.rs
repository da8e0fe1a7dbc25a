//! Triangles that were given stay until a new vertex is to come into their circle.
//!
//! Their edges are fixed without being constraints. Where a point is to become a vertex, the fixed edges go that are on the border of its cavity
//! and behind which it is in conflict, and what is around them is made Delaunay again. So the triangulation is at all times the constrained
//! Delaunay triangulation of its constraints and of the edges that are kept, and all that is proven of refinement holds.
//!
//! Cost: the cavity once more for each vertex, and the flips; nothing where no edge is kept.

use delone_predicates::in_circle;

use super::Refined2;
use super::free::Met;
use super::mesher::Mesher;
use crate::ids::{EdgeId, TriangleId};
use crate::plane::constrained::{Constrained2, SegmentId, sorted};

impl Refined2 {
    /// Whether a constraint edge is there only to keep triangles ([`super::Refinement::triangles`]) or layers, and is no border.
    pub fn only_keeps(&self, c: &Constrained2, e: EdgeId) -> bool {
        let is_kept = |segment: SegmentId| self.kept.binary_search(&segment).is_ok();
        !self.kept.is_empty() && c.covering(e).iter().all(|one| is_kept(one.segment))
    }
}

impl Mesher<'_> {
    /// A walk as [`Self::walk`], on which kept edges in the way go, and so do those that part the point from its cavity. Nothing if
    /// the triangle that it starts in went with them.
    pub(super) fn reach(&mut self, start: EdgeId, q: [f64; 2]) -> Option<Met> {
        let ends = [self.layer.mesh.tail(start), self.layer.mesh.head(start), self.layer.mesh.tip(start)];
        loop {
            let met = self.walk(start, q);
            let going = match met {
                Met::Constraint(e) if self.is_kept(e) => vec![e],
                Met::Triangle(t) if !self.kept.is_empty() => self.parting(t, q),
                _ => return Some(met),
            };
            if going.is_empty() {
                return Some(met);
            }
            self.release(&going);
            let mesh = &self.layer.mesh;
            if [mesh.tail(start), mesh.head(start), mesh.tip(start)] != ends {
                return None;
            }
        }
    }

    /// Lets the kept edges go that part a point on a constraint from its cavity. Gives the constraint, which may be in other triangles then.
    pub(super) fn make_way(&mut self, mut e: EdgeId, q: [f64; 2]) -> EdgeId {
        if self.kept.is_empty() {
            return e;
        }
        let ends = [self.layer.mesh.tail(e), self.layer.mesh.head(e)];
        loop {
            let seed = self.triangle_of(e, q);
            self.layer.mesh.set_fixed(e, false);
            let going = self.parting(seed, q);
            self.layer.mesh.set_fixed(e, true);
            if going.is_empty() {
                return e;
            }
            self.release(&going);
            let found = self.layer.mesh.edge_between(ends[0], ends[1]);
            debug_assert!(found.is_some(), "a constraint stays");
            e = found.unwrap_or(e);
        }
    }

    /// The kept edges on the border of a point's cavity, found from a triangle in it, behind which it is in conflict too.
    fn parting(&mut self, seed: TriangleId, q: [f64; 2]) -> Vec<EdgeId> {
        self.dig(q, seed);
        let mesh = &self.layer.mesh;
        let is_parting = |e: &EdgeId| {
            if mesh.tip(*e).is_ghost() || !mesh.is_fixed(*e) || !self.is_kept(*e) {
                return false;
            }
            let [a, b, c] = [mesh.tail(*e), mesh.head(*e), mesh.tip(*e)].map(|v| self.point(v));
            in_circle(a, b, c, q).is_positive()
        };
        let going = self.layer.cavity.border().iter().map(|edge| edge.1).filter(is_parting).collect();
        self.abandon();
        going
    }

    /// Lets kept edges go, and looks at what is new.
    fn release(&mut self, edges: &[EdgeId]) {
        let mut changed: Vec<TriangleId> = Vec::new();
        for &e in edges {
            let mesh = &mut self.layer.mesh;
            self.kept.remove(&sorted([mesh.tail(e), mesh.head(e)]));
            mesh.set_fixed(e, false);
        }
        let flipped = |e: EdgeId, twin: EdgeId| changed.extend([e.triangle(), twin.triangle()]);
        self.layer.legalize_observed(edges.to_vec(), flipped);
        changed.sort_unstable();
        changed.dedup();
        for t in changed {
            self.look_at(t);
            for e in [0, 1, 2].map(|k| t.edge(k)) {
                if self.is_constraint(e) {
                    self.look_at_constraint(e);
                }
            }
        }
    }
}
