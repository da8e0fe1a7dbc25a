//! Location while all vertices are on one line: a balanced tree of them, in lexicographic order.
//!
//! Source: Seidel & Aragon, "Randomized search trees", Algorithmica 1996; Tarjan, Levy & Timmel, "Zip trees", TALG 2021, for how
//! subtrees are parted and joined. The rank of a vertex is a hash of its place, so that the tree is a function of the places.
//!
//! Cost: O(log n) vertices a search, an insertion, a removal, expected whatever the order in which vertices come. The tree is made
//! at the first search, 8 bytes a place, and gone when a vertex is off the line.

use std::cmp::Ordering;

use delone_predicates::{angle, lexicographic};

use super::Layer;
use super::insert::Spot;
use super::kernel::Kernel;
use crate::ids::{EdgeId, Place};
use crate::locate::Ground;
use crate::order::random::SplitMix;
use crate::tally::{Phase, Tally};

/// No vertex: the slot above the root.
const NONE: u32 = 0;
/// The sides of a vertex.
const BEFORE: usize = 0;
const AFTER: usize = 1;

/// See the module. The vertex of a place is in the slot of the next index.
#[derive(Clone, Debug)]
pub(super) struct Line {
    /// For each slot the roots of what is before and after. Everything is after the slot above the root.
    sides: Vec<[u32; 2]>,
}

fn slot(v: Place) -> u32 {
    v.index() as u32 + 1
}

fn vertex(slot: u32) -> Option<Place> {
    Some(Place::new(slot.checked_sub(1)? as usize))
}

/// The rank of a slot: slots above have higher ranks.
fn rank(slot: u32) -> u64 {
    SplitMix(slot.into()).next()
}

/// The side of a slot on which a vertex is that is in order with it.
fn side(points: &[[f64; 2]], slot: u32, v: Place) -> usize {
    let Some(at) = vertex(slot) else { return AFTER };
    if lexicographic(points[v.index()], points[at.index()]).is_lt() { BEFORE } else { AFTER }
}

impl Line {
    fn new(points: &[[f64; 2]], vertices: impl Iterator<Item = Place>) -> Self {
        let mut line = Self { sides: vec![[NONE; 2]; points.len() + 1] };
        vertices.for_each(|v| line.insert(points, v));
        line
    }

    fn insert(&mut self, points: &[[f64; 2]], v: Place) {
        let new = slot(v);
        if self.sides.len() <= new as usize {
            self.sides.resize(new as usize + 1, [NONE; 2]);
        }
        let (mut above, mut on) = (NONE, AFTER);
        let mut below = self.sides[above as usize][on];
        while below != NONE && rank(below) >= rank(new) {
            (above, on) = (below, side(points, below, v));
            below = self.sides[above as usize][on];
        }
        self.sides[above as usize][on] = new;
        // What was there is parted: a path down alternates between what is before the vertex and what is after it.
        let mut open = [(new, BEFORE), (new, AFTER)];
        while below != NONE {
            let towards = side(points, below, v);
            let end = &mut open[1 - towards];
            self.sides[end.0 as usize][end.1] = below;
            *end = (below, towards);
            below = self.sides[below as usize][towards];
        }
        for (above, on) in open {
            self.sides[above as usize][on] = NONE;
        }
    }

    fn remove(&mut self, points: &[[f64; 2]], v: Place) {
        let (mut above, mut on) = (NONE, AFTER);
        loop {
            match self.sides[above as usize][on] {
                below if below == slot(v) => break,
                NONE => return debug_assert!(false, "what is removed is on the line"),
                below => (above, on) = (below, side(points, below, v)),
            }
        }
        let [mut before, mut after] = self.sides[slot(v) as usize];
        while before != NONE && after != NONE {
            if rank(before) >= rank(after) {
                self.sides[above as usize][on] = before;
                (above, on) = (before, AFTER);
                before = self.sides[before as usize][AFTER];
            } else {
                self.sides[above as usize][on] = after;
                (above, on) = (after, BEFORE);
                after = self.sides[after as usize][BEFORE];
            }
        }
        self.sides[above as usize][on] = before.max(after);
    }

    /// The vertex at a goal, or else those before and after it. `towards` says for a vertex where from it the goal is.
    fn search(&self, mut towards: impl FnMut(Place) -> Ordering) -> Result<Place, [Option<Place>; 2]> {
        let mut around = [None; 2];
        let mut below = self.sides[NONE as usize][AFTER];
        while let Some(v) = vertex(below) {
            let on = match towards(v) {
                Ordering::Equal => return Ok(v),
                Ordering::Less => BEFORE,
                Ordering::Greater => AFTER,
            };
            around[1 - on] = Some(v);
            below = self.sides[below as usize][on];
        }
        Err(around)
    }
}

