//! Volumes, areas and centers of mass of polyhedra from the corners of their faces.
//!
//! All of a polyhedron in one pass, seen from one corner, so that far from the origin nothing is lost; where products leave the range of
//! `f64`, in other units.
//!
//! Cost: O(k) for k corners.

/// Below this a product of four lengths may have lost bits: 1e-308 with room for the factor that is smallest.
const LEAST_PRODUCT: f64 = 1e-150;
/// Below this, in coordinate units squared, a face whose square was lost may count: at most 1e-75, a part of 1e-20.
const LEAST_AREA: f64 = 1e-55;

type Point = [f64; 3];

#[inline]
fn less(p: Point, q: Point) -> Point {
    [p[0] - q[0], p[1] - q[1], p[2] - q[2]]
}

/// From one point to another, scaled: also where the way between them is beyond the range of `f64`.
#[inline]
fn way(from: Point, to: Point, scale: f64) -> Point {
    let way = less(to, from);
    if scale == 1.0 || way.iter().all(|x| x.is_finite()) {
        return way.map(|x| x * scale);
    }
    less(to.map(|x| x * scale), from.map(|x| x * scale))
}

#[inline]
fn dot(p: Point, q: Point) -> f64 {
    p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
}

#[inline]
fn cross(p: Point, q: Point) -> Point {
    [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]
}

/// The measures of a polyhedron.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(in crate::space) struct Measures {
    /// Never negative: less than nothing is rounding. Beyond the range of `f64` it is infinite.
    pub(in crate::space) volume: f64,
    /// Of all faces.
    pub(in crate::space) area: f64,
    /// The center of mass. `None` if there is no volume.
    pub(in crate::space) centroid: Option<Point>,
}

/// Sums of one pass over the faces, seen from a point and scaled.
struct Sums {
    six_volumes: f64,
    /// 24 times the moment.
    moment: Point,
    two_areas: f64,
    /// The box around the corners, neither moved nor scaled.
    low: Point,
    high: Point,
}

/// The outward normal of a face, twice as long as its area, as seen from a point and scaled. Hands out each triangle of the fan from its
/// first corner, with six times the volume between that and the point.
#[inline]
fn fan(
    face: impl Iterator<Item = Point>,
    from: Point,
    scale: f64,
    mut each: impl FnMut([Point; 3], f64),
) -> Point {
    let mut seen = face.map(|p| way(from, p, scale));
    let (Some(a), Some(mut b)) = (seen.next(), seen.next()) else { return [0.0; 3] };
    let (mut side, mut normal) = (less(b, a), [0.0; 3]);
    for c in seen {
        let next = less(c, a);
        let more = cross(side, next);
        each([a, b, c], dot(a, more));
        normal = [normal[0] + more[0], normal[1] + more[1], normal[2] + more[2]];
        (b, side) = (c, next);
    }
    normal
}

#[inline]
fn sums<F: Iterator<Item = Point>>(faces: impl Iterator<Item = F>, from: Point, scale: f64) -> Sums {
    let mut sums = Sums { six_volumes: 0.0, moment: [0.0; 3], two_areas: 0.0, low: from, high: from };
    for face in faces {
        let Sums { six_volumes, moment, two_areas, low, high } = &mut sums;
        let seen = face.inspect(|p| {
            for k in 0..3 {
                (low[k], high[k]) = (low[k].min(p[k]), high[k].max(p[k]));
            }
        });
        let normal = fan(seen, from, scale, |[a, b, c], six| {
            *six_volumes += six;
            for k in 0..3 {
                moment[k] += six * (a[k] + b[k] + c[k]);
            }
        });
        *two_areas += dot(normal, normal).sqrt();
    }
    sums
}

impl Sums {
    /// Whether nothing was lost: products of four are in the range of `f64`.
    fn are_in_range(&self) -> bool {
        let volume = self.six_volumes.abs();
        (LEAST_PRODUCT..=f64::MAX).contains(&volume)
            && (LEAST_AREA..=f64::MAX).contains(&self.two_areas)
            && self.moment.iter().all(|x| x.is_finite())
    }
}

/// A power of two that takes lengths of about the extent of points, as seen from one, to about one.
#[cold]
fn unit_of(points: impl Iterator<Item = Point>, from: Point) -> f64 {
    let far = |most: f64, p: Point| less(p, from).into_iter().fold(most, |most, x| most.max(x.abs()));
    let exponent = ((points.fold(0.0, far).to_bits() >> 52) as i32 - 1023).clamp(-1000, 1000);
    f64::from_bits(((1023 - exponent) as u64) << 52)
}

