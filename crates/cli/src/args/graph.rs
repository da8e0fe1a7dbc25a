//! Arguments of commands with segments.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::{formats, length};

/// Segments, and what they mean.
#[derive(Clone, Debug, Default, Args)]
#[command(next_help_heading = "Segments")]
pub struct GraphArgs {
    /// Segments between the points.
    #[arg(long, value_name = "FILE", help = formats::segments())]
    pub(crate) segments: Option<PathBuf>,
    /// Join what nearly touches: points at most this far apart become one, and vertices at most this far from a segment become part of it.
    #[arg(long, value_name = "DISTANCE", value_parser = length, allow_negative_numbers = true)]
    pub(crate) weld: Option<f64>,
    /// Treatment of lines and polygons of longitude and latitude that cross the meridian of 180 degrees or hold a pole [default: keep].
    #[arg(long, value_name = "HOW")]
    pub(crate) antimeridian: Option<AntimeridianName>,
    /// Treatment of segments that cross [default: refuse].
    #[arg(long, value_name = "HOW")]
    pub(crate) crossings: Option<CrossingsName>,
    /// The rule for the inside [default: seeds for .poly, even-odd for polygons, all for lines]. Lines bound areas
    /// where there are no polygons.
    #[arg(long, value_name = "RULE")]
    pub(crate) fill: Option<FillName>,
    /// The polygon that has the attributes and the region of a place in several [default: last].
    #[arg(long, value_name = "WHICH")]
    pub(crate) overlaps: Option<OverlapsName>,
}

impl GraphArgs {
    /// Whether anything was asked for that needs segments.
    pub(crate) fn is_given(&self) -> bool {
        self.segments.is_some()
            || self.weld.is_some()
            || self.antimeridian == Some(AntimeridianName::Cut)
            || self.crossings.is_some()
            || self.fill.is_some()
            || self.overlaps.is_some()
    }
}

/// The treatment of what crosses the meridian of 180 degrees.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum AntimeridianName {
    /// Coordinates are taken as those of the plane: an edge from 179 to -179 goes around the world, which is told.
    Keep,
    /// Edges go the short way, and are cut there. Rings that go around a pole are closed along it.
    Cut,
}

/// The treatment of segments that cross.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum CrossingsName {
    /// It is an error, which names two segments and the place.
    Refuse,
    /// They are split there: points are added, which follow those of the input.
    Split,
}

/// The polygon that has a place which is in several.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum OverlapsName {
    /// The last one in the input.
    Last,
    /// The first one in the input.
    First,
    /// The one of the smallest area.
    Smallest,
    /// A region of its own for each set of polygons.
    Combined,
}

/// The rule for the inside.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum FillName {
    /// Places that an odd number of rings surrounds.
    EvenOdd,
    /// Places around which the rings wind, counter-clockwise less clockwise.
    Nonzero,
    /// Places around which they wind more often counter-clockwise.
    Positive,
    /// Places around which they wind more often clockwise.
    Negative,
    /// Places in the outer ring of a polygon and in none of its holes, in whatever direction these are.
    ShellsMinusHoles,
    /// Places that segments separate from the outside, without the holes of a .poly file.
    Seeds,
    /// Everything in the convex hull.
    All,
}
