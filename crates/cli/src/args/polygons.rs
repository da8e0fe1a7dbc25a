//! Arguments of `polygons`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use delone::RingFill;
use delone_io::{Contents, Format};

use super::formats;
use super::{AntimeridianName, CrossingsName, WktArgs, length};

/// Triangulate polygons.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  delone polygons buildings.geojson -o buildings.ply
  delone polygons lakes.geojson --fill shells-minus-holes --crossings split -o lakes.ply
  delone polygons countries.wkt --crossings split --keep-going -o triangles.npy --stats stats.json
  delone polygons a.geojson b.geojson -o both.geojson -o both.png

Each polygon is triangulated alone: the triangles of its inside, without its holes, are those of the constrained Delaunay
triangulation of its corners. Indices are those of all corners in the order of the files, without the last of each ring, which is the first
again; points that were added where sides cross follow. GeoJSON has the polygon of each triangle as property `polygon`, PLY
and VTK as its region.
Exit status: 0 done, 1 bad data or failed work, 2 wrong usage.")]
pub(crate) struct PolygonsArgs {
    /// Files of polygons.
    #[arg(
        value_name = "IN", required = true,
        help = format!(
            "Files of polygons ({}), or - for standard input. Several files are one list",
            formats::read(Contents::Polygons)
        )
    )]
    pub(crate) input: Vec<PathBuf>,
    /// Format of the input, if its extension does not tell.
    #[arg(long, value_name = "FORMAT")]
    pub(crate) from: Option<Format>,
    /// Output files.
    #[arg(long, short, value_name = "OUT", required = true, help = formats::outputs(&[Contents::Patches]))]
    pub(crate) output: Vec<PathBuf>,
    /// Format of outputs whose extension does not tell.
    #[arg(long, value_name = "FORMAT")]
    pub(crate) to: Option<Format>,
    #[command(flatten)]
    pub(crate) wkt: WktArgs,
    /// The rule for the inside of a polygon.
    #[arg(long, value_name = "RULE", default_value = "even-odd")]
    pub(crate) fill: PolygonFill,
    /// Join what nearly touches: points at most this far apart become one, and vertices at most this far from a side become part of it.
    #[arg(long, value_name = "DISTANCE", value_parser = length, allow_negative_numbers = true)]
    pub(crate) weld: Option<f64>,
    /// Treatment of polygons of longitude and latitude that cross the meridian of 180 degrees or hold a pole [default: keep].
    #[arg(long, value_name = "HOW")]
    pub(crate) antimeridian: Option<AntimeridianName>,
    /// Treatment of sides of a polygon that cross [default: refuse].
    #[arg(long, value_name = "HOW")]
    pub(crate) crossings: Option<CrossingsName>,
    /// Leave out polygons that are refused, and say which, instead of failing.
    #[arg(long)]
    pub(crate) keep_going: bool,
    /// The longer side of pictures in pixels.
    #[arg(long, value_name = "PIXELS", default_value_t = 1600, value_parser = clap::value_parser!(u32).range(16..=20_000))]
    pub(crate) size: u32,
    /// Write what was counted and timed, and on how many threads at most, to a JSON file.
    #[arg(long, value_name = "FILE")]
    pub(crate) stats: Option<PathBuf>,
}

impl PolygonFill {
    pub(crate) fn rule(self) -> RingFill {
        match self {
            Self::EvenOdd => RingFill::EvenOdd,
            Self::Nonzero => RingFill::NonZero,
            Self::Positive => RingFill::Positive,
            Self::Negative => RingFill::Negative,
            Self::ShellsMinusHoles => RingFill::ShellMinusHoles,
        }
    }
}

/// The rule for the inside of a polygon.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum PolygonFill {
    /// Places that an odd number of rings surrounds.
    EvenOdd,
    /// Places around which the rings wind, counter-clockwise less clockwise.
    Nonzero,
    /// Places around which they wind more often counter-clockwise.
    Positive,
    /// Places around which they wind more often clockwise.
    Negative,
    /// Places in the outer ring and in none of the holes, in whatever direction these are.
    ShellsMinusHoles,
}
