//! Whether rings are borders of a polygon, and how they lie in each other: one sweep over their corners.
//!
//! A line moves over the plane from left to right and knows the sides that it crosses, from below to above. Sides
//! that share more than corners of both are neighbors on the line before it gets there, and neighbors are compared.
//! Where a ring begins, what is directly below tells what it is in.
//!
//! Source: Shamos & Hoey, "Geometric intersection problems", FOCS 1976. Corners with one x are swept from below, as if the
//! plane were turned a little. All decisions are exact.
//!
//! Cost: O(m log m) for m sides.

use std::cmp::Ordering;
use std::collections::BTreeSet;

use delone_predicates::{lexicographic, orient2d, strictly_between};

use crate::error::{Error, RegionProblem};
use crate::sorting;

/// How a ring lies among the others.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::plane) struct Nesting {
    /// How many other rings are around it.
    pub(in crate::plane) depth: usize,
    pub(in crate::plane) is_counter_clockwise: bool,
}

/// A side of a ring, from its lesser to its greater corner.
#[derive(Clone, Copy, Debug)]
struct Side {
    low: [f64; 2],
    high: [f64; 2],
    ring: usize,
    /// The corner that it leaves, along the ring.
    corner: usize,
    /// Whether that is the lesser one.
    is_forward: bool,
}

impl Side {
    /// Where a side is that begins no earlier: below or above.
    fn compare_later(&self, later: &Self) -> Ordering {
        let [begin, end] = [later.low, later.high].map(|p| orient2d(self.low, self.high, p));
        let side = if begin.is_zero() { end } else { begin };
        0.cmp(&(side as i8))
    }
}

impl Ord for Side {
    fn cmp(&self, other: &Self) -> Ordering {
        #[cfg(test)]
        tests::COMPARISONS.set(tests::COMPARISONS.get() + 1);
        let names = (self.ring, self.corner).cmp(&(other.ring, other.corner));
        if names.is_eq() {
            return names;
        }
        let order = if lexicographic(self.low, other.low).is_le() {
            self.compare_later(other)
        } else {
            other.compare_later(self).reverse()
        };
        order.then(names)
    }
}

impl PartialOrd for Side {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Side {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Side {}

/// Finds how rings lie in each other. Each has three corners or more, and none twice.
///
/// # Errors
/// The first ring and corner where sides share more than corners, or where rings cross.
pub(in crate::plane) fn nesting(rings: &[Vec<[f64; 2]>]) -> Result<Vec<Nesting>, Error> {
    let mut sweep = Sweep { rings, line: BTreeSet::new(), found: vec![None; rings.len()] };
    let mut events: Vec<([f64; 2], Side)> = Vec::new();
    for (ring, corners) in rings.iter().enumerate() {
        let next = corners.iter().cycle().skip(1);
        for (corner, (&p, &q)) in corners.iter().zip(next).enumerate() {
            let is_forward = lexicographic(p, q).is_lt();
            let (low, high) = if is_forward { (p, q) } else { (q, p) };
            let side = Side { low, high, ring, corner, is_forward };
            events.extend([(low, side), (high, side)]);
        }
    }
    sorting::by(&mut events, |a, b| lexicographic(a.0, b.0));
    for at_one in events.chunk_by(|a, b| a.0 == b.0) {
        sweep.pass(at_one)?;
    }
    let missing = Nesting { depth: 0, is_counter_clockwise: true };
    Ok(sweep.found.into_iter().map(|found| found.unwrap_or(missing)).collect())
}

struct Sweep<'a> {
    rings: &'a [Vec<[f64; 2]>],
    /// The sides that cross the sweeping line, from below to above.
    line: BTreeSet<Side>,
    /// By ring, of those that have begun.
    found: Vec<Option<Nesting>>,
}

impl Sweep<'_> {
    /// Moves the line over a point, which is a corner of some sides.
    fn pass(&mut self, at_one: &[([f64; 2], Side)]) -> Result<(), Error> {
        let [mut ending, mut beginning] = [true, false].map(|ends| {
            let sides = at_one.iter().filter(|(at, side)| (*at == side.high) == ends);
            sides.map(|(_, side)| *side).collect::<Vec<Side>>()
        });
        if at_one.len() > 2 {
            ending.sort();
        }
        for side in &ending {
            self.line.remove(side);
            compare(self.below(side), self.above(side))?;
        }
        self.line.extend(beginning.iter().copied());
        for side in &beginning {
            compare(self.below(side), Some(*side))?;
            compare(Some(*side), self.above(side))?;
        }
        beginning.sort();
        if at_one.len() > 2 {
            self.check_around(&beginning, &ending)?;
        }
        for side in &beginning {
            if self.found[side.ring].is_none() {
                // Its least corner: the lower one of its two sides comes first.
                let depth = self.below(side).map_or(0, |below| {
                    let around = self.found[below.ring];
                    around.map_or(0, |n| n.depth + usize::from(n.is_counter_clockwise == below.is_forward))
                });
                self.found[side.ring] = Some(Nesting { depth, is_counter_clockwise: side.is_forward });
            }
        }
        Ok(())
    }

    fn below(&self, side: &Side) -> Option<Side> {
        self.line.range(..*side).next_back().copied()
    }

    fn above(&self, side: &Side) -> Option<Side> {
        use std::ops::Bound::{Excluded, Unbounded};
        self.line.range((Excluded(*side), Unbounded)).next().copied()
    }

