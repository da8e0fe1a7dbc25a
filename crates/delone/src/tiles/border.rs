//! Borders: the simplices of a tile, or of a group of tiles, that a join decides.

use super::along::Along;
use crate::error::BorderProblem;

/// The corners of open triangles and of the hull, with names for the vertices, and the open triangles. See [`super::join()`].
///
/// As bytes it is 24 for a point, 12 for a triangle and 32 more; [`Self::to_bytes`].
pub type Border = BorderOf<2, 3>;

/// The border of a tile in space: the open tetrahedra, their corners and those of the hull. See [`super::join3()`].
///
/// As bytes it is 32 for a point, 16 for a tetrahedron and 32 more.
pub type Border3 = BorderOf<3, 4>;

/// [`Border`] or [`Border3`]: of points with `D` coordinates, and simplices with `C` = `D` + 1 corners. Its bytes are a format of their
/// own, which has these arrays: no field will be added.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BorderOf<const D: usize, const C: usize> {
    /// The points, all different.
    pub points: Vec<[f64; D]>,
    /// A name for each point, by which seams know it; [`super::Node::id`] makes some.
    pub ids: Vec<u64>,
    /// The open triangles: indices of points, counter-clockwise; in space the tetrahedra, in positive order.
    pub open: Vec<[u32; C]>,
}

impl<const D: usize, const C: usize> BorderOf<D, C> {
    /// Of vertices along a curve, some of whose simplices are open.
    pub(super) fn of<A: Along<D, C>>(along: &A, open: &[A::Id], name: impl Fn(u32) -> u64) -> Self {
        let corners = || open.iter().flat_map(|&t| along.corners(t));
        let mut vertices: Vec<u32> = along.hull().chain(corners()).collect();
        vertices.sort_unstable();
        vertices.dedup();
        let index = |vertex| vertices.partition_point(|&v| v < vertex) as u32;
        Self {
            points: vertices.iter().map(|&v| along.points()[v as usize]).collect(),
            ids: vertices.iter().map(|&v| name(v)).collect(),
            open: open.iter().map(|&t| along.corners(t).map(index)).collect(),
        }
    }

    /// Whether every point is finite and has a name, and every simplex its corners.
    pub(super) fn check(&self) -> Result<(), BorderProblem> {
        let (points, ids) = (self.points.len(), self.ids.len());
        if points != ids {
            return Err(BorderProblem::Ids { points, ids });
        }
        if let Some(point) = self.points.iter().position(|p| !p.iter().all(|x| x.is_finite())) {
            return Err(BorderProblem::NotFinite { point });
        }
        let is_wrong = |t: &[u32; C]| t.iter().any(|&v| v as usize >= points);
        match self.open.iter().position(is_wrong) {
            Some(simplex) => Err(BorderProblem::Corner { simplex, points }),
            None => Ok(()),
        }
    }
}
