//! The formats, one file each.

pub(crate) mod adcirc;
mod atoms;
pub(crate) mod cells;
pub(crate) mod dxf;
pub(crate) mod e57;
pub(crate) mod edges;
pub(crate) mod ept;
pub(crate) mod extxyz;
pub(crate) mod flatgeobuf;
pub(crate) mod geojson;
pub(crate) mod geopackage;
pub(crate) mod gpx;
pub(crate) mod graphs;
pub(crate) mod inp;
pub(crate) mod json;
pub(crate) mod lammps;
pub(crate) mod las;
mod lines;
pub(crate) mod list;
pub(crate) mod listed;
pub(crate) mod medit;
pub(crate) mod msh;
pub(crate) mod nastran;
pub(crate) mod npy;
mod numbers;
pub(crate) mod obj;
pub(crate) mod off;
mod osmosis;
pub(crate) mod pairs;
pub(crate) mod pcd;
pub(crate) mod ply;
pub(crate) mod poly;
pub(crate) mod polyhedra;
pub(crate) mod ptx;
pub(crate) mod quads;
pub(crate) mod raw;
pub(crate) mod shapefile;
pub(crate) mod shapes;
pub(crate) mod sms;
pub(crate) mod stl;
pub(crate) mod su2;
pub(crate) mod text;
pub(crate) mod triangle;
pub(crate) mod vector;
pub(crate) mod voronoi;
pub(crate) mod vtk;
pub(crate) mod vtu;
pub(crate) mod wkb;
pub(crate) mod wkt;
pub(crate) mod xdmf;

/// A point of the plane or of space, in space.
fn in_space(p: &impl AsRef<[f64]>) -> [f64; 3] {
    [0, 1, 2].map(|k| p.as_ref().get(k).copied().unwrap_or_default())
}
