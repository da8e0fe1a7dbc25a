//! A proof that a triangulation is the canonical one of its points and segments.
//!
//! A sphere of triangles whose finite ones are counter-clockwise, with a convex hull that goes around once, is a triangulation;
//! it is the canonical one if every edge is a constraint or has the far corner outside of the circle, if both sides of an edge
//! agree on that, and if the constraints are what the segments cover, no more and no less. Cost: O(n + m log m) for n points and
//! m constraint edges.

use super::Constrained2;
use super::segments::{Ends, SegmentId};
use crate::ids::EdgeId;
use crate::plane::check::Flaw2;

/// What is wrong with a constrained triangulation, one sentence each.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ConstrainedFlaw2 {
    /// It is no triangulation, or an edge is neither a constraint nor Delaunay.
    #[error(transparent)]
    Triangulation(#[from] Flaw2),
    /// An edge is a constraint on one side only.
    #[error("edge {0:?} is a constraint on one side only")]
    Side(EdgeId),
    /// A part of a segment is no constraint.
    #[error("a part of segment {} is no constraint", .0.index())]
    Missing(SegmentId),
    /// A constraint is covered by no segment.
    #[error("edge {0:?} is a constraint, and no segment covers it")]
    Stray(EdgeId),
    /// What is remembered of the segments that cover an edge is wrong.
    #[error("the segments that cover edge {0:?} are not those remembered")]
    Cover(EdgeId),
}

impl Constrained2 {
    /// Proves that this is the canonical constrained Delaunay triangulation of its points and segments, or returns the first
    /// flaw found. Independent of how it was built and changed.
    pub fn check(&self) -> Result<(), ConstrainedFlaw2> {
        self.graph.check()?;
        let mesh = self.mesh();
        if let Some(e) = mesh.undirected_edges().find(|&e| mesh.is_fixed(e) != mesh.is_fixed(mesh.twin(e))) {
            return Err(ConstrainedFlaw2::Side(e));
        }
        let mut covered: Vec<(Ends, SegmentId, bool)> = Vec::new();
        for (s, _) in self.segments() {
            let mut is_missing = false;
            self.edges_of(s, |s, e| {
                is_missing |= !mesh.is_fixed(e);
                let ends = [mesh.origin(e), mesh.destination(e)];
                let forward = ends[0] < ends[1];
                covered.push((if forward { ends } else { [ends[1], ends[0]] }, s, forward));
            });
            let length: usize = self.segments.pieces(s).count();
            if is_missing || !self.is_whole(s) || length == 0 {
                return Err(ConstrainedFlaw2::Missing(s));
            }
        }
        covered.sort_unstable();
        for e in self.constraint_edges() {
            let ends = [mesh.origin(e), mesh.destination(e)];
            let ends = [ends[0].min(ends[1]), ends[0].max(ends[1])];
            let start = covered.partition_point(|c| c.0 < ends);
            let of_edge = || covered[start..].iter().take_while(|c| c.0 == ends);
            if of_edge().next().is_none() {
                return Err(ConstrainedFlaw2::Stray(e));
            }
            if let Some(cover) = self.cover.get() {
                let remembered = cover.of(ends);
                let is_same = |(c, r): (&(Ends, SegmentId, bool), &super::Covering2)| {
                    (c.1, c.2) == (r.segment, r.is_forward)
                };
                if of_edge().count() != remembered.len() || !of_edge().zip(&remembered).all(is_same) {
                    return Err(ConstrainedFlaw2::Cover(e));
                }
            }
        }
        Ok(())
    }

    /// Whether a segment's edges lead from its first end to its second.
    fn is_whole(&self, s: SegmentId) -> bool {
        let mesh = self.mesh();
        let Some([first, last]) = self.segments.ends(s) else { return false };
        let mut at = Some(first);
        self.edges_of(s, |_, e| at = at.filter(|&v| v == mesh.origin(e)).map(|_| mesh.destination(e)));
        at == Some(last)
    }
}
