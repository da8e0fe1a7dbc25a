//! The writers of diagrams, in all formats of polygons.

use delone::Triangulation;

use crate::diagram::{Diagram, LineDiagram, OrderDiagram, Tiles};
use crate::format::{Contents, Direction};
use crate::formats::vector;
use crate::{Error, Format, formats, picture};

/// Writes Voronoi cells, one for each site with its input index (`site`), the area of its cell and its attributes: as GeoJSON, FlatGeobuf or GeoPackage,
/// or as CSV with the columns `site,area,...,wkt`; as well-known text, a geometry a line or one collection ([`Format::WktCollection`]), and well-known
/// binary, one collection, without index and area; or as a picture whose longer side has `size` pixels.
///
/// The rings are the same in all of them, bit for bit. A cell that is empty has its place: no geometry in GeoJSON, an empty
/// polygon in the other formats. An area beyond the range of numbers is null in GeoJSON and an empty field in CSV.
///
/// # Errors
/// [`Error::Unsupported`] for other formats, and those of the output.
///
/// ```
/// use delone::{Delaunay2, Region2};
/// use delone_io::{Diagram, Format, write_diagram};
///
/// let d = Delaunay2::from_points(&[[0.0, 0.0], [4.0, 0.0]])?;
/// let cells = d.voronoi().clip(&Region2::rectangle([0.0, 0.0], [4.0, 1.0])?);
/// let diagram = Diagram { triangulation: &d, cells: &cells, crs: None, features: None };
/// let mut file = Vec::new();
/// write_diagram(&mut file, Format::Text, &diagram, 800)?;
/// assert!(String::from_utf8(file)?.starts_with("site,area,wkt\n0,2.0,\"POLYGON (("));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write_diagram(
    out: &mut dyn std::io::Write,
    format: Format,
    diagram: &Diagram<impl Triangulation<Point = [f64; 2]>>,
    size: u32,
) -> Result<(), Error> {
    write_tiles(out, format, diagram, size)
}

/// Writes the cells of lines, each with the index of its line (`site`) and its area, in the formats of [`write_diagram`].
///
/// # Errors
/// [`Error::Unsupported`] for other formats, and those of the output.
pub fn write_lines_diagram(
    out: &mut dyn std::io::Write,
    format: Format,
    diagram: &LineDiagram,
    size: u32,
) -> Result<(), Error> {
    write_tiles(out, format, diagram, size)
}

/// Writes the regions of a diagram of higher order, each with the input indices of its sites (`sites`, in CSV apart by spaces) and its
/// area, in the formats of [`write_diagram`].
///
/// # Errors
/// [`Error::Unsupported`] for other formats, and those of the output.
pub fn write_orders(
    out: &mut dyn std::io::Write,
    format: Format,
    diagram: &OrderDiagram,
    size: u32,
) -> Result<(), Error> {
    write_tiles(out, format, diagram, size)
}

fn write_tiles(
    out: &mut dyn std::io::Write,
    format: Format,
    diagram: &impl Tiles,
    size: u32,
) -> Result<(), Error> {
    match format {
        Format::GeoJson => formats::geojson::write_cells(out, diagram)?,
        Format::Wkt | Format::WktCollection => {
            formats::cells::write_wkt(out, diagram, format == Format::WktCollection)?;
        }
        Format::FlatGeobuf | Format::GeoPackage => vector::write(out, format, &vector::Cells(diagram))?,
        Format::Text => formats::cells::write_csv(out, diagram)?,
        Format::Wkb => formats::cells::write_wkb(out, diagram)?,
        Format::Svg | Format::Png => picture::write_cells(out, format, diagram, size)?,
        _ => return Err(format.without(Contents::Cells, Direction::Written)),
    }
    Ok(())
}
