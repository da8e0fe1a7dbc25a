//! Volumes, areas and centers of mass of polyhedra from the corners of their faces.
//!
//! All is seen from one corner, so that far from the origin nothing is lost; where products leave the range of `f64`, in other units.
//!
//! Cost: O(k) for k corners.

/// Below this a product of four may have lost bits.
const LEAST_PRODUCT: f64 = 1e-150;

type Point = [f64; 3];

#[inline]
fn less(p: Point, q: Point) -> Point {
    [p[0] - q[0], p[1] - q[1], p[2] - q[2]]
}

/// From one point to another, scaled: also where the way between them is beyond the range of `f64`.
#[inline]
fn seen(p: Point, from: Point, scale: f64) -> Point {
    let way = less(p, from);
    if scale == 1.0 || way.iter().all(|x| x.is_finite()) {
        return way.map(|x| x * scale);
    }
    less(p.map(|x| x * scale), from.map(|x| x * scale))
}

#[inline]
fn dot(p: Point, q: Point) -> f64 {
    p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
}

#[inline]
fn cross(p: Point, q: Point) -> Point {
    [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]
}

/// Hands out the triangles of a face from its first corner on, as seen from a point and scaled.
#[inline]
fn triangles(
    face: impl Iterator<Item = Point>,
    from: Point,
    scale: f64,
    mut each: impl FnMut(Point, Point, Point),
) {
    let mut corners = face.map(|p| seen(p, from, scale));
    let (Some(a), Some(mut b)) = (corners.next(), corners.next()) else { return };
    for c in corners {
        each(a, b, c);
        b = c;
    }
}

/// Six times the volume, seen from a point.
#[inline]
fn six<F: Iterator<Item = Point>>(faces: impl Iterator<Item = F>, from: Point, scale: f64) -> f64 {
    let mut sum = 0.0;
    for face in faces {
        let (mut apex, mut twice) = ([0.0; 3], [0.0; 3]);
        triangles(face, from, scale, |a, b, c| {
            let more = cross(less(b, a), less(c, a));
            (apex, twice) = (a, [twice[0] + more[0], twice[1] + more[1], twice[2] + more[2]]);
        });
        sum += dot(apex, twice);
    }
    sum
}

/// Six times the volume and 24 times its moment, seen from a point.
#[inline]
fn moments<F: Iterator<Item = Point>>(
    faces: impl Iterator<Item = F>,
    from: Point,
    scale: f64,
) -> (f64, Point) {
    let (mut volume, mut moment) = (0.0, [0.0; 3]);
    for face in faces {
        triangles(face, from, scale, |a, b, c| {
            let six = dot(a, cross(b, c));
            volume += six;
            for k in 0..3 {
                moment[k] += six * (a[k] + b[k] + c[k]);
            }
        });
    }
    (volume, moment)
}

/// Whether nothing was lost: products of four are in the range of `f64`.
fn is_in_range(volume: f64, moment: Point) -> bool {
    volume.abs() >= LEAST_PRODUCT && volume.is_finite() && moment.iter().all(|x| x.is_finite())
}

/// A power of two that takes lengths of about the extent of points, as seen from one, to about one.
#[cold]
fn unit_of(points: impl Iterator<Item = Point>, from: Point) -> f64 {
    let far = |most: f64, p: Point| less(p, from).into_iter().fold(most, |most, x| most.max(x.abs()));
    let exponent = ((points.fold(0.0, far).to_bits() >> 52) as i32 - 1023).clamp(-1000, 1000);
    f64::from_bits(((1023 - exponent) as u64) << 52)
}

fn first<F: Iterator<Item = Point>>(mut faces: impl Iterator<Item = F>) -> Option<Point> {
    faces.next()?.next()
}

