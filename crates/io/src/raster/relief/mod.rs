//! Relief: what a raster of heights looks like or how steep it is, as another raster.
//!
//! Source: Horn, "Hill shading and the reflectance map", Proc. IEEE 69 (1981), for the slopes: weighted differences of the eight cells
//! around. Beside no data and at the border the cell itself stands for its neighbor. Elsewhere numbers are those of `gdaldem`, but for aspects
//! of cells that are not square, which heed both sides here.
//!
//! Memory: three rows. Cost: O(cells).

mod png;
mod scale;

use delone::surface::Grid;
use delone_predicates::hypotenuse;

use crate::Crs;
use scale::Scale;

pub use png::ShadeWriter;

/// Where the light is, in degrees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    /// Clockwise from north.
    pub azimuth: f64,
    /// Above the horizon.
    pub altitude: f64,
}

impl Default for Light {
    /// In the north-west, as is usual on maps.
    fn default() -> Self {
        Self { azimuth: 315.0, altitude: 45.0 }
    }
}

/// The kind of a relief.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum ReliefKind {
    /// Shades from 1 to 255 of ground that is lit from one side.
    Hillshade(Light),
    /// Shades of ground that is lit from the south-west, the west, the north-west and the north at once (after Mark, "Multidirectional,
    /// oblique-weighted, shaded-relief image", USGS Open-File Report 92-422, 1992). Weights are those of `gdaldem`: the squared cosine of
    /// the angle between where the ground falls to and where a light is.
    Multidirectional {
        /// The height of the lights above the horizon, in degrees.
        altitude: f64,
    },
    /// Degrees between the ground and the horizon.
    Slope,
    /// Where the ground falls to, in degrees clockwise from north; nothing where it is level.
    Aspect,
}

/// A relief of heights, and how heights are stretched before.
///
/// ```
/// use delone::surface::Grid;
/// use delone_io::{Relief, ReliefKind};
///
/// // A ramp that falls to the west by one in one.
/// let grid = Grid::new([0.0, 2.0], [1.0, -1.0], 3, 2)?;
/// let mut slopes = Relief::new(ReliefKind::Slope).rows(&grid, None);
/// let mut rows = Vec::new();
/// rows.extend(slopes.next(&[0.0, 1.0, 2.0]));
/// rows.extend(slopes.next(&[0.0, 1.0, 2.0]));
/// rows.extend(slopes.last());
/// assert_eq!((rows.len(), rows[0][1]), (2, 45.0));
/// # Ok::<(), delone::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Relief {
    /// The kind.
    pub kind: ReliefKind,
    /// The factor of heights.
    pub z_factor: f64,
}

impl Default for Relief {
    /// A hillshade of heights as they are, lit as is usual on maps.
    fn default() -> Self {
        Self::new(ReliefKind::Hillshade(Light::default()))
    }
}

impl Relief {
    /// Heights as they are.
    pub fn new(kind: ReliefKind) -> Self {
        Self { kind, z_factor: 1.0 }
    }

    /// Begins with the first row of a raster. Its system says what units are: degrees are lengths on the ellipsoid, and where it names units
    /// of lengths and of heights these may differ. Else heights are in the units of x and y, and in metres over degrees.
    pub fn rows(self, grid: &Grid, crs: Option<&Crs>) -> ReliefRows {
        let scale = Scale::of(grid, crs, self.z_factor);
        ReliefRows { shader: Shader::of(self.kind), scale, number: 0, above: None, row: None }
    }
}

/// Rows of heights become rows of relief, one row later.
#[derive(Debug)]
pub struct ReliefRows {
    shader: Shader,
    scale: Scale,
    /// The number of the next row that is made.
    number: usize,
    /// That row, and the one above it.
    above: Option<Vec<f64>>,
    row: Option<Vec<f64>>,
}

impl ReliefRows {
    /// Takes the next row of heights, all of which have one length, and gives the relief of the row before.
    pub fn next(&mut self, below: &[f64]) -> Option<Vec<f64>> {
        let row = self.row.replace(below.to_vec())?;
        let made = self.make(&row, below);
        self.above = Some(row);
        Some(made)
    }

    /// The relief of the last row.
    pub fn last(&mut self) -> Option<Vec<f64>> {
        let row = self.row.take()?;
        Some(self.make(&row, &row))
    }

    fn make(&mut self, row: &[f64], below: &[f64]) -> Vec<f64> {
        let above = self.above.as_deref().unwrap_or(row);
        let steps = self.scale.steps(self.number);
        self.number += 1;
        let last = row.len().saturating_sub(1);
        let at = |(k, &height): (usize, &f64)| {
            if height.is_nan() {
                return f64::NAN;
            }
            let around = [k.saturating_sub(1), k, (k + 1).min(last)];
            let [north, level, south] =
                [above, row, below].map(|row| around.map(|k| if row[k].is_nan() { height } else { row[k] }));
            let east = (north[2] + 2.0 * level[2] + south[2]) - (north[0] + 2.0 * level[0] + south[0]);
            let down = (south[0] + 2.0 * south[1] + south[2]) - (north[0] + 2.0 * north[1] + north[2]);
            self.shader.value([east / (8.0 * steps[0]), down / (8.0 * steps[1])])
        };
        row.iter().enumerate().map(at).collect()
    }
}

/// Where the lights of multidirectional shades are, in degrees clockwise from north.
const AROUND: [f64; 4] = [225.0, 270.0, 315.0, 360.0];

/// The value of a cell by its slopes.
#[derive(Clone, Copy, Debug)]
enum Shader {
    /// The direction of a light.
    One([f64; 3]),
    /// The directions of four lights.
    Four([[f64; 3]; 4]),
    Slope,
    Aspect,
}

