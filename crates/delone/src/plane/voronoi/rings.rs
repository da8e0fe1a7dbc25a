//! Whether a ring of rounded corners is the border of something, and the rings that it falls apart into.
//!
//! Rings that all are such borders, and share the sides between them, cover their region without gaps or overlaps: how often a
//! point is wound around by all rings together is how often it is by the region's border.
//!
//! All decisions are exact.

use delone_predicates::{lexicographic, orient2d};

use crate::plane::region::sweep::are_in_conflict;
use crate::sorting;

/// Whether a ring of at least three corners, of which some are known to be exact, is simple and counter-clockwise. The ring of exact
/// corners that it stands for is simple.
///
/// O(k) for a convex ring of k corners, which nearly all are, O(r k) for others with r corners that are not exact.
#[inline]
pub(super) fn is_border(
    ring: impl ExactSizeIterator<Item = [f64; 2]> + Clone,
    is_exact: impl Fn(usize) -> bool,
) -> bool {
    is_convex(ring.clone()) || is_simple(&ring.collect::<Vec<_>>(), &is_exact)
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

/// Whether a ring is simple and counter-clockwise: each side with an end that is not exact against all others.
#[cold]
#[inline(never)]
pub(super) fn is_simple(ring: &[[f64; 2]], is_exact: &dyn Fn(usize) -> bool) -> bool {
    let count = ring.len();
    let after = |i: usize| if i + 1 == count { 0 } else { i + 1 };
    let side = |i: usize| [ring[i], ring[after(i)]];
    let is_apart = |[p, q]: [[f64; 2]; 2], [s, t]: [[f64; 2]; 2]| {
        let beyond = |k: usize| p[k].max(q[k]) < s[k].min(t[k]) || s[k].max(t[k]) < p[k].min(q[k]);
        beyond(0) || beyond(1)
    };
    for i in (0..count).filter(|&i| !(is_exact(i) && is_exact(after(i)))) {
        for j in (0..count).filter(|&j| j != i) {
            // Corners are visited once.
            if ring[j] == ring[i] || (!is_apart(side(i), side(j)) && are_in_conflict(side(i), side(j))) {
                return false;
            }
        }
    }
    // A simple ring turns left at its least corner, or else right.
    let least = (0..count).min_by(|&i, &j| lexicographic(ring[i], ring[j])).unwrap_or(0);
    let before = if least == 0 { count - 1 } else { least - 1 };
    orient2d(ring[before], ring[least], ring[after(least)]).is_positive()
}

/// The rings that a ring falls apart into where it visits a corner again, by the indices of its corners; what has fewer than three corners
/// is gone.
pub(super) fn parts(ring: &[u32], vertices: &[[f64; 2]]) -> Vec<Vec<u32>> {
    let at = |i: &u32| vertices[*i as usize];
    let mut sorted = ring.to_vec();
    sorting::by(&mut sorted, |i, j| lexicographic(at(i), at(j)));
    let mut parts = Vec::new();
    let mut open: Vec<u32> = Vec::new();
    if sorted.windows(2).all(|pair| at(&pair[0]) != at(&pair[1])) {
        open.extend(ring);
    } else {
        for corner in ring {
            if let Some(start) = open.iter().position(|other| at(other) == at(corner)) {
                parts.push(open.split_off(start));
            }
            open.push(*corner);
        }
    }
    parts.push(open);
    parts.retain(|part| part.len() > 2);
    parts
}

#[cfg(test)]
mod tests {
    use super::{is_border, is_convex, parts};

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
    fn rings_fall_apart_where_they_meet_themselves() {
        // Two vertices of each place.
        let vertices: Vec<[f64; 2]> = (0..20).map(|i| [f64::from(i % 10), 0.0]).collect();
        let of = |ring: &[u32]| {
            let other: Vec<u32> = ring.iter().enumerate().map(|(k, i)| i + 10 * (k as u32 % 2)).collect();
            let parts = parts(&other, &vertices);
            parts
                .into_iter()
                .map(|part| part.into_iter().map(|i| i % 10).collect())
                .collect::<Vec<Vec<u32>>>()
        };
        assert_eq!(of(&[1, 2, 3, 4]), [[1, 2, 3, 4]]);
        // A spike goes, and a side that is gone and come again.
        assert_eq!(of(&[1, 2, 3, 2, 4]), [[1, 2, 4]]);
        assert_eq!(of(&[1, 2, 1, 2]), Vec::<Vec<u32>>::new());
        assert_eq!(of(&[1, 2, 2, 3, 3, 1]), [[1, 2, 3]]);
        assert_eq!(of(&[1, 2, 3, 1, 4, 5]), [[1, 2, 3], [1, 4, 5]]);
    }
}
