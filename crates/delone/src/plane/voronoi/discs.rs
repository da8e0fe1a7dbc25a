//! Which pieces of lines reach into discs without sites, and so might be nearer somewhere than the cells tell.
//!
//! Along a side in the cell of a site, the disc around each place that has the site on its circle has no site inside. These circles pass
//! through the site and its mirror image, so powers of a point change linearly along the side: of what reaches into some disc by the square
//! of a depth, a part reaches as far into the one around an end. So it is enough to look at both ends.

use super::lines::{Piece, nearest_on};
use crate::plane::boxes::{Boxes, span};
use delone_predicates::hypotenuse;

/// The pieces that may be divided, in a tree.
pub(super) struct Discs<'a> {
    sites: &'a [[f64; 2]],
    pieces: &'a [Piece],
    /// Indices of pieces.
    divisible: Vec<usize>,
    boxes: Boxes,
    /// How far a piece may reach into a disc, in coordinate units.
    depth: f64,
}

fn distance(p: [f64; 2], q: [f64; 2]) -> f64 {
    hypotenuse(p[0] - q[0], p[1] - q[1])
}

impl<'a> Discs<'a> {
    pub(super) fn new(sites: &'a [[f64; 2]], pieces: &'a [Piece], divisible: Vec<usize>, depth: f64) -> Self {
        let spans = divisible.iter().map(|&piece| span(&pieces[piece].ends.map(|site| sites[site])));
        let boxes = Boxes::new(spans.collect());
        Self { sites, pieces, divisible, boxes, depth }
    }

    /// Marks the pieces that reach too far into discs around places of a side, which is in the cell of a site. A piece may reach so many times
    /// the depth, at least once.
    pub(super) fn mark(
        &self,
        side: [[f64; 2]; 2],
        site: usize,
        reach: impl Fn(usize) -> f64,
        marked: &mut Vec<usize>,
    ) {
        let own = self.sites[site];
        // Discs of less than the depth cannot be entered farther.
        let least = distance(own, nearest_on(own, side)).max(self.depth);
        for at in side {
            let radius = distance(own, at);
            let part = self.depth * (least / radius) / radius;
            let within = |reach: f64| radius * (1.0 - reach * part).max(0.0).sqrt();
            if part.is_nan() || part >= 1.0 {
                continue;
            }
            self.boxes.each_within(at, within(1.0), |k| {
                let piece = self.divisible[k];
                let ends = self.pieces[piece].ends.map(|site| self.sites[site]);
                if distance(at, nearest_on(at, ends)) < within(reach(piece)) {
                    marked.push(piece);
                }
            });
        }
    }
}
