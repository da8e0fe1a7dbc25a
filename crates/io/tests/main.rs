//! All tests of readers and writers from outside, in one program.

mod chunks;
mod constrained;
mod dialects;
mod elements;
mod features;
mod formats;
mod geotiff;
mod gpx;
mod graphs;
mod las;
mod lidar;
mod listed;
mod new_kind;
mod numbers;
mod rasters;
mod same_points;
mod scene;
mod solvers;
mod stl;
mod triangle;
mod vectors;

use delone_io::{Contents, Direction, Format};

/// The formats that triangulations are written to.
fn meshes(contents: Contents) -> impl Iterator<Item = Format> {
    let is_there = |format: &Format| *format != Format::GeoPackage || cfg!(feature = "geopackage");
    Format::all().filter(move |format| format.holds(contents, Direction::Written)).filter(is_there)
}
