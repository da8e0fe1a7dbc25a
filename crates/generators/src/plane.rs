//! Named point sets in the plane.

use std::f64::consts::TAU;

use crate::{Point2, Random, repeat};

kinds! {
    /// A named family of point sets in the plane.
    Kind, points -> Vec<Point2>:
    /// Uniform in the unit square.
    Uniform = "uniform", |n, r| repeat(n, || [r.unit(), r.unit()]);
    /// Log-normal coordinates: dense near the origin, with far tails.
    LogNormal = "lognormal", |n, r| repeat(n, || [libm::exp(r.normal()), libm::exp(r.normal())]);
    /// Uniform in the unit square, and ten points up to a billion times as far away.
    Outliers = "outliers", outliers;
    /// Centers of disjoint unit disks, at distance above 2, in a square of side 4 sqrt(n).
    Disks = "disks", disks;
    /// A hundred normal clusters.
    Clusters = "clusters", clusters;
    /// The square integer grid, in random order: every cell is cocircular.
    Grid = "grid", grid;
    /// On a circle, rounded to 24-bit integers.
    Circle = "circle", |n, r| repeat(n, || on_ellipse(r, HALF_RANGE, HALF_RANGE));
    /// On an ellipse of ratio 2, rounded to 24-bit integers.
    Ellipse = "ellipse", |n, r| repeat(n, || on_ellipse(r, HALF_RANGE, HALF_RANGE / 2.0));
    /// 95% on an ellipse and 5% in a square, 24-bit integers.
    Ellipse2 = "ellipse2", ellipse2;
    /// On a parabola, rounded to 24-bit integers.
    Parabola = "parabola", |n, r| repeat(n, || on_parabola(r));
    /// The grid in steps of a tenth: cocircular up to rounding.
    TenthGrid = "tenth-grid", |n, r| map(grid(n, r), |x| x * 0.1);
    /// The grid rotated by three degrees: nearly cocircular and nearly collinear everywhere.
    RotatedGrid = "rotated-grid", rotated_grid;
    /// Doubles on the unit circle: cocircular up to rounding.
    UnitCircle = "unit-circle", |n, r| repeat(n, || { let t = TAU * r.unit(); [libm::cos(t), libm::sin(t)] });
    /// On the line y = x / 3 + 0.1 up to rounding.
    NearLine = "near-line", |n, r| repeat(n, || { let x = r.unit(); [x, x / 3.0 + 0.1] });
    /// Exactly collinear.
    Line = "line", |n, r| repeat(n, || { let x = (r.bits() >> 40) as f64; [x, 3.0 * x - 7.0] });
    /// A lattice of steps 2^-53 at (0.5, 0.5), and the points (12, 12) and (24, 24).
    TinyLattice = "tiny-lattice", tiny_lattice;
    /// Two unit clusters 1e12 apart.
    FarClusters = "far-clusters", |n, r| repeat(n, || {
        let far = if r.unit() < 0.5 { 0.0 } else { 1e12 };
        [far + r.unit(), r.unit()]
    });
    /// Each point about four times.
    Duplicates = "duplicates", duplicates;
    /// Small integers: duplicates, collinear and cocircular points in plenty.
    SmallIntegers = "small-integers", |n, r| {
        let side = 2 + (n as f64).sqrt() as usize;
        repeat(n, || [r.below(side) as f64, r.below(side) as f64])
    };
    /// Magnitudes from 1e-300 to 1e300, both signs.
    HugeSpan = "huge-span", |n, r| repeat(n, || [any_magnitude(r), any_magnitude(r)]);
    /// At every distance from the origin from 2^-1000 to 2^1000: boxes within boxes.
    Octaves = "octaves", |n, r| (0..n).map(|i| {
        let scale = libm::exp2((i % 2001) as f64 - 1000.0);
        [scale * r.between(0.5, 1.0), scale * r.unit()]
    }).collect();
    /// Three concentric circles and two crossing lines on integers: symmetric in many ways.
    Spokes = "spokes", spokes;
    /// Centers of disks of falling radii that overlap two by two (Devillers 2011, §6.2).
    Nested = "nested", |n, _| nested(n, false);
    /// An instance of `nested`, row by row, for which hints mislead.
    NestedInstance = "nested-instance", |n, _| nested(n, true);
    /// A hub and pairs of points on a spiral into it: nearest corners of triangles mislead (Devillers 1998, appendix).
    Hub = "hub", |n, _| hub(n);
    /// Uniform in a square kilometre at a UTM-like offset, in millimetres.
    Utm = "utm", |n, r| repeat(n, || {
        [500_000.0 + (r.unit() * 1e6).floor() / 1e3, 5_400_000.0 + (r.unit() * 1e6).floor() / 1e3]
    });
    /// Scan lines in overlapping swaths, half a metre apart, in whole millimetres at a UTM-like offset.
    Lidar = "lidar", lidar;
    /// Nine points of ten in a square a thousandth as wide as the land of the others.
    DensePatch = "dense-patch", |n, r| repeat(n, || {
        let p = [r.unit(), r.unit()];
        if r.unit() < 0.9 { p.map(|x| 0.7 + 0.001 * x) } else { p }
    });
}

