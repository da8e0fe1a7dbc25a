//! Cells around the origin for points at very many magnitudes: one sort where keys would need dozens.
//!
//! At the origin alone boxes of doubles can nest hundreds of times; elsewhere their 53 bits are soon used up. Keys of a
//! box in which most points are near to the origin find one crowded cell, whose box is as crowded again. Exponents
//! tell at once in which of these boxes a point is: around each corner that the four quadrants have at the origin, squares
//! shrink by a power of two from *level* to level, and what is between two squares is cut into two blocks: one beyond the
//! smaller square along x, and one above or below the smaller square.
//!
//! Cost: O(1) a point, O(log n) for a sample.

use crate::points::Bounds;

/// As many levels as cuts of a byte and one digit of the sort can hold.
const LEVELS: i32 = 120;

/// Bits of the slot of a cell in its quadrant.
const SLOT_BITS: u32 = 9;

/// Squares around the origin.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shells {
    /// The biased exponent of the largest coordinate.
    largest: i32,
    /// Exponents a level.
    width: i32,
    /// How many squares are cut out of each other.
    levels: i32,
    extent: [f64; 2],
}

impl Shells {
    /// For points of which each middle quarter of a sample has more magnitudes than a quarter of the bits of a key. `None` for others.
    pub(super) fn around(points: &[[f64; 2]], bounds: &Bounds<2>, bits: u32) -> Option<Self> {
        const SAMPLE: usize = 64;
        let taken = points.len().min(SAMPLE);
        let mut sample = [0; SAMPLE];
        for (k, exponent) in sample.iter_mut().enumerate().take(taken) {
            *exponent = exponents(points[k * points.len() / taken]).into_iter().max()?;
        }
        let sample = &mut sample[..taken];
        sample.sort_unstable();
        // Two clusters have two magnitudes, one of them between quartiles.
        let [first, second, third] = [1, 2, 3].map(|quarter| sample[quarter * taken / 4]);
        if (second - first).min(third - second) <= (bits as i32 / 4).max(2) {
            return None;
        }
        let largest = exponents(bounds.low).into_iter().chain(exponents(bounds.high)).max()?;
        // A few at the very origin would make all levels wide.
        let range = largest - sample[taken / 16] + 1;
        let width = (range + LEVELS - 1) / LEVELS;
        let extent = [0, 1].map(|k| bounds.high[k] - bounds.low[k]);
        Some(Self { largest, width, levels: (range + width - 1) / width, extent })
    }

    /// The bits of a key.
    pub(super) const KEY_BITS: u32 = 2 + SLOT_BITS;

    /// The deepest cut is above this depth.
    pub(super) fn depth(&self) -> u32 {
        2 + 2 * self.levels as u32
    }

    /// The place of a point's cell among all in Morton order: the quadrant, then the slot. Blocks on the way to the origin
    /// have slots from 0 up, those behind it from `4 * levels` down, and what is in the smallest square is between them.
    #[inline]
    pub(super) fn key(&self, p: [f64; 2]) -> u32 {
        const { assert!(4 * LEVELS < 1 << SLOT_BITS) };
        let level = exponents(p).map(|exponent| (self.largest - exponent) / self.width);
        let outermost = level[0].min(level[1]);
        let after = p.map(|x| u32::from(x >= 0.0));
        let quadrant = after[0] << 1 | after[1];
        let slot = if outermost >= self.levels {
            2 * self.levels
        } else {
            let axis = usize::from(level[0] > level[1]);
            let depth = 2 * outermost + axis as i32;
            if after[axis] == 1 { 4 * self.levels - depth } else { depth }
        };
        quadrant << SLOT_BITS | slot as u32
    }

    /// The depth of the cut between two keys. Even ones are by x.
    #[inline]
    pub(super) fn cut(&self, left: u32, right: u32) -> u32 {
        match (left ^ right) >> SLOT_BITS {
            0 => {
                let depth = |key: u32| {
                    let slot = key & ((1 << SLOT_BITS) - 1);
                    slot.min(4 * self.levels as u32 - slot)
                };
                2 + depth(left).min(depth(right))
            }
            1 => 1,
            _ => 0,
        }
    }

    /// Upper bounds on width and height of what a cut of some depth divides.
    pub(super) fn block(&self, depth: u32) -> [f64; 2] {
        let side = |cuts: u32| self.side((cuts as i32 - 1).max(0) * self.width);
        let sides = if depth < 2 { [f64::INFINITY; 2] } else { [side(depth.div_ceil(2)), side(depth / 2)] };
        [0, 1].map(|k| self.extent[k].min(sides[k]))
    }

    /// The side of the squares, or more, that are so many exponents below the largest.
    fn side(&self, below: i32) -> f64 {
        match self.largest - below + 1 {
            2047.. => f64::INFINITY,
            biased => f64::from_bits((biased.max(1) as u64) << 52),
        }
    }
}

/// The biased exponents of coordinates.
#[inline]
fn exponents(p: [f64; 2]) -> [i32; 2] {
    p.map(|x| (x.to_bits() >> 52) as i32 & 0x7ff)
}

#[cfg(test)]
mod tests {
    use super::Shells;
    use crate::points::Bounds;
    use delone_generators::Kind;

    fn shells(points: &[[f64; 2]]) -> Option<Shells> {
        Shells::around(points, &Bounds::of(points.iter().copied()), 10)
    }

    #[test]
    fn only_many_magnitudes_have_shells() {
        for &kind in Kind::ALL {
            let points = kind.points(10_000, 1);
            assert_eq!(shells(&points).is_some(), kind.is_extreme(), "{}", kind.name());
        }
    }

    /// Any two cells are separated by their cut, along its axis, and are in the block that it divides.
    #[test]
    fn keys_are_ordered_by_their_cuts() {
        for kind in [Kind::HugeSpan, Kind::Octaves, Kind::Hub, Kind::NestedInstance] {
            let mut points = kind.points(300, 2);
            points.extend([[0.0, 0.0], [-0.0, 5e-324], [f64::MAX, f64::MIN], [0.0, -f64::MAX]]);
            let shells = shells(&points).expect("magnitudes");
            assert!(shells.depth() < 247);
            for (p, q) in points.iter().flat_map(|p| points.iter().map(move |q| (*p, *q))) {
                let (left, right) = (shells.key(p), shells.key(q));
                if left < right {
                    let depth = shells.cut(left, right);
                    assert!(depth < shells.depth());
                    let axis = depth as usize % 2;
                    assert!(p[axis] < q[axis], "{p:?} {q:?}");
                    let block = shells.block(depth);
                    assert!((0..2).all(|k| (p[k] - q[k]).abs() <= block[k]), "{p:?} {q:?} {block:?}");
                }
            }
        }
    }
}
