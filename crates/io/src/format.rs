//! Formats, and how files say which one they are.

mod beginning;
mod contents;
mod readers;
mod table;

use std::fmt;
use std::path::Path;
use std::str::FromStr;

pub(crate) use contents::Readers;
pub use contents::{Contents, Direction};

use crate::{Crs, Error};
use table::{Row, TABLE};

/// How a file says what its coordinates mean.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Said {
    /// So that readers know.
    Whole,
    /// Not at all.
    Not,
    /// Not, and readers will take them for something else.
    Otherwise,
    /// It has none.
    NeedNot,
}

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
    /// Triangle's neighbors.
    Neigh,
    /// Triangle's edges.
    Edge,
    /// LAS and LAZ point clouds.
    Las,
    /// Entwine Point Tiles.
    Ept,
    /// E57 scans.
    E57,
    /// Leica's scans as text.
    Ptx,
    /// Dumps of LAMMPS.
    Lammps,
    /// Extended XYZ.
    ExtXyz,
    /// Stanford polygons.
    Ply,
    /// Wavefront.
    Obj,
    /// Geomview.
    Off,
    /// Stereolithography.
    Stl,
    /// VTK unstructured grids.
    Vtu,
    /// Other XML files of VTK, of which points are read.
    Vtp,
    /// VTK's legacy format.
    Vtk,
    /// Clouds of the Point Cloud Library.
    Pcd,
    /// GeoJSON.
    GeoJson,
    /// GeoJSON with a feature a line.
    GeoJsonLines,
    /// JSON that is no GeoJSON. It is written alone: `json` names GeoJSON where that is read or can be written.
    Json,
    /// FlatGeobuf.
    FlatGeobuf,
    /// GeoPackage.
    GeoPackage,
    /// Shapefiles, with what lies beside them.
    Shapefile,
    /// Drawings of CAD.
    Dxf,
    /// Well-known text of geometries, one a line.
    Wkt,
    /// Well-known text of one collection that holds all geometries. It is written alone: reading tells by itself, and no extension is its.
    WktCollection,
    /// Well-known binary of geometries.
    Wkb,
    /// Tracks, routes and waypoints.
    Gpx,
    /// GeoTIFF rasters.
    Tiff,
    /// ESRI ASCII grids.
    Asc,
    /// Meshes of Gmsh.
    Msh,
    /// Meshes of Abaqus.
    Inp,
    /// Meshes of Medit, which FreeFEM and MMG read.
    Medit,
    /// Meshes of SU2.
    Su2,
    /// Meshes of SMS.
    Sms,
    /// Grids of ADCIRC.
    Adcirc,
    /// Bulk data of Nastran.
    Nastran,
    /// XDMF.
    Xdmf,
    /// Vector pictures.
    Svg,
    /// Pixel pictures.
    Png,
}

impl Format {
    /// All formats, in the order in which they are listed.
    pub fn all() -> impl Iterator<Item = Self> {
        TABLE.iter().map(|row| row.format)
    }

    /// The format that a file's extension names; `.gz` after it says that the file is compressed. A file `ept.json` is one of its own.
    ///
    /// ```
    /// use std::path::Path;
    /// use delone_io::Format;
    ///
    /// assert_eq!(Format::of(Path::new("survey/ept.json"))?, Format::Ept);
    /// assert_eq!(Format::of(Path::new("survey/a.json.gz"))?, Format::GeoJson);
    /// # Ok::<(), delone_io::Error>(())
    /// ```
    pub fn of(path: &Path) -> Result<Self, Error> {
        if path.file_name().is_some_and(|name| name == crate::formats::ept::NAME) {
            return Ok(Self::Ept);
        }
        let inner = if is_gzip(path) { path.with_extension("") } else { path.to_owned() };
        let extension = inner.extension().and_then(|e| e.to_str()).unwrap_or_default();
        extension.parse().map_err(|_| Error::UnknownExtension(path.display().to_string()))
    }

