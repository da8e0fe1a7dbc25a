//! Lines without points that they visit twice: taken apart where they touch themselves.
//!
//! Cost: O(k log k) for k points, and O(k) more where some are equal.

use std::cmp::Ordering;
use std::collections::BTreeMap;

use delone_predicates::orient2d;

use super::link::Path;

/// Compares lists of points lexicographically.
pub(super) fn compare(a: &[[f64; 2]], b: &[[f64; 2]]) -> Ordering {
    let points = a.iter().zip(b).map(|(p, q)| p[0].total_cmp(&q[0]).then(p[1].total_cmp(&q[1])));
    points.into_iter().find(|order| order.is_ne()).unwrap_or_else(|| a.len().cmp(&b.len()))
}

/// A line, and whether it is closed.
pub(super) type Line = (Vec<[f64; 2]>, bool);

/// The simple lines that a line is made of, which may come to a point twice: closed ones of at least three points, which begin with their
/// lexicographically least, and an open one of at least two. Their direction stays.
pub(super) fn simple((Path { mut points, is_closed, .. }, may_touch): (Path, bool)) -> Vec<Line> {
    let mut parts = Vec::new();
    if may_touch && has_equal(&points) {
        if is_closed {
            least_rotation(&mut points);
        }
        let mut path: Vec<[f64; 2]> = Vec::new();
        let mut places = BTreeMap::new();
        for p in points {
            if let Some(&place) = places.get(&key(p)) {
                // Back where it was: what is in between is a ring of its own.
                let mut ring = path.split_off(place + 1);
                ring.iter().for_each(|&q| _ = places.remove(&key(q)));
                ring.push(p);
                parts.push((ring, true));
            } else {
                places.insert(key(p), path.len());
                path.push(p);
            }
        }
        parts.push((path, is_closed));
    } else {
        parts.push((points, is_closed));
    }
    parts.retain(|(points, is_closed)| points.len() >= if *is_closed { 3 } else { 2 });
    for (points, is_closed) in &mut parts {
        let least = (0..points.len()).min_by(|&i, &j| order(points[i], points[j]));
        if *is_closed {
            points.rotate_left(least.unwrap_or(0));
        }
    }
    parts
}

/// Turns a ring so that it is lexicographically least: where it is taken apart must not depend on where it was begun.
fn least_rotation(points: &mut [[f64; 2]]) {
    let n = points.len();
    let (mut best, mut other, mut equal) = (0, 1, 0);
    while best < n && other < n && equal < n {
        match order(points[(best + equal) % n], points[(other + equal) % n]) {
            Ordering::Equal => equal += 1,
            Ordering::Greater => (best, equal) = (best + equal + 1, 0),
            Ordering::Less => (other, equal) = (other + equal + 1, 0),
        }
        other += usize::from(best == other);
    }
    points.rotate_left(best.min(other));
}

/// The lexicographic order of points.
pub(super) fn order(p: [f64; 2], q: [f64; 2]) -> Ordering {
    p[0].total_cmp(&q[0]).then(p[1].total_cmp(&q[1]))
}

fn key(p: [f64; 2]) -> [u64; 2] {
    p.map(f64::to_bits)
}

fn has_equal(points: &[[f64; 2]]) -> bool {
    let mut keys: Vec<[u64; 2]> = points.iter().map(|&p| key(p)).collect();
    keys.sort_unstable();
    keys.windows(2).any(|pair| pair[0] == pair[1])
}

/// How a ring turns: counter-clockwise or not; `None` where nothing is inside but what rounding made. Rounding may lay sides over each
/// other or across, so no single corner can tell: the area does, and where that is not larger than its error, what is left when flat
/// corners are cut off, the lexicographically least first, which changes no area.
pub(super) fn turns_left(ring: &[[f64; 2]]) -> Option<bool> {
    let (area, error) = doubled_area(ring);
    if area.abs() > error {
        return Some(area > 0.0);
    }
    let mut rest = ring.to_vec();
    while let [first, second, .., last] = rest[..] {
        let sign = orient2d(last, first, second);
        if !sign.is_zero() {
            return Some(sign.is_positive());
        }
        rest.remove(0);
        let least = (0..rest.len()).min_by(|&i, &j| order(rest[i], rest[j])).unwrap_or(0);
        rest.rotate_left(least);
    }
    None
}

