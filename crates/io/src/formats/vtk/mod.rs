//! VTK's files: the legacy format (`.vtk`, in `legacy.rs`), and XML (`.vtu`, `.vtp`, in `xml.rs`). Points; and of the cells
//! lines, triangles, quadrilaterals (as two triangles) and tetrahedra, of any order by their corners. Lines are segments, and no borders;
//! an array `marker` of the cells of XML has their markers.

mod cells;
mod legacy;
#[cfg(test)]
mod tests;
mod xml;

use crate::error::excerpt;
use crate::{Cloud, Error, Graph, Source};
use cells::Cells;

/// A reader of points, and of cells too if they are wanted.
type Read = fn(Box<dyn Source>, bool) -> Result<(Cloud, Cells), Error>;

/// Reads the points of a legacy file.
pub(crate) fn read_legacy(source: Box<dyn Source>) -> Result<Cloud, Error> {
    Ok(legacy::read(source, false)?.0)
}

/// Reads the points of all pieces of an XML file.
pub(crate) fn read_xml(source: Box<dyn Source>) -> Result<Cloud, Error> {
    Ok(xml::read(source, false)?.0)
}

/// Reads the points of a legacy file, and its lines as segments.
pub(crate) fn read_legacy_graph(source: Box<dyn Source>) -> Result<Graph, Error> {
    graph(legacy::read, source)
}

/// Reads the points of an XML file, and its lines as segments.
pub(crate) fn read_xml_graph(source: Box<dyn Source>) -> Result<Graph, Error> {
    graph(xml::read, source)
}

/// Whether there is a line in a legacy file, or cells that are not understood, which the reader of lines tells.
pub(crate) fn has_legacy_lines(source: Box<dyn Source>) -> bool {
    legacy::read(source, true).map_or(true, |(_, cells)| cells.has_lines())
}

/// Whether there is a line in an XML file, or cells that are not understood.
pub(crate) fn has_xml_lines(source: Box<dyn Source>) -> bool {
    xml::read(source, true).map_or(true, |(_, cells)| cells.has_lines())
}

/// Reads the triangles (N = 3) or tetrahedra (N = 4) of a legacy file, as indices of the points.
pub(crate) fn read_legacy_simplices<const N: usize>(source: Box<dyn Source>) -> Result<Vec<[u64; N]>, Error> {
    Ok(simplices(legacy::read, source)?.0)
}

/// Reads the triangles (N = 3) or tetrahedra (N = 4) of an XML file, as indices of the points.
pub(crate) fn read_xml_simplices<const N: usize>(source: Box<dyn Source>) -> Result<Vec<[u64; N]>, Error> {
    Ok(simplices(xml::read, source)?.0)
}

/// How many quadrilaterals of an XML file, or of a legacy one, are read as two triangles.
pub(crate) fn count_quads(source: Box<dyn Source>, is_legacy: bool) -> Result<usize, Error> {
    Ok(simplices::<3>(if is_legacy { legacy::read } else { xml::read }, source)?.1)
}

fn simplices<const N: usize>(read: Read, source: Box<dyn Source>) -> Result<(Vec<[u64; N]>, usize), Error> {
    let (cloud, cells) = read(source, true)?;
    cells.simplices(&cloud.xy)
}

fn graph(read: Read, source: Box<dyn Source>) -> Result<Graph, Error> {
    let (cloud, cells) = read(source, true)?;
    let (segments, markers) = cells.segments();
    Ok(Graph { is_border: vec![false; segments.len()], segments, markers, ..Graph::of_points(cloud) })
}

fn broken(what: impl std::fmt::Display) -> Error {
    Error::content(format!("VTK: {what}"))
}

/// The loss of values of points and cells with these names.
fn left_out(names: &str) -> String {
    format!("values of points and cells are left out: {names}")
}

/// A number of an array that is text.
fn number(word: &str) -> Result<f64, Error> {
    word.parse().map_err(|_| broken(format!("{:?} is no number", excerpt(word))))
}
