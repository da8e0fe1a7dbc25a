//! Verdicts on simplices from other programs.

/// The verdict of `verify` on triangles or tetrahedra that are a Delaunay triangulation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Verdict {
    /// Pairs of neighbors whose corners are cocircular, or cospherical, and divided in another way than the canonical
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
