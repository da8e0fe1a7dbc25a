//! The tree on which divide and conquer works, as cuts between neighbors in an order.
//!
//! Each cut has a depth, counted from the box that holds both its neighbors: the shallowest cut of a run divides it. Depth
//! tells the size of the cell that the cut divides and, by its parity, the axis. The cuts alone are the tree, so no tree is
//! stored.

use bytemuck::Zeroable;

use super::exponents::Exponents;
use super::quantize::Quantizer;

/// Runs of equal keys up to this length are sorted by comparison; longer ones get keys of their own.
pub(super) const SHORT_RUN: usize = 32;

/// One set of keys: the positions it sorted and the geometry of its cells.
#[derive(Clone, Copy, Debug)]
pub(crate) struct KeyBox {
    /// First position in the order.
    pub(crate) start: usize,
    /// One past the last position.
    pub(crate) end: usize,
    pub(super) cells: Cells,
    /// The depth at which keys are used up: of a square, twice the bits an axis.
    pub(super) depth: u32,
}

/// The resolution of the keys of a box.
#[derive(Clone, Copy, Debug)]
pub(super) enum Cells {
    /// Nothing: the box is a single point, or has a few.
    One,
    /// Cells of a square.
    Square(Quantizer),
    /// Blocks around the origin, of all sizes: what is in one has a box of its own.
    Exponents(Exponents),
}

impl KeyBox {
    /// The number of depths at which this box is cut; at the last, keys are equal and the order is
    /// lexicographic.
    pub(crate) fn depths(&self) -> u32 {
        self.depth + 1
    }

    /// Upper bounds on width and height of the cells at a depth, before the cut there.
    pub(crate) fn cell(&self, depth: u32) -> [f64; 2] {
        match &self.cells {
            Cells::One => [0.0; 2],
            Cells::Square(quantizer) => quantizer.block([depth.div_ceil(2), depth / 2]),
            Cells::Exponents(exponents) => exponents.block(depth),
        }
    }

    /// The depth of a cut, an index below [`Self::depths`], and whether it separates by x (else by y).
    pub(crate) fn split(&self, cut: Cut) -> (usize, bool) {
        let depth = u32::from(cut.0 - 1).min(self.depth);
        (depth as usize, depth % 2 == 0)
    }
}

/// The cut between two neighbors: larger is deeper. [`Cut::OUTSIDE`] is shallower than all.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Zeroable)]
pub(crate) struct Cut(u8);

impl Cut {
    /// The border of a box.
    pub(crate) const OUTSIDE: Self = Self(0);
    /// Not decided by keys: both are in one cell.
    pub(super) const SAME_CELL: Self = Self(254);
    /// Before a point that equals the one before it. None is left when sorting is done.
    pub(super) const DUPLICATE: Self = Self(255);

    /// The first of the shallowest of some cuts. In two passes over bytes, which take sixteen at a time.
    pub(crate) fn first_shallowest(cuts: &[Self]) -> Option<usize> {
        let shallowest = cuts.iter().fold(u8::MAX, |least, cut| least.min(cut.0));
        cuts.iter().position(|cut| cut.0 == shallowest)
    }

    /// Between keys of `depth` bits.
    #[inline]
    pub(super) fn between(left: u32, right: u32, depth: u32) -> Self {
        match left ^ right {
            0 => Self::SAME_CELL,
            // Keys that first differ at depth d differ in bit depth - 1 - d.
            differing => Self::at(depth - 1 - differing.ilog2()),
        }
    }

    /// At a depth.
    #[inline]
    pub(super) fn at(depth: u32) -> Self {
        Self((depth + 1) as u8)
    }

    /// Before the `i`th of the points of one cell: balanced, because between two equal numbers of trailing
    /// zeros lies a larger one.
    pub(super) fn within_cell(i: u32, depth: u32) -> Self {
        const { assert!(SHORT_RUN <= 32) };
        Self((depth + 6 - i.trailing_zeros()) as u8)
    }
}