impl Shader {
    fn of(kind: ReliefKind) -> Self {
        let towards = |azimuth: f64, altitude: f64| {
            let [azimuth, altitude] = [azimuth, altitude].map(f64::to_radians);
            [
                libm::sin(azimuth) * libm::cos(altitude),
                libm::cos(azimuth) * libm::cos(altitude),
                libm::sin(altitude),
            ]
        };
        match kind {
            ReliefKind::Hillshade(light) => Self::One(towards(light.azimuth, light.altitude)),
            ReliefKind::Multidirectional { altitude } => {
                Self::Four(AROUND.map(|azimuth| towards(azimuth, altitude)))
            }
            ReliefKind::Slope => Self::Slope,
            ReliefKind::Aspect => Self::Aspect,
        }
    }

    /// The value of a cell, by how much it rises to the east and to the north.
    fn value(&self, [east, north]: [f64; 2]) -> f64 {
        let normal = [-east, -north, 1.0];
        let length = normal.iter().map(|x| x * x).sum::<f64>().sqrt();
        let bright = |light: &[f64; 3]| {
            (normal.iter().zip(light).map(|(a, b)| a * b).sum::<f64>() / length).clamp(0.0, 1.0)
        };
        let steep = hypotenuse(east, north);
        match self {
            Self::One(light) => 1.0 + 254.0 * bright(light),
            Self::Four(lights) if steep == 0.0 => 1.0 + 254.0 * bright(&lights[0]),
            Self::Four(lights) => {
                let weight = |azimuth: &f64| {
                    let (sine, cosine) = libm::sincos(azimuth.to_radians());
                    ((east * sine + north * cosine) / steep).powi(2)
                };
                1.0 + 127.0
                    * AROUND
                        .iter()
                        .zip(lights)
                        .map(|(azimuth, light)| weight(azimuth) * bright(light))
                        .sum::<f64>()
            }
            Self::Slope => libm::atan(steep).to_degrees(),
            Self::Aspect if steep == 0.0 => f64::NAN,
            Self::Aspect => {
                let degrees = libm::atan2(-east, -north).to_degrees();
                if degrees < 0.0 { degrees + 360.0 } else { degrees }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Light, Relief, ReliefKind};
    use crate::raster::placed;

    /// The value in the middle of nine heights in cells of size two.
    fn middle(kind: ReliefKind, z_factor: f64, heights: &[f64; 9]) -> f64 {
        let grid = placed([0.0, 6.0], [2.0, -2.0], 3, 3).expect("a raster");
        let mut rows = Relief { kind, z_factor }.rows(&grid, None);
        let mut made: Vec<Vec<f64>> = heights.chunks(3).filter_map(|row| rows.next(row)).collect();
        made.extend(rows.last());
        assert_eq!(made.len(), 3);
        made[1][1]
    }

    fn is_near(a: f64, b: f64) -> bool {
        (a - b).abs() < 1e-9
    }

    #[test]
    fn slopes_are_those_of_the_formula() {
        let heights = [1.0, 2.0, 5.0, 2.0, 4.0, 9.0, 3.0, 7.0, 8.0];
        // Horn: to the east 5 + 18 + 8 less 1 + 4 + 3, to the south 3 + 14 + 8 less 1 + 4 + 5, each over 16.
        let (east, south) = (23.0 / 16.0, 15.0 / 16.0);
        let slope = f64::hypot(east, south).atan().to_degrees();
        assert!(is_near(middle(ReliefKind::Slope, 1.0, &heights), slope));
        // It falls to the west and the north.
        let aspect = 270.0 + (south / east).atan().to_degrees();
        assert!(is_near(middle(ReliefKind::Aspect, 1.0, &heights), aspect));
        let half = std::f64::consts::FRAC_1_SQRT_2;
        let length = (1.0 + east * east + south * south).sqrt();
        // From the north-west, 45 degrees high.
        let bright = (half + 0.5 * (east + south)) / length;
        let shade = middle(ReliefKind::Hillshade(Light::default()), 1.0, &heights);
        assert!(is_near(shade, 1.0 + 254.0 * bright));
        let stretched = middle(ReliefKind::Slope, 2.0, &heights);
        assert!(is_near(stretched, f64::hypot(2.0 * east, 2.0 * south).atan().to_degrees()));
    }

    #[test]
    fn four_lights_are_weighted() {
        // A ramp that falls to the west by one in one: half of the light of the west, a quarter each of its neighbors.
        let ramp = [0.0, 2.0, 4.0, 0.0, 2.0, 4.0, 0.0, 2.0, 4.0];
        let half = std::f64::consts::FRAC_1_SQRT_2;
        let [west, beside] = [half + half, half + 0.5].map(|sum| sum * half);
        let shade = middle(ReliefKind::Multidirectional { altitude: 45.0 }, 1.0, &ramp);
        assert!(is_near(shade, 1.0 + 127.0 * (west.min(1.0) + 0.5 * beside + 0.5 * beside)));
        let level = middle(ReliefKind::Multidirectional { altitude: 45.0 }, 1.0, &[3.0; 9]);
        assert!(is_near(level, 1.0 + 254.0 * half));
        assert!(middle(ReliefKind::Aspect, 1.0, &[3.0; 9]).is_nan());
    }

    #[test]
    fn beside_no_data_the_cell_stands_for_its_neighbors() {
        let nothing = f64::NAN;
        let alone = [nothing, nothing, nothing, nothing, 3.0, nothing, nothing, nothing, nothing];
        assert!(is_near(middle(ReliefKind::Slope, 1.0, &alone), 0.0));
        let mut heights = [1.0; 9];
        heights[4] = nothing;
        assert!(middle(ReliefKind::Slope, 1.0, &heights).is_nan());
    }
}
