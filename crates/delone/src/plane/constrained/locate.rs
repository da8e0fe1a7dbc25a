//! Where does a point fall? As in a Delaunay triangulation, by a walk that asks edges in random order, because a visibility
//! walk may run in circles where edges are fixed.

use super::Constrained2;
use crate::error::Error;
use crate::plane::Location2;
use crate::points::Position2;

impl Constrained2 {
    /// Finds where a point falls. Exact.
    ///
    /// Cost: as [`crate::Delaunay2::locate`].
    ///
    /// # Errors
    /// [`Error::Coordinate`] for NaN and infinities.
    #[doc(alias("find_simplex", "point_location"))]
    pub fn locate<P: Position2>(&self, q: P) -> Result<Location2, Error> {
        self.graph.locate(q)
    }
}
