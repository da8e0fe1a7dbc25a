//! Files in and out: points, meshes and pictures, one file of code for each format.
//!
//! Reading gives a [`Cloud`]; writing takes a [`Mesh`], a triangulation of any kind with what lies beside it.
//! Formats are found by extension ([`Format`]). Output goes to a temporary name that is renamed when complete
//! ([`Output`]), so no reader ever sees half a file.

mod cloud;
mod crs;
mod diagram;
mod error;
mod format;
mod formats;
mod guard;
mod input;
mod mesh;
mod output;
pub mod picture;
mod solid;
mod trim;

pub use cloud::Cloud;
pub use crs::Crs;
pub use diagram::Diagram;
pub use error::Error;
pub use format::Format;
pub use formats::las::LAS_CLASSES;
pub use input::decompressed;
pub use mesh::{Drawable, Mesh, write_mesh};
pub use output::{Output, followed, remove_unfinished};
pub use solid::{Solid, write_solid};
pub use trim::{Cut, Trim};

use std::io::{BufRead, Seek};

use delone::Triangulation;

/// What a user should know of a file that was written.
pub type Remark = Option<String>;

/// What a format may be read from: files, and standard input once it is in memory.
pub trait Source: BufRead + Seek + Send + Sync {}

impl<T: BufRead + Seek + Send + Sync> Source for T {}

/// How to read points.
#[derive(Clone, Debug, Default)]
pub struct ReadOptions {
    /// LAS classes to keep; all when empty.
    pub classes: Vec<u8>,
    /// Columns of text that are x, y and perhaps z: names of the header, or numbers from 1.
    pub columns: Vec<String>,
    /// Coordinates of a point where the format does not tell (raw numbers): 2 or 3.
    pub dimension: usize,
}

/// Reads the points of a file, in its order.
///
/// Coordinates are not judged here: NaN and infinities pass, and the library names them by index.
pub fn read_points(source: Box<dyn Source>, format: Format, options: &ReadOptions) -> Result<Cloud, Error> {
    use formats::{e57, geojson, las, npy, obj, off, pcd, ply, raw, stl, text, triangle, vtk};
    match format {
        Format::Text => text::read(source, &options.columns),
        Format::Pts => text::read_pts(source),
        Format::Npy => npy::read_points(source),
        Format::Npz => npy::read_archive(source),
        Format::Raw => raw::read(source, options.dimension),
        Format::Node => triangle::read_node(source),
        Format::Las => las::read(source, &options.classes),
        Format::E57 => e57::read(source),
        Format::Ply => ply::read_points(source),
        Format::Obj => obj::read_points(source),
        Format::Off => off::read_points(source),
        Format::Stl => stl::read_points(source),
        Format::GeoJson => geojson::read(source),
        Format::Vtu => vtk::read_xml(source),
        Format::Vtk => vtk::read_legacy(source),
        Format::Pcd => pcd::read(source),
        _ => Err(Error::NotPoints(format)),
    }
}

/// Reads the triangles of a mesh file as indices into its points, from 0.
pub fn read_triangles(source: Box<dyn Source>, format: Format) -> Result<Vec<[u64; 3]>, Error> {
    use formats::{npy, obj, off, ply, triangle};
    match format {
        Format::Off => off::read_triangles(source),
        Format::Npy => npy::read_simplices(source),
        Format::Ele => triangle::read_ele(source),
        Format::Ply => ply::read_triangles(source),
        Format::Obj => obj::read_triangles(source),
        _ => Err(Error::NotTriangles(format)),
    }
}

/// Reads the tetrahedra of a mesh file as indices into its points, from 0.
pub fn read_tetrahedra(source: Box<dyn Source>, format: Format) -> Result<Vec<[u64; 4]>, Error> {
    match format {
        Format::Npy => formats::npy::read_simplices(source),
        Format::Ele => formats::triangle::read_ele(source),
        _ => Err(Error::NotTetrahedra(format)),
    }
}

/// What formats of triangles in space ask for.
trait Shape {
    /// The coordinates of the points, zero where there is no height.
    fn positions(&self) -> impl Iterator<Item = [f64; 3]>;
    /// The triangles as indices of points.
    fn triangles(&self) -> impl Iterator<Item = [usize; 3]> + Send;
    /// A value for each point.
    fn heights(&self) -> Option<&[f64]>;
    /// What the coordinates mean.
    fn crs(&self) -> Option<&Crs> {
        None
    }
}

/// Reads the rings of polygons: those of GeoJSON polygons, or all points of another format as one ring.
pub fn read_rings(source: Box<dyn Source>, format: Format) -> Result<Vec<Vec<[f64; 2]>>, Error> {
    match format {
        Format::GeoJson => formats::geojson::read_rings(source),
        _ => {
            Ok(vec![read_points(source, format, &ReadOptions { dimension: 2, ..ReadOptions::default() })?.xy])
        }
    }
}

/// Writes Voronoi cells: as GeoJSON, one feature for each site with its input index and the area of its cell, or as a
/// picture whose longer side has `size` pixels.
pub fn write_diagram(
    out: &mut dyn std::io::Write,
    format: Format,
    diagram: &Diagram<impl Triangulation<Point = [f64; 2]>>,
    size: u32,
) -> Result<(), Error> {
    match format {
        Format::GeoJson => formats::geojson::write_cells(out, diagram)?,
        Format::Svg | Format::Png => picture::write_cells(out, format, diagram, size)?,
        _ => return Err(Error::NotCells(format)),
    }
    Ok(())
}

/// Writes bare points of the plane (D = 2) or of space (D = 3).
pub fn write_points<const D: usize>(
    out: &mut dyn std::io::Write,
    format: Format,
    points: &[[f64; D]],
) -> Result<(), Error> {
    use formats::{geojson, npy, obj, ply, raw, text, triangle};
    match format {
        Format::Text => text::write(out, points)?,
        Format::Npy => npy::write_points(out, points)?,
        Format::Raw => raw::write(out, points)?,
        Format::Node => triangle::write_node(out, 0, D, points, None)?,
        Format::Ply => ply::write_points(out, points)?,
        Format::Obj => obj::write_points(out, points)?,
        Format::GeoJson => geojson::write_points(out, points)?,
        _ => return Err(Error::NotPoints(format)),
    }
    Ok(())
}

/// Writes indices, -1 where there is none: npy (int64, one dimension) or text (a line each).
pub fn write_index_list(out: &mut dyn std::io::Write, format: Format, values: &[i64]) -> Result<(), Error> {
    use formats::{npy, text};
    match format {
        Format::Npy => npy::write_index_list(out, values)?,
        Format::Text => text::write_indices(out, 1, values)?,
        _ => return Err(Error::NotPoints(format)),
    }
    Ok(())
}

/// Writes rows of indices, -1 where there is none: npy (int64) or text.
pub fn write_indices(
    out: &mut dyn std::io::Write,
    format: Format,
    columns: usize,
    values: &[i64],
) -> Result<(), Error> {
    use formats::{npy, text};
    match format {
        Format::Npy => npy::write_indices(out, columns, values)?,
        Format::Text => text::write_indices(out, columns, values)?,
        _ => return Err(Error::NotPoints(format)),
    }
    Ok(())
}
