//! Files in and out: points, meshes and pictures, one file of code for each format.
//!
//! Reading gives a [`Cloud`], or a [`Graph`] of points with segments; writing takes a [`Mesh`], a triangulation of any kind with what lies beside it.
//! Formats are found by extension ([`Format`]). Output goes to a temporary name that is renamed when complete
//! ([`Output`]), so no reader ever sees half a file.

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

mod answers;
mod border;
mod cell;
mod chunks;
mod cloud;
#[cfg(feature = "parquet")]
mod columns;
mod contours;
mod crs;
mod diagram;
mod elements;
mod error;
mod features;
mod filtration;
mod format;
mod formats;
mod graph;
mod guard;
mod input;
mod iteration;
mod limit;
mod mesh;
mod middles;
mod names;
mod options;
mod output;
mod patches;
mod paths;
pub mod picture;
mod polyhedra;
mod raster;
mod rings;
mod solid;
mod strings;
mod tiled;
mod xml;

pub use answers::{Answers, Found, write_answers};
pub use cell::UnitCell;
pub use chunks::Take;
pub use cloud::Cloud;
#[cfg(feature = "parquet")]
pub use columns::{Column, write_columns};
pub use contours::{ContourMap, write_contours};
pub use crs::{Crs, GeoKeys};
pub use delone::surface::{Border, Cut, Trim};
pub use diagram::{Diagram, LineDiagram, OrderDiagram};
pub use error::Error;
pub use features::{ColumnType, Features, Table, Value};
pub use filtration::write_filtration;
pub use format::{Contents, Direction, Format, Said};
pub use formats::edges::{Edges, write_edges};
pub use formats::las::{LAS_CLASSES, LasFilter, LasFlag, Returns};
pub use formats::npy::{Element, write_array};
pub use formats::poly::{Beside, has_points_beside};
pub use formats::polyhedra::write_polyhedra;
pub use formats::voronoi::{write_voronoi_edge, write_voronoi_node};
pub use graph::{Attributes, Graph, GraphRing, Rings};
pub use input::{decompressed, trust_compressed};
pub use iteration::{next_file, next_stem};
pub use limit::limit_output;
pub use mesh::{Constraints, Drawable, Mesh, Rows, write_mesh};
pub use names::Names;
pub use options::ReadOptions;
pub use output::{
    Finished, Output, TemporaryFolder, followed, give_names, remove_unfinished, sync_file, sync_folder,
    wait_for_names,
};
pub use patches::{Patches, write_patches};
pub use paths::{beside, open, open_as, side};
pub use polyhedra::{LeastFace, Polyhedra};
pub use raster::{
    ASC_NODATA, Compression, Light, Overviews, Raster, RasterInfo, RasterWriter, Relief, ReliefKind,
    ReliefRows, Sample, ShadeWriter, beside_raster, besides_of_raster, crs_of_side, heed_sides, read_raster,
    read_raster_place, read_surface,
};
pub use solid::{Solid, write_solid};
pub use tiled::{write_diagram, write_lines_diagram, write_orders};

use std::io::{BufRead, Seek};

use chunks::Chunks;
use formats::shapes::Purpose;
use formats::vector;

/// A remark on a file that was written.
pub type Remark = Option<String>;

/// A source of a format: a file, or standard input once it is in memory.
pub trait Source: BufRead + Seek + Send + Sync {}

impl<T: BufRead + Seek + Send + Sync> Source for T {}

/// Reads the points of a file, in its order.
///
/// A number in text becomes the double that is nearest to it, however many digits it has; of two that are as near, the one whose
/// last bit is 0. Writers give the fewest digits that read back as the same bits.
///
/// Coordinates are not judged here: NaN and infinities pass, and the library names them by index.
pub fn read_points(source: Box<dyn Source>, format: Format, options: &ReadOptions) -> Result<Cloud, Error> {
    read_with(source, format, options, None)
}

/// Reads the points of a file and of those beside it ([`Format::sides`]), which `beside` opens by their extension; those of an EPT by their
/// path from the folder of `ept.json`, as in `ept-data/0-0-0-0.laz`.
///
/// # Errors
/// As [`read_points`]. A file that is not there is a remark, but of an EPT an error.
pub fn read_points_beside(
    source: Box<dyn Source>,
    format: Format,
    options: &ReadOptions,
    beside: Beside,
) -> Result<Cloud, Error> {
    read_with(source, format, options, Some(beside))
}