    /// Whether rings that share a corner only touch there: around it, sides of one ring are in pairs like brackets.
    fn check_around(&self, beginning: &[Side], ending: &[Side]) -> Result<(), Error> {
        let mut open: Vec<&Side> = Vec::new();
        for side in beginning.iter().chain(ending.iter().rev()) {
            if open.last().is_some_and(|last| last.ring == side.ring) {
                open.pop();
            } else {
                open.push(side);
            }
        }
        let Some(side) = open.iter().max_by_key(|side| side.ring) else { return Ok(()) };
        let is_start = beginning.iter().any(|s| s == *side) == side.is_forward;
        let count = self.rings[side.ring].len();
        let corner = if is_start { side.corner } else { (side.corner + 1) % count };
        Err(Error::Region { ring: side.ring, corner, problem: RegionProblem::Crossing })
    }
}

/// Whether neighbors on the line are apart but for corners.
fn compare(below: Option<Side>, above: Option<Side>) -> Result<(), Error> {
    match below.zip(above) {
        Some((p, q)) if are_in_conflict([p.low, p.high], [q.low, q.high]) => {
            let (ring, corner) = (p.ring, p.corner).max((q.ring, q.corner));
            Err(Error::Region { ring, corner, problem: RegionProblem::Crossing })
        }
        _ => Ok(()),
    }
}

/// Whether two segments share a point that is not an end of both, or are one. Exact.
pub(in crate::plane) fn are_in_conflict([p, q]: [[f64; 2]; 2], [s, t]: [[f64; 2]; 2]) -> bool {
    let (at_s, at_t) = (orient2d(p, q, s), orient2d(p, q, t));
    let (at_p, at_q) = (orient2d(s, t, p), orient2d(s, t, q));
    let touches = (at_s.is_zero() && strictly_between(p, q, s))
        || (at_t.is_zero() && strictly_between(p, q, t))
        || (at_p.is_zero() && strictly_between(s, t, p))
        || (at_q.is_zero() && strictly_between(s, t, q));
    let are_one = (p == s && q == t) || (p == t && q == s);
    touches || are_one || ((at_s * at_t).is_negative() && (at_p * at_q).is_negative())
}

#[cfg(test)]
mod tests {
    use super::nesting;
    use std::cell::Cell;

    thread_local! {
        /// How often two sides were compared.
        pub(in crate::plane) static COMPARISONS: Cell<usize> = const { Cell::new(0) };
    }

    fn square(x: f64, y: f64, size: f64) -> Vec<[f64; 2]> {
        vec![[x, y], [x + size, y], [x + size, y + size], [x, y + size]]
    }

    /// The definition: what a line to the left crosses.
    fn depth(rings: &[Vec<[f64; 2]>], of: usize) -> usize {
        let [x, y] = [0, 1].map(|axis| rings[of][0][axis] / 2.0 + rings[of][1][axis] / 2.0);
        let is_around = |ring: &Vec<[f64; 2]>| {
            let mut inside = false;
            for (i, a) in ring.iter().enumerate() {
                let b = ring[(i + 1) % ring.len()];
                let at = a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
                inside ^= (a[1] > y) != (b[1] > y) && at < x;
            }
            inside
        };
        (0..rings.len()).filter(|&i| i != of && is_around(&rings[i])).count()
    }

    #[test]
    fn depths_are_those_of_the_definition() {
        let mut rings = vec![square(-1.0, -1.0, 40.0)];
        for i in 0..12 {
            for j in 0..12 {
                // Three in each other, which touch their neighbors at corners where sizes agree.
                let (x, y) = (f64::from(i) * 3.0, f64::from(j) * 3.0);
                let size = if (i + j) % 2 == 0 { 3.0 } else { 2.5 };
                let moved = if (i + j) % 2 == 0 { 0.0 } else { 0.25 };
                rings.push(square(x + moved, y + moved, size));
                rings.push(vec![[x + 0.5, y + 1.0], [x + 1.0, y + 2.25], [x + 2.0, y + 0.5]]);
                rings.push(vec![[x + 1.0, y + 1.125], [x + 1.125, y + 1.0], [x + 1.125, y + 1.125]]);
            }
        }
        for (i, ring) in rings.iter_mut().enumerate() {
            ring.rotate_left(i % 3);
            if i % 2 == 0 {
                ring.reverse();
            }
        }
        let found = nesting(&rings).expect("apart");
        for (i, ring) in rings.iter().enumerate() {
            assert_eq!(found[i].depth, depth(&rings, i), "{i}");
            let area: f64 = (0..ring.len())
                .map(|k| (ring[k], ring[(k + 1) % ring.len()]))
                .map(|(p, q)| p[0] * q[1] - p[1] * q[0])
                .sum();
            assert_eq!(found[i].is_counter_clockwise, area > 0.0, "{i}");
        }
    }

    /// Neither many rings nor sides that overlap in x make more than a few comparisons a side.
    #[test]
    fn comparisons_grow_as_the_sides() {
        let grid = |n: usize| -> Vec<Vec<[f64; 2]>> {
            let inner = (0..n * n).map(|i| square(3.0 * (i % n) as f64, 3.0 * (i / n) as f64, 1.0));
            inner.chain([square(-1.0, -1.0, 3.0 * n as f64)]).collect()
        };
        let comb = |n: usize| -> Vec<Vec<[f64; 2]>> {
            let teeth = (0..n).flat_map(|i| [[0.0, i as f64], [1e6, i as f64 + 0.5]]);
            vec![teeth.chain([[-1.0, n as f64], [-1.0, 0.0]]).collect()]
        };
        for rings in [grid(20), grid(40), grid(60), comb(1000), comb(10_000)] {
            let sides: usize = rings.iter().map(Vec::len).sum();
            super::tests::COMPARISONS.set(0);
            nesting(&rings).expect("apart");
            let comparisons = COMPARISONS.get() as f64;
            assert!(comparisons < 20.0 * sides as f64 * (sides as f64).log2(), "{comparisons} for {sides}");
        }
    }
}
