//! What a tile, or a group of them, leaves to be decided with others.

use crate::error::BorderProblem;
use crate::ids::{Place, TriangleId};
use crate::mesh::Mesh2;

/// The corners of open triangles and of the hull, with names for the vertices, and the open triangles. See [`super::join`].
///
/// As bytes it is 24 for a point, 12 for a triangle and 32 more; [`Self::to_bytes`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Border {
    /// The points, all different.
    pub points: Vec<[f64; 2]>,
    /// A name for each point, by which seams know it; [`super::Node::id`] makes some.
    pub ids: Vec<u64>,
    /// The open triangles: indices of points, counter-clockwise.
    pub open: Vec<[u32; 3]>,
}

impl Border {
    /// Of vertices along a curve, some of whose triangles are open.
    pub(super) fn of(
        mesh: &Mesh2,
        points: &[[f64; 2]],
        open: &[TriangleId],
        name: impl Fn(usize) -> u64,
    ) -> Self {
        let corners = || open.iter().flat_map(|&t| mesh.places(t));
        let mut places: Vec<Place> = mesh.border().chain(corners()).collect();
        places.sort_unstable();
        places.dedup();
        let index = |place| places.partition_point(|&p| p < place) as u32;
        Self {
            points: places.iter().map(|p| points[p.index()]).collect(),
            ids: places.iter().map(|p| name(p.index())).collect(),
            open: open.iter().map(|&t| mesh.places(t).map(index)).collect(),
        }
    }

    /// Whether every point is finite and has a name, and every triangle its corners.
    pub(super) fn check(&self) -> Result<(), BorderProblem> {
        let (points, ids) = (self.points.len(), self.ids.len());
        if points != ids {
            return Err(BorderProblem::Ids { points, ids });
        }
        if let Some(point) = self.points.iter().position(|p| !p.iter().all(|x| x.is_finite())) {
            return Err(BorderProblem::NotFinite { point });
        }
        let is_wrong = |t: &[u32; 3]| t.iter().any(|&v| v as usize >= points);
        match self.open.iter().position(is_wrong) {
            Some(triangle) => Err(BorderProblem::Corner { triangle, points }),
            None => Ok(()),
        }
    }
}
