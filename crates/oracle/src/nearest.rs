//! How far points are from segments and triangles, as fractions.

use std::cmp::Ordering;

use num_bigint::BigInt;

use crate::exact::{Point3, integers};

/// A number as a fraction, whose denominator is positive.
struct Fraction(BigInt, BigInt);

impl Fraction {
    fn compare(&self, other: &Self) -> Ordering {
        (&self.0 * &other.1).cmp(&(&other.0 * &self.1))
    }
}

/// The order of the distances of a point from two segments.
pub fn compare_segments<const D: usize>(q: [f64; D], s: [[f64; D]; 2], t: [[f64; D]; 2]) -> Ordering {
    let p = integers(&[q, s[0], s[1], t[0], t[1]]);
    from_segment(&p[0], &p[1], &p[2]).compare(&from_segment(&p[0], &p[3], &p[4]))
}

/// The order of the distances of a point from two triangles.
pub fn compare_triangles(q: Point3, s: [Point3; 3], t: [Point3; 3]) -> Ordering {
    let p = integers(&[q, s[0], s[1], s[2], t[0], t[1], t[2]]);
    from_triangle(&p[0], [&p[1], &p[2], &p[3]]).compare(&from_triangle(&p[0], [&p[4], &p[5], &p[6]]))
}

fn between<const D: usize>(p: &[BigInt; D], q: &[BigInt; D]) -> [BigInt; D] {
    std::array::from_fn(|k| &q[k] - &p[k])
}

fn dot<const D: usize>(u: &[BigInt; D], v: &[BigInt; D]) -> BigInt {
    u.iter().zip(v).map(|(x, y)| x * y).sum()
}

/// The squared distance from a segment.
fn from_segment<const D: usize>(q: &[BigInt; D], a: &[BigInt; D], b: &[BigInt; D]) -> Fraction {
    let (along, to_a, to_b) = (between(a, b), between(a, q), between(b, q));
    let (length, part) = (dot(&along, &along), dot(&along, &to_a));
    if part <= BigInt::ZERO {
        Fraction(dot(&to_a, &to_a), 1.into())
    } else if part >= length {
        Fraction(dot(&to_b, &to_b), 1.into())
    } else {
        Fraction(dot(&to_a, &to_a) * &length - &part * &part, length)
    }
}

fn cross([ux, uy, uz]: &[BigInt; 3], [vx, vy, vz]: &[BigInt; 3]) -> [BigInt; 3] {
    [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx]
}

/// The squared distance from a triangle.
fn from_triangle(q: &[BigInt; 3], corners: [&[BigInt; 3]; 3]) -> Fraction {
    let [a, b, c] = corners;
    let normal = cross(&between(a, b), &between(a, c));
    let is_inside = |k: usize| {
        let (from, to) = (corners[k], corners[(k + 1) % 3]);
        dot(&cross(&between(from, to), &between(from, q)), &normal) >= BigInt::ZERO
    };
    if (0..3).all(is_inside) {
        let height = dot(&normal, &between(a, q));
        return Fraction(&height * &height, dot(&normal, &normal));
    }
    let sides = (0..3).map(|k| from_segment(q, corners[k], corners[(k + 1) % 3]));
    sides.min_by(Fraction::compare).expect("three")
}

#[cfg(test)]
mod tests {
    use std::cmp::Ordering;

    use super::{compare_segments, compare_triangles};

    #[test]
    fn ends_and_insides_are_told_apart() {
        let (x, y) = ([[0.0, 0.0], [4.0, 0.0]], [[0.0, 0.0], [0.0, 4.0]]);
        for (q, order) in
            [([2.0, 1.0], Ordering::Less), ([-1.0, -3.0], Ordering::Equal), ([5.0, 1.0], Ordering::Less)]
        {
            assert_eq!(compare_segments(q, x, y), order, "{q:?}");
            let [q, lower, upper] = [[q; 2], x, y].map(|s| s.map(|[x, y]| [x, y, 0.0]));
            let flat =
                |[a, b]: [[f64; 3]; 2]| [a, b, [a[0] / 2.0 + b[0] / 2.0, a[1] / 2.0 + b[1] / 2.0, -9.0]];
            assert_eq!(compare_triangles(q[0], flat(lower), flat(upper)), order, "{q:?}");
        }
        let above = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];
        let below = [[0.0, 0.0, -1.0], [1.0, 0.0, -1.0], [0.0, 1.0, -1.0]];
        assert_eq!(compare_triangles([1.0, 1.0, 2.0], above, below), Ordering::Less);
        assert_eq!(compare_triangles([1.0, 1.0, -2.0], above, below), Ordering::Greater);
    }
}
