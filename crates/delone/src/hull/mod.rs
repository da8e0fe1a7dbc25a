//! Convex hulls without a triangulation, in the plane and in space.

mod merge;
pub(crate) mod plane;
mod space;

pub use plane::Hull2;
pub use space::{Hull3, HullHistory3};
