//! Which pieces of lines lose their empty circle when others are divided.
//!
//! A piece is an edge of the triangulation while no site is in its diametral circle. Each division adds a site, which may be in the circle of
//! a piece that was clear before. Around a hub of lines this goes on from line to line: to follow it here takes one triangulation instead
//! of one a line. Cost: a search in a tree for each piece that is marked.

use delone_predicates::{angle, hypotenuse};

use super::lines::Piece;
use crate::plane::boxes::Boxes;

/// The place where a piece is divided.
pub(super) fn middle([a, b]: [[f64; 2]; 2]) -> [f64; 2] {
    [0, 1].map(|k| 0.5 * a[k] + 0.5 * b[k])
}

/// Marks pieces of those that may be divided whose circle has the middle of a marked piece in it, and so on.
pub(super) fn mark_crossed(
    sites: &[[f64; 2]],
    pieces: &[Piece],
    divisible: &[usize],
    marked: &mut Vec<usize>,
) {
    let ends = |piece: usize| pieces[piece].ends.map(|site| sites[site]);
    let mut is_marked = vec![false; pieces.len()];
    marked.iter().for_each(|&piece| is_marked[piece] = true);
    let circle = |&piece: &usize| {
        let [a, b] = ends(piece);
        let radius = 0.5 * hypotenuse(b[0] - a[0], b[1] - a[1]);
        let center = middle([a, b]);
        // Two roundings: of the center, and of the sum.
        [
            center.map(|x| (x - radius).next_down().next_down()),
            center.map(|x| (x + radius).next_up().next_up()),
        ]
    };
    let boxes = Boxes::new(divisible.iter().map(circle).collect());
    let mut next = 0;
    while let Some(&piece) = marked.get(next) {
        next += 1;
        let middle = middle(ends(piece));
        boxes.each(&[middle; 2], |k| {
            let other = divisible[k];
            let [a, b] = ends(other);
            if !is_marked[other] && angle(middle, a, b).is_negative() {
                is_marked[other] = true;
                marked.push(other);
            }
        });
    }
    marked.sort_unstable();
}
