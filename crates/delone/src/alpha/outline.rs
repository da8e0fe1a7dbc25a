//! The outline in the plane: the border of the triangles as polygons with holes.
//!
//! A border is followed with the inside on its left. Where it comes to a corner it goes on along the side that is reached by turning
//! through triangles, so that parts that touch in a corner stay two. A ring that comes to a corner again is cut there: what was
//! closed is a ring of its own, so no ring touches itself.

use delone_predicates::{Sign, lexicographic, orient2d};

use super::Alpha;
use super::components::joined;
use super::facing::{NONE, across};
use crate::ids::VertexId;

/// A part of an outline: its outer ring, counter-clockwise, and then its holes, clockwise; rings begin with their least vertex.
pub type OutlinePart = Vec<Vec<VertexId>>;

impl Alpha<2> {
    /// The outline of the triangles that are there at a squared radius, as one polygon for each part that hangs together across edges. Edges
    /// and vertices outside of all triangles are no part of it. Polygons may touch in corners, and so may rings of one; they share nothing
    /// else. Sorted by vertices. O(k log k) for k triangles, and O(n).
    ///
    /// ```
    /// use delone::{Delaunay2, VertexId};
    /// // A square ring: the middle is missing while the radius is small.
    /// let mut points: Vec<[i32; 2]> = Vec::new();
    /// for x in 0..5 {
    ///     points.extend((0..5).map(|y| [x, y]).filter(|p| *p != [2, 2]));
    /// }
    /// let d = Delaunay2::from_points(&points)?;
    /// let [part] = &d.alpha().outline(0.5)[..] else { panic!("one part") };
    /// // The outer ring has 16 corners, the hole has those beside the point that is missing.
    /// assert_eq!(part.iter().map(Vec::len).collect::<Vec<_>>(), [16, 4]);
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn outline(&self, alpha: f64) -> Vec<OutlinePart> {
        let triangles = self.triangles.until(alpha);
        let across = across(self.points.len(), triangles);
        let mut sets = joined(&across);
        let border = Border { alpha: self, triangles, across: &across };
        let mut seen = vec![[false; 3]; triangles.len()];
        let mut places = vec![NONE; self.points.len()];
        let mut parts: Vec<OutlinePart> = Vec::new();
        let mut part_of = vec![NONE; triangles.len()];
        for i in 0..triangles.len() {
            for k in (0..3).filter(|&k| across[i][k] == NONE) {
                if seen[i][k] {
                    continue;
                }
                let set = sets.find(i as u32);
                let part = &mut part_of[set as usize];
                if *part == NONE {
                    *part = parts.len() as u32;
                    parts.push(Vec::new());
                }
                let rings = &mut parts[*part as usize];
                border.follow((i as u32, k), &mut seen, &mut places, rings);
            }
        }
        let mut parts: Vec<OutlinePart> = parts.into_iter().map(|rings| self.in_order(rings)).collect();
        parts.sort_unstable();
        parts
    }

    /// The outer ring first, each from its least vertex on.
    fn in_order(&self, mut rings: OutlinePart) -> OutlinePart {
        for ring in &mut rings {
            let least = (0..ring.len()).min_by_key(|&i| ring[i]).unwrap_or(0);
            ring.rotate_left(least);
        }
        rings.sort_by_cached_key(|ring| (!self.is_counter_clockwise(ring), ring.clone()));
        rings
    }

    /// At its smallest corner a ring turns as it goes around.
    fn is_counter_clockwise(&self, ring: &[VertexId]) -> bool {
        let at = |i: usize| self.position(ring[i % ring.len()]);
        let least = (0..ring.len()).min_by(|&i, &j| lexicographic(at(i), at(j)));
        least.is_some_and(|i| orient2d(at(i + ring.len() - 1), at(i), at(i + 1)).is_positive())
    }
}

/// A side: a triangle, and the corner opposite to it.
type Side = (u32, usize);

/// Triangles, corners by increasing id, and what is across their sides.
struct Border<'a> {
    alpha: &'a Alpha<2>,
    triangles: &'a [[VertexId; 3]],
    across: &'a [[u32; 3]],
}

impl Border<'_> {
    /// The places of the corners after a place, counter-clockwise.
    fn after(&self, triangle: u32, k: usize) -> [usize; 2] {
        let [a, b, c] = self.triangles[triangle as usize].map(|v| self.alpha.position(v));
        let (next, last) = ((k + 1) % 3, (k + 2) % 3);
        if orient2d(a, b, c) == Sign::Positive { [next, last] } else { [last, next] }
    }

    /// The side that goes on where this one ends.
    fn next(&self, (mut triangle, mut k): Side) -> Side {
        let [mut from, end] = self.after(triangle, k);
        let v = self.triangles[triangle as usize][end];
        // The other side at its end is opposite to where this one begins.
        loop {
            let beyond = self.across[triangle as usize][from];
            if beyond == NONE {
                return (triangle, from);
            }
            triangle = beyond;
            let corners = &self.triangles[triangle as usize];
            k = corners.iter().position(|&w| w == v).unwrap_or(0);
            // Of the two sides at v the one that leaves it, opposite to the corner before it.
            from = self.after(triangle, k)[1];
        }
    }

    /// Follows a border from a side until it is back, as rings without repeated corners.
    fn follow(&self, first: Side, seen: &mut [[bool; 3]], places: &mut [u32], rings: &mut OutlinePart) {
        let mut ring: Vec<VertexId> = Vec::new();
        let mut side = first;
        loop {
            let (triangle, k) = side;
            seen[triangle as usize][k] = true;
            let start = self.triangles[triangle as usize][self.after(triangle, k)[0]];
            close(&mut ring, start, places, rings);
            places[start.index()] = ring.len() as u32;
            ring.push(start);
            side = self.next(side);
            if side == first {
                break;
            }
        }
        ring.iter().for_each(|v| places[v.index()] = NONE);
        rings.push(ring);
    }
}

/// Cuts off what comes back to a corner.
fn close(ring: &mut Vec<VertexId>, corner: VertexId, places: &mut [u32], rings: &mut OutlinePart) {
    let place = places[corner.index()];
    if place != NONE {
        let closed = ring.split_off(place as usize);
        closed.iter().for_each(|v| places[v.index()] = NONE);
        rings.push(closed);
    }
}
