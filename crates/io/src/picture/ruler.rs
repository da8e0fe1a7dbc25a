//! How long things are: units of pictures, and the shape of what is given in degrees.

use crate::Crs;

/// Metres of a degree of latitude, on the sphere of the mean radius of the Earth (6,371,008.8 m: IUGG, GRS 80).
const DEGREE_METRES: f64 = 6_371_008.8 * std::f64::consts::PI / 180.0;
/// Maps of the poles alone would have no width.
const LEAST_COSINE: f64 = 0.01;
/// Longitudes may go around twice, where none of them jumps.
const LONGITUDE_RANGE: f64 = 720.0;
const LATITUDE_RANGE: f64 = 90.0;

/// The unit of coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Ruler {
    /// Nobody tells.
    Unknown,
    /// A unit is as many metres.
    Metres(f64),
    /// Longitude and latitude.
    Degrees,
}

impl Ruler {
    pub(super) fn of(crs: Option<&Crs>) -> Self {
        let Some(crs) = crs else { return Self::Unknown };
        if crs.is_degrees() { Self::Degrees } else { crs.metres().map_or(Self::Unknown, Self::Metres) }
    }

    /// The ruler of what is between these corners: no degrees are beyond the poles.
    pub(super) fn within(self, low: [f64; 2], high: [f64; 2]) -> Self {
        let ranges = [LONGITUDE_RANGE, LATITUDE_RANGE];
        let is_on_earth = (0..2).all(|k| low[k] >= -ranges[k] && high[k] <= ranges[k]);
        if self == Self::Degrees && !is_on_earth { Self::Unknown } else { self }
    }

    /// The width of a unit of x, as a part of the height of a unit of y: of degrees that at the middle latitude.
    pub(super) fn squeeze(self, low: [f64; 2], high: [f64; 2]) -> f64 {
        match self {
            Self::Degrees => libm::cos(f64::midpoint(low[1], high[1]).to_radians()).max(LEAST_COSINE),
            _ => 1.0,
        }
    }

    /// The metres of a unit of y, where they are known.
    pub(super) fn metres(self) -> Option<f64> {
        match self {
            Self::Unknown => None,
            Self::Metres(metres) => Some(metres),
            Self::Degrees => Some(DEGREE_METRES),
        }
    }
}

/// The unit of heights, as far as the system of coordinates tells.
pub(super) fn height_unit(crs: Option<&Crs>) -> &'static str {
    match crs.and_then(Crs::metres_of_heights) {
        Some(1.0) => " m",
        Some(metres) if (0.30..0.31).contains(&metres) => " ft",
        _ => "",
    }
}

/// A number for a label: few digits, an exponent only where it is needed.
pub(super) struct Short(pub(super) f64);

impl std::fmt::Display for Short {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let magnitude = self.0.abs();
        if magnitude != 0.0 && !(1e-3..1e6).contains(&magnitude) {
            let text = format!("{:.1e}", self.0);
            return f.write_str(&text.replace(".0e", "e"));
        }
        let digits = if magnitude >= 100.0 {
            0
        } else if magnitude >= 1.0 {
            1
        } else {
            4
        };
        let text = format!("{:.digits$}", self.0);
        f.write_str(if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text })
    }
}

/// A length of a scale bar with its unit: metres, or kilometres from a thousand of them.
pub(super) fn length_label(length: f64, is_metres: bool) -> String {
    match (is_metres, length) {
        (false, 1.0) => "1 unit".to_owned(),
        (false, length) => format!("{} units", Short(length)),
        (true, length) if length >= 1000.0 => format!("{} km", Short(length / 1000.0)),
        (true, length) => format!("{} m", Short(length)),
    }
}
