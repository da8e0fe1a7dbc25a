//! Typed indices: 32 bits inside, never a bare integer in public.
//!
//! A directed edge is `4 * triangle + k`: the edge that leaves corner k (0, 1, 2) of a triangle, so triangle
//! and corner are known without a look-up, and a triangle's record starts on a 32-byte boundary. Four edge
//! indices a triangle and 2n - 2 triangles for n points bound n by [`MAX_POINTS`].

#[cfg(feature = "serde")]
mod serialized;

use std::fmt;

use bytemuck::Zeroable;

/// The largest number of points of one triangulation: 2^29 = 536,870,912.
pub const MAX_POINTS: usize = 1 << 29;

/// The largest number of points of one triangulation of space: 2^27 = 134,217,728, whose 6.77 tetrahedra each, where
/// they are evenly spread, have indices below 2^30.
pub const MAX_POINTS_IN_SPACE: usize = 1 << 27;

/// One more than the largest index of a tetrahedron, four facets each: 2^30, or 32 gigabytes of them.
pub(crate) const MAX_TETRAHEDRA: usize = 1 << 30;

/// A vertex: the index of its point, counted over the input and all later insertions.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct VertexId(u32);

impl VertexId {
    /// The vertex at infinity, which closes the surface: every hull edge has a ghost triangle with it.
    pub const GHOST: Self = Self(u32::MAX);

    /// The vertex of the point with this index. From [`MAX_POINTS`] on there is no such point: the id is that of no vertex of
    /// any triangulation.
    #[inline]
    pub fn new(index: usize) -> Self {
        Self(if index < MAX_POINTS { index as u32 } else { u32::MAX - 1 })
    }

    /// The place of this index, as long as places are indices.
    #[inline]
    pub(crate) fn same(self) -> Place {
        Place(self.0)
    }

    /// The index of the vertex's point. Meaningless for the ghost vertex.
    #[inline]
    pub fn index(self) -> usize {
        self.0 as usize
    }

    /// The index in 32 bits.
    pub(crate) fn bits(self) -> u32 {
        self.0
    }

    /// Whether this is the vertex at infinity.
    #[inline]
    pub fn is_ghost(self) -> bool {
        self == Self::GHOST
    }
}

impl fmt::Debug for VertexId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_ghost() { f.write_str("ghost") } else { write!(f, "v{}", self.0) }
    }
}

/// A point that equals an earlier one and is no vertex. It is a pair, and no field will be added.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Duplicate {
    /// The index of the point.
    pub point: usize,
    /// The vertex that stands for it: the first point given with these coordinates.
    pub vertex: VertexId,
}

/// The outcome of an insertion. A point is a new vertex or equals one, so a match may name both.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Inserted {
    /// It is a vertex now.
    New(VertexId),
    /// It equals this vertex, and nothing has changed.
    Existing(VertexId),
}

impl Inserted {
    /// The vertex with the point's coordinates.
    pub fn vertex(self) -> VertexId {
        match self {
            Self::New(v) | Self::Existing(v) => v,
        }
    }
}

/// Where a vertex is kept: the index of its coordinates and of its star inside a mesh. It equals the vertex's
/// index until a triangulation is changed; then it follows the memory, and the [`VertexId`] stays.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Zeroable)]
pub(crate) struct Place(u32);

impl Place {
    /// The place of the vertex at infinity, which has no coordinates.
    pub(crate) const GHOST: Self = Self(u32::MAX);

    #[inline]
    pub(crate) fn new(index: usize) -> Self {
        debug_assert!(index < 4 * MAX_POINTS, "place {index} is out of range");
        Self(index as u32)
    }

    #[inline]
    pub(crate) fn index(self) -> usize {
        self.0 as usize
    }

    #[inline]
    pub(crate) fn is_ghost(self) -> bool {
        self == Self::GHOST
    }

    /// The vertex whose index this is, as long as places are indices.
    #[inline]
    pub(crate) fn same(self) -> VertexId {
        VertexId(self.0)
    }
}

impl fmt::Debug for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_ghost() { f.write_str("ghost") } else { write!(f, "p{}", self.0) }
    }
}

/// A triangle, finite or ghost.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Zeroable)]
pub struct TriangleId(u32);

impl TriangleId {
    #[inline]
    pub(crate) fn new(index: usize) -> Self {
        debug_assert!(index < 2 * MAX_POINTS, "triangle index {index} is out of range");
        Self(index as u32)
    }