fn read_with(
    source: Box<dyn Source>,
    format: Format,
    options: &ReadOptions,
    beside: Option<Beside>,
) -> Result<Cloud, Error> {
    let readers = format.readers();
    match (readers.shapes, readers.parts, readers.points) {
        (Some(read), ..) => Ok(read(source, options, beside, Purpose::Points)?.cloud()),
        (None, Some(read), _) => read(source, options, beside, &mut Chunks::default()),
        (None, None, Some(read)) => read(source, options),
        (None, None, None) => Err(format.without(Contents::Points, Direction::Read)),
    }
}

/// Reads the points of a file in its order, about `most` at a time: `take` is given them, and may refuse to go on. What is
/// returned has no points, and all else that the file tells.
///
/// Formats are text, npy, raw numbers, LAS or LAZ, and EPT, where all files of a kind have heights or none has. Costs memory for
/// some 100 bytes a point of `most`, and 64 megabytes where chunks of LAZ are decoded on all cores.
///
/// # Errors
/// [`Error::Unsupported`] for other formats; what `take` returns; else as [`read_points`].
///
/// ```
/// use std::io::Cursor;
/// use delone_io::{Format, ReadOptions, read_chunks};
///
/// let mut counts = Vec::new();
/// let text = Box::new(Cursor::new("x,y\n1,2\n3,4\n5,6\n"));
/// read_chunks(text, Format::Text, &ReadOptions::default(), 2, &mut |points, _| {
///     counts.push(points.len());
///     Ok(())
/// })?;
/// assert_eq!(counts, [2, 1]);
/// # Ok::<(), delone_io::Error>(())
/// ```
pub fn read_chunks(
    source: Box<dyn Source>,
    format: Format,
    options: &ReadOptions,
    most: usize,
    take: Take,
) -> Result<Cloud, Error> {
    read_chunks_with(source, format, options, most, take, None)
}

/// Reads the points of a file and of those beside it as [`read_chunks`] does, which `beside` opens as for [`read_points_beside`].
///
/// # Errors
/// As [`read_chunks`].
pub fn read_chunks_beside(
    source: Box<dyn Source>,
    format: Format,
    options: &ReadOptions,
    most: usize,
    take: Take,
    beside: Beside,
) -> Result<Cloud, Error> {
    read_chunks_with(source, format, options, most, take, Some(beside))
}

fn read_chunks_with(
    source: Box<dyn Source>,
    format: Format,
    options: &ReadOptions,
    most: usize,
    take: Take,
    beside: Option<Beside>,
) -> Result<Cloud, Error> {
    let readers = format.readers();
    // Rows of attributes are not taken in pieces.
    let options = &ReadOptions { attributes: false, ..options.clone() };
    let mut chunks = Chunks(Some((most.max(1), &mut *take)));
    let mut rest = match (readers.parts, readers.pieces) {
        (Some(read), _) => read(source, options, beside, &mut chunks)?,
        (None, Some(read)) => read(source, options, &mut chunks)?,
        (None, None) => return Err(format.without(Contents::Pieces, Direction::Read)),
    };
    if !rest.xy.is_empty() {
        take(&rest.xy, rest.z.as_deref())?;
        rest.clear();
    }
    Ok(rest)
}

/// Reads the triangles of a mesh file as indices into its points, from 0. In files of Gmsh, Medit, SU2 and VTK a quadrilateral is two of them: see
/// [`count_quads`].
///
/// # Errors
/// What is wrong with the file; a quadrilateral that crosses itself or is flat.
pub fn read_triangles(source: Box<dyn Source>, format: Format) -> Result<Vec<[u64; 3]>, Error> {
    format.readers().triangles.ok_or_else(|| format.without(Contents::Triangles, Direction::Read))?(source)
}

/// How many quadrilaterals [`read_triangles`] gives as two triangles each, by a diagonal inside: of two such, by that of a Delaunay
/// triangulation of the four corners.
pub fn count_quads(source: Box<dyn Source>, format: Format) -> Result<usize, Error> {
    match format {
        Format::Msh => formats::msh::count_quads(source),
        Format::Medit => Ok(formats::medit::read(source)?.quads.len()),
        Format::Su2 => Ok(formats::su2::read(source)?.quads.len()),
        Format::Vtu | Format::Vtp => formats::vtk::count_quads(source, false),
        Format::Vtk => formats::vtk::count_quads(source, true),
        _ => Ok(0),
    }
}

