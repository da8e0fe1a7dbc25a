//! Colors of triangles: by region, shaded height, density, or smallest angle.

use delone::Triangulation;

use super::color::{ANGLE, DENSITY, Density, HEIGHT, Ramp, Rgb, shade};
use super::palette::{region_color, region_pixel};
use crate::{Mesh, Shape};

/// The direction of the light: from the north-west, 45 degrees up.
const LIGHT: [f64; 3] = [-0.5, 0.5, std::f64::consts::FRAC_1_SQRT_2];

/// The colors of a surface's triangles.
pub(super) enum Paint<'a> {
    Relief(Relief<'a>),
    /// By the area.
    Density(Density),
    /// By the number of the region of each triangle, among the known values in their order.
    Regions {
        numbers: Vec<usize>,
        known: Vec<f64>,
    },
    /// By the smallest angle of each triangle, as a part of 60 degrees.
    Angles(Vec<f64>),
}

/// Height colors and light at each point.
pub(super) struct Relief<'a> {
    heights: &'a [f64],
    /// The brightness at each point, 1 for flat ground.
    light: Vec<f64>,
    pub(super) low: f64,
    pub(super) high: f64,
}

impl<'a> Paint<'a> {
    pub(super) fn of(mesh: &'a Mesh<impl Triangulation<Point = [f64; 2]>>, angles: bool) -> Self {
        if angles {
            let share = |triangle: [usize; 3]| smallest_angle(triangle.map(|i| mesh.points[i])) / 60.0;
            return Self::Angles(mesh.triangles().map(share).collect());
        }
        if let Some(regions) = mesh.region_values() {
            return Self::regions(regions.collect());
        }
        match mesh.heights {
            Some(heights) if !heights.is_empty() => Self::Relief(Relief::of(mesh, heights)),
            _ => Self::density(mesh),
        }
    }

    fn density(mesh: &Mesh<impl Triangulation<Point = [f64; 2]>>) -> Self {
        let areas = mesh.triangles().map(|triangle| area(triangle.map(|i| mesh.points[i])));
        let mut areas: Vec<f64> = areas.filter(|area| *area > 0.0 && area.is_finite()).collect();
        let (low, high) = spread(&mut areas);
        Self::Density(Density::between(low, high))
    }

    /// Regions in the order of their values.
    fn regions(values: Vec<f64>) -> Self {
        let mut known = values.clone();
        known.sort_unstable_by(f64::total_cmp);
        known.dedup_by(|a, b| a.total_cmp(b).is_eq());
        let number = |value: &f64| known.binary_search_by(|other| other.total_cmp(value)).unwrap_or_default();
        Self::Regions { numbers: values.iter().map(number).collect(), known }
    }

    /// The colors, if there is an order.
    fn ramp(&self) -> Option<&'static Ramp> {
        match self {
            Self::Relief(_) => Some(&HEIGHT),
            Self::Density(_) => Some(&DENSITY),
            Self::Regions { .. } => None,
            Self::Angles(_) => Some(&ANGLE),
        }
    }

    /// Color and light at the corners of triangle `i`, of `area`: the value on the ramp or the number of the region, and
    /// the brightness.
    pub(super) fn corners(&self, i: usize, triangle: [usize; 3], area: f64) -> [[f64; 2]; 3] {
        match self {
            Self::Regions { numbers, .. } => [[numbers[i] as f64, 1.0]; 3],
            Self::Angles(shares) => [[shares[i], 1.0]; 3],
            Self::Relief(relief) => triangle.map(|i| [relief.value(i), relief.light[i]]),
            Self::Density(density) => [[density.of(area), 1.0]; 3],
        }
    }

    /// The color of a value and a brightness.
    pub(super) fn color(&self, [value, light]: [f64; 2]) -> Rgb {
        // The mean of equal numbers may be off by a little.
        self.ramp().map_or_else(|| region_color(value.round() as usize), |ramp| shade(ramp.at(value), light))
    }

    /// The color of a pixel, which may be one of hatching.
    pub(super) fn pixel(&self, value: [f64; 2], at: [usize; 2]) -> Rgb {
        match self {
            Self::Regions { .. } => region_pixel(value[0].round() as usize, at),
            _ => self.color(value),
        }
    }

    /// The number of a region, where colors are those of regions.
    pub(super) fn region(&self, value: f64) -> Option<usize> {
        matches!(self, Self::Regions { .. }).then(|| value.round() as usize)
    }
}

impl<'a> Relief<'a> {
    fn of(mesh: &Mesh<impl Triangulation<Point = [f64; 2]>>, heights: &'a [f64]) -> Self {
        let mut sorted: Vec<f64> = heights.iter().copied().filter(|z| z.is_finite()).collect();
        let (low, high) = spread(&mut sorted);
        Self { heights, light: light(mesh), low, high }
    }

    fn value(&self, i: usize) -> f64 {
        fraction(self.heights[i], self.low, self.high)
    }
}

