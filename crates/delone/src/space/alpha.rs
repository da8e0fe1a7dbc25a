//! The alpha complexes of triangulations of space.

use super::{Delaunay3, Regular3};
use crate::alpha::{Alpha3, build};

impl Delaunay3 {
    /// The alpha complexes: all faces with the squared radius from which on each is there, and the shapes of that. O(n log n), on all threads.
    ///
    /// ```
    /// use delone::Delaunay3;
    ///
    /// let cube: Vec<[i32; 3]> = (0..8).map(|k| [k & 1, k >> 1 & 1, k >> 2]).collect();
    /// let d = Delaunay3::from_points(&cube)?;
    /// assert_eq!(d.alpha().optimal(1), Some(0.75)); // the squared radius from which all is one part
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn alpha(&self) -> Alpha3 {
        build(self, |_| 0.0)
    }
}

impl Regular3 {
    /// The alpha complexes of the sites, whose weights are squared radii: balls of squared radius `alpha` and the weight, so that at 0 it is the dual of
    /// the union of the balls. O(n log n), on all threads.
    pub fn alpha(&self) -> Alpha3 {
        build(self, |v| self.site(v).map_or(0.0, |site| site.1))
    }
}