/// The volume inside of faces that are counter-clockwise seen from outside. Beyond the range of `f64` it is infinite, and never NaN.
pub(in crate::space) fn volume<F: Iterator<Item = Point>>(faces: impl Iterator<Item = F> + Clone) -> f64 {
    let Some(from) = first(faces.clone()) else { return 0.0 };
    let plain = six(faces.clone(), from, 1.0);
    if is_in_range(plain, [0.0; 3]) {
        return plain / 6.0;
    }
    let scale = unit_of(faces.clone().flatten(), from);
    six(faces, from, scale) / 6.0 / scale / scale / scale
}

/// The center of mass. `None` if there is no volume.
pub(in crate::space) fn centroid<F: Iterator<Item = Point>>(
    faces: impl Iterator<Item = F> + Clone,
) -> Option<Point> {
    let from = first(faces.clone())?;
    let ((mut volume, mut moment), mut scale) = (moments(faces.clone(), from, 1.0), 1.0);
    if !is_in_range(volume, moment) {
        scale = unit_of(faces.clone().flatten(), from);
        (volume, moment) = moments(faces.clone(), from, scale);
    }
    if volume.is_nan() || volume <= 0.0 {
        return None;
    }
    // A sliver has a volume of roundings: its center is among its corners all the same.
    let (mut low, mut high) = (from, from);
    for p in faces.flatten() {
        for k in 0..3 {
            (low[k], high[k]) = (low[k].min(p[k]), high[k].max(p[k]));
        }
    }
    let center = |k: usize| {
        let way = moment[k] / volume / 4.0;
        let plain = way / scale;
        if plain.is_finite() { from[k] + plain } else { (from[k] * scale + way) / scale }
    };
    Some([0, 1, 2].map(|k| center(k).clamp(low[k], high[k])))
}

/// The outward normal of a face, as long as its area; in units of a power of two, which is the second.
pub(in crate::space) fn area_vector<F: Iterator<Item = Point> + Clone>(face: F) -> (Point, f64) {
    let Some(from) = face.clone().next() else { return ([0.0; 3], 1.0) };
    let sum = |scale: f64| {
        let mut sum = [0.0; 3];
        triangles(face.clone(), from, scale, |_, b, c| {
            let twice = cross(b, c);
            sum = [sum[0] + twice[0], sum[1] + twice[1], sum[2] + twice[2]];
        });
        sum.map(|x| x / 2.0)
    };
    let plain = sum(1.0);
    let square = dot(plain, plain);
    // The square of an area is a product of four.
    if is_in_range(square, plain) {
        return (plain, 1.0);
    }
    let scale = unit_of(face.clone(), from);
    (sum(scale), scale)
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
    use super::{area, area_vector, centroid, direction, volume};

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
                assert_eq!(volume(faces()), 16.0 * unit * unit * unit, "2^{power}");
                let center = centroid(faces()).expect("a volume");
                assert_eq!(center, [0, 1, 2].map(|k| ([1.0, 1.0, 1.5][k] + at[k]) * unit), "2^{power}");
                let base = [o, y, x];
                assert_eq!(area(base.into_iter()), 8.0 * unit * unit);
                assert_eq!(direction(area_vector(base.into_iter()).0), Some([0.0, 0.0, -1.0]));
            }
        }
        // The way between two corners is beyond all numbers.
        let corner = |p: [f64; 3]| p.map(|x| x * 2f64.powi(1023));
        let [o, x, y, z] = [[-1.0; 3], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]].map(corner);
        let faces = [[o, y, x], [o, x, z], [o, z, y], [x, y, z]];
        let faces = || faces.iter().map(|face| face.iter().copied());
        assert_eq!((volume(faces()), area(faces().flatten())), (f64::INFINITY, f64::INFINITY));
        assert_eq!(centroid(faces()), Some(corner([-0.5; 3])));
        assert_eq!(direction(area_vector([o, y, x].into_iter()).0), Some([0.0, 0.0, -1.0]));
        assert_eq!(volume(std::iter::empty::<std::array::IntoIter<[f64; 3], 3>>()), 0.0);
    }
}
