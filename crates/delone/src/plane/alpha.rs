//! The alpha complexes of triangulations of the plane.

use super::{Delaunay2, Regular2};
use crate::alpha::{Alpha2, build};

impl Delaunay2 {
    /// The alpha complexes: all faces with the squared radius from which on each is there, and the shapes of that. O(n log n), on all threads.
    ///
    /// ```
    /// use delone::Delaunay2;
    ///
    /// let d = Delaunay2::from_points(&[[0, 0], [2, 0], [0, 2], [9, 9]])?;
    /// let shape = d.alpha();
    /// assert_eq!(shape.complex(2.0).triangles.len(), 1); // of the squared radius 2
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn alpha(&self) -> Alpha2 {
        build(self, |_| 0.0)
    }
}

impl Regular2 {
    /// The alpha complexes of the sites, whose weights are squared radii: balls of squared radius `alpha` and the weight, so that at 0 it is the dual of
    /// the union of the balls. O(n log n), on all threads.
    pub fn alpha(&self) -> Alpha2 {
        build(self, |v| self.site(v).map_or(0.0, |site| site.1))
    }
}
