//! Readers that several formats share, or that one has for all contents.

use super::Readers;
use crate::formats::listed::corners;
use crate::formats::{geojson, medit, msh, poly, su2, vtk, wkt};

/// The readers of GeoJSON, which tell by themselves whether there is a feature a line.
pub(super) const OF_GEOJSON: Readers = Readers {
    shapes: Some(|source, options, _, purpose| geojson::read(source, options, purpose)),
    ..Readers::NONE
};

/// The readers of well-known text, which tell by themselves whether it is one collection.
pub(super) const OF_WKT: Readers =
    Readers { shapes: Some(|source, options, _, _| wkt::read(source, options)), ..Readers::NONE };

/// The readers of VTK's files of XML.
pub(super) const OF_VTK: Readers = Readers {
    points: Some(|source, _| vtk::read_xml(source)),
    lines: Some(|source, _, _| vtk::read_xml_graph(source)),
    has_lines: Some(vtk::has_xml_lines),
    triangles: Some(vtk::read_xml_simplices),
    tetrahedra: Some(vtk::read_xml_simplices),
    ..Readers::NONE
};

/// The readers of Medit's meshes.
pub(super) const OF_MEDIT: Readers = Readers {
    points: Some(|source, _| Ok(medit::read(source)?.cloud())),
    lines: Some(|source, _, _| Ok(medit::read(source)?.graph())),
    has_lines: Some(|source| medit::read(source).is_ok_and(|mesh| !mesh.lines.is_empty())),
    triangles: Some(|source| Ok(corners(medit::read(source)?.triangles(medit::NAME)?))),
    tetrahedra: Some(|source| Ok(corners(medit::read(source)?.tetrahedra))),
    ..Readers::NONE
};

/// The readers of SU2's meshes.
pub(super) const OF_SU2: Readers = Readers {
    points: Some(|source, _| Ok(su2::read(source)?.cloud())),
    lines: Some(|source, _, _| Ok(su2::read(source)?.graph())),
    has_lines: Some(|source| su2::read(source).is_ok_and(|mesh| !mesh.lines.is_empty())),
    triangles: Some(|source| Ok(corners(su2::read(source)?.triangles(su2::NAME)?))),
    tetrahedra: Some(|source| Ok(corners(su2::read(source)?.tetrahedra))),
    ..Readers::NONE
};

/// The readers of Gmsh's meshes.
pub(super) const OF_MSH: Readers = Readers {
    points: Some(|source, _| msh::read_points(source)),
    lines: Some(|source, _, _| msh::read_graph(source)),
    has_lines: Some(msh::has_lines),
    triangles: Some(msh::read_simplices),
    tetrahedra: Some(msh::read_simplices),
    ..Readers::NONE
};

/// The readers of Triangle's graphs.
pub(super) const OF_POLY: Readers = Readers {
    points: Some(|source, _| poly::read_points(source)),
    lines: Some(|source, _, beside| poly::read(source, beside)),
    polygons: Some(poly::read_rings),
    segments: Some(poly::read_segments),
    ..Readers::NONE
};