/// Twice the area of a ring, negative if it is clockwise, and a bound of its error; an infinite one where numbers end.
fn doubled_area(ring: &[[f64; 2]]) -> (f64, f64) {
    let Some(&[x, y]) = ring.first() else { return (0.0, 0.0) };
    let (mut area, mut size) = (0.0, 0.0);
    for pair in ring.windows(2) {
        let [a, b] = [pair[0], pair[1]].map(|p| [p[0] - x, p[1] - y]);
        area += a[0] * b[1] - a[1] * b[0];
        size += (a[0] * b[1]).abs() + (a[1] * b[0]).abs();
    }
    // Five roundings of each product and as many as there are terms of the sum; below the smallest product nothing is sure.
    let error = (ring.len() + 8) as f64 * (f64::EPSILON * size + f64::MIN_POSITIVE);
    if error.is_finite() { (area, error) } else { (0.0, f64::INFINITY) }
}

/// Whether a point is inside of a ring, exactly; points on it are inside or not.
pub(super) fn holds(ring: &[[f64; 2]], q: [f64; 2]) -> bool {
    let mut is_inside = false;
    for (i, &p) in ring.iter().enumerate() {
        let r = ring[(i + 1) % ring.len()];
        // Sides that the ray to the right of the point meets; of their ends the lower one counts.
        if (p[1] <= q[1]) != (r[1] <= q[1]) {
            let (low, high) = if p[1] <= r[1] { (p, r) } else { (r, p) };
            is_inside ^= orient2d(low, high, q).is_positive();
        }
    }
    is_inside
}

#[cfg(test)]
mod tests {
    use super::{Line, Path, holds, turns_left};

    fn simple(points: Vec<[f64; 2]>, is_closed: bool) -> Vec<Line> {
        super::simple((Path { set: 0, points, is_closed }, true))
    }

    const A: [f64; 2] = [0.0, 0.0];
    const B: [f64; 2] = [2.0, 0.0];
    const C: [f64; 2] = [2.0, 2.0];
    const D: [f64; 2] = [0.0, 2.0];
    const E: [f64; 2] = [4.0, 0.0];
    const F: [f64; 2] = [4.0, 1.0];

    #[test]
    fn lines_are_taken_apart_where_they_touch() {
        assert_eq!(simple(vec![C, D, A, B], true), [(vec![A, B, C, D], true)]);
        // A spur out and back, a peak, a ridge.
        assert_eq!(simple(vec![A, B, E, B, C], true), [(vec![A, B, C], true)]);
        assert_eq!(simple(vec![A, B, E, B], true), []);
        assert_eq!(simple(vec![A, B, A], false), []);
        // Two rings at a point, and a line with a ring.
        let two = simple(vec![B, C, D, A, B, E, F], true);
        assert_eq!(two, [(vec![B, E, F], true), (vec![A, B, C, D], true)]);
        assert_eq!(simple(vec![A, B, E, F, B, C], false), [(vec![B, E, F], true), (vec![A, B, C], false)]);
        assert_eq!(simple(vec![A, B, A], true), []);
    }

    #[test]
    fn rings_turn_and_hold() {
        assert_eq!(turns_left(&[A, B, C, D]), Some(true));
        assert_eq!(turns_left(&[A, D, C, B]), Some(false));
        assert_eq!(turns_left(&[A, B, E]), None);
        for (q, inside) in
            [([1.0, 1.0], true), ([3.0, 1.0], false), ([-1.0, 0.0], false), ([1.0, 3.0], false)]
        {
            assert_eq!(holds(&[A, B, C, D], q), inside, "{q:?}");
        }
    }
}
