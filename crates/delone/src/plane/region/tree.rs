//! A polygon cut into a tree of boxes, each with its part, so that a cell looks at what is near it.
//!
//! Boxes are cut at the median corner of their sides, across the longer extent or, where that does not part the sides, across
//! the other one. Parts are exact.
//!
//! Cost: O(m log m) typical for m sides.

use delone_predicates::{Line, Spot, orient2d};

use super::clip::{Corner, Ring, clip};

/// Sides, up to which a box is not cut further.
const LEAF_SIDES: usize = 8;
/// The deepest box.
const DEEPEST: u32 = 48;

/// A box with its part of the polygon.
#[derive(Clone, Debug)]
pub(in crate::plane) struct Node {
    pub(in crate::plane) rings: Vec<Ring>,
    /// Whether the part is all of the box, as of a rectangle. What a polygon is cut into has sides.
    pub(in crate::plane) full: bool,
    /// The axis and the coordinate of the cut, and what is below and above.
    halves: Option<(usize, f64, Box<[Node; 2]>)>,
}

/// How a box lies to a region.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::plane) enum Relation {
    Inside,
    Outside,
    /// Or too near to a side to tell.
    Across,
}

impl Node {
    /// The tree of a polygon.
    pub(in crate::plane) fn new(rings: Vec<Ring>) -> Self {
        Self::at_depth(rings, 0)
    }

    /// A box that is all of the region.
    pub(in crate::plane) fn whole(ring: Ring) -> Self {
        Self { rings: vec![ring], full: true, halves: None }
    }

    fn at_depth(rings: Vec<Ring>, depth: u32) -> Self {
        let is_side = |corner: &&Corner| corner.side.is_some();
        let count = |rings: &[Ring]| rings.iter().flatten().filter(is_side).count();
        let side_count = count(&rings);
        if side_count <= LEAF_SIDES || depth == DEEPEST {
            return Self { rings, full: false, halves: None };
        }
        // Where to cut is no decision about the polygon, so roughly is enough.
        let sides = rings.iter().flatten().filter(is_side);
        let corners: Vec<[f64; 2]> = sides.filter_map(|corner| corner.spot.rounded()).collect();
        let extent = |axis: usize| {
            let coordinates = corners.iter().map(|c| c[axis]);
            coordinates.clone().fold(f64::MIN, f64::max) - coordinates.fold(f64::MAX, f64::min)
        };
        let longer = usize::from(extent(1) > extent(0));
        for axis in [longer, 1 - longer] {
            let mut coordinates: Vec<f64> = corners.iter().map(|corner| corner[axis]).collect();
            let middle = coordinates.len() / 2;
            if coordinates.is_empty() {
                break;
            }
            let at = *coordinates.select_nth_unstable_by(middle, f64::total_cmp).1;
            let halves = [Line::Below(axis, at), Line::Above(axis, at)].map(|half| clip(rings.clone(), half));
            let counts = halves.each_ref().map(|half| count(half));
            // Sides that all go across, like the teeth of a comb, may be apart along the other axis, unless they are aslant.
            let are_apart = axis == longer || 2 * (counts[0] + counts[1]) <= 3 * side_count;
            if are_apart && counts.iter().all(|&count| count < side_count) {
                let halves = halves.map(|half| Self::at_depth(half, depth + 1));
                return Self { rings, full: false, halves: Some((axis, at, Box::new(halves))) };
            }
        }
        Self { rings, full: false, halves: None }
    }

    /// The smallest box of the tree that contains one, which is inside of the whole.
    #[inline]
    pub(in crate::plane) fn around(&self, low: [f64; 2], high: [f64; 2]) -> &Self {
        let mut node = self;
        while let Some((axis, at, halves)) = &node.halves {
            if high[*axis] <= *at {
                node = &halves[0];
            } else if low[*axis] >= *at {
                node = &halves[1];
            } else {
                break;
            }
        }
        node
    }

    /// The smallest box of the tree that contains rings, which are inside of a box of numbers, with what touches them. Exact.
    pub(in crate::plane) fn around_rings(&self, rings: &[Ring], low: [f64; 2], high: [f64; 2]) -> &Self {
        let mut node = self.around(low, high);
        while let Some((axis, at, halves)) = &node.halves {
            let within = |half: Line| rings.iter().flatten().all(|c| half.side(&c.spot).is_positive());
            if within(Line::Below(*axis, *at)) {
                node = &halves[0];
            } else if within(Line::Above(*axis, *at)) {
                node = &halves[1];
            } else {
                break;
            }
        }
        node
    }

