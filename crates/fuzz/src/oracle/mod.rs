//! Definitions over big integers, from first principles. Nothing here knows how the engine decides.

pub(crate) mod delaunay;
pub(crate) mod exact;
pub(crate) mod hull;
pub(crate) mod rings;
