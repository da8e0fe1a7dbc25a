//! Definitions over big integers, for points of any dimension. Nothing here knows how the library decides.
//!
//! The crate `delone-oracle` judges the tests of the library. These definitions were written apart from it: two judges with the same
//! fault are less likely than one with a fault.

pub(crate) mod delaunay;
pub(crate) mod exact;
pub(crate) mod half_spaces;
pub(crate) mod hull;
pub(crate) mod rings;
