//! The hull edge that is nearest to a point outside.
//!
//! A walk that leaves the hull ends at whichever it meets first of the edges that the point is beyond, which depends on where it began.
//! Along the hull their distances from the point fall towards the nearest one and rise from there, so that it is found from any of them.
//!
//! Cost: two angles at most and an orientation for each edge in between.

use delone_predicates::angle;

use super::Layer;
use super::kernel::Kernel;
use crate::ids::{EdgeId, Place, TriangleId};
use crate::tally::Tally;

impl<K: Kernel> Layer<K> {
    /// Of the hull edges that a point is strictly beyond, given the ghost of one, that with the nearest point to it; of two that meet in
    /// that point, the first counter-clockwise. With how many edges were looked at: if these are more than `most`, which is at least 1, the
    /// nearest one is further on.
    #[inline(never)]
    pub(in crate::plane) fn nearest_hull_edge(
        &self,
        ghost: TriangleId,
        q: [f64; 2],
        most: usize,
    ) -> (EdgeId, usize) {
        let mesh = &self.mesh;
        let point = |v: Place| self.points[v.index()];
        // Edges that leave the ghost vertex stand for those of the hull that end where they do.
        let hull_edge = |e: EdgeId| mesh.twin(e.next());
        let mut edges = [0, 1, 2].map(|k| ghost.edge(k)).into_iter();
        let Some(mut at) = edges.find(|e| mesh.tail(*e).is_ghost()) else { return (ghost.edge(0), 1) };
        let mut steps = 1;
        while steps <= most {
            let [a, b] = [mesh.tip(at), mesh.head(at)].map(point);
            let is_past_end = angle(b, a, q).is_negative();
            let (towards, is_nearer) = if is_past_end {
                let next = mesh.twin(at).next();
                (next, angle(b, q, point(mesh.head(next))).is_positive())
            } else {
                (mesh.twin(at.previous()), !angle(a, b, q).is_positive())
            };
            if !is_nearer {
                break;
            }
            if !self.is_beyond(hull_edge(towards), q) {
                break;
            }
            at = towards;
            steps += 1;
        }
        (hull_edge(at), steps)
    }

    /// The same, however far, told as it goes.
    pub(in crate::plane) fn hull_edge_nearest_to<T: Tally>(
        &self,
        q: [f64; 2],
        ghost: TriangleId,
        tally: &mut T,
    ) -> EdgeId {
        let (edge, steps) = self.nearest_hull_edge(ghost, q, usize::MAX);
        (0..steps).for_each(|_| tally.visited());
        edge
    }
}
