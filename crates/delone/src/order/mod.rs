//! Permutations of points: the orders in which algorithms visit them. Knows coordinates, no mesh.

pub(crate) mod brio;
pub(crate) mod curve;
mod hilbert;
pub(crate) mod morton;
mod quantize;
pub(crate) mod random;