    /// The index among all triangles, finite and ghost.
    #[inline]
    pub fn index(self) -> usize {
        self.0 as usize
    }

    /// The edge that leaves corner `k` (0, 1 or 2).
    #[inline]
    pub fn edge(self, k: usize) -> EdgeId {
        debug_assert!(k < 3, "a triangle has no corner {k}");
        EdgeId(4 * self.0 + k as u32)
    }
}

impl fmt::Debug for TriangleId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "t{}", self.0)
    }
}

/// A directed edge of a triangle (a half-edge), the triangle on its left.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Zeroable)]
pub struct EdgeId(u32);

impl EdgeId {
    /// No edge: the twin of an edge not linked yet, the incident edge of an index that is no vertex.
    pub(crate) const NONE: Self = Self(u32::MAX);

    /// As plain bits, and back.
    #[inline]
    pub(crate) fn bits(self) -> u32 {
        self.0
    }

    #[inline]
    pub(crate) fn from_bits(bits: u32) -> Self {
        Self(bits)
    }

    #[cfg(test)]
    pub(crate) fn new(index: usize) -> Self {
        Self(index as u32)
    }

    /// The position among the records of all edges, four a triangle.
    #[inline]
    pub(crate) fn index(self) -> usize {
        self.0 as usize
    }

    /// The triangle on the left.
    #[inline]
    pub fn triangle(self) -> TriangleId {
        TriangleId(self.0 >> 2)
    }

    /// The corner of that triangle which the edge leaves: 0, 1 or 2.
    #[inline]
    pub fn corner(self) -> usize {
        (self.0 & 3) as usize
    }

    /// The next edge of the triangle, counter-clockwise. Arithmetic, because a branch here would be
    /// mispredicted one time in three.
    #[inline]
    #[must_use]
    pub fn next(self) -> Self {
        let last = u32::from(self.0 & 3 == 2);
        Self(self.0 + 1 - 3 * last)
    }

    /// The previous edge of the triangle, which ends where this one starts.
    #[inline]
    #[must_use]
    pub fn previous(self) -> Self {
        let first = u32::from(self.0 & 3 == 0);
        Self((self.0 + 3 * first) - 1)
    }
}

impl fmt::Debug for EdgeId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if *self == Self::NONE { f.write_str("none") } else { write!(f, "t{}.{}", self.0 >> 2, self.0 & 3) }
    }
}

/// A tetrahedron, finite or ghost.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct TetrahedronId(u32);

impl TetrahedronId {
    /// No tetrahedron.
    pub(crate) const NONE: Self = Self(u32::MAX);

    #[inline]
    pub(crate) fn new(index: usize) -> Self {
        debug_assert!(index < MAX_TETRAHEDRA, "tetrahedron index {index} is out of range");
        Self(index as u32)
    }

    /// The index among all tetrahedra, finite and ghost.
    #[inline]
    pub fn index(self) -> usize {
        self.0 as usize
    }

    /// The facet across from corner `k` (0 to 3).
    #[inline]
    pub fn facet(self, k: usize) -> FacetId {
        debug_assert!(k < 4, "a tetrahedron has no corner {k}");
        FacetId(4 * self.0 + k as u32)
    }
}

impl fmt::Debug for TetrahedronId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "c{}", self.0)
    }
}

/// A facet of a tetrahedron, seen from inside of it.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct FacetId(u32);

impl FacetId {
    /// No facet: what is across a facet not linked yet.
    pub(crate) const NONE: Self = Self(u32::MAX);

    /// The tetrahedron.
    #[inline]
    pub fn tetrahedron(self) -> TetrahedronId {
        TetrahedronId(self.0 >> 2)
    }

    /// The corner of the tetrahedron that is not on the facet: 0 to 3.
    #[inline]
    pub fn corner(self) -> usize {
        (self.0 & 3) as usize
    }
}

impl fmt::Debug for FacetId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if *self == Self::NONE { f.write_str("none") } else { write!(f, "c{}.{}", self.0 >> 2, self.0 & 3) }
    }
}

#[cfg(test)]
mod tests {
    use super::TriangleId;

    #[test]
    fn edges_turn_around_their_triangle() {
        let t = TriangleId::new(5);
        let [a, b, c] = [0, 1, 2].map(|k| t.edge(k));
        assert_eq!([a.next(), b.next(), c.next()], [b, c, a]);
        assert_eq!([a.previous(), b.previous(), c.previous()], [c, a, b]);
        assert_eq!((c.triangle(), c.corner()), (t, 2));
    }
}
