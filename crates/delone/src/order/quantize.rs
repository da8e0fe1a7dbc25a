//! Coordinates to the integer cells of a square, monotonically: x <= y implies cell(x) <= cell(y).
//!
//! Monotone rounding is all that the orders need: a cut between two cells then separates the points
//! strictly, whatever the rounding did to the cells' borders.

use std::ops::Range;

use crate::parallel;

/// A square of 2^bits x 2^bits cells around some points.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Quantizer {
    low: [f64; 2],
    /// 1/2 where the extent of the points overflows, else 1.
    half: f64,
    /// Two factors, because their product overflows when the extent is subnormal.
    scale: [f64; 2],
    last: u32,
    /// The larger side of the bounding box, in `half` units.
    side: f64,
    /// Both sides of the bounding box.
    extent: [f64; 2],
}

impl Quantizer {
    /// Cells for the points inside a bounding box. `None` if the box is a single point.
    pub(crate) fn new(low: [f64; 2], high: [f64; 2], bits: u32) -> Option<Self> {
        let extent = [high[0] - low[0], high[1] - low[1]];
        let half = if extent[0].max(extent[1]).is_finite() { 1.0 } else { 0.5 };
        let side = (high[0] * half - low[0] * half).max(high[1] * half - low[1] * half);
        if side == 0.0 {
            return None;
        }
        // A power of two that brings the smallest subnormal extent into the normal range.
        let lift = if side < 1e-290 { 2f64.powi(200) } else { 1.0 };
        let cells = f64::from(1 << bits);
        let low = low.map(|x| x * half);
        Some(Self { low, half, scale: [lift, cells / (side * lift)], last: (1 << bits) - 1, side, extent })
    }

    /// The column and row of a point's cell.
    #[inline]
    pub(crate) fn cell(&self, p: [f64; 2]) -> [u32; 2] {
        let along = |k: usize| {
            let cell = (p[k] * self.half - self.low[k]) * self.scale[0] * self.scale[1];
            (cell as u32).min(self.last)
        };
        [along(0), along(1)]
    }

    /// Upper bounds on the width and the height of a block of cells, `halvings` of the square in each
    /// direction. The cells' borders are rounded, by far less than the thousandth added here.
    pub(crate) fn block(&self, halvings: [u32; 2]) -> [f64; 2] {
        let side = self.side / self.half * 1.001;
        [0, 1].map(|k| (side / f64::from(1 << halvings[k])).min(self.extent[k]))
    }
}

/// The size of what most points are in: of a sample the middle half, along the axis where it is the longest. A few far points
/// change nothing.
fn usual_size<const D: usize>(count: usize, point: impl Fn(usize) -> [f64; D]) -> f64 {
    const SAMPLE: usize = 64;
    let taken = count.min(SAMPLE);
    let sample: Vec<[f64; D]> = (0..taken).map(|k| point(k * count / taken)).collect();
    let middle = (0..D).map(|axis| {
        // Sorted as the words that are sorted elsewhere, by the same code.
        let mut along: Vec<u64> = sample.iter().map(|p| word(p[axis])).collect();
        along.sort_unstable();
        match taken {
            0 => 0.0,
            _ => number(along[(3 * taken / 4).min(taken - 1)]) - number(along[taken / 4]),
        }
    });
    middle.fold(0.0, f64::max)
}

/// A word for a number: they are ordered alike.
fn word(x: f64) -> u64 {
    let bits = x.to_bits();
    if x.is_sign_negative() { !bits } else { bits | 1 << 63 }
}

/// The number of a word.
fn number(word: u64) -> f64 {
    f64::from_bits(if word >> 63 == 0 { !word } else { word & !(1 << 63) })
}

/// The power of two that brings a size outside of some range near to 1. `None` within the range, and for no size.
pub(crate) fn power_to_one(size: f64, range: &Range<f64>) -> Option<f64> {
    let exponent = ((size.to_bits() >> 52) as i32 - 1023).clamp(-1000, 1000);
    let outside = size > 0.0 && !range.contains(&size);
    outside.then(|| f64::from_bits(((1023 - exponent) as u64) << 52))
}

/// Points that are too far apart or too near to each other for filters that want sets of some sizes, multiplied by a power of two,
/// and the power: decisions do not change. `None` if there is no need to, or a coordinate would lose bits.
pub(crate) fn scaled<const D: usize>(
    count: usize,
    point: impl Fn(usize) -> [f64; D] + Sync,
    sizes: &Range<f64>,
) -> Option<(Vec<[f64; D]>, f64)> {
    let scale = power_to_one(usual_size(count, &point), sizes)?;
    let back = 1.0 / scale;
    let scaled: Vec<[f64; D]> = parallel::collect(count, |i| point(i).map(|x| x * scale));
    let same = |i: usize| scaled[i].map(|x| x * back) == point(i);
    (0..count).all(same).then_some((scaled, scale))
}

#[cfg(test)]
mod tests {
    use super::{Quantizer, number, word};

    #[test]
    fn words_are_ordered_as_numbers_are() {
        let ascending = [f64::MIN, -1.0, -5e-324, -0.0, 0.0, 5e-324, f64::MIN_POSITIVE, 1.0, f64::MAX];
        assert!(ascending.is_sorted_by(|&x, &y| word(x) < word(y)));
        assert!(ascending.iter().all(|&x| number(word(x)).to_bits() == x.to_bits()));
    }

    #[test]
    fn every_range_is_cut_from_end_to_end() {
        for (low, high) in
            [(0.0, 1.0), (-1.0, 1e-300), (f64::MIN, f64::MAX), (0.0, 5e-324), (1.0, 1.0 + 1e-15)]
        {
            let quantizer = Quantizer::new([low; 2], [high; 2], 4).expect("two distinct corners");
            assert_eq!(quantizer.cell([low; 2]), [0, 0], "{low} {high}");
            assert_eq!(quantizer.cell([high; 2]), [15, 15], "{low} {high}");
        }
        assert!(Quantizer::new([2.0; 2], [2.0; 2], 4).is_none());
    }
}