/// Half the range of the 24-bit integers of the paper of the Delaunay hierarchy: [-2^24, 2^24].
const HALF_RANGE: f64 = 16_777_216.0;

/// A survey from the air: swaths along y, each a quarter wider than they are apart, every other one flown back. A mirror swings across while
/// the flight goes on, so that lines are a zigzag. Lines are as far apart as points on them, some 0.5 m, whatever their number.
fn lidar(n: usize, random: &mut Random) -> Vec<Point2> {
    const SPACING: f64 = 500.0;
    const SWATH: f64 = 400_000.0;
    const NOISE: f64 = 20.0;
    let side = SPACING * (n as f64).sqrt();
    let swaths = (side / SWATH).ceil().max(2.0) as usize;
    let apart = side / swaths as f64;
    let width = 1.25 * apart;
    let of_swath = n.div_ceil(swaths).max(1);
    let step = (width * side / of_swath as f64).sqrt();
    let of_line = (width / step).round().max(1.0);
    let point = |i: usize| {
        let (swath, k) = (i / of_swath, (i % of_swath) as f64);
        let (line, place) = ((k / of_line).floor(), k % of_line);
        let across = if line % 2.0 == 0.0 { place } else { of_line - 1.0 - place };
        let flown = side * k / of_swath as f64;
        let x = swath as f64 * apart + width * (across + 0.5) / of_line;
        let y = if swath.is_multiple_of(2) { flown } else { side - flown };
        [691_000_000.0 + x + NOISE * random.normal(), 5_334_000_000.0 + y + NOISE * random.normal()]
            .map(f64::round)
    };
    (0..n).map(point).collect()
}

fn map(points: Vec<Point2>, f: impl Fn(f64) -> f64) -> Vec<Point2> {
    points.into_iter().map(|p| p.map(&f)).collect()
}

fn on_ellipse(random: &mut Random, a: f64, b: f64) -> Point2 {
    let angle = TAU * random.unit();
    [(a * libm::cos(angle)).round(), (b * libm::sin(angle)).round()]
}

fn on_parabola(random: &mut Random) -> Point2 {
    let x = random.between(-HALF_RANGE, HALF_RANGE).round();
    [x, (x * x / HALF_RANGE).round()]
}

fn ellipse2(n: usize, random: &mut Random) -> Vec<Point2> {
    let in_square = |r: &mut Random| r.between(-HALF_RANGE, HALF_RANGE).round();
    repeat(n, || {
        if random.unit() < 0.95 {
            on_ellipse(random, HALF_RANGE, HALF_RANGE / 2.0)
        } else {
            [in_square(random), in_square(random)]
        }
    })
}

