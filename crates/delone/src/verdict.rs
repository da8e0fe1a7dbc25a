//! What is right about simplices from elsewhere that are a Delaunay triangulation, and wrong with a regular one.

use crate::ids::VertexId;

/// What `verify` found of triangles or tetrahedra that are a Delaunay triangulation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Verdict {
    /// Pairs of neighbours whose corners are cocircular, or cospherical, and divided in another way than the canonical
    /// one. None of them: it is *the* canonical triangulation.
    pub other_ties: usize,
    /// Simplices given in negative order: clockwise triangles.
    pub negative: usize,
    /// Points that equal a corner without being one.
    pub duplicates: usize,
    /// In the plane the points on the border of the convex hull, in space its facets; none without simplices.
    pub hull: usize,
}

impl Verdict {
    /// Whether the simplices are those that Delone gives.
    pub fn is_canonical(&self) -> bool {
        self.other_ties == 0
    }
}

/// What is wrong with a regular triangulation, one sentence each. `F` is what may be wrong with any triangulation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum RegularFlaw<F> {
    /// The simplices are not the regular ones of the vertices.
    #[error(transparent)]
    Triangulation(#[from] F),
    /// A site is called hidden and is below the simplices.
    #[error("site {} is no vertex, and none of the others hides it", .0.index())]
    Hidden(VertexId),
    /// A site is called the duplicate of a vertex that it does not equal, or is not called that of the one that it equals.
    #[error("site {} is said to be another one's duplicate and is not, or the other way round", .0.index())]
    Duplicate(VertexId),
}
