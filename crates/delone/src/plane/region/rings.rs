//! Whether a ring of rounded corners is the border of something, and the rings that it falls apart into.
//!
//! Rings that all are such borders, and share the sides between them, cover their region without gaps or overlaps: how often a
//! point is wound around by all rings together is how often it is by the region's border.
//!
//! All decisions are exact.

use delone_predicates::{lexicographic, orient2d};

use super::sweep::{Nesting, are_in_conflict, nesting};
use crate::sorting;

/// Whether a ring of at least three corners, of which some are known to be exact, is simple and counter-clockwise. The ring of exact
/// corners that it stands for is simple.
///
/// O(k) for a convex ring of k corners, which nearly all are, O(k (r + log k)) for others with r corners that are not exact.
#[inline]
pub(in crate::plane) fn is_border(
    ring: impl ExactSizeIterator<Item = [f64; 2]> + Clone,
    is_exact: impl Fn(usize) -> bool,
) -> bool {
    is_convex(ring.clone()) || simple_orientation(&ring.collect::<Vec<_>>(), &is_exact) == Some(true)
}

/// Whether a ring turns left at every corner, and goes around once.
#[inline]
fn is_convex(mut ring: impl ExactSizeIterator<Item = [f64; 2]> + Clone) -> bool {
    let mut corners = ring.clone();
    let (Some(first), Some(second)) = (corners.next(), corners.next()) else { return false };
    let goes_back = |p: [f64; 2], q: [f64; 2]| q[0] < p[0] || (q[0] == p[0] && q[1] < p[1]);
    let (mut a, mut b, mut back) = (first, second, goes_back(first, second));
    let mut turns = 0;
    ring = corners;
    for c in ring.chain([first, second]) {
        if !orient2d(a, b, c).is_positive() {
            return false;
        }
        // Once around, the direction comes back from the left half plane to the right one once.
        let was_back = std::mem::replace(&mut back, goes_back(b, c));
        turns += u32::from(was_back && !back);
        (a, b) = (b, c);
    }
    turns == 1
}

/// The orientation of a simple ring of at least three corners: `Some(true)` if it is counter-clockwise, `None` if the ring touches itself.
/// Only sides with an end that is not exact are tested.
#[cold]
#[inline(never)]
pub(in crate::plane) fn simple_orientation(
    ring: &[[f64; 2]],
    is_exact: &dyn Fn(usize) -> bool,
) -> Option<bool> {
    let count = ring.len();
    let after = |i: usize| if i + 1 == count { 0 } else { i + 1 };
    let side = |i: usize| [ring[i], ring[after(i)]];
    let is_apart = |[p, q]: [[f64; 2]; 2], [s, t]: [[f64; 2]; 2]| {
        let beyond = |k: usize| p[k].max(q[k]) < s[k].min(t[k]) || s[k].max(t[k]) < p[k].min(q[k]);
        beyond(0) || beyond(1)
    };
    if visits_twice(ring) {
        return None;
    }
    for i in (0..count).filter(|&i| !(is_exact(i) && is_exact(after(i)))) {
        if (0..count).any(|j| j != i && !is_apart(side(i), side(j)) && are_in_conflict(side(i), side(j))) {
            return None;
        }
    }
    // A simple ring turns left at its least corner, or else right.
    let least = (0..count).min_by(|&i, &j| lexicographic(ring[i], ring[j])).unwrap_or(0);
    let before = if least == 0 { count - 1 } else { least - 1 };
    Some(orient2d(ring[before], ring[least], ring[after(least)]).is_positive())
}

/// Whether rings of at least three corners each are the border of something, whatever they are to each other.
pub(in crate::plane) fn each_is_border(rings: &[Vec<[f64; 2]>]) -> bool {
    rings.iter().all(|ring| simple_orientation(ring, &|_| false) == Some(true))
}

/// Whether rings of at least three corners are all of the border of something on their left: they touch in corners at most, outer ones are
/// counter-clockwise, holes clockwise. O(k log k) for k corners.
pub(in crate::plane) fn are_border(rings: &[Vec<[f64; 2]>]) -> bool {
    let is_right = |nesting: &Nesting| nesting.is_counter_clockwise == nesting.depth.is_multiple_of(2);
    rings.iter().all(|ring| !visits_twice(ring)) && nesting(rings).is_ok_and(|all| all.iter().all(is_right))
}

