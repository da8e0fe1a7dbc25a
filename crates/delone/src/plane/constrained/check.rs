//! A proof that a triangulation is the canonical one of its points and segments.
//!
//! A sphere of triangles whose finite ones are counter-clockwise, with a convex hull that goes around once, is a triangulation;
//! it is the canonical one if every edge is a constraint or has the far corner outside of the circle, if both sides of an edge
//! agree on that, and if the constraints are what the segments cover, no more and no less. Cost: O(n + m log m) for n points and
//! m constraint edges.

use super::segments::{Cover, SegmentId};
use super::{Constrained2, Covering2, overlaps};
use crate::ids::{EdgeId, Place};
use crate::plane::check::Flaw2;

/// A flaw of a constrained triangulation.
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
    /// The table of segments that cover an edge is wrong.
    #[error("the segments that cover edge {0:?} are not those remembered")]
    Cover(EdgeId),
}

impl Constrained2 {
    /// Proves that this is the canonical constrained Delaunay triangulation of its points and segments, or returns the first
    /// flaw found. Independent of how it was built and changed.
    ///
    /// ```
    /// use delone::Constrained2;
    ///
    /// let c = Constrained2::from_parts(&[[0, 0], [4, 1], [0, 4], [1, 1]], &[[0, 2]])?;
    /// assert!(c.check().is_ok());
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn check(&self) -> Result<(), ConstrainedFlaw2> {
        self.graph.check()?;
        let mesh = self.mesh();
        if let Some(e) = mesh.undirected_edges().find(|&e| mesh.is_fixed(e) != mesh.is_fixed(mesh.twin(e))) {
            return Err(ConstrainedFlaw2::Side(e));
        }
        let mut pieces: Vec<(SegmentId, [Place; 2])> = Vec::new();
        for (s, ends) in self.segments() {
            // From one end to the other, each piece where the last one ended.
            let mut at = Some(ends[0]);
            for [v, w] in self.segments.pieces(s) {
                at = at.filter(|&at| at == v).map(|_| w);
            }
            pieces.extend(self.places_of(s).map(|piece| (s, piece)));
            let count = self.segments.pieces(s).count();
            let is_whole = at == Some(ends[1]) && count > 0;
            if !is_whole || pieces.iter().rev().take_while(|piece| piece.0 == s).count() != count {
                return Err(ConstrainedFlaw2::Missing(s));
            }
        }
        let covered = overlaps::weights(self.ground(), pieces.iter().map(|piece| piece.1));
        let covered = covered.map_err(|piece| ConstrainedFlaw2::Missing(pieces[piece].0))?;
        let is_covered = |e: EdgeId| covered.binary_search_by_key(&e.min(mesh.twin(e)), |w| w.0).is_ok();
        if let Some(e) = self.constraint_edges().find(|&e| !is_covered(e)) {
            return Err(ConstrainedFlaw2::Stray(e));
        }
        self.cover.get().map_or(Ok(()), |cover| self.check_cover(cover))
    }

    /// Compares the table of covering segments with the mesh.
    fn check_cover(&self, cover: &Cover) -> Result<(), ConstrainedFlaw2> {
        let mesh = self.mesh();
        let mut covered: Vec<(EdgeId, SegmentId, bool)> = Vec::new();
        for (s, _) in self.segments() {
            self.edges_of(s, |s, e| {
                covered.push((e.min(mesh.twin(e)), s, mesh.origin(e) < mesh.destination(e)));
            });
        }
        covered.sort_unstable();
        for of_edge in covered.chunk_by(|c, d| c.0 == d.0) {
            let e = of_edge[0].0;
            let [v, w] = [mesh.origin(e), mesh.destination(e)];
            let remembered = cover.of([v.min(w), v.max(w)]);
            let found = of_edge.iter().map(|&(_, segment, is_forward)| Covering2 { segment, is_forward });
            if !found.eq(remembered) {
                return Err(ConstrainedFlaw2::Cover(e));
            }
        }
        Ok(())
    }
}