    /// How what is in a box lies to the part of the polygon, if no side comes near. `sides` are those of the region.
    pub(in crate::plane) fn relation(
        &self,
        sides: &[[[f64; 2]; 2]],
        low: [f64; 2],
        high: [f64; 2],
    ) -> Relation {
        if self.full {
            return Relation::Inside;
        }
        let own = self.rings.iter().flatten().filter_map(|corner| sides.get(corner.side?));
        if own.into_iter().any(|&side| !keeps_off(side, low, high)) {
            return Relation::Across;
        }
        // All or nothing of the box: as its middle, which is on no edge of the part.
        let middle = [0, 1].map(|axis| low[axis] / 2.0 + high[axis] / 2.0);
        if self.contains(middle) { Relation::Inside } else { Relation::Outside }
    }

    /// Whether a point that is on no edge is in the part. Exact.
    fn contains(&self, p: [f64; 2]) -> bool {
        let mut inside = false;
        for ring in &self.rings {
            let is_above = |corner: &Corner| Line::Above(1, p[1]).side(&corner.spot).is_positive();
            let Some(mut from) = ring.first().map(is_above) else { continue };
            for (i, edge) in ring.iter().enumerate() {
                let to = is_above(ring.get(i + 1).unwrap_or(&ring[0]));
                if to != from {
                    let side = edge.line.side(&Spot::Point(p));
                    inside ^= if to { side.is_positive() } else { side.is_negative() };
                }
                from = to;
            }
        }
        inside
    }
}

/// Whether a side surely shares no point with a box.
fn keeps_off([p, q]: [[f64; 2]; 2], low: [f64; 2], high: [f64; 2]) -> bool {
    let beside = |k: usize| p[k].max(q[k]) < low[k] || high[k] < p[k].min(q[k]);
    if beside(0) || beside(1) {
        return true;
    }
    let corners = [low, [high[0], low[1]], high, [low[0], high[1]]];
    let first = orient2d(p, q, low);
    !first.is_zero() && corners.iter().all(|&corner| orient2d(p, q, corner) == first)
}

#[cfg(test)]
mod tests {
    use super::{LEAF_SIDES, Node, keeps_off};
    use crate::plane::region::clip::{Corner, sides};

    /// The sides of all smallest boxes.
    fn all(node: &Node) -> usize {
        let own = || node.rings.iter().flatten().filter(|corner: &&Corner| corner.side.is_some()).count();
        node.halves.as_ref().map_or_else(own, |(_, _, halves)| halves.iter().map(all).sum())
    }

    fn ellipse(n: u32, at: [f64; 2], [width, height]: [f64; 2]) -> Vec<[f64; 2]> {
        let angle = |k: u32| std::f64::consts::TAU * (f64::from(k) + 0.3) / f64::from(n);
        (0..n).map(|k| [at[0] + width * angle(k).cos(), at[1] + height * angle(k).sin()]).collect()
    }

    #[test]
    fn boxes_are_cut_across_their_longer_extent() {
        for at in [[0.0, 0.0], [1000.0, 0.0], [-20.0, 1000.0], [1000.0, -1000.0], [77.0, 77.0]] {
            for (size, axis) in [([7.0, 5.0], 0), ([5.0, 7.0], 1), ([5.0, 1.0], 0), ([1.0, 5.0], 1)] {
                let node = Node::new(vec![sides(&ellipse(40, at, size), 0)]);
                assert_eq!(node.halves.map(|(axis, ..)| axis), Some(axis), "{at:?} {size:?}");
            }
        }
    }

    #[test]
    fn a_few_sides_are_not_cut() {
        assert!(
            Node::new(vec![sides(&ellipse(LEAF_SIDES as u32, [0.0; 2], [5.0, 1.0]), 0)]).halves.is_none()
        );
        assert!(
            Node::new(vec![sides(&ellipse(LEAF_SIDES as u32 + 1, [0.0; 2], [5.0, 1.0]), 0)]).halves.is_some()
        );
    }