/// Reads the tetrahedra of a mesh file as indices into its points, from 0.
pub fn read_tetrahedra(source: Box<dyn Source>, format: Format) -> Result<Vec<[u64; 4]>, Error> {
    format.readers().tetrahedra.ok_or_else(|| format.without(Contents::Tetrahedra, Direction::Read))?(source)
}

/// Reads points with segments: those of `.poly` files, the lines and rings of GeoJSON, well-known text and well-known binary;
/// other formats give points alone.
///
/// A `.poly` file may leave its points to the `.node` file of the same name; `beside` opens it, given that extension. Rings
/// share their first point with their last. JSON may also be bare coordinates: arrays of rings (a polygon), or arrays of
/// those, whose rings are closed whether or not they repeat their first position. Ends of segments are in range, and count
/// from 0 whatever the file counts from; coordinates are not judged.
///
/// Costs time and memory linear in the file; what a header claims takes no memory.
///
/// # Errors
/// What is wrong with the file, and in which line or ring.
///
/// ```
/// use std::io::Cursor;
/// use delone_io::{Format, ReadOptions, read_graph};
///
/// // A square with a hole in its middle.
/// let poly = "4 2 0 0\n1 0 0\n2 4 0\n3 4 4\n4 0 4\n4 0\n1 1 2\n2 2 3\n3 3 4\n4 4 1\n1\n1 2 2\n";
/// let graph = read_graph(Box::new(Cursor::new(poly)), Format::Poly, &ReadOptions::default(), None)?;
/// assert_eq!(graph.segments, [[0, 1], [1, 2], [2, 3], [3, 0]]);
/// assert_eq!(graph.holes, [[2.0, 2.0]]);
/// # Ok::<(), delone_io::Error>(())
/// ```
pub fn read_graph(
    source: Box<dyn Source>,
    format: Format,
    options: &ReadOptions,
    beside: Option<Beside>,
) -> Result<Graph, Error> {
    let readers = format.readers();
    match (readers.shapes, readers.lines, readers.attributed) {
        (Some(read), ..) => {
            let purpose = if options.closed { Purpose::Polygons } else { Purpose::Lines };
            read(source, options, beside, purpose)?.graph()
        }
        (None, Some(read), _) => read(source, options, beside),
        (None, None, Some(read)) => read(source),
        (None, None, None) => read_with(source, format, options, beside).map(Graph::of_points),
    }
}

/// Whether a file is one of lines and polygons: its format is made for them, or there are some in it.
pub fn holds_lines(source: Box<dyn Source>, format: Format) -> bool {
    let readers = format.readers();
    readers.has(Contents::Lines) && readers.has_lines.is_none_or(|is_there| is_there(source))
}

/// Reads segments alone, as indices of points from 0: text with two columns, a NumPy array of shape (m, 2), a `.poly` or an
/// `.edge` file. Whether there are such points is for the reader of these to ask, except in a `.poly` file that has them.
pub fn read_segments(source: Box<dyn Source>, format: Format) -> Result<Vec<[usize; 2]>, Error> {
    format.readers().segments.ok_or_else(|| format.without(Contents::Segments, Direction::Read))?(source)
}

/// Reads a number for each point: text with one in each line, or a NumPy array of shape (n,).
pub fn read_numbers(source: Box<dyn Source>, format: Format) -> Result<Vec<f64>, Error> {
    format.readers().numbers.ok_or_else(|| format.without(Contents::Numbers, Direction::Read))?(source)
}

/// Reads the attributes of the triangles of an `.ele` file, or their groups in files of Gmsh and Medit, a row each; other formats have none.
pub fn read_triangle_attributes(source: Box<dyn Source>, format: Format) -> Result<Attributes, Error> {
    match format {
        Format::Ele => Ok(formats::triangle::read_ele::<3>(source, true)?.1),
        Format::Msh => formats::msh::read_groups(source),
        Format::Medit => formats::medit::read(source)?.regions(formats::medit::NAME),
        _ => Ok(Attributes::default()),
    }
}

/// Reads the largest area that each triangle may have, where there is a bound, from an `.area` file.
pub fn read_areas(source: Box<dyn Source>, format: Format) -> Result<Vec<Option<f64>>, Error> {
    format.readers().areas.ok_or_else(|| format.without(Contents::Areas, Direction::Read))?(source)
}