fn outliers(n: usize, random: &mut Random) -> Vec<Point2> {
    let mut points = repeat(n, || [random.unit(), random.unit()]);
    for k in 0..n.min(10) {
        let (angle, radius) = (TAU * random.unit(), libm::exp10(k as f64));
        let place = random.below(n);
        points[place] = [radius * libm::cos(angle), radius * libm::sin(angle)];
    }
    points
}

/// Dart throwing with one cell list: the density, 0.196 of the plane, is far below saturation (0.547).
fn disks(n: usize, random: &mut Random) -> Vec<Point2> {
    let side = 4.0 * (n as f64).sqrt();
    let cells = ((side / 2.0) as usize).max(1);
    let mut cell_list: Vec<Vec<Point2>> = vec![Vec::new(); cells * cells];
    let cell = |x: f64| ((x / 2.0) as usize).min(cells - 1);
    let mut points = Vec::with_capacity(n);
    while points.len() < n {
        let p = [random.between(0.0, side), random.between(0.0, side)];
        let [i, j] = p.map(cell);
        let near = (i.saturating_sub(1)..=(i + 1).min(cells - 1))
            .flat_map(|i| (j.saturating_sub(1)..=(j + 1).min(cells - 1)).map(move |j| (i, j)))
            .flat_map(|(i, j)| &cell_list[i * cells + j])
            .any(|q| (p[0] - q[0]).powi(2) + (p[1] - q[1]).powi(2) <= 4.0);
        if !near {
            cell_list[i * cells + j].push(p);
            points.push(p);
        }
    }
    points
}

fn clusters(n: usize, random: &mut Random) -> Vec<Point2> {
    let centers = repeat(100, || [random.unit(), random.unit()]);
    repeat(n, || {
        let [x, y] = centers[random.below(100)];
        [x + 0.005 * random.normal(), y + 0.005 * random.normal()]
    })
}

fn grid(n: usize, random: &mut Random) -> Vec<Point2> {
    let columns = (n as f64).sqrt().ceil().max(1.0) as usize;
    let mut points: Vec<_> = (0..n).map(|i| [(i % columns) as f64, (i / columns) as f64]).collect();
    random.shuffle(&mut points);
    points
}

fn rotated_grid(n: usize, random: &mut Random) -> Vec<Point2> {
    let (sin, cos) = libm::sincos(3f64.to_radians());
    grid(n, random).into_iter().map(|[x, y]| [x * cos - y * sin, x * sin + y * cos]).collect()
}

fn tiny_lattice(n: usize, random: &mut Random) -> Vec<Point2> {
    let mut points = grid(n.saturating_sub(2), random);
    for p in &mut points {
        *p = p.map(|x| 0.5 + x * (f64::EPSILON / 2.0));
    }
    points.extend([[12.0, 12.0], [24.0, 24.0]].into_iter().take(n));
    points
}

fn duplicates(n: usize, random: &mut Random) -> Vec<Point2> {
    let distinct = repeat(n.div_ceil(4), || [random.unit(), random.unit()]);
    repeat(n, || distinct[random.below(distinct.len())])
}

fn any_magnitude(random: &mut Random) -> f64 {
    let magnitude = libm::exp10(random.between(-300.0, 300.0));
    if random.unit() < 0.5 { -magnitude } else { magnitude }
}

fn spokes(n: usize, random: &mut Random) -> Vec<Point2> {
    // Integer points at distances 65, 325 and 1105 from the origin: circles rich in lattice points.
    let on_circle = |radius: i64| {
        (-radius..=radius).filter_map(move |x| {
            let y = ((radius * radius - x * x) as f64).sqrt().round() as i64;
            (x * x + y * y == radius * radius).then_some([x as f64, y as f64])
        })
    };
    let mut places: Vec<_> = [65, 325, 1105].into_iter().flat_map(on_circle).collect();
    places.extend(places.clone().into_iter().map(|[x, y]| [x, -y]));
    places.extend(
        (-40..=40).flat_map(|i| [[f64::from(i) * 30.0; 2], [f64::from(i) * 30.0, f64::from(i) * -30.0]]),
    );
    repeat(n, || places[random.below(places.len())])
}