/// The area of a triangle: infinite if it is too large for an `f64`, and never NaN.
pub(super) fn area(corners: [[f64; 2]; 3]) -> f64 {
    let of = |[a, b, c]: [[f64; 2]; 3]| ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2.0;
    let area = of(corners);
    if area.is_finite() {
        return area;
    }
    // Products that overflow may cancel: large coordinates are made small, axis by axis, and the area large again.
    let is_large = |axis: usize| corners.iter().any(|p| p[axis].abs() > 2f64.powi(500));
    let [x, y] = [0, 1].map(|axis| if is_large(axis) { 2f64.powi(-520) } else { 1.0 });
    of(corners.map(|p| [p[0] * x, p[1] * y])) / x / y
}

/// The smallest angle of a triangle in degrees, rounded.
fn smallest_angle([a, b, c]: [[f64; 2]; 3]) -> f64 {
    let at = |[p, q, r]: [[f64; 2]; 3]| {
        // Halves of coordinates, so that differences are numbers; the longer coordinate is 1, so that products are.
        let toward = |q: [f64; 2]| [0, 1].map(|k| q[k] / 2.0 - p[k] / 2.0);
        let unit = |u: [f64; 2]| {
            let longer = u[0].abs().max(u[1].abs());
            u.map(|x| x / longer)
        };
        let (u, v) = (unit(toward(q)), unit(toward(r)));
        libm::atan2(u[0] * v[1] - u[1] * v[0], u[0] * v[0] + u[1] * v[1])
    };
    let smallest = [[a, b, c], [b, c, a], [c, a, b]].map(at).into_iter().fold(f64::INFINITY, f64::min);
    if smallest.is_finite() { smallest.to_degrees().max(0.0) } else { 0.0 }
}

/// Where a value lies between two others, 0.5 if these are equal.
fn fraction(value: f64, low: f64, high: f64) -> f64 {
    if high > low { ((value - low) / (high - low)).clamp(0.0, 1.0) } else { 0.5 }
}

/// All but the lowest and the highest hundredth: outliers must not eat the ramp.
fn spread(values: &mut [f64]) -> (f64, f64) {
    if values.is_empty() {
        return (0.0, 0.0);
    }
    values.sort_unstable_by(f64::total_cmp);
    let cut = values.len() / 100;
    (values[cut], values[values.len() - 1 - cut])
}

/// A power of two that makes the extent of points about one, so that fourth powers of it are numbers.
fn unit(points: &[[f64; 3]]) -> f64 {
    let extent = |k: usize| {
        let finite = points.iter().map(|p| p[k]).filter(|x| x.is_finite());
        let none = (f64::INFINITY, f64::NEG_INFINITY);
        let (low, high) = finite.fold(none, |(low, high), x| (low.min(x), high.max(x)));
        high / 2.0 - low / 2.0
    };
    let extent = extent(0).max(extent(1)).max(extent(2));
    let exponent = ((extent.to_bits() >> 52) as i32 - 1023).clamp(-1000, 1000);
    f64::from_bits(((1023 - exponent) as u64) << 52)
}

/// The light at each point, from the mean normal of its triangles. Flat land is exaggerated until its typical
/// slope can be seen.
fn light(mesh: &Mesh<impl Triangulation<Point = [f64; 2]>>) -> Vec<f64> {
    let positions: Vec<_> = mesh.positions().collect();
    let unit = unit(&positions);
    let mut normals = vec![[0.0_f64; 3]; positions.len()];
    for triangle in mesh.triangles() {
        let [a, b, c] = triangle.map(|i| positions[i]);
        let [u, v] = [b, c].map(|p| [0, 1, 2].map(|k| (p[k] - a[k]) * unit));
        let normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        for i in triangle {
            (0..3).for_each(|k| normals[i][k] += normal[k]);
        }
    }
    let slope = |n: &[f64; 3]| (n[0] * n[0] + n[1] * n[1]).sqrt() / n[2];
    let mut slopes: Vec<f64> = normals.iter().map(slope).filter(|s| s.is_finite()).collect();
    slopes.sort_unstable_by(f64::total_cmp);
    let typical = slopes.get(slopes.len() / 2).copied().unwrap_or_default();
    let exaggeration = if typical > 0.0 { (0.3 / typical).clamp(0.01, 20.0) } else { 1.0 };
    let brightness = |n: &[f64; 3]| {
        let tilted = [n[0] * exaggeration, n[1] * exaggeration, n[2]];
        let length = tilted.iter().map(|x| x * x).sum::<f64>().sqrt();
        let facing: f64 = tilted.iter().zip(LIGHT).map(|(x, l)| x * l).sum::<f64>() / length;
        let light = 0.3 + 0.7 * facing.max(0.0) / LIGHT[2];
        if light.is_finite() { light } else { 1.0 }
    };
    normals.iter().map(brightness).collect()
}
