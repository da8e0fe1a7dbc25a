//! Rings of a polygon cut by a half-plane.
//!
//! Every edge of a ring knows the line that it lies on, and every corner is a point of the input or the meeting of two
//! such lines, and stays that until the end: what is decided about it is decided exactly. So the parts of a polygon are
//! what they should be, whatever is equal, parallel or on a border, and parts on both sides of a line tile. What is
//! left of a polygon is the closure of what is inside: nothing that only touches.
//!
//! Source: Sutherland & Hodgman, "Reentrant polygon clipping", CACM 1974, with the pieces joined along the line in
//! pairs, so that a polygon falls apart into as many rings as it should.
//!
//! Cost: O(k log k) for k corners, O(k) for a convex ring.

use crate::sorting;
use delone_predicates::{Line, Sign, Spot};

/// A corner of a ring, and the edge that leaves it.
#[derive(Clone, Copy, Debug)]
pub(in crate::plane) struct Corner {
    pub(in crate::plane) spot: Spot,
    /// The line of the edge, with the polygon on its left.
    pub(in crate::plane) line: Line,
    /// Which side of the region the edge is on, if it is on the border.
    pub(in crate::plane) side: Option<usize>,
}

/// Corners of a closed line, the polygon on its left. Edges may be points.
pub(in crate::plane) type Ring = Vec<Corner>;

/// A ring with its own edges as sides, numbered from `first`, each on an axis-parallel line if it can be.
pub(in crate::plane) fn sides(corners: &[[f64; 2]], first: usize) -> Ring {
    let next = corners.iter().cycle().skip(1);
    let side = |(i, (&p, &q)): (usize, (&[f64; 2], &[f64; 2]))| {
        let line = match (p[0] == q[0], p[1] == q[1]) {
            (true, _) if p[1] < q[1] => Line::Below(0, p[0]),
            (true, _) => Line::Above(0, p[0]),
            (_, true) if p[0] < q[0] => Line::Above(1, p[1]),
            (_, true) => Line::Below(1, p[1]),
            _ => Line::Through(p, q),
        };
        Corner { spot: Spot::Point(p), line, side: Some(first + i) }
    };
    corners.iter().zip(next).enumerate().map(side).collect()
}

/// The part of a polygon on the left of a line.
pub(in crate::plane) fn clip(rings: Vec<Ring>, half: Line) -> Vec<Ring> {
    let mut kept = Vec::with_capacity(rings.len());
    let mut chains = Vec::new();
    for ring in rings {
        let signs: Vec<Sign> = ring.iter().map(|corner| half.side(&corner.spot)).collect();
        if signs.iter().all(|sign| sign.is_positive()) {
            kept.push(ring);
        } else if signs.iter().any(|sign| sign.is_positive()) {
            let cut = Cut { ring: &ring, signs: &signs, half };
            let gaps = cut.gaps();
            if gaps.is_empty() {
                kept.push(cut.touched());
            } else {
                let next = gaps.iter().cycle().skip(1);
                chains.extend(gaps.iter().zip(next).map(|(from, to)| cut.chain(*from, *to)));
            }
        }
    }
    join(chains, half, &mut kept);
    kept
}

/// Corners from one to another, around the ring, that are not inside.
#[derive(Clone, Copy)]
struct Gap {
    first: usize,
    last: usize,
}

/// A ring, on which side of the line its corners are, and the line.
struct Cut<'a> {
    ring: &'a Ring,
    signs: &'a [Sign],
    half: Line,
}

impl Cut<'_> {
    fn after(&self, i: usize) -> usize {
        if i + 1 == self.ring.len() { 0 } else { i + 1 }
    }

    fn before(&self, i: usize) -> usize {
        (if i == 0 { self.ring.len() } else { i }) - 1
    }

    /// The gaps, in order. One corner on the line between two inside is none: the ring only touches.
    fn gaps(&self) -> Vec<Gap> {
        let enters = |&i: &usize| !self.signs[i].is_positive() && self.signs[self.before(i)].is_positive();
        let gap = |first: usize| {
            let mut last = first;
            while !self.signs[self.after(last)].is_positive() {
                last = self.after(last);
            }
            Gap { first, last }
        };
        let gaps = (0..self.ring.len()).filter(enters).map(gap);
        gaps.filter(|gap| gap.first != gap.last || self.signs[gap.first].is_negative()).collect()
    }

    /// The corners from one gap to the next, each end on the line.
    fn chain(&self, from: Gap, to: Gap) -> Ring {
        let mut chain = Ring::new();
        let meeting = |i: usize| Spot::Meeting(self.ring[i].line, self.half);
        let before = self.ring[self.before(from.last)];
        if self.signs[from.last].is_negative() {
            chain.push(Corner { spot: meeting(from.last), ..self.ring[from.last] });
        } else {
            if self.signs[self.before(from.last)].is_negative() && self.is_vertex(from.last) {
                chain.push(Corner { spot: Spot::Meeting(before.line, self.half), ..before });
            }
            chain.push(self.ring[from.last]);
        }
        let mut i = self.after(from.last);
        while i != to.first {
            chain.push(self.ring[i]);
            i = self.after(i);
        }
        let leave = |spot: Spot| Corner { spot, line: self.half, side: None };
        if self.signs[i].is_negative() {
            chain.push(leave(meeting(self.before(i))));
        } else if self.signs[self.after(i)].is_negative() && self.is_vertex(i) {
            chain.push(self.ring[i]);
            chain.push(leave(meeting(i)));
        } else {
            chain.push(leave(self.ring[i].spot));
        }
        chain
    }

    /// The ring with an edge on the line at each corner that it touches, if these are Voronoi vertices.
    fn touched(&self) -> Ring {
        let mut ring = Ring::with_capacity(self.ring.len() + 1);
        for (i, &corner) in self.ring.iter().enumerate() {
            if self.signs[i].is_zero() && self.is_vertex(i) {
                let before = self.ring[self.before(i)].line;
                ring.push(Corner { spot: Spot::Meeting(before, self.half), line: self.half, side: None });
                ring.push(Corner { spot: Spot::Meeting(self.half, corner.line), ..corner });
            } else {
                ring.push(corner);
            }
        }
        ring
    }

    /// Whether four sites on one circle have their center at a corner on the line. Its edge on the line is a point then, and
    /// is made nonetheless: so the corner is the center of the triangles that neighbors have it from.
    fn is_vertex(&self, i: usize) -> bool {
        let lines = [self.ring[i].line, self.ring[self.before(i)].line, self.half];
        lines.iter().all(|line| matches!(line, Line::Bisector(..) | Line::Radical(..)))
    }
}