    /// A description in a few words.
    pub fn title(self) -> &'static str {
        self.row().title
    }

    /// Its names, which are extensions too: those that are listed, and others that are understood.
    pub fn names(self) -> [&'static [&'static str]; 2] {
        [self.row().names, self.row().also]
    }

    /// Whether files of this format hold such contents, as far as they are read or written.
    ///
    /// ```
    /// use delone_io::{Contents, Direction, Format};
    ///
    /// assert!(Format::Las.holds(Contents::Points, Direction::Read));
    /// assert!(!Format::Las.holds(Contents::Points, Direction::Written));
    /// ```
    pub fn holds(self, contents: Contents, direction: Direction) -> bool {
        match direction {
            Direction::Read => self.row().readers.has(contents),
            Direction::Written => self.row().writes.contains(&contents),
        }
    }

    /// How files of this format say what their coordinates mean. Side files of rasters count.
    ///
    /// ```
    /// use delone_io::{Crs, Format, Said};
    ///
    /// let ours = Crs::of_wkt("PROJCS[\"ours\",UNIT[\"metre\",1]]").expect("a system");
    /// assert_eq!(Format::GeoJson.says(&Crs::of_epsg(25832)), Said::Whole);
    /// assert_eq!(Format::GeoJson.says(&ours), Said::Whole);
    /// let named = Crs { name: Some("ours".to_owned()), ..Crs::default() };
    /// assert_eq!(Format::GeoJson.says(&named), Said::Otherwise);
    /// assert_eq!(Format::Vtu.says(&ours), Said::Not);
    /// ```
    pub fn says(self, crs: &Crs) -> Said {
        let when = |is_said: bool| if is_said { Said::Whole } else { Said::Not };
        match self {
            Self::GeoJson if crs.known_name().is_some() || crs.is_plain_degrees() => Said::Whole,
            Self::GeoJson => Said::Otherwise,
            Self::FlatGeobuf | Self::GeoPackage => {
                when(crs.epsg.is_some() || crs.wkt.is_some() || crs.is_plain_degrees())
            }
            Self::Wkb | Self::Ply | Self::Obj => when(crs.epsg.is_some()),
            Self::Tiff => when(crs.epsg.is_some() || crs.wkt.is_some() || crs.keys.is_some()),
            Self::Asc => when(crs.wkt.is_some()),
            Self::Wkt
            | Self::WktCollection
            | Self::Node
            | Self::Poly
            | Self::Off
            | Self::Stl
            | Self::Vtu
            | Self::Json
            | Self::Msh
            | Self::Inp
            | Self::Medit
            | Self::Su2
            | Self::Sms
            | Self::Adcirc
            | Self::Nastran
            | Self::Xdmf => Said::Not,
            // There are no coordinates in it, or nobody looks for their meaning.
            _ => Said::NeedNot,
        }
    }

    /// Whether files of this format lack the system of heights that `crs` has beside the horizontal one.
    ///
    /// ```
    /// use delone_io::{Crs, Format};
    ///
    /// let heights = Crs { vertical: Some(7837), ..Crs::of_epsg(25832) };
    /// assert!(Format::Ply.lacks_heights(&heights) && !Format::GeoJson.lacks_heights(&heights));
    /// ```
    pub fn lacks_heights(self, crs: &Crs) -> bool {
        let is_apart = crs.vertical.is_some() && !crs.is_compound();
        match self {
            Self::FlatGeobuf | Self::GeoPackage => is_apart && crs.wkt.is_none(),
            Self::Wkb | Self::Ply | Self::Obj => is_apart && crs.epsg.is_some(),
            _ => false,
        }
    }

    /// Whether files of this format have the attributes of the input beside such contents.
    ///
    /// ```
    /// use delone_io::{Contents, Format};
    ///
    /// assert!(Format::GeoJson.keeps_attributes(Contents::Cells));
    /// assert!(!Format::Wkt.keeps_attributes(Contents::Cells));
    /// ```
    pub fn keeps_attributes(self, contents: Contents) -> bool {
        match contents {
            Contents::Cells | Contents::Answers => self == Self::Text || self.has_layers(),
            Contents::Polyhedra => matches!(self, Self::Text | Self::Json | Self::Vtu),
            Contents::Triangles | Contents::Patches => self == Self::Vtu || self.has_layers(),
            // Those of the input beside triangles, which want a layer of their own.
            Contents::Lines => self == Self::GeoPackage,
            _ => false,
        }
    }

    /// Whether files of this format have names of regions or boundaries ([`crate::Names`]).
    ///
    /// ```
    /// use delone_io::Format;
    ///
    /// assert!(Format::Msh.keeps_names() && !Format::Vtu.keeps_names());
    /// ```
    pub fn keeps_names(self) -> bool {
        matches!(
            self,
            Self::Poly | Self::Msh | Self::Inp | Self::Su2 | Self::Sms | Self::Adcirc | Self::Nastran
        )
    }

    /// The extensions of the files beside one of this format that are read with it.
    pub fn sides(self) -> &'static [&'static str] {
        if self == Self::Shapefile { crate::formats::shapefile::SIDES } else { &[] }
    }

    /// Whether its files have features with attributes of all types.
    fn has_layers(self) -> bool {
        matches!(self, Self::GeoJson | Self::FlatGeobuf | Self::GeoPackage)
    }

    /// Refuses contents that files of this format do not hold.
    ///
    /// # Errors
    /// [`Error::Unsupported`], which knows the formats that do.
    pub fn check(self, contents: Contents, direction: Direction) -> Result<(), Error> {
        if self.holds(contents, direction) { Ok(()) } else { Err(self.without(contents, direction)) }
    }

    /// In which direction such contents, or any at all, go where this one does not work.
    ///
    /// ```
    /// use delone_io::{Contents, Direction, Format};
    ///
    /// let way = Format::Las.other_way(Contents::Points, Direction::Written);
    /// assert_eq!(way.as_deref(), Some("points are read from las files, not written to them"));
    /// let way = Format::Png.other_way(Contents::Points, Direction::Read);
    /// assert_eq!(way.as_deref(), Some("png files are written alone"));
    /// assert_eq!(Format::Ply.other_way(Contents::Rasters, Direction::Read), None);
    /// ```
    pub fn other_way(self, contents: Contents, direction: Direction) -> Option<String> {
        let (other, way, not) = match direction {
            Direction::Read => (Direction::Written, "written", "read from"),
            Direction::Written => (Direction::Read, "read", "written to"),
        };
        if self.holds(contents, direction) {
            return None;
        }
        if self.holds(contents, other) {
            return Some(format!("{contents} are {other} {self} files, not {not} them"));
        }
        let is_one_way = !Contents::ALL.iter().any(|&any| self.holds(any, direction));
        is_one_way.then(|| format!("{self} files are {way} alone"))
    }

    /// The error of a format that does not hold such contents.
    pub(crate) fn without(self, contents: Contents, direction: Direction) -> Error {
        Error::Unsupported { format: self, contents, direction }
    }

    /// The functions that read it.
    pub(crate) fn readers(self) -> &'static Readers {
        &self.row().readers
    }

    /// The names of the formats that hold any of these contents, apart by spaces: all that are listed of what is read, the first of what
    /// is written.
    ///
    /// ```
    /// use delone_io::{Contents, Direction, Format};
    ///
    /// assert_eq!(Format::with(&[Contents::Rasters], Direction::Written), "npy tif asc");
    /// ```
    pub fn with(any: &[Contents], direction: Direction) -> String {
        let holds = |row: &&Row| any.iter().any(|&contents| row.format.holds(contents, direction));
        let most = if direction == Direction::Read { usize::MAX } else { 1 };
        let names = TABLE.iter().filter(holds).flat_map(|row| row.names.iter().take(most));
        names.copied().collect::<Vec<_>>().join(" ")
    }

    fn row(self) -> &'static Row {
        &TABLE[self as usize]
    }
}

// Rows are found by the order of the formats.
const _: () = {
    assert!(TABLE.len() == Format::Png as usize + 1);
    let mut place = 0;
    while place < TABLE.len() {
        assert!(TABLE[place].format as usize == place);
        place += 1;
    }
};

/// Whether a file is compressed, by its name.
pub(crate) fn is_gzip(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("gz"))
}

impl FromStr for Format {
    type Err = Error;

    fn from_str(name: &str) -> Result<Self, Error> {
        let is_named =
            |row: &&Row| row.names.iter().chain(row.also).any(|known| name.eq_ignore_ascii_case(known));
        TABLE
            .iter()
            .find(is_named)
            .map(|row| row.format)
            .ok_or_else(|| Error::UnknownExtension(name.to_owned()))
    }
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // One collection has no name of its own for files.
        let of = if *self == Self::WktCollection { Self::Wkt } else { *self };
        f.write_str(of.row().names.first().unwrap_or(&"unnamed"))
    }
}
