//! Lines without points that they visit twice: taken apart where they touch themselves.
//!
//! Cost: O(k log k) for k points, and O(k) more where some are equal.

use std::cmp::Ordering;
use std::collections::BTreeMap;

use delone_predicates::orient2d;

/// Compares lists of points lexicographically.
pub(super) fn compare(a: &[[f64; 2]], b: &[[f64; 2]]) -> Ordering {
    let points = a.iter().zip(b).map(|(p, q)| p[0].total_cmp(&q[0]).then(p[1].total_cmp(&q[1])));
    points.into_iter().find(|order| order.is_ne()).unwrap_or_else(|| a.len().cmp(&b.len()))
}

/// A line, and whether it is closed.
pub(super) type Line = (Vec<[f64; 2]>, bool);

/// The simple lines that a line is made of: closed ones of at least three points, which begin with their lexicographically least, and an
/// open one of at least two. Their direction stays.
pub(super) fn simple(mut points: Vec<[f64; 2]>, is_closed: bool) -> Vec<Line> {
    // Minus zero is zero, so that equal points have equal bits.
    points.as_flattened_mut().iter_mut().for_each(|x| *x += 0.0);
    points.dedup();
    while is_closed && points.len() > 1 && points.first() == points.last() {
        points.pop();
    }
    let mut parts = Vec::new();
    if has_equal(&points) {
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

fn order(p: [f64; 2], q: [f64; 2]) -> Ordering {
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

/// How a simple ring turns: counter-clockwise at its least corner or not; `None` where that corner is flat, so that nothing is inside
/// but what rounding made.
pub(super) fn turns_left(ring: &[[f64; 2]]) -> Option<bool> {
    let [first, second, .., last] = ring else { return None };
    let sign = orient2d(*last, *first, *second);
    (!sign.is_zero()).then(|| sign.is_positive())
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
    use super::{holds, simple, turns_left};

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
        assert_eq!(simple(vec![A, A, A], true), []);
        assert_eq!(simple(vec![A, B, E, B], true), []);
        assert_eq!(simple(vec![A, B, A], false), []);
        // Two rings at a point, and a line with a ring.
        let two = simple(vec![B, C, D, A, B, E, F], true);
        assert_eq!(two, [(vec![A, B, C, D], true), (vec![B, E, F], true)]);
        assert_eq!(simple(vec![A, B, E, F, B, C], false), [(vec![B, E, F], true), (vec![A, B, C], false)]);
        assert_eq!(simple(vec![[0.0, -0.0], B, [0.0, 0.0]], false), []);
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
