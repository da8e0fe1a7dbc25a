//! Colors and ramps.

/// Red, green, blue.
pub(super) type Rgb = [u8; 3];

pub(super) const PAPER: Rgb = [255, 255, 255];
pub(super) const INK: Rgb = [38, 50, 56];
pub(super) const EDGE: Rgb = [96, 125, 139];
pub(super) const FAINT: Rgb = [207, 216, 220];
pub(super) const HULL: Rgb = [216, 67, 21];
pub(super) const POINT: Rgb = [26, 35, 126];
pub(super) const DISK: Rgb = [187, 222, 251];
pub(super) const LINK: Rgb = [46, 125, 50];
pub(super) const CONSTRAINT: Rgb = [33, 33, 33];

/// Equally spaced colors, interpolated.
pub(super) struct Ramp(&'static [Rgb]);

/// Heights: valley green over ochre to snow.
pub(super) const HEIGHT: Ramp = Ramp(&[
    [46, 105, 88],
    [104, 154, 96],
    [170, 190, 120],
    [226, 214, 156],
    [205, 165, 108],
    [164, 118, 82],
    [150, 122, 110],
    [244, 242, 238],
]);

/// Densities: from sparse (light) to dense (dark), readable without color vision.
pub(super) const DENSITY: Ramp =
    Ramp(&[[247, 244, 220], [199, 226, 180], [127, 196, 187], [65, 153, 192], [44, 97, 170], [30, 45, 110]]);

/// Smallest angles: from small (dark) to those of equilateral triangles (light), readable without color vision.
pub(super) const ANGLE: Ramp =
    Ramp(&[[60, 10, 40], [150, 30, 70], [214, 84, 66], [243, 153, 73], [250, 214, 130], [252, 248, 220]]);

impl Ramp {
    /// Its colors.
    pub(super) fn colors(&self) -> &'static [Rgb] {
        self.0
    }

    /// The color at `t` from 0 to 1.
    pub(super) fn at(&self, t: f64) -> Rgb {
        let last = self.0.len() - 1;
        let position = if t > 0.0 { t.min(1.0) * last as f64 } else { 0.0 };
        let k = (position as usize).min(last - 1);
        mix(self.0[k], self.0[k + 1], position - k as f64)
    }
}

/// How dense what has these areas is, by the logarithms of their ratios: so it is the same in all units.
pub(super) struct Density {
    low: f64,
    /// The logarithms, over `low`, between which colors change.
    range: [f64; 2],
}

impl Density {
    /// Between two areas. Even areas are to look even, and those that differ by rounding alike: all colors are a factor of four.
    pub(super) fn between(low: f64, high: f64) -> Self {
        let low = low.max(f64::MIN_POSITIVE);
        let span = ratio(high, low);
        let widen = (libm::log(4.0) - span).max(0.0) / 2.0;
        Self { low, range: [-widen, span + widen] }
    }

    /// From 0, sparse, to 1, dense.
    pub(super) fn of(&self, area: f64) -> f64 {
        let [from, to] = self.range;
        (1.0 - (ratio(area, self.low) - from) / (to - from)).clamp(0.0, 1.0)
    }
}

/// The logarithm of a ratio, whatever numbers there are.
fn ratio(area: f64, low: f64) -> f64 {
    libm::log((area / low).clamp(f64::MIN_POSITIVE, f64::MAX))
}

/// From `a` to `b`.
pub(super) fn mix(a: Rgb, b: Rgb, t: f64) -> Rgb {
    [0, 1, 2].map(|i| (f64::from(a[i]) * (1.0 - t) + f64::from(b[i]) * t).round() as u8)
}

/// Darker below 1, lighter above.
pub(super) fn shade(color: Rgb, light: f64) -> Rgb {
    if light <= 1.0 {
        mix([16, 24, 32], color, light.max(0.0))
    } else {
        mix(color, PAPER, (light - 1.0).min(1.0))
    }
}
