//! Colors of regions: each is told from all others by eyes of every kind, and hatching tells more of them apart.
//!
//! The colors are spread in CIELAB as wide as light colors can be, in the eyes of everyone: with three kinds of cones, and without
//! those of long, medium or short waves. Colors beside each other in the list are the furthest apart, since numbers of neighbors
//! often follow each other.

use super::color::{Rgb, shade};

/// Light enough for dark lines on them. Their least distance is 19.7, between colors beside each other in the list 32.
const REGION_COLORS: [Rgb; 10] = [
    [203, 125, 190],
    [112, 177, 112],
    [229, 216, 242],
    [112, 151, 255],
    [164, 151, 151],
    [190, 255, 164],
    [216, 138, 60],
    [177, 190, 255],
    [242, 216, 99],
    [125, 242, 190],
];

/// How many regions look different: a color, and none, one or both of two diagonals.
pub(super) const DISTINCT_REGIONS: usize = 4 * REGION_COLORS.len();
/// The distance of parallel lines of hatching along both axes, and their width, in pixels.
pub(super) const HATCH_STEP: u32 = 10;
pub(super) const HATCH_WIDTH: u32 = 2;
/// How dark lines of hatching are, as a part of the light of their region.
const HATCH_LIGHT: f64 = 0.62;

/// All of them.
pub(super) fn region_colors() -> &'static [Rgb] {
    &REGION_COLORS
}

/// Light colors, which come back after a while.
pub(super) fn region_color(number: usize) -> Rgb {
    REGION_COLORS[number % REGION_COLORS.len()]
}

/// The color of the lines of hatching on a region.
pub(super) fn hatch_color(number: usize) -> Rgb {
    shade(region_color(number), HATCH_LIGHT)
}

/// Whether a region has lines that go up to the right, and such that go down.
pub(super) fn hatching(number: usize) -> [bool; 2] {
    let round = number / REGION_COLORS.len();
    [round & 1 == 1, round & 2 == 2]
}

/// The color of a pixel of a region.
pub(super) fn region_pixel(number: usize, [x, y]: [usize; 2]) -> Rgb {
    let [x, y] = [x as u32 % HATCH_STEP, y as u32 % HATCH_STEP];
    let [up, down] = hatching(number);
    let is_line =
        up && (x + y) % HATCH_STEP < HATCH_WIDTH || down && (x + HATCH_STEP - y) % HATCH_STEP < HATCH_WIDTH;
    if is_line { hatch_color(number) } else { region_color(number) }
}

#[cfg(test)]
mod tests {
    use super::{DISTINCT_REGIONS, REGION_COLORS, hatching, region_color};
    use crate::picture::color::Rgb;

    /// The least distances in CIELAB of any two colors, and of two that follow each other.
    const LEAST_DISTANCES: [f64; 2] = [15.0, 30.0];

    type Matrix = [[f64; 3]; 3];

    /// Eyes of everyone, and those without cones of long, medium and short waves: Machado, Oliveira and Fernandes, A
    /// physiologically-based model for simulation of color vision deficiency, IEEE TVCG 15 (2009), the matrices of severity 1.
    const EYES: [Matrix; 4] = [
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        [
            [0.152_286, 1.052_583, -0.204_868],
            [0.114_503, 0.786_281, 0.099_216],
            [-0.003_882, -0.048_116, 1.051_998],
        ],
        [
            [0.367_322, 0.860_646, -0.227_968],
            [0.280_085, 0.672_501, 0.047_413],
            [-0.011_820, 0.042_940, 0.968_881],
        ],
        [
            [1.255_528, -0.076_749, -0.178_779],
            [-0.078_411, 0.930_809, 0.147_602],
            [0.004_733, 0.691_367, 0.303_900],
        ],
    ];

    /// From linear sRGB to XYZ, and the white of D65 (IEC 61966-2-1).
    const XYZ: Matrix = [[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]];
    const WHITE: [f64; 3] = [0.95047, 1.0, 1.08883];

    fn times(matrix: &Matrix, v: [f64; 3]) -> [f64; 3] {
        matrix.map(|row| (0..3).map(|k| row[k] * v[k]).sum())
    }

    /// A color in CIELAB, as some eyes see it.
    fn lab(color: Rgb, eyes: &Matrix) -> [f64; 3] {
        let linear = |part: u8| {
            let c = f64::from(part) / 255.0;
            if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
        };
        let seen = times(eyes, color.map(linear)).map(|part| part.clamp(0.0, 1.0));
        let xyz = times(&XYZ, seen);
        let f = [0, 1, 2].map(|k| {
            let part = xyz[k] / WHITE[k];
            if part > 216.0 / 24389.0 { part.cbrt() } else { 841.0 / 108.0 * part + 4.0 / 29.0 }
        });
        [116.0 * f[1] - 16.0, 500.0 * (f[0] - f[1]), 200.0 * (f[1] - f[2])]
    }

    fn distance(a: Rgb, b: Rgb, eyes: &Matrix) -> f64 {
        let (a, b) = (lab(a, eyes), lab(b, eyes));
        (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt()
    }

    #[test]
    fn regions_differ_in_the_eyes_of_everyone() {
        for (kind, eyes) in EYES.iter().enumerate() {
            for (i, &a) in REGION_COLORS.iter().enumerate() {
                for (j, &b) in REGION_COLORS.iter().enumerate().skip(i + 1) {
                    let is_next = j == i + 1 || (i, j) == (0, REGION_COLORS.len() - 1);
                    let apart = distance(a, b, eyes);
                    assert!(apart >= LEAST_DISTANCES[usize::from(is_next)], "{kind}: {a:?} {b:?} {apart}");
                }
                assert!(distance(a, [255; 3], eyes) > 10.0, "{a:?} is paper");
            }
        }
        // Two colors that were of one palette before.
        assert!(distance([252, 199, 198], [170, 221, 193], &EYES[2]) < 5.0);
    }

    #[test]
    fn looks_of_regions_are_their_own() {
        let looks: std::collections::BTreeSet<_> =
            (0..DISTINCT_REGIONS).map(|k| (region_color(k), hatching(k))).collect();
        assert_eq!(looks.len(), DISTINCT_REGIONS);
    }
}
