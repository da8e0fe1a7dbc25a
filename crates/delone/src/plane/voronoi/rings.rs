//! Whether a ring of rounded corners is the border of something, and the rings that it falls apart into.
//!
//! Rings that all are such borders, and share the sides between them, cover their region without gaps or overlaps: how often a
//! point is wound around by all rings together is how often it is by the region's border.
//!
//! All decisions are exact.

use std::collections::BTreeMap;

use delone_predicates::{lexicographic, orient2d};

use crate::plane::region::sweep::nesting;
use crate::sorting;

/// A corner, in lexicographic order.
#[derive(Clone, Copy, Debug)]
pub(super) struct At(pub(super) [f64; 2]);

impl Ord for At {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        lexicographic(self.0, other.0)
    }
}

impl PartialOrd for At {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for At {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for At {}

/// Whether a ring of at least three corners is simple and counter-clockwise.
///
/// O(k) for a convex ring of k corners, which nearly all are, O(k log k) for others.
#[inline]
pub(super) fn is_border(ring: impl ExactSizeIterator<Item = [f64; 2]> + Clone) -> bool {
    is_convex(ring.clone()) || is_simple(ring.collect())
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

#[cold]
#[inline(never)]
fn is_simple(ring: Vec<[f64; 2]>) -> bool {
    let mut sorted: Vec<At> = ring.iter().copied().map(At).collect();
    sorting::by(&mut sorted, At::cmp);
    let visits_twice = sorted.windows(2).any(|pair| pair[0] == pair[1]);
    !visits_twice && nesting(&[ring]).is_ok_and(|nesting| nesting[0].is_counter_clockwise)
}

/// The rings that a ring falls apart into where it visits a corner again; what has fewer than three corners is gone.
pub(super) fn parts(ring: impl IntoIterator<Item = At>) -> Vec<Vec<At>> {
    let (mut parts, mut open, mut position) = (Vec::new(), Vec::new(), BTreeMap::new());
    for at in ring {
        if let Some(&start) = position.get(&at) {
            let part: Vec<At> = open.split_off(start);
            position.retain(|_, i| *i < start);
            parts.push(part);
        }
        position.insert(at, open.len());
        open.push(at);
    }
    parts.push(open);
    parts.retain(|part| part.len() > 2);
    parts
}

#[cfg(test)]
mod tests {
    use super::{At, is_border, is_convex, parts};

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
                assert_eq!(is_border(turned.iter().copied()), border, "{turned:?}");
            }
        }
    }

    #[test]
    fn rings_fall_apart_where_they_meet_themselves() {
        let of = |ring: &[u8]| -> Vec<Vec<u8>> {
            let parts = parts(ring.iter().map(|&k| At([f64::from(k), 0.0])));
            parts.into_iter().map(|part| part.into_iter().map(|At([x, _])| x as u8).collect()).collect()
        };
        assert_eq!(of(&[1, 2, 3, 4]), [[1, 2, 3, 4]]);
        // A spike goes, and a side that is gone and come again.
        assert_eq!(of(&[1, 2, 3, 2, 4]), [[1, 2, 4]]);
        assert_eq!(of(&[1, 2, 1, 2]), Vec::<Vec<u8>>::new());
        assert_eq!(of(&[1, 2, 2, 3, 3, 1]), [[1, 2, 3]]);
        assert_eq!(of(&[1, 2, 3, 1, 4, 5]), [[1, 2, 3], [1, 4, 5]]);
    }
}
