//! Arguments of commands about heights: `contours`, `simplify`.

use std::path::PathBuf;

use clap::Args;
use delone_io::{Contents, Format};

use super::formats;
use super::{DuplicatesName, EdgeArgs, InputArgs, WktArgs, count};

/// Contours.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  delone contours tile.laz --class ground --interval 5 -o contours.geojson
  delone contours dem.tif --interval 10 --bands -o bands.geojson -o bands.png
  delone contours soundings.csv --levels -20,-10,-5 --max-edge 200 -o depths.geojson
  delone contours dem.tif --interval 2.5 --base 1 -o - --to geojson

Points with heights, or the cells of a raster (tif asc, and npy of shape (rows, columns)), are triangulated, and lines are drawn where
the triangles have a height: simple lines, closed or from border to border, with the higher ground on the left. A point exactly at a
height counts as above it. With --bands the areas between two heights are written, polygons that tile the triangles; pictures have bands
and lines then. GeoJSON has the property `elevation`, of bands `lower` and `upper`.
Exit status: 0 done, 1 bad data or failed work, 2 wrong usage.")]
pub(crate) struct ContoursArgs {
    #[command(flatten)]
    pub(crate) input: InputArgs,
    /// Output files.
    #[arg(long, short, value_name = "OUT", required = true, help = formats::outputs(&[Contents::Contours]))]
    pub(crate) output: Vec<PathBuf>,
    /// Format of outputs whose extension does not tell.
    #[arg(long, value_name = "FORMAT")]
    pub(crate) to: Option<Format>,
    /// Heights that are multiples of this.
    #[arg(
        long,
        value_name = "DZ",
        conflicts_with = "levels",
        required_unless_present = "levels",
        allow_negative_numbers = true
    )]
    pub(crate) interval: Option<f64>,
    /// A height that multiples of the interval are counted from [default: 0].
    #[arg(long, value_name = "Z", requires = "interval", allow_hyphen_values = true)]
    pub(crate) base: Option<f64>,
    /// These heights, separated by commas.
    #[arg(long, value_name = "Z", value_delimiter = ',', allow_hyphen_values = true)]
    pub(crate) levels: Vec<f64>,
    /// Which height a place has at which there are several points.
    #[arg(long, value_name = "RULE", default_value = "lowest")]
    pub(crate) duplicates: DuplicatesName,
    /// Write the areas between heights.
    #[arg(long)]
    pub(crate) bands: bool,
    #[command(flatten)]
    pub(crate) edges: EdgeArgs,
    /// The longer side of pictures in pixels.
    #[arg(long, value_name = "PIXELS", default_value_t = 1600, value_parser = clap::value_parser!(u32).range(16..=20_000))]
    pub(crate) size: u32,
}

/// Thinning.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  delone simplify dem.tif --max-error 0.2 -o terrain.ply
  delone simplify tile.laz --class ground --max-error 0.5 --max-edge 50 -o terrain.obj -o terrain.png
  delone simplify tile.laz --points 1e4 -o terrain.ply --stats stats.json
  delone simplify survey.csv --segments breaklines.csv --max-error 0.1 -o terrain.ply --kept kept.npy

Few of the points with heights (or of the cells of a raster: tif asc, and npy of shape (rows, columns)) are left, so that the triangles
of these are nowhere further from any other point than --max-error, in height: the corners of the hull first, then always the point that
is furthest away (Garland & Heckbert 1995); then points that later ones made superfluous are left out. All points are measured again in
the end. Segments of the input and of --segments stay edges. What is written has the points that are left alone, in the order of the input; --kept says which.
Exit status: 0 done, 1 bad data or failed work, 2 wrong usage.")]
pub(crate) struct SimplifyArgs {
    #[command(flatten)]
    pub(crate) input: InputArgs,
    /// Output files.
    #[arg(long, short, value_name = "OUT", required = true, help = formats::outputs(&[Contents::Triangles]))]
    pub(crate) output: Vec<PathBuf>,
    /// Format of outputs whose extension does not tell.
    #[arg(long, value_name = "FORMAT")]
    pub(crate) to: Option<Format>,
    #[command(flatten)]
    pub(crate) wkt: WktArgs,
    /// How far from the triangles any point may be, in height.
    #[arg(long, value_name = "DZ", required_unless_present = "points", allow_negative_numbers = true)]
    pub(crate) max_error: Option<f64>,
    /// The number of points to stop at.
    #[arg(long, value_name = "N", value_parser = count)]
    pub(crate) points: Option<usize>,
    /// Which height a place has at which there are several points.
    #[arg(long, value_name = "RULE", default_value = "lowest")]
    pub(crate) duplicates: DuplicatesName,
    /// Segments between the points.
    #[arg(long, value_name = "FILE", help = formats::segments())]
    pub(crate) segments: Option<PathBuf>,
    /// Write the indices of the points that are left, of rasters among the cells with data, row by row (npy csv).
    #[arg(long, value_name = "FILE")]
    pub(crate) kept: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) edges: EdgeArgs,
}
