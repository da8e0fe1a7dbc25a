//! GeoPackage: a database of SQLite whose tables have geometries. Read and written by SQLite itself, which is compiled with the feature
//! `geopackage`; without it, what is asked for is refused.
//!
//! Source: OGC 12-128r19, <https://www.geopackage.org/spec140/>.

#[cfg(not(feature = "geopackage"))]
mod absent;
#[cfg(feature = "geopackage")]
mod database;
#[cfg(feature = "geopackage")]
mod index;
#[cfg(feature = "geopackage")]
mod read;
#[cfg(all(test, feature = "geopackage"))]
mod tests;
#[cfg(feature = "geopackage")]
mod write;

#[cfg(not(feature = "geopackage"))]
pub(crate) use absent::{read, write};
#[cfg(feature = "geopackage")]
pub(crate) use read::read;
#[cfg(feature = "geopackage")]
pub(crate) use write::write;
