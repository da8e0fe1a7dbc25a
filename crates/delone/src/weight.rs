//! The data of a site besides its point: nothing, or a weight.
//!
//! Triangulations keep weights by place, beside their points. Those without weights keep `()`, which takes no memory, and is
//! never looked up.

use std::fmt::Debug;

use crate::ids::Place;

/// See the module. Weights are squared radii.
pub(crate) trait Weight: Copy + Debug + Default + PartialEq + Send + Sync + 'static {
    /// The weight at a place.
    fn at(weights: &[Self], p: Place) -> Self;
}

impl Weight for () {
    #[inline]
    fn at(_: &[()], _: Place) {}
}

impl Weight for f64 {
    #[inline]
    fn at(weights: &[Self], p: Place) -> Self {
        weights[p.index()]
    }
}