/// Triangles as formats of surfaces see them.
trait Shape {
    /// The coordinates of the points, zero where there is no height.
    fn positions(&self) -> impl Iterator<Item = [f64; 3]>;
    /// The triangles as indices of points.
    fn triangles(&self) -> impl Iterator<Item = [usize; 3]> + Send;
    /// Whether the triangles are around a body; otherwise they are over the plane.
    fn is_closed(&self) -> bool {
        false
    }
    /// A value for each point.
    fn heights(&self) -> Option<&[f64]>;
    /// The region of each triangle, where there are any.
    fn region_values(&self) -> Option<impl Iterator<Item = f64>> {
        None::<std::iter::Empty<f64>>
    }
    /// The system of coordinates.
    fn crs(&self) -> Option<&Crs> {
        None
    }
    /// The attributes of the polygons that triangles are in, where they are known.
    fn table(&self) -> Option<&Table> {
        None
    }
    /// The row of each triangle in that table.
    fn rows(&self) -> impl Iterator<Item = Option<usize>> {
        std::iter::empty()
    }
}

/// Reads the rings of polygons: those of formats that have polygons, or all points of another format as one ring.
pub fn read_rings(source: Box<dyn Source>, format: Format) -> Result<Rings, Error> {
    read_rings_with(source, format, None)
}

fn read_rings_with(source: Box<dyn Source>, format: Format, beside: Option<Beside>) -> Result<Rings, Error> {
    let readers = format.readers();
    let options = ReadOptions { dimension: 2, ..ReadOptions::default() };
    match (readers.shapes, readers.polygons) {
        (Some(read), _) => Ok(read(source, &options, beside, Purpose::Polygons)?.rings()),
        (None, Some(read)) => read(source),
        (None, None) => {
            let cloud = read_with(source, format, &options, beside)?;
            Ok(Rings { rings: vec![cloud.xy], crs: cloud.crs, losses: cloud.losses })
        }
    }
}

/// Reads the rings of polygons of a file and what their system is from those beside it ([`Format::sides`]).
pub fn read_rings_beside(source: Box<dyn Source>, format: Format, beside: Beside) -> Result<Rings, Error> {
    read_rings_with(source, format, Some(beside))
}

/// Writes bare points of the plane (D = 2) or of space (D = 3).
pub fn write_points<const D: usize>(
    out: &mut dyn std::io::Write,
    format: Format,
    points: &[[f64; D]],
) -> Result<(), Error> {
    use formats::{geojson, npy, obj, ply, raw, text, triangle, wkb, wkt};
    match format {
        Format::Text => text::write(out, points)?,
        Format::Npy => npy::write_points(out, points)?,
        Format::Raw => raw::write(out, points)?,
        Format::Node => triangle::NodeRows::of(D, points).write(out)?,
        Format::Ply => ply::write_points(out, points)?,
        Format::Obj => obj::write_points(out, points)?,
        Format::GeoJson => geojson::write_points(out, points)?,
        Format::FlatGeobuf | Format::GeoPackage => vector::write(out, format, &vector::Points(points))?,
        Format::Wkt | Format::WktCollection => {
            wkt::write_points(out, points, format == Format::WktCollection)?;
        }
        Format::Wkb => wkb::write_points(out, points)?,
        _ => return Err(format.without(Contents::Points, Direction::Written)),
    }
    Ok(())
}

/// Writes a graph: as a `.poly` file with all attributes and markers, holes and regions; as GeoJSON, FlatGeobuf, GeoPackage or well-known text with its
/// polygons, lines of all other segments, and points that no segment joins: in text a geometry a line, or one collection
/// ([`Format::WktCollection`]).
pub fn write_graph(out: &mut dyn std::io::Write, format: Format, graph: &Graph) -> Result<(), Error> {
    match format {
        Format::Poly => Ok(formats::poly::write_graph(out, graph)?),
        Format::GeoJson => Ok(formats::graphs::write_geojson(out, graph)?),
        Format::FlatGeobuf | Format::GeoPackage => vector::write(out, format, &vector::Graphs::new(graph)),
        Format::Wkt | Format::WktCollection => {
            Ok(formats::graphs::write_wkt(out, graph, format == Format::WktCollection)?)
        }
        _ => Err(format.without(Contents::Lines, Direction::Written)),
    }
}

/// Writes indices, -1 where there is none: npy (int64, one dimension) or text (a line each).
pub fn write_index_list(out: &mut dyn std::io::Write, format: Format, values: &[i64]) -> Result<(), Error> {
    use formats::{npy, text};
    match format {
        Format::Npy => npy::write_index_list(out, values)?,
        Format::Text => text::write_indices(out, 1, values)?,
        _ => return Err(format.without(Contents::Indices, Direction::Written)),
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
        _ => return Err(format.without(Contents::Indices, Direction::Written)),
    }
    Ok(())
}
