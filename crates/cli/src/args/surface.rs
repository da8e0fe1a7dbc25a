//! Arguments of `dtm` and `interpolate`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use delone::surface::Duplicates;
use delone_io::{Compression, Contents, Format};
use delone_terrain::Method;

use super::formats;
use super::{DimArgs, EdgeArgs, InputArgs, LightArgs, PlaceArgs, tiles::size};
use crate::message::Failure;

/// How values between points come about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum MethodName {
    /// Linear in each triangle.
    Linear,
    /// Natural neighbors: what the cell of a place takes from the cells of its neighbors (Sibson).
    #[value(alias = "sibson")]
    Natural,
    /// Natural neighbors: the size of facets over distances (Laplace).
    Laplace,
    /// The value of the nearest point.
    Nearest,
    /// Natural neighbors with gradients: smooth at the points too (Sibson).
    Smooth,
    /// Smooth at the points too, by a cubic (Farin).
    Farin,
}

impl MethodName {
    /// The method of the library.
    pub(crate) fn method(self) -> Method {
        match self {
            Self::Linear => Method::Linear,
            Self::Natural => Method::Natural,
            Self::Laplace => Method::Laplace,
            Self::Nearest => Method::Nearest,
            Self::Smooth => Method::Smooth,
            Self::Farin => Method::Farin,
        }
    }

    /// Whether it needs gradients.
    pub(crate) fn is_bent(self) -> bool {
        self.method().needs_gradients()
    }
}

/// Which height a place has at which there are several points.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum DuplicatesName {
    /// The lowest.
    #[default]
    Lowest,
    /// That of the first point.
    First,
    /// The highest.
    Highest,
    /// The mean of all.
    Mean,
}

impl DuplicatesName {
    /// The rule of the library.
    pub(crate) fn rule(self) -> Duplicates {
        match self {
            Self::Lowest => Duplicates::Lowest,
            Self::First => Duplicates::First,
            Self::Highest => Duplicates::Highest,
            Self::Mean => Duplicates::Mean,
        }
    }
}

/// How GeoTIFF is compressed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum CompressName {
    /// Deflate, which is read everywhere.
    #[default]
    Deflate,
    /// LZW: larger files, for old readers.
    Lzw,
    /// Numbers as they are.
    None,
}

impl CompressName {
    /// Refuses a compression for outputs that have none.
    pub(crate) fn check(self, formats: impl IntoIterator<Item = Format>) -> Result<(), Failure> {
        if self == Self::default() || formats.into_iter().any(|format| format == Format::Tiff) {
            return Ok(());
        }
        Err(Failure::usage("--compress is for GeoTIFF", "leave it out, or name an output .tif"))
    }
}

impl From<CompressName> for Compression {
    fn from(name: CompressName) -> Self {
        match name {
            CompressName::Deflate => Self::Deflate,
            CompressName::Lzw => Self::Lzw,
            CompressName::None => Self::None,
        }
    }
}

/// Points with heights to a raster of terrain.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  delone dtm tile.laz --cell 1 -o dem.tif -o shade.png -o contours.geojson --interval 2
  delone dtm survey/ --cell 0.5 --memory 2G -o dem.tif
  delone dtm ground.csv --cell 1 --method natural --breaklines ridges.geojson -o dem.asc
  delone dtm tile.laz --all-classes --cell 1 --max-edge 50 --clip area.geojson -o surface.npy
  delone dtm tile.laz --cell 1 --extent 500000,5400000,501000,5401000 -o dem.tif
  delone dtm later.laz --like dem.tif -o later.tif

Outputs by extension: tif (Cloud Optimized GeoTIFF), asc (ESRI), npy (float64, rows from north to south, NaN for no data) are the heights; png
is a hillshade; geojson, fgb and gpkg have contours, lines with their elevation. Cells begin at multiples of their size, or those from
--origin, around the points or --extent; --like takes the cells of another raster. Values are those of centers.
Of LAS and LAZ files ground (class 2) is taken unless --class or --all-classes says otherwise; a folder stands for all such files in it.
With --memory work is done in tiles on disk, beside the first output: the same values, bit for bit.