/// Joins chains to rings: from where one goes out, along the line to where the next one comes in.
fn join(mut chains: Vec<Ring>, half: Line, kept: &mut Vec<Ring>) {
    if chains.len() < 2 {
        kept.append(&mut chains);
        return;
    }
    let first = |i: usize| chains[i].first().map_or(Spot::Point([0.0; 2]), |corner| corner.spot);
    let last = |i: usize| chains[i].last().map_or(Spot::Point([0.0; 2]), |corner| corner.spot);
    let ins = along(half, (0..chains.len()).map(first).collect());
    let outs = along(half, (0..chains.len()).map(last).collect());
    let mut next = vec![0; chains.len()];
    for (&out, &to) in outs.iter().zip(&ins) {
        next[out] = to;
    }
    let mut used = vec![false; chains.len()];
    for first in 0..chains.len() {
        let mut ring = Ring::new();
        let mut i = first;
        while !used[i] {
            used[i] = true;
            ring.append(&mut chains[i]);
            i = next[i];
        }
        if !ring.is_empty() {
            kept.push(ring);
        }
    }
}

/// The indices of spots on a line, in their order along it.
fn along(half: Line, spots: Vec<Spot>) -> Vec<usize> {
    let mut order: Vec<usize> = (0..spots.len()).collect();
    sorting::by(&mut order, |&i, &j| half.compare(&spots[i], &spots[j]));
    order
}

#[cfg(test)]
mod tests {
    use delone_predicates::{Line, Spot};

    use super::{clip, sides};

    const SQUARE: [[f64; 2]; 4] = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]];

    #[test]
    fn sides_have_the_polygon_on_their_left() {
        let kite = [[3.0, 0.0], [5.0, 1.0], [5.0, 4.0], [2.0, 4.0], [2.0, 1.0]];
        for (corners, aslant) in [(SQUARE.as_slice(), 0), (&kite, 2)] {
            let center = [0, 1].map(|k| corners.iter().map(|p| p[k]).sum::<f64>() / corners.len() as f64);
            let ring = sides(corners, 10);
            assert!(
                ring.iter().all(|corner| corner.line.side(&Spot::Point(center)).is_positive()),
                "{ring:?}"
            );
            assert!(ring.iter().enumerate().all(|(i, corner)| corner.side == Some(10 + i)));
            assert_eq!(ring.iter().filter(|c| matches!(c.line, Line::Through(..))).count(), aslant);
            for (i, corner) in ring.iter().enumerate() {
                for k in [i, (i + 1) % ring.len()] {
                    assert!(corner.line.side(&Spot::Point(corners[k])).is_zero());
                }
            }
        }
    }

    /// Corners of a square stay as they are: no meeting of lines replaces them.
    #[test]
    fn corners_on_a_cut_stay_corners() {
        let spots = |half: Line| {
            let parts = clip(vec![sides(&SQUARE, 0)], half);
            assert_eq!(parts.len(), 1);
            parts[0].iter().map(|corner| corner.spot).collect::<Vec<_>>()
        };
        // Through two corners; and touching one, from inside.
        let diagonal = Line::Bisector([2.0, 0.0], [0.0, 2.0]);
        assert_eq!(spots(diagonal), [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0]].map(Spot::Point));
        assert_eq!(spots(Line::Bisector([0.0, 0.0], [4.0, 4.0])), SQUARE.map(Spot::Point));
    }

    /// A cut that is repeated changes nothing.
    #[test]
    fn a_second_cut_changes_nothing() {
        let (site, mut cell) = ([1.0, 1.0], vec![sides(&SQUARE, 0)]);
        for w in [[2.5, 1.0], [1.0, 2.5], [-0.5, 1.0], [1.0, -0.5]].repeat(2) {
            cell = clip(cell, Line::Bisector(site, w));
            assert_eq!((cell.len(), cell[0].len()), (1, 4), "{w:?}");
        }
    }
}
