//! The formats, one file each.

pub(crate) mod geojson;
pub(crate) mod las;
mod lines;
pub(crate) mod npy;
pub(crate) mod obj;
pub(crate) mod ply;
pub(crate) mod raw;
pub(crate) mod stl;
pub(crate) mod text;
pub(crate) mod triangle;
pub(crate) mod vtu;
