//! Formats, and how files say which one they are.

use std::fmt;
use std::path::Path;
use std::str::FromStr;

use crate::Error;

/// A file format.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Format {
    /// Columns of numbers: csv, xyz, txt, tsv.
    Text,
    /// Counted lists of points with other numbers: pts.
    Pts,
    /// NumPy arrays.
    Npy,
    /// NumPy archives.
    Npz,
    /// Raw little-endian f64.
    Raw,
    /// Triangle's points.
    Node,
    /// Triangle's graphs: points, segments, holes and regions.
    Poly,
    /// Triangle's largest areas of triangles.
    Area,
    /// Triangle's triangles.
    Ele,
    /// Triangle's neighbours.
    Neigh,
    /// Triangle's edges.
    Edge,
    /// LAS and LAZ point clouds.
    Las,
    /// E57 scans.
    E57,
    /// Stanford polygons.
    Ply,
    /// Wavefront.
    Obj,
    /// Geomview.
    Off,
    /// Stereolithography.
    Stl,
    /// VTK unstructured grids; points are read of other XML files of VTK too.
    Vtu,
    /// VTK's legacy format.
    Vtk,
    /// Clouds of the Point Cloud Library.
    Pcd,
    /// GeoJSON.
    GeoJson,
    /// Well-known text of geometries, one a line.
    Wkt,
    /// Well-known text of one collection that holds all geometries. It is written alone: reading tells by itself, and no extension is its.
    WktCollection,
    /// Well-known binary of geometries.
    Wkb,
    /// GeoTIFF rasters.
    Tiff,
    /// ESRI ASCII grids.
    Asc,
    /// Meshes of Gmsh.
    Msh,
    /// Meshes of Abaqus.
    Inp,
    /// Vector pictures.
    Svg,
    /// Pixel pictures.
    Png,
}

/// Names and extensions; the first of each format is the one it prints.
const NAMES: &[(&str, Format)] = &[
    ("csv", Format::Text),
    ("xyz", Format::Text),
    ("txt", Format::Text),
    ("tsv", Format::Text),
    ("dat", Format::Text),
    ("pts", Format::Pts),
    ("npy", Format::Npy),
    ("npz", Format::Npz),
    ("bin", Format::Raw),
    ("node", Format::Node),
    ("poly", Format::Poly),
    ("area", Format::Area),
    ("ele", Format::Ele),
    ("neigh", Format::Neigh),
    ("edge", Format::Edge),
    ("las", Format::Las),
    ("laz", Format::Las),
    ("e57", Format::E57),
    ("ply", Format::Ply),
    ("obj", Format::Obj),
    ("off", Format::Off),
    ("stl", Format::Stl),
    ("vtu", Format::Vtu),
    ("vtp", Format::Vtu),
    ("vtk", Format::Vtk),
    ("pcd", Format::Pcd),
    ("geojson", Format::GeoJson),
    ("json", Format::GeoJson),
    ("geojsonl", Format::GeoJson),
    ("geojsons", Format::GeoJson),
    ("ndjson", Format::GeoJson),
    ("wkt", Format::Wkt),
    ("ewkt", Format::Wkt),
    ("wkb", Format::Wkb),
    ("ewkb", Format::Wkb),
    ("tif", Format::Tiff),
    ("tiff", Format::Tiff),
    ("asc", Format::Asc),
    ("msh", Format::Msh),
    ("inp", Format::Inp),
    ("svg", Format::Svg),
    ("png", Format::Png),
];

impl Format {
    /// The format that a file's extension names; `.gz` after it says that the file is compressed.
    pub fn of(path: &Path) -> Result<Self, Error> {
        let inner = if is_gzip(path) { path.with_extension("") } else { path.to_owned() };
        let extension = inner.extension().and_then(|e| e.to_str()).unwrap_or_default();
        extension.parse().map_err(|_| Error::UnknownExtension(path.display().to_string()))
    }
}

/// Whether a file is compressed, by its name.
pub(crate) fn is_gzip(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("gz"))
}

impl FromStr for Format {
    type Err = Error;

    fn from_str(name: &str) -> Result<Self, Error> {
        let named = |(known, _): &&(&str, Self)| name.eq_ignore_ascii_case(known);
        NAMES.iter().find(named).map(|entry| entry.1).ok_or_else(|| Error::UnknownExtension(name.to_owned()))
    }
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // It is no name of its own for files.
        let of = if *self == Self::WktCollection { Self::Wkt } else { *self };
        let name = NAMES.iter().find(|entry| entry.1 == of).map_or("unnamed", |entry| entry.0);
        f.write_str(name)
    }
}
