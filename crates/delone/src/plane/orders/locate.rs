//! The region that a point is in.
//!
//! Cost: that of finding the k nearest vertices, and O(k log n).

use super::{OrderK2, OrderRegion2};
use crate::error::Error;
use crate::points::Position2;

impl OrderK2<'_> {
    /// The region of a point: the k nearest sites as a set, of sites at one distance the lexicographically smallest. There
    /// always is one.
    ///
    /// # Errors
    /// [`Error::Coordinate`] for NaN and infinities.
    pub fn locate<P: Position2>(&self, q: P) -> Result<OrderRegion2<'_>, Error> {
        let mut sites = self.triangulation.k_nearest(q, self.order)?;
        sites.sort_unstable();
        // By the perturbation, too, larger points count as further away.
        Ok(self.region_of_sorted(&sites).expect("where these are nearest is a region"))
    }
}