/// Pairs (x, s) and (x, -s), s falling by tenths while there is room for it; the first point is to the right of all.
/// With x = 2 s they are the centers of disks of radius 2.1 s. These hold points near the axis: on a parabola so narrow
/// that the first point is joined to all others, and a walk from one of a pair to the other crosses all that fan.
fn nested(n: usize, is_instance: bool) -> Vec<Point2> {
    let levels = n / 2;
    let step = (600.0 / levels.max(1) as f64).min(1.0);
    let scale = |level: usize| libm::exp10((levels as f64 / 2.0 - level as f64) * step);
    let pair = |i: usize| {
        let s = scale((i - 1) / 2);
        let x = if is_instance { s * (s / (8.0 * scale(0))) } else { 2.0 * s };
        [x, if i % 2 == 1 { s } else { -s }]
    };
    (0..n).map(|i| if i == 0 { [3.0 * scale(0), 0.0] } else { pair(i) }).collect()
}

/// The hub at the origin; then pairs, each in much the same direction from it, the second less than half as far away and a
/// little to the right; each pair is 4.5 times nearer than the one before, while there is room for it, and a little further to
/// the left. The hub is joined to the second ones. Without its own second point a pair has a triangle there, with the hub and
/// a point of a pair further away, and of these three corners the hub is nearest to the missing point; but of all points
/// one of the next pair is.
fn hub(n: usize) -> Vec<Point2> {
    let pairs = (n / 2).max(1) as f64;
    let shrink = 4.5_f64.min(libm::exp2(1990.0 / pairs));
    let point = |i: usize| {
        if i == 0 {
            return [0.0, 0.0];
        }
        let (pair, is_second) = (((i - 1) / 2) as f64, i.is_multiple_of(2));
        let radius = libm::pow(shrink, pairs / 2.0 - pair) / if is_second { 2.1 } else { 1.0 };
        let angle = (pair + if is_second { 0.0 } else { 0.01 }) / pairs;
        [radius * libm::cos(angle), radius * libm::sin(angle)]
    };
    (0..n).map(point).collect()
}

impl Kind {
    /// Whether coordinates span so many magnitudes that hardly a decision can be made in floating point.
    pub fn is_extreme(self) -> bool {
        matches!(self, Self::HugeSpan | Self::Octaves | Self::Nested | Self::NestedInstance | Self::Hub)
    }
}

#[cfg(test)]
mod tests {
    use super::Kind;

    #[test]
    fn every_kind_gives_what_was_asked() {
        for &kind in Kind::ALL {
            assert_eq!(Kind::named(kind.name()), Some(kind));
            assert!(!kind.about().is_empty());
            for n in [0, 1, 2, 3, 11, 1000] {
                let points = kind.points(n, 7);
                assert_eq!(points.len(), n, "{}", kind.name());
                assert!(points.iter().flatten().all(|x| x.is_finite()), "{}", kind.name());
                assert_eq!(points, kind.points(n, 7), "{}", kind.name());
            }
        }
    }

    #[test]
    fn disks_are_disjoint() {
        let points = Kind::Disks.points(500, 3);
        for (i, p) in points.iter().enumerate() {
            for q in &points[..i] {
                assert!((p[0] - q[0]).hypot(p[1] - q[1]) > 2.0);
            }
        }
    }

    /// A change of any generator is a change of everybody's data.
    #[test]
    fn bits_are_fixed() {
        let hash = |kind: Kind| {
            let bits = kind.points(200, 42).into_iter().flatten().map(f64::to_bits);
            bits.fold(0u64, |h, b| (h ^ b).wrapping_mul(0x0100_0000_01b3).rotate_left(23))
        };
        let all: Vec<_> =
            Kind::ALL.iter().map(|&kind| (kind.name(), format!("{:016x}", hash(kind)))).collect();
        let expected = include_str!("bits.txt");
        let found: String = all.iter().map(|(name, hash)| format!("{name} {hash}\n")).collect();
        assert_eq!(found, expected);
    }
}
