//! Cells around the origin for points at very many magnitudes: one sort where keys would need dozens.
//!
//! At the origin alone boxes of doubles can nest hundreds of times; elsewhere their 53 bits are soon used up. Keys of a
//! box in which most points are near to the origin find one crowded cell, whose box is as crowded again. Exponents
//! tell at once in which of these boxes a point is: squares around the origin halve from *level* to level, and what is
//! between two squares is cut into four blocks, like the blades of a pinwheel: left of the smaller square, below it, right of
//! it and above it.
//!
//! Cost: O(1) a point, O(1) for a sample.

use crate::points::Bounds;

/// The cuts of a level.
const BLADES: u32 = 4;

/// The levels of a box: its cuts are counted by a byte.
const LEVELS: u32 = 60;

/// The depths at which a box is cut. The smallest square of one is the box of the next.
pub(super) const DEPTHS: u32 = BLADES * LEVELS;

/// Squares around the origin.
#[derive(Clone, Copy, Debug)]
pub(super) struct Exponents {
    /// The biased exponent of the largest coordinate.
    largest: u32,
    /// The cuts of all levels.
    depth: u32,
    extent: [f64; 2],
}

impl Exponents {
    /// For many points of which each middle quarter of a sample has more magnitudes than a quarter of the bits of a key.
    /// `None` for others.
    pub(super) fn around(points: &[[f64; 2]], bounds: &Bounds<2>, bits: u32) -> Option<Self> {
        const SAMPLE: usize = 64;
        // A few are sorted by keys in no time, however deep.
        if points.len() < 2 * SAMPLE {
            return None;
        }
        // Sorted as the words that are sorted elsewhere, by the same code.
        let mut sample = [0_u64; SAMPLE];
        for (k, exponent) in sample.iter_mut().enumerate() {
            *exponent = exponents(points[k * points.len() / SAMPLE]).into_iter().max()?.into();
        }
        sample.sort_unstable();
        let sample = sample.map(|exponent| exponent as u32);
        // Two clusters have two magnitudes, one of them between quartiles.
        let [first, second, third] = [1, 2, 3].map(|quarter| sample[quarter * SAMPLE / 4]);
        if (second - first).min(third - second) <= (bits / 4).max(2) {
            return None;
        }
        let largest = exponents(bounds.low).into_iter().chain(exponents(bounds.high)).max()?;
        let extent = [0, 1].map(|k| bounds.high[k] - bounds.low[k]);
        Some(Self { largest, depth: BLADES * (largest + 1 - sample[0]), extent })
    }

    /// The bits of a key.
    pub(super) const KEY_BITS: u32 = 14;

    /// The place of a point's block among all: blocks before the smaller squares are numbered from 0 up by the depth of
    /// their cuts, those behind them from twice the last depth down, and what is in the smallest square is between.
    #[inline]
    pub(super) fn key(&self, p: [f64; 2]) -> u32 {
        const { assert!(2 * BLADES * 2047 < 1 << Self::KEY_BITS) };
        let exponents = exponents(p);
        let largest = exponents[0].max(exponents[1]);
        let first = BLADES * (self.largest - largest);
        if first >= self.depth {
            return self.depth;
        }
        let [is_beside, is_beyond] = exponents.map(|exponent| exponent == largest);
        match [is_beside && p[0] < 0.0, is_beyond && p[1] < 0.0, is_beside] {
            [true, ..] => first,
            [_, true, _] => first + 1,
            [.., true] => 2 * self.depth - (first + 2),
            _ => 2 * self.depth - (first + 3),
        }
    }

    /// The depth of the cut between two keys. Even ones are by x.
    #[inline]
    pub(super) fn cut(&self, left: u32, right: u32) -> u32 {
        let depth = |key: u32| key.min(2 * self.depth - key);
        depth(left).min(depth(right))
    }

    /// The squares from some box on, and the first and the last key in it. `None` if there are not so many boxes.
    pub(super) fn nth_box(&self, k: u32) -> Option<(Self, [u32; 2])> {
        let first = k * DEPTHS;
        let depth = self.depth.checked_sub(first).filter(|&rest| rest > 0)?;
        Some((Self { largest: self.largest - k * LEVELS, depth, ..*self }, [first, 2 * self.depth - first]))
    }

    /// Upper bounds on width and height of what a cut of some depth below [`DEPTHS`] divides.
    pub(super) fn block(&self, depth: u32) -> [f64; 2] {
        let [half, next] = [0, 1].map(|below| self.half(depth / BLADES + below));
        let sides = match depth % BLADES {
            0 => [2.0 * half, 2.0 * half],
            1 => [half + next, 2.0 * half],
            2 => [half + next, half + next],
            _ => [2.0 * next, half + next],
        };
        [0, 1].map(|k| self.extent[k].min(sides[k]))
    }

    /// Half the side, or more, of the square of a level.
    fn half(&self, level: u32) -> f64 {
        match (self.largest + 1).saturating_sub(level) {
            2047.. => f64::INFINITY,
            biased => f64::from_bits(u64::from(biased.max(1)) << 52),
        }
    }
}

/// The biased exponents of coordinates.
#[inline]
fn exponents(p: [f64; 2]) -> [u32; 2] {
    p.map(|x| (x.to_bits() >> 52) as u32 & 0x7ff)
}

#[cfg(test)]
mod tests {
    use super::Exponents;
    use crate::points::Bounds;
    use delone_generators::Kind;

    fn exponents(points: &[[f64; 2]]) -> Option<Exponents> {
        Exponents::around(points, &Bounds::of(points.iter().copied()), 10)
    }

    #[test]
    fn only_many_magnitudes_have_shells() {
        for &kind in Kind::ALL {
            let points = kind.points(10_000, 1);
            assert_eq!(exponents(&points).is_some(), kind.is_extreme(), "{}", kind.name());
        }
    }

    /// Any two cells are separated by their cut, along its axis, and are in the block that it divides.
    #[test]
    fn keys_are_ordered_by_their_cuts() {
        for kind in [Kind::HugeSpan, Kind::Octaves, Kind::Hub, Kind::NestedInstance] {
            let mut points = kind.points(300, 2);
            points.extend([[0.0, 0.0], [-0.0, 5e-324], [f64::MAX, f64::MIN], [0.0, -f64::MAX]]);
            let exponents = exponents(&points).expect("magnitudes");
            for (p, q) in points.iter().flat_map(|p| points.iter().map(move |q| (*p, *q))) {
                let (left, right) = (exponents.key(p), exponents.key(q));
                if left < right {
                    let depth = exponents.cut(left, right);
                    assert!(depth < exponents.depth);
                    let axis = depth as usize % 2;
                    assert!(p[axis] < q[axis], "{p:?} {q:?}");
                    let block = exponents.block(depth);
                    assert!((0..2).all(|k| (p[k] - q[k]).abs() <= block[k]), "{p:?} {q:?} {block:?}");
                }
            }
        }
    }
}