Exit status: 0 done, 1 bad data or failed work, 2 wrong usage.")]
pub(crate) struct DtmArgs {
    #[command(flatten)]
    pub(crate) input: InputArgs,
    /// Output files.
    #[arg(
        long, short, value_name = "OUT", required = true,
        help = format!(
            "Output file ({} png geojson fgb gpkg), or - for standard output; may be repeated",
            formats::written(&[Contents::Rasters])
        )
    )]
    pub(crate) output: Vec<PathBuf>,
    /// Format of outputs whose extension does not tell.
    #[arg(long, value_name = "FORMAT")]
    pub(crate) to: Option<Format>,
    /// The side of a cell, in coordinate units [default: about one point a cell].
    #[arg(
        long,
        value_name = "SIZE",
        allow_negative_numbers = true,
        conflicts_with = "like",
        help_heading = "Cells"
    )]
    pub(crate) cell: Option<f64>,
    #[command(flatten)]
    pub(crate) place: PlaceArgs,
    /// How heights between points come about.
    #[arg(long, value_name = "METHOD", default_value = "linear")]
    pub(crate) method: MethodName,
    /// Take the points of all classes of LAS and LAZ files, not ground alone.
    #[arg(long, conflicts_with = "class")]
    pub(crate) all_classes: bool,
    /// Which height counts where points have the same x and y.
    #[arg(long, value_name = "RULE", default_value = "lowest")]
    pub(crate) duplicates: DuplicatesName,
    #[command(flatten)]
    pub(crate) edges: EdgeArgs,
    /// Polygons around heights.
    #[arg(
        long, value_name = "FILE", help_heading = "Borders",
        help = format!(
            "Polygons outside of which there are no heights ({})",
            formats::read(Contents::Polygons)
        )
    )]
    pub(crate) clip: Option<PathBuf>,
    /// Lines that must be edges.
    #[arg(
        long, value_name = "FILE", help_heading = "Lines", conflicts_with = "memory",
        help = format!(
            "Lines that must be edges, with their own heights or, without, those of the surface below ({}); may be repeated",
            formats::read(Contents::Lines)
        )
    )]
    pub(crate) breaklines: Vec<PathBuf>,
    /// Polygons that are level, water say: at the one height that they have, or at the lowest of the surface along their border.
    #[arg(long, value_name = "FILE", help_heading = "Lines", conflicts_with = "memory")]
    pub(crate) flat: Vec<PathBuf>,
    /// The number for no data [default: -9999 in asc, NaN else].
    #[arg(long, value_name = "NUMBER", allow_negative_numbers = true)]
    pub(crate) nodata: Option<f64>,
    /// How GeoTIFF is compressed.
    #[arg(long, value_name = "HOW", default_value = "deflate")]
    pub(crate) compress: CompressName,
    #[command(flatten)]
    pub(crate) light: LightArgs,
    /// The distance of contours in height [default: about ten of them].
    #[arg(long, value_name = "HEIGHT", allow_negative_numbers = true)]
    pub(crate) interval: Option<f64>,
    /// Memory that may be taken, as in 500M or 4G, from 64M on; by default as much as there is.
    #[arg(long, value_name = "SIZE", value_parser = size)]
    pub(crate) memory: Option<u64>,
    /// Points of a tile at most, and bands of few rows: for tests of what only large sets would show.
    #[arg(long, value_name = "N", hide = true, requires = "memory")]
    pub(crate) tile: Option<usize>,
}

/// Values between points.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  delone interpolate stations.csv --value temperature --queries places.csv -o at-places.csv
  delone interpolate stations.csv --value temperature --value rain --queries places.npy --method natural -o values.npy
  delone interpolate stations.csv --value temperature --grid 100 -o temperature.tif
  delone interpolate stations.csv --value temperature --like dem.tif -o temperature.tif
  delone interpolate sites.csv --dim 3 --value grade --queries blocks.csv -o grades.csv

Of several values the answers are columns. Outside of the hull of the points there is NaN, unless --outside says otherwise: `nearest` goes
on with steps, `hull` without.
Exit status: 0 done, 1 bad data or failed work, 2 wrong usage.")]
pub(crate) struct InterpolateArgs {
    #[command(flatten)]
    pub(crate) input: InputArgs,
    #[command(flatten)]
    pub(crate) dim: DimArgs,
    /// A value at each point: a column of text by name or number from 1, or a file with one for each point (npy csv); may be repeated
    /// [default: the height, in the plane].
    #[arg(long, value_name = "COLUMN|FILE")]
    pub(crate) value: Vec<String>,
    /// File of places to interpolate at.
    #[arg(
        long, value_name = "FILE", required_unless_present_any = ["grid", "like"],
        conflicts_with_all = ["grid", "like", "extent", "origin"]
    )]
    pub(crate) queries: Option<PathBuf>,
    /// Interpolate at the centers of the cells of a raster, whose side this is.
    #[arg(
        long,
        value_name = "SIZE",
        allow_negative_numbers = true,
        conflicts_with = "like",
        help_heading = "Cells"
    )]
    pub(crate) grid: Option<f64>,
    #[command(flatten)]
    pub(crate) place: PlaceArgs,
    /// Which value a place has at which there are several points.
    #[arg(long, value_name = "RULE", default_value = "lowest")]
    pub(crate) duplicates: DuplicatesName,
    /// How values between points come about.
    #[arg(long, value_name = "METHOD", default_value = "natural")]
    pub(crate) method: MethodName,
    /// How GeoTIFF is compressed.
    #[arg(long, value_name = "HOW", default_value = "deflate")]
    pub(crate) compress: CompressName,
    /// Values outside of the hull.
    #[arg(long, value_name = "WHAT", default_value = "nothing")]
    pub(crate) outside: OutsideName,
    /// Output files.
    #[arg(
        long, short, value_name = "OUT",
        help = format!(
            "Output file, or - for standard output: npy for the values alone, {} for the places with their attributes too; of a raster {}",
            formats::written(&[Contents::Answers]), formats::written(&[Contents::Rasters])
        )
    )]
    pub(crate) output: PathBuf,
    /// Format of the output, if its extension does not tell.
    #[arg(long, value_name = "FORMAT")]
    pub(crate) to: Option<Format>,
}

/// The values outside of the hull.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum OutsideName {
    /// Nothing: NaN.
    Nothing,
    /// The value of the nearest point.
    Nearest,
    /// The value at the nearest place of the hull.
    Hull,
}
