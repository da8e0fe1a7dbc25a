//! How long the steps of a raster are, in units of its heights.
//!
//! A degree of latitude and of longitude on the ellipsoid of WGS 84 (Snyder, "Map projections: a working manual", USGS Professional Paper
//! 1395, 1987, equations 4-19 and 4-21, with 4-20 for the radius), for the middle of each row. Other ellipsoids in use differ by less than one
//! in a thousand; over a row of half a degree the length of a degree of longitude changes by less than two in a hundred below 65 degrees of
//! latitude.

use delone::surface::Grid;

use crate::Crs;

/// The larger half axis in metres and the squared eccentricity of WGS 84.
const AXIS: f64 = 6_378_137.0;
const ECCENTRICITY: f64 = 0.006_694_379_990_14;

/// Steps in units of heights, row by row.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scale {
    grid: Grid,
    is_degrees: bool,
    /// Units of heights for each metre, or for each unit of x and y.
    factor: f64,
}

impl Scale {
    /// The steps of a raster whose heights are multiplied by a factor.
    pub(super) fn of(grid: &Grid, crs: Option<&Crs>, z_factor: f64) -> Self {
        let is_degrees = crs.is_some_and(Crs::is_degrees);
        let lengths = if is_degrees { Some(1.0) } else { crs.and_then(Crs::metres) };
        let heights = crs.and_then(Crs::metres_of_heights).or(is_degrees.then_some(1.0));
        let ratio = lengths.zip(heights).map_or(1.0, |(lengths, heights)| lengths / heights);
        Self { grid: *grid, is_degrees, factor: ratio / z_factor }
    }

    /// The steps to the east and to the next row.
    pub(super) fn steps(&self, row: usize) -> [f64; 2] {
        let [east, down] = self.grid.step().map(|step| step * self.factor);
        if !self.is_degrees {
            return [east, down];
        }
        let [longitude, latitude] = degree(self.grid.y(row));
        [east * longitude, down * latitude]
    }
}

/// The metres of a degree of longitude and of one of latitude.
fn degree(latitude: f64) -> [f64; 2] {
    let (sine, cosine) = libm::sincos(latitude.clamp(-90.0, 90.0).to_radians());
    let part = 1.0 - ECCENTRICITY * sine * sine;
    [AXIS * cosine / part.sqrt(), AXIS * (1.0 - ECCENTRICITY) / (part * part.sqrt())].map(f64::to_radians)
}

#[cfg(test)]
mod tests {
    use super::{Scale, degree};
    use crate::Crs;
    use crate::raster::placed;

    #[test]
    fn degrees_have_their_lengths() {
        // Snyder's table 9 is of the ellipsoid of Clarke; these are of WGS 84 (NGA.STND.0036, version 1.0.0, and any geodesic solver).
        for (latitude, longitude, of_latitude) in
            [(0.0, 111_319.491, 110_574.276), (45.0, 78_846.835, 111_131.778), (60.0, 55_800.0, 111_412.24)]
        {
            let found = degree(latitude);
            assert!((found[0] - longitude).abs() < 0.6 && (found[1] - of_latitude).abs() < 0.6, "{found:?}");
        }
        assert!(degree(90.0)[0].abs() < 1e-9 && degree(95.0)[0].abs() < 1e-9);
    }

    #[test]
    fn units_are_those_of_the_system() {
        let grid = placed([10.0, 45.5], [0.5, -1.0], 2, 1).expect("a raster");
        let steps = |crs: Option<&Crs>, factor| Scale::of(&grid, crs, factor).steps(0);
        assert_eq!(steps(None, 2.0), [0.25, -0.5]);
        let feet = Crs::of_epsg(2992);
        assert_eq!(steps(Some(&feet), 1.0), [0.5, -1.0]);
        let metres_above = Crs { vertical: Some(5703), ..feet.clone() };
        assert_eq!(steps(Some(&metres_above), 1.0), [0.5 * 0.3048, -0.3048]);
        let feet_above = Crs { vertical: Some(6360), ..feet };
        assert_eq!(steps(Some(&feet_above), 1.0), [0.5, -1.0]);
        let [east, down] = steps(Some(&Crs::of_epsg(4326)), 1.0);
        let [longitude, latitude] = degree(45.0);
        assert_eq!([east, down], [0.5 * longitude, -latitude]);
        let [east, _] = steps(Some(&Crs { vertical: Some(6360), ..Crs::of_epsg(4326) }), 1.0);
        assert!((east * 0.3048 - 0.5 * longitude).abs() < 1e-6);
    }
}
