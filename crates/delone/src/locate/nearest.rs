//! Vertices by distance, along edges: nearest, k nearest, within a radius; in the plane and in space.
//!
//! Why following edges is enough: of the neighbors of a vertex that is not nearest to q one is nearer, so a
//! descent ends at the nearest; the k + 1 nearest vertices are the k nearest and a neighbor of one of them; and the
//! vertices within a radius are connected by edges between them (all three because the edges contain those of the
//! Delaunay graph). The same holds of powers in a regular triangulation, whose lifted vertices are those of a convex hull.
//!
//! Equal distances are ordered by the points, lexicographically, so every answer is a function of the set of
//! points alone.

use std::cmp::Ordering;
use std::collections::{BTreeSet, BinaryHeap};

use super::Ground;
use crate::ids::Place;
use crate::tally::Tally;

/// Vertices joined by edges, as searches by distance, or by power, see them.
pub(crate) trait Near<P: Copy> {
    /// Compares two vertices by their distance from `q`, then lexicographically.
    fn nearer(&self, q: P, a: Place, b: Place) -> Ordering;

    /// Whether a vertex is at most `radius` away from `q`.
    fn is_within(&self, q: P, v: Place, radius: f64) -> bool;

    /// Calls for each neighbor of a vertex.
    fn beside(&self, v: Place, each: impl FnMut(Place));
}

/// A triangulation whose vertices are searched by distance.
pub(crate) trait Metric: Ground + Near<<Self as Ground>::Point> {}

impl<G: Ground + Near<<G as Ground>::Point>> Metric for G {}

/// The nearest vertex, down along edges from another one.
pub(crate) fn descend<P: Copy, G: Near<P>, T: Tally>(ground: &G, from: Place, q: P, tally: &mut T) -> Place {
    descend_within(ground, from, q, usize::MAX, tally).0
}

/// The same, but it ends, on the way, once more than `most` vertices have been compared; and how many have.
pub(crate) fn descend_within<P: Copy, G: Near<P>, T: Tally>(
    ground: &G,
    from: Place,
    q: P,
    most: usize,
    tally: &mut T,
) -> (Place, usize) {
    let (mut best, mut compared) = (from, 0);
    loop {
        let mut next = best;
        ground.beside(best, |w| {
            tally.compared();
            compared += 1;
            if ground.nearer(q, w, next).is_lt() {
                next = w;
            }
        });
        if next == best || compared > most {
            return (next, compared);
        }
        best = next;
    }
}

/// A vertex on the way to becoming one of the nearest. The greatest is the nearest, as a heap wants it.
struct Candidate<'a, P, G> {
    ground: &'a G,
    q: P,
    place: Place,
}

impl<P: Copy, G: Near<P>> PartialEq for Candidate<'_, P, G> {
    fn eq(&self, other: &Self) -> bool {
        self.place == other.place
    }
}

impl<P: Copy, G: Near<P>> Eq for Candidate<'_, P, G> {}

impl<P: Copy, G: Near<P>> Ord for Candidate<'_, P, G> {
    fn cmp(&self, other: &Self) -> Ordering {
        self.ground.nearer(self.q, other.place, self.place)
    }
}

impl<P: Copy, G: Near<P>> PartialOrd for Candidate<'_, P, G> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// The k nearest vertices, nearest first, given the nearest one.
pub(crate) fn k_nearest<P: Copy, G: Near<P>>(
    ground: &G,
    nearest: Option<Place>,
    q: P,
    k: usize,
) -> Vec<Place> {
    let candidate = |place: Place| Candidate { ground, q, place };
    let mut found = Vec::new();
    let mut waiting: BinaryHeap<_> = nearest.into_iter().map(candidate).collect();
    // Not collected, which would sort: code that pages load.
    let mut seen = BTreeSet::new();
    seen.extend(nearest);
    while found.len() < k {
        let Some(Candidate { place, .. }) = waiting.pop() else { break };
        found.push(place);
        ground.beside(place, |w| {
            if seen.insert(w) {
                waiting.push(candidate(w));
            }
        });
    }
    found
}

/// The vertices at most `radius` away, in no special order, given the nearest one.
pub(crate) fn within<P: Copy, G: Near<P>>(
    ground: &G,
    nearest: Option<Place>,
    q: P,
    radius: f64,
) -> BTreeSet<Place> {
    let mut pending: Vec<Place> = nearest.into_iter().filter(|&v| ground.is_within(q, v, radius)).collect();
    let mut seen = BTreeSet::new();
    seen.extend(pending.iter().copied());
    while let Some(v) = pending.pop() {
        ground.beside(v, |w| {
            if ground.is_within(q, w, radius) && seen.insert(w) {
                pending.push(w);
            }
        });
    }
    seen
}
