//! Boxes rescaled by powers of two, where they are too large or too small for the filters of floating point.
//!
//! A power of two changes no decision, and brings the products of a box back into the range where they are sure. One power for
//! all points does so for a set of any size (`order/quantize.rs`); where boxes of all sizes are nested, each needs its own.
//!
//! Cost: O(1) a point.

use std::ops::Range;

use delone_predicates::{Filter, Grid};

use crate::order::cuts::KeyBox;
use crate::order::quantize::power_to_one;
use crate::parallel;

/// Sizes of sets whose products are in the range of the filters, also those of small cells: 2^-80 to 2^200.
pub(super) const SIZES: Range<f64> = 8.3e-25..1.6e60;

/// The points of boxes that are too large or too small for filters, multiplied by a power of two for each box: those in which
/// no other box is nested, where most of the work is.
pub(super) struct Rescaled {
    /// All points. Those of other boxes are as they were.
    pub(super) points: Vec<[f64; 2]>,
    /// For each box the power, 1 if it is as it was.
    pub(super) powers: Vec<f64>,
}

impl Rescaled {
    /// `None` if there is no such box.
    pub(super) fn of(ordered: &[[f64; 2]], boxes: &[KeyBox], scale: f64) -> Option<Self> {
        let power = |(i, b): (usize, &KeyBox)| {
            let holds_boxes = boxes.get(i + 1).is_some_and(|next| next.start < b.end);
            let [width, height] = b.cell(0);
            if holds_boxes { None } else { power_to_one(width.max(height) * scale, &SIZES) }
        };
        let powers: Vec<Option<f64>> = boxes.iter().enumerate().map(power).collect();
        if powers.iter().all(Option::is_none) {
            return None;
        }
        let mut near = Self { points: ordered.to_vec(), powers: vec![1.0; boxes.len()] };
        for ((key_box, power), of_box) in boxes.iter().zip(powers).zip(&mut near.powers) {
            let Some(power) = power else { continue };
            let run = key_box.start..key_box.end;
            let (points, back) = (&mut near.points[run.clone()], 1.0 / power);
            points.iter_mut().for_each(|p| *p = p.map(|x| x * power));
            if points.iter().zip(&ordered[run.clone()]).all(|(p, q)| p.map(|x| x * back) == *q) {
                *of_box = power;
            } else {
                points.copy_from_slice(&ordered[run]);
            }
        }
        Some(near)
    }
}

/// The finest step of a grid on which arithmetic is exact in the smallest cells of some box, about.
pub(super) fn finest_step(boxes: &[KeyBox], scale: f64) -> f64 {
    let finest = |b: &KeyBox| {
        let [width, height] = b.cell(b.depths() - 1);
        Filter::finest_step(width * scale, height * scale)
    };
    boxes.iter().map(finest).fold(f64::INFINITY, f64::min)
}

/// The grid of coordinates if it is coarser than a step. In parallel: the grid of the first part is mostly that of all.
pub(super) fn grid_of(coordinates: &[f64], least: f64) -> Option<Grid> {
    let parts = parallel::parts(coordinates.len() / 2);
    if parts > 1 {
        let mut parts = coordinates.chunks(coordinates.len().div_ceil(parts));
        let first = Grid::coarser_than(least, parts.next()?)?;
        if parallel::map(parts.collect(), |part| first.holds_all(part)).iter().all(|&holds| holds) {
            return Some(first);
        }
    }
    Grid::coarser_than(least, coordinates)
}

#[cfg(test)]
mod tests {
    use delone_generators::Kind;

    use super::*;
    use crate::order::morton;
    use crate::points::survey;

    /// Every box in which no other is nested is brought into the range, and back without loss.
    #[test]
    fn boxes_of_all_sizes_are_near() {
        for kind in [Kind::Octaves, Kind::Nested, Kind::Hub] {
            let points = kind.points(20_000, 1);
            let sorted = morton::sort(&points, &survey(&points).0);
            let near = Rescaled::of(&sorted.points, &sorted.boxes, 1.0).expect("boxes out of range");
            let mut scaled = 0;
            for (i, (key_box, power)) in sorted.boxes.iter().zip(&near.powers).enumerate() {
                if sorted.boxes.get(i + 1).is_some_and(|next| next.start < key_box.end) {
                    assert!(*power == 1.0, "{}: other boxes are in it", kind.name());
                    continue;
                }
                let side = key_box.cell(0).into_iter().fold(0.0, f64::max) * power;
                assert!(side == 0.0 || SIZES.contains(&side), "{}: {side:e}", kind.name());
                scaled += usize::from(*power != 1.0);
                for at in key_box.start..key_box.end {
                    assert_eq!(near.points[at].map(|x| x / power), sorted.points[at], "{}", kind.name());
                }
            }
            assert!(scaled > 100, "{}: {scaled}", kind.name());
        }
    }

    /// Where low bits would be lost, points are left as they are.
    #[test]
    fn what_would_be_rounded_is_left() {
        let points = [[0.0, 0.0], [1e300, 5e-324], [2e300, 1e300], [1e300, 3e300]];
        let sorted = morton::sort(&points, &survey(&points).0);
        let near = Rescaled::of(&sorted.points, &sorted.boxes, 1.0).expect("too large");
        assert_eq!((near.points, near.powers), (sorted.points, vec![1.0]));
    }

    #[test]
    fn usual_sizes_need_nothing() {
        let points = Kind::named("uniform").expect("a kind").points(1000, 1);
        let sorted = morton::sort(&points, &survey(&points).0);
        assert!(Rescaled::of(&sorted.points, &sorted.boxes, 1.0).is_none());
    }
}
