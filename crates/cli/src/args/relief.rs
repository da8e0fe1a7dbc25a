//! Relief: hillshades, and how steep the ground is.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use delone_io::{Contents, Format, Light, Relief, ReliefKind};

use super::formats;
use super::surface::CompressName;

/// How the ground is lit.
#[derive(Debug, Args)]
pub(crate) struct LightArgs {
    /// Factor of heights before slopes are taken.
    #[arg(long, value_name = "FACTOR", default_value_t = 1.0, value_parser = factor, help_heading = "Hillshade")]
    pub(crate) z_factor: f64,
    /// Where the light comes from, in degrees clockwise from north.
    #[arg(long, value_name = "DEGREES", default_value_t = 315.0, value_parser = degrees, help_heading = "Hillshade")]
    pub(crate) azimuth: f64,
    /// How high the light is above the horizon, in degrees.
    #[arg(long, value_name = "DEGREES", default_value_t = 45.0, value_parser = degrees, help_heading = "Hillshade")]
    pub(crate) altitude: f64,
    /// Light from the south-west, the west, the north-west and the north at once.
    #[arg(long, conflicts_with = "azimuth", help_heading = "Hillshade")]
    pub(crate) multidirectional: bool,
}

impl LightArgs {
    /// A hillshade.
    pub(crate) fn hillshade(&self) -> Relief {
        let (azimuth, altitude) = (self.azimuth, self.altitude);
        let kind = if self.multidirectional {
            ReliefKind::Multidirectional { altitude }
        } else {
            ReliefKind::Hillshade(Light { azimuth, altitude })
        };
        Relief { kind, z_factor: self.z_factor }
    }
}

/// The kind of a relief.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum ReliefName {
    /// Shades from 1 to 255.
    Hillshade,
    /// Degrees between the ground and the horizon.
    Slope,
    /// Where the ground falls to, in degrees clockwise from north.
    Aspect,
}

/// Relief of a raster.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  delone relief dem.tif -o shade.tif -o shade.png
  delone relief dem.tif --multidirectional --z-factor 2 -o shade.tif
  delone relief dem.tif --kind slope -o slope.tif

Hillshades are bytes with 0 for no data, slopes and aspects numbers with -9999, as gdaldem has them; level ground has no aspect. Beside no
data and at the border a cell stands for its neighbors. Of longitude and latitude lengths are those on the ellipsoid, and heights metres
unless the system has others. Where the system names units of x and y and of heights, feet over metres say, slopes heed them; where it names no
unit of heights, these are in the unit of x and y. A png has a world file beside it.
Exit status: 0 done, 1 bad data or failed work, 2 wrong usage.")]
pub(crate) struct ReliefArgs {
    /// A raster of heights.
    #[arg(value_name = "IN", help = format!("Raster of heights: {}", formats::read(Contents::Rasters)))]
    pub(crate) input: PathBuf,
    /// Format of the input, if its extension does not tell.
    #[arg(long, value_name = "FORMAT")]
    pub(crate) from: Option<Format>,
    /// Output files.
    #[arg(
        long, short, value_name = "OUT", required = true,
        help = format!(
            "Output file ({}; png of hillshades), or - for standard output; may be repeated",
            formats::written(&[Contents::Rasters])
        )
    )]
    pub(crate) output: Vec<PathBuf>,
    /// Format of outputs whose extension does not tell.
    #[arg(long, value_name = "FORMAT")]
    pub(crate) to: Option<Format>,
    /// The kind of the output.
    #[arg(long, value_name = "KIND", default_value = "hillshade")]
    pub(crate) kind: ReliefName,
    #[command(flatten)]
    pub(crate) light: LightArgs,
    /// How GeoTIFF is compressed.
    #[arg(long, value_name = "HOW", default_value = "deflate")]
    pub(crate) compress: CompressName,
    /// Write what was counted and timed, and on how many threads at most, to a JSON file.
    #[arg(long, value_name = "FILE")]
    pub(crate) stats: Option<PathBuf>,
}

impl ReliefArgs {
    /// The relief of the library.
    pub(crate) fn relief(&self) -> Relief {
        let kind = match self.kind {
            ReliefName::Hillshade => return self.light.hillshade(),
            ReliefName::Slope => ReliefKind::Slope,
            ReliefName::Aspect => ReliefKind::Aspect,
        };
        Relief { kind, z_factor: self.light.z_factor }
    }
}

/// A positive number.
fn factor(text: &str) -> Result<f64, String> {
    let number = text.parse().ok().filter(|x: &f64| *x > 0.0 && x.is_finite());
    number.ok_or_else(|| "it is no positive number".to_owned())
}

/// An angle from 0 to 360 degrees.
fn degrees(text: &str) -> Result<f64, String> {
    let number = text.parse().ok().filter(|x: &f64| (0.0..=360.0).contains(x));
    number.ok_or_else(|| "it is no angle from 0 to 360 degrees".to_owned())
}
