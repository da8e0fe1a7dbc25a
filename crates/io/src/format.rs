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
    /// NumPy arrays.
    Npy,
    /// Raw little-endian f64.
    Raw,
    /// Triangle's points.
    Node,
    /// Triangle's triangles.
    Ele,
    /// Triangle's neighbours.
    Neigh,
    /// Triangle's edges.
    Edge,
    /// LAS and LAZ point clouds.
    Las,
    /// Stanford polygons.
    Ply,
    /// Wavefront.
    Obj,
    /// Stereolithography.
    Stl,
    /// VTK unstructured grids.
    Vtu,
    /// GeoJSON.
    GeoJson,
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
    ("npy", Format::Npy),
    ("bin", Format::Raw),
    ("node", Format::Node),
    ("ele", Format::Ele),
    ("neigh", Format::Neigh),
    ("edge", Format::Edge),
    ("las", Format::Las),
    ("laz", Format::Las),
    ("ply", Format::Ply),
    ("obj", Format::Obj),
    ("stl", Format::Stl),
    ("vtu", Format::Vtu),
    ("geojson", Format::GeoJson),
    ("json", Format::GeoJson),
    ("svg", Format::Svg),
    ("png", Format::Png),
];

impl Format {
    /// The format that a file's extension names.
    pub fn of(path: &Path) -> Result<Self, Error> {
        let extension = path.extension().and_then(|e| e.to_str()).unwrap_or_default();
        extension.parse().map_err(|_| Error::UnknownExtension(path.display().to_string()))
    }
}

impl Format {
    /// Whether a triangulation can be written in it.
    pub fn holds_meshes(self) -> bool {
        !matches!(self, Self::Text | Self::Raw | Self::Las)
    }
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
        let name = NAMES.iter().find(|entry| entry.1 == *self).map_or("unnamed", |entry| entry.0);
        f.write_str(name)
    }
}
