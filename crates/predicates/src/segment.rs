//! The distance of a point from a segment against a radius: filter, exact. Equal is an answer.

use std::cmp::Ordering;

use crate::distance::{ERROR, SMALLEST, angle, compare_with_radius};
use crate::{Point2, exact};

/// Compares the distance of `q` from the segment between `a` and `b` with `radius`: `Less` if it is strictly nearer. A negative radius is
/// smaller than every distance.
///
/// Exact for every finite input. O(1).
///
/// ```
/// use std::cmp::Ordering;
/// use delone_predicates::compare_segment_with_radius;
///
/// let segment = [[0.0, 0.0], [6.0, 8.0]];
/// assert_eq!(compare_segment_with_radius([7.0, 1.0], segment, 5.0), Ordering::Equal);
/// assert_eq!(compare_segment_with_radius([-3.0, -4.0], segment, 5.0), Ordering::Equal);
/// assert_eq!(compare_segment_with_radius([3.0, 4.0], segment, 5e-324), Ordering::Less);
/// ```
#[inline]
pub fn compare_segment_with_radius(q: Point2, [a, b]: [Point2; 2], radius: f64) -> Ordering {
    // The nearest point is an end, or on the line.
    if !angle(a, q, b).is_positive() {
        return compare_with_radius(q, a, radius);
    }
    if !angle(b, q, a).is_positive() {
        return compare_with_radius(q, b, radius);
    }
    if radius < 0.0 {
        return Ordering::Greater;
    }
    on_line(q, [a, b], radius).unwrap_or_else(|| exact::compare_line_with_radius(q, [a, b], radius))
}

/// The distance from the line, if floating point can tell: the square of the area of a parallelogram, against that of a rectangle.
#[inline]
fn on_line(q: Point2, [a, b]: [Point2; 2], radius: f64) -> Option<Ordering> {
    /// Relative error of the square of an area, and of the product of two squares: roundings on top of those of the areas.
    const OF_SQUARES: f64 = 4.0 * ERROR;
    let (dx, dy, ex, ey) = (b[0] - a[0], b[1] - a[1], q[0] - a[0], q[1] - a[1]);
    let (left, right) = (dx * ey, dy * ex);
    let is_zero = (dx == 0.0 || ey == 0.0) && (dy == 0.0 || ex == 0.0);
    let (size, height) = (left.abs() + right.abs(), (left - right).abs());
    let (squared, length) = (radius * radius, dx * dx + dy * dy);
    let rectangle = squared * length;
    // No product has lost bits by underflow, or is infinite.
    let bounds = SMALLEST..f64::INFINITY;
    let is_known = (is_zero || bounds.contains(&size))
        && (radius == 0.0 || bounds.contains(&squared) && bounds.contains(&rectangle))
        && bounds.contains(&length);
    if !is_known {
        return None;
    }
    let [least, most] =
        [(height - ERROR * size).max(0.0), height + ERROR * size].map(|height| height * height);
    let (low, high) = (rectangle * (1.0 - OF_SQUARES), rectangle * (1.0 + OF_SQUARES));
    if least > high && bounds.contains(&least) {
        Some(Ordering::Greater)
    } else if most < low && (is_zero || bounds.contains(&most)) {
        Some(Ordering::Less)
    } else {
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Definition over integers, at all scales.
    #[test]
    fn it_is_the_distance() {
        let mut state = 1_u64;
        let mut next = |below: i64| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) as i64 % below
        };
        let mut met = [0; 3];
        for round in 0..30_000 {
            let below = [5, 12, 1000][round % 3];
            let [a, b, q] = [(); 3].map(|()| [next(below), next(below)]);
            let radius = next(below);
            let minus = |p: [i64; 2], o: [i64; 2]| [p[0] - o[0], p[1] - o[1]];
            let dot = |p: [i64; 2], r: [i64; 2]| p[0] * r[0] + p[1] * r[1];
            let (d, e) = (minus(b, a), minus(q, a));
            let far = |p: [i64; 2]| dot(minus(q, p), minus(q, p)).cmp(&(radius * radius));
            let expected = if dot(d, e) <= 0 {
                far(a)
            } else if dot(d, minus(q, b)) >= 0 {
                far(b)
            } else {
                let area = d[0] * e[1] - d[1] * e[0];
                (area * area).cmp(&(radius * radius * dot(d, d)))
            };
            met[(expected as i8 + 1) as usize] += 1;
            for scale in [0, 60, -60, 500, -500, 1000, -1060] {
                let scaled = |x: i64| x as f64 * 2.0_f64.powi(scale / 2) * 2.0_f64.powi(scale - scale / 2);
                let [a, b, q] = [a, b, q].map(|p| p.map(scaled));
                assert_eq!(
                    compare_segment_with_radius(q, [a, b], scaled(radius)),
                    expected,
                    "{a:?} {b:?} {q:?}"
                );
                assert_eq!(compare_segment_with_radius(q, [b, a], scaled(radius)), expected);
            }
        }
        assert!(met.iter().all(|&count| count > 100), "{met:?}");
        assert_eq!(
            compare_segment_with_radius([1.0, 0.0], [[0.0, 0.0], [2.0, 0.0]], -0.5),
            Ordering::Greater
        );
    }
}