/// Measures of what is inside of faces that are counter-clockwise seen from outside.
pub(in crate::space) fn of<F: Iterator<Item = Point>>(faces: impl Iterator<Item = F> + Clone) -> Measures {
    let Some(from) = faces.clone().next().and_then(|mut face| face.next()) else {
        return Measures::default();
    };
    let (mut sums, mut scale) = (self::sums(faces.clone(), from, 1.0), 1.0);
    if !sums.are_in_range() {
        scale = unit_of(faces.clone().flatten(), from);
        sums = self::sums(faces, from, scale);
    }
    let Sums { six_volumes, moment, two_areas, low, high } = sums;
    // A sliver has a volume of roundings: its center is among its corners all the same.
    let center = |k: usize| {
        let way = moment[k] / six_volumes / 4.0;
        let plain = way / scale;
        let center = if plain.is_finite() { from[k] + plain } else { (from[k] * scale + way) / scale };
        center.clamp(low[k], high[k])
    };
    Measures {
        volume: (six_volumes / 6.0 / scale / scale / scale).max(0.0),
        area: two_areas / 2.0 / scale / scale,
        centroid: (six_volumes > 0.0).then(|| [0, 1, 2].map(center)),
    }
}

/// The outward normal of a face, as long as its area; in units of a power of two, which is the second.
pub(in crate::space) fn area_vector<F: Iterator<Item = Point> + Clone>(face: F) -> (Point, f64) {
    let Some(from) = face.clone().next() else { return ([0.0; 3], 1.0) };
    let half = |scale: f64| fan(face.clone(), from, scale, |_, _| {}).map(|x| x / 2.0);
    let plain = half(1.0);
    // The square of an area is a product of four.
    if (LEAST_PRODUCT..=f64::MAX).contains(&dot(plain, plain)) {
        return (plain, 1.0);
    }
    let scale = unit_of(face.clone(), from);
    (half(scale), scale)
}

/// The area of a face. Infinite if it is beyond the range of `f64`.
pub(in crate::space) fn area<F: Iterator<Item = Point> + Clone>(face: F) -> f64 {
    let (vector, scale) = area_vector(face);
    dot(vector, vector).sqrt() / scale / scale
}

/// A vector as long as one, if it has a direction.
pub(in crate::space) fn direction(vector: Point) -> Option<Point> {
    let length = dot(vector, vector).sqrt();
    (length > 0.0 && length.is_finite()).then(|| vector.map(|x| x / length))
}

#[cfg(test)]
mod tests {
    use super::{Measures, area, area_vector, direction, of};

    /// Of a tetrahedron, in whatever units.
    #[test]
    fn measures_do_not_depend_on_the_units() {
        for power in [-300, -150, -90, -40, 0, 40, 90, 150, 300] {
            let unit = 2f64.powi(power);
            for at in [[0.0; 3], [1.0, -2.0, 3.0]] {
                let corner = |p: [f64; 3]| [0, 1, 2].map(|k| (p[k] + at[k]) * unit);
                let [o, x, y, z] = [[0.0; 3], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0], [0.0, 0.0, 6.0]].map(corner);
                let faces = [[o, y, x], [o, x, z], [o, z, y], [x, y, z]];
                let faces = || faces.iter().map(|face| face.iter().copied());
                let Measures { volume, area: surface, centroid } = of(faces());
                assert_eq!(volume, 16.0 * unit * unit * unit, "2^{power}");
                let center = [0, 1, 2].map(|k| ([1.0, 1.0, 1.5][k] + at[k]) * unit);
                assert_eq!(centroid, Some(center), "2^{power}");
                let sum: f64 = faces().map(area).sum();
                assert!(surface == sum || (surface / sum - 1.0).abs() < 1e-15, "2^{power}");
                let base = [o, y, x];
                assert_eq!(area(base.into_iter()), 8.0 * unit * unit);
                assert_eq!(direction(area_vector(base.into_iter()).0), Some([0.0, 0.0, -1.0]));
            }
        }
        // The way between two corners is beyond all numbers.
        let corner = |p: [f64; 3]| p.map(|x| x * 2f64.powi(1023));
        let [o, x, y, z] = [[-1.0; 3], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]].map(corner);
        let faces = [[o, y, x], [o, x, z], [o, z, y], [x, y, z]];
        let Measures { volume, area, centroid } = of(faces.iter().map(|face| face.iter().copied()));
        assert_eq!((volume, area), (f64::INFINITY, f64::INFINITY));
        assert_eq!(centroid, Some(corner([-0.5; 3])));
        assert_eq!(direction(area_vector([o, y, x].into_iter()).0), Some([0.0, 0.0, -1.0]));
        assert_eq!(of(std::iter::empty::<std::array::IntoIter<[f64; 3], 3>>()), Measures::default());
    }
}