    /// Most teeth of a comb aslant are on both sides of every cut: it is left as it is.
    #[test]
    fn sides_aslant_do_not_multiply() {
        let tooth = |y: f64| [[0.0, y], [1000.0, y + 200.0], [1000.0, y + 200.4], [0.0, y + 0.4]];
        let mut comb: Vec<[f64; 2]> = (0..300).flat_map(|i| tooth(f64::from(i))).collect();
        comb.extend([[-1.0, 300.0], [-1.0, 0.0]]);
        let upright: Vec<[f64; 2]> = comb.iter().rev().map(|&[x, y]| [y, x]).collect();
        for ring in [comb, upright] {
            let found = all(&Node::new(vec![sides(&ring, 0)]));
            assert!(found < 2 * ring.len(), "{found} sides of {}", ring.len());
        }
    }

    /// The smallest box around rings is found from any box around them.
    #[test]
    fn rings_are_in_the_smallest_box_around_them() {
        let whole = Node::new(vec![sides(&ellipse(400, [0.0; 2], [5.0, 3.0]), 0)]);
        let mut parts = 0;
        for i in 0..400 {
            let [x, y] = [0.5 * f64::from(i % 20) - 5.0, 0.3 * f64::from(i / 20) - 3.0];
            let (low, high) = ([x, y], [x + 0.01, y + 0.01]);
            let ring = sides(&[low, [high[0], low[1]], high, [low[0], high[1]]], 0);
            let expected = whole.around(low, high);
            let found = whole.around_rings(&[ring], [-5.0, -3.0], [5.0, 3.0]);
            assert!(std::ptr::eq(found, expected), "{x} {y}");
            parts += usize::from(found.halves.is_none());
        }
        assert!(parts > 300, "{parts}");
    }

    #[test]
    fn sides_keep_off_a_box_or_not() {
        let off = |p: [f64; 2], q: [f64; 2]| {
            let found = keeps_off([p, q], [1.0, 2.0], [4.0, 8.0]);
            assert_eq!(found, keeps_off([q, p], [1.0, 2.0], [4.0, 8.0]), "{p:?} {q:?}");
            found
        };
        // Beside it, to the left, the right, below, above, on a line through it or not; and past each corner.
        assert!(off([0.0, 3.0], [0.5, 4.0]) && off([5.0, 3.0], [9.0, 4.0]));
        assert!(off([2.0, 0.0], [3.0, 1.0]) && off([2.0, 9.0], [3.0, 10.0]));
        assert!(off([0.0, 4.0], [0.9, 1.0]) && off([0.0, 9.0], [9.0, 8.1]));
        assert!(off([0.0, 2.9], [1.9, 1.0]) && off([3.1, 1.0], [5.0, 2.9]));
        assert!(off([0.0, 7.1], [1.9, 9.0]) && off([3.1, 9.0], [5.0, 7.1]));
        // Across, inside, and touching a side or a corner.
        assert!(!off([0.0, 3.0], [9.0, 5.0]) && !off([2.0, 3.0], [3.0, 4.0]));
        assert!(!off([0.0, 3.0], [1.0, 4.0]) && !off([4.0, 3.0], [9.0, 4.0]));
        assert!(!off([2.0, 0.0], [3.0, 2.0]) && !off([2.0, 8.0], [3.0, 10.0]));
        assert!(!off([0.0, 3.0], [2.0, 1.0]) && !off([3.0, 1.0], [5.0, 3.0]));
        assert!(!off([0.0, 7.0], [2.0, 9.0]) && !off([3.0, 9.0], [5.0, 7.0]));
    }

    /// The most sides that a smallest box has.
    fn most(node: &Node) -> usize {
        let own = || node.rings.iter().flatten().filter(|corner: &&Corner| corner.side.is_some()).count();
        node.halves.as_ref().map_or_else(own, |(_, _, halves)| halves.iter().map(most).max().unwrap_or(0))
    }

    /// The teeth of a comb all go across the longer extent, with corners at both ends of it.
    #[test]
    fn combs_are_cut_between_their_teeth() {
        for teeth in [10, 100, 500] {
            let tooth = |i: u32| [[0.0, f64::from(i)], [1000.0, f64::from(i) + 0.5]];
            let mut comb: Vec<[f64; 2]> = (0..teeth).flat_map(tooth).collect();
            comb.extend([[-1.0, f64::from(teeth)], [-1.0, 0.0]]);
            let upright: Vec<[f64; 2]> = comb.iter().rev().map(|&[x, y]| [y, x]).collect();
            for ring in [comb, upright] {
                let found = most(&Node::new(vec![sides(&ring, 0)]));
                assert!(found <= LEAF_SIDES, "{found} sides in a box, {teeth} teeth");
            }
        }
    }
}
