//! Convex hulls without a triangulation.

pub(crate) mod planar;
pub mod spatial;
