//! The attacks, a file each.

pub(crate) mod broken;
pub(crate) mod builds;
pub(crate) mod plane;
pub(crate) mod space;