/// Whether a ring has a corner twice. O(k log k).
pub(in crate::plane) fn visits_twice(ring: &[[f64; 2]]) -> bool {
    let mut sorted = ring.to_vec();
    sorting::by(&mut sorted, |p, q| lexicographic(*p, *q));
    sorted.windows(2).any(|pair| pair[0] == pair[1])
}

#[cfg(test)]
mod tests {
    use super::{are_border, each_is_border, is_border, is_convex};

    #[test]
    fn borders_are_simple_and_counter_clockwise() {
        let square = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]];
        let dent = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [1.0, 0.5], [0.0, 2.0]];
        let straight = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [2.0, 2.0]];
        let bow = [[0.0, 0.0], [2.0, 2.0], [2.0, 0.0], [0.0, 2.0]];
        let twice = [[0.0, 0.0], [2.0, 0.0], [1.0, 1.0], [0.0, 0.0], [2.0, 0.0], [1.0, 1.0]];
        let pinched = [[0.0, 0.0], [2.0, 0.0], [1.0, 1.0], [2.0, 2.0], [0.0, 2.0], [1.0, 1.0]];
        let flat = [[0.0, 0.0], [2.0, 0.0], [1.0, 0.0]];
        let spike = [[0.0, 0.0], [2.0, 0.0], [3.0, 0.0], [2.0, 0.0], [2.0, 2.0]];
        let star = [[0.0, 3.0], [-2.0, -2.0], [3.0, 1.0], [-3.0, 1.0], [2.0, -2.0]];
        // A corner that touches a side.
        let touching = [[0.0, 0.0], [2.0, 0.0], [0.0, 1.0], [2.0, 2.0], [0.0, 2.0]];
        let clockwise: Vec<[f64; 2]> = square.into_iter().rev().collect();
        let cases: [(&[[f64; 2]], bool, bool); 11] = [
            (&touching, false, false),
            (&square, true, true),
            (&dent, false, true),
            (&straight, false, true),
            (&bow, false, false),
            (&twice, false, false),
            (&pinched, false, false),
            (&flat, false, false),
            (&spike, false, false),
            (&star, false, false),
            (&clockwise, false, false),
        ];
        for (ring, convex, border) in cases {
            for turn in 0..ring.len() {
                let mut turned = ring.to_vec();
                turned.rotate_left(turn);
                assert_eq!(is_convex(turned.iter().copied()), convex, "{turned:?}");
                assert_eq!(is_border(turned.iter().copied(), |_| false), border, "{turned:?}");
            }
        }
    }

    #[test]
    fn rings_together_touch_in_corners_at_most() {
        let square =
            |x: f64, y: f64, size: f64| vec![[x, y], [x + size, y], [x + size, y + size], [x, y + size]];
        let turned = |ring: Vec<[f64; 2]>| ring.into_iter().rev().collect::<Vec<_>>();
        let outer = square(0.0, 0.0, 4.0);
        for (others, expected) in [
            (vec![square(5.0, 0.0, 1.0)], true),
            (vec![square(4.0, 4.0, 1.0)], true),
            (vec![square(3.0, 3.0, 2.0)], false),
            (vec![square(1.0, 1.0, 1.0)], false),
            (vec![turned(square(1.0, 1.0, 1.0))], true),
            (vec![turned(square(1.0, 1.0, 2.0)), square(1.5, 1.5, 0.5)], true),
            (vec![turned(square(5.0, 0.0, 1.0))], false),
        ] {
            let all: Vec<_> = std::iter::once(outer.clone()).chain(others).collect();
            assert_eq!(are_border(&all), expected, "{all:?}");
        }
        assert!(each_is_border(&[outer.clone(), square(1.0, 1.0, 1.0)]));
        assert!(!each_is_border(&[outer, turned(square(1.0, 1.0, 1.0))]));
    }
}