impl<K: Kernel> Layer<K> {
    fn line(&self) -> &Line {
        self.line.get_or_init(|| Line::new(&self.points, self.mesh.inhabited()))
    }

    /// Where a point of the line falls, and how many vertices it was compared with.
    pub(super) fn spot_on_line<T: Tally>(&self, q: [f64; 2], tally: &mut T) -> (Spot, usize) {
        let mut steps = 0;
        let found = self.line().search(|v| {
            steps += 1;
            tally.visited();
            lexicographic(q, self.points[v.index()])
        });
        let spot = match found {
            Ok(v) => Spot::Vertex(v),
            Err([Some(a), Some(b)]) => {
                let along = |e: &EdgeId| self.mesh.head(*e) == b;
                self.mesh.spokes(a).find(along).map_or(Spot::End(a), Spot::Segment)
            }
            Err([Some(end), None] | [None, Some(end)]) => Spot::End(end),
            Err([None, None]) => Spot::Empty,
        };
        (spot, steps)
    }

    /// The vertex of the line that is nearest to any point, and an edge at it. There are two vertices at least.
    pub(super) fn near_on_line<T: Tally>(&self, q: [f64; 2], tally: &mut T) -> (Place, EdgeId) {
        tally.phase(Phase::Nearest);
        let point = |v: Place| self.points[v.index()];
        let e = self.mesh.ghost_edge.next();
        let (a, b) = (self.mesh.tail(e), self.mesh.head(e));
        // The foot of the point is where its distances from the vertices stop to fall.
        let found = self.line().search(|v| {
            tally.visited();
            let other = if v == a { b } else { a };
            let is_other_after = lexicographic(point(v), point(other)).is_lt();
            match angle(point(v), q, point(other)) {
                sign if sign.is_zero() => Ordering::Equal,
                sign if sign.is_positive() == is_other_after => Ordering::Greater,
                _ => Ordering::Less,
            }
        });
        let nearest = found.unwrap_or_else(|around| {
            tally.compared();
            let nearer = |a: Place, b: Place| if self.compare_distances(q, b, a).is_lt() { b } else { a };
            around.into_iter().flatten().reduce(nearer).unwrap_or(a)
        });
        (nearest, self.mesh.incident[nearest.index()])
    }

    /// A vertex has come onto the line.
    pub(super) fn join_line(&mut self, v: Place) {
        if let Some(line) = self.line.get_mut() {
            line.insert(&self.points, v);
        }
    }

    /// Removes a vertex of the line; its place stays.
    pub(in crate::plane) fn leave_line(&mut self, v: Place) {
        self.mesh.remove_from_line(v);
        if let Some(line) = self.line.get_mut() {
            line.remove(&self.points, v);
        }
    }

    /// Puts a vertex to another place, that of the same point.
    pub(in crate::plane) fn rename(&mut self, from: Place, to: Place) {
        self.mesh.rename(from, to);
        if let Some(line) = self.line.get_mut() {
            line.remove(&self.points, from);
            line.insert(&self.points, to);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// In order, and as deep as a random tree; whatever came and went.
    #[test]
    fn the_tree_has_the_order_of_the_line() {
        let points: Vec<[f64; 2]> = (0..4000_u32).map(|i| [f64::from(i * 1237 % 4001), 0.0]).collect();
        let mut line = Line::new(&points, (0..4000).map(Place::new));
        let mut random = SplitMix(1);
        let mut is_there = vec![true; 4000];
        for round in 0..12_000 {
            let i = random.below(4000);
            let v = Place::new(i);
            if is_there[i] {
                line.remove(&points, v);
            } else {
                line.insert(&points, v);
            }
            is_there[i] = !is_there[i];
            let x = random.below(4001) as f64 + if round % 2 == 0 { 0.0 } else { 0.5 };
            let mut steps = 0;
            let found = line.search(|v| {
                steps += 1;
                lexicographic([x, 0.0], points[v.index()])
            });
            assert!(steps < 60, "{steps} steps");
            if round % 40 > 0 {
                continue;
            }
            let there = (0..4000).filter(|&i| is_there[i]);
            let [before, after] = [Ordering::Less, Ordering::Greater].map(|side| {
                let beside = there.clone().filter(|&i| points[i][0].total_cmp(&x) == side);
                let order = |i: &usize, j: &usize| points[*i][0].total_cmp(&points[*j][0]);
                if side.is_lt() { beside.max_by(order) } else { beside.min_by(order) }
            });
            match there.clone().find(|&i| points[i][0] == x) {
                Some(i) => assert_eq!(found, Ok(Place::new(i))),
                None => assert_eq!(found, Err([before, after].map(|i| i.map(Place::new)))),
            }
        }
    }
}
