//! Contours: lines and bands of heights, as features or as a picture.
//!
//! Cost: linear in the points.

use std::io::Write;

use delone::surface::{ContourBand, ContourLine};

use crate::{Contents, Crs, Direction, Error, Format, formats, picture};

/// Lines or bands to be written, or both.
///
/// ```
/// use delone::Delaunay2;
/// use delone::surface::{Contours, Levels};
/// use delone_io::{ContourMap, Format, write_contours};
///
/// let d = Delaunay2::from_points(&[[0.0, 0.0], [4.0, 0.0], [0.0, 4.0]])?;
/// let lines = Contours::new(&d, &[0.0, 4.0, 0.0])?.lines(&Levels::given(&[1.0])?)?;
/// let mut file = Vec::new();
/// write_contours(&mut file, Format::GeoJson, &ContourMap { lines: &lines, ..ContourMap::default() }, 800)?;
/// assert!(String::from_utf8(file)?.contains(r#""properties":{"elevation":1.0}"#));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, Default)]
pub struct ContourMap<'a> {
    /// The lines.
    pub lines: &'a [ContourLine],
    /// The bands, drawn below the lines.
    pub bands: &'a [ContourBand],
    /// The system of coordinates.
    pub crs: Option<&'a Crs>,
}

impl ContourMap<'_> {
    /// All points.
    pub(crate) fn points(&self) -> impl Iterator<Item = [f64; 2]> + '_ {
        let rings = self.bands.iter().flat_map(|band| band.polygons.iter().flatten().flatten());
        self.lines.iter().flat_map(|line| &line.points).chain(rings).copied()
    }

    /// The least and the largest finite height.
    pub(crate) fn range(&self) -> [f64; 2] {
        let bounds = self.bands.iter().flat_map(|band| [band.lower, band.upper]);
        let heights = self.lines.iter().map(|line| line.level).chain(bounds).filter(|z| z.is_finite());
        heights.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], z| [low.min(z), high.max(z)])
    }
}

/// Writes contours: as GeoJSON, FlatGeobuf or GeoPackage, a feature for each line with the property `elevation` and one for each band with `lower` and `upper`
/// (null where there is no bound), or as a picture whose longer side has `size` pixels.
///
/// # Errors
/// [`Error::Unsupported`] for other formats, and those of the output.
pub fn write_contours(
    out: &mut dyn Write,
    format: Format,
    map: &ContourMap<'_>,
    size: u32,
) -> Result<(), Error> {
    format.check(Contents::Contours, Direction::Written)?;
    match format {
        Format::GeoJson => Ok(formats::geojson::write_contours(out, map)?),
        Format::FlatGeobuf | Format::GeoPackage => formats::vector::write(out, format, map),
        _ => picture::write_contours(out, format, map, size),
    }
}
