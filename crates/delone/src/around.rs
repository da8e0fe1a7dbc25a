//! The surroundings of a point: the simplices whose circles contain it, found without a change. A new vertex there would take their
//! place; their corners are its natural neighbors.
//!
//! Source: Sibson, "A vector identity for the Dirichlet tessellation", 1980, for the neighbors; Bowyer and Watson, 1981, for the
//! search. Cost: O(k) for k simplices after location, which is O(1) expected from a simplex nearby.

use std::fmt::Debug;

use delone_predicates::SeenCorner;

use crate::error::Error;
use crate::ids::{EdgeId, VertexId};
use crate::triangulation::{Ask, Found, Triangulation};

/// A triangulation that tells what surrounds a point.
pub trait Surround: Ask {
    /// Finds where a point falls, by a walk from a simplex that is near it, or by the strategy of location where that would be long
    /// and where none is given. Outside it tells no face: which facet is the nearest takes longer to find than that it is outside.
    ///
    /// # Errors
    /// [`Error::Coordinate`] for NaN and infinities.
    fn find_near(&self, near: Option<Self::Simplex>, q: Self::Point) -> Result<Found<Self::Simplex>, Error>;

    /// The same, and what surrounds it. That is nothing for a vertex, outside, and where there are no simplices.
    fn surround(
        &self,
        near: Option<Self::Simplex>,
        q: Self::Point,
        around: &mut Around<Self>,
    ) -> Result<Found<Self::Simplex>, Error>;
}

/// The surroundings of a point, in buffers that the next question uses again.
#[derive(Clone, Debug)]
pub struct Around<T: Triangulation + ?Sized> {
    pub(crate) cavity: Vec<T::Simplex>,
    pub(crate) border: Vec<(T::Facet, T::Simplex)>,
    pub(crate) is_at_hull: bool,
    pub(crate) seen: Seen,
    /// Sides of simplices that are to be looked at.
    pub(crate) pending: Vec<(T::Simplex, usize)>,
    /// The surroundings in the plane, by numbers.
    pub(crate) ring: Ring,
}

/// The neighbors of a point of the plane, numbered as they were met, and triangles between them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Ring {
    pub(crate) vertices: Vec<VertexId>,
    pub(crate) corners_seen: Vec<SeenCorner>,
    /// All of them, counter-clockwise.
    pub(crate) order: Vec<u32>,
    /// The cavity.
    pub(crate) triangles: Vec<[u32; 3]>,
    pub(crate) pending: Vec<Side>,
}

/// An edge of the cavity that is to be looked across.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Side {
    /// The edge as seen from beyond.
    pub(crate) edge: EdgeId,
    /// From which corner to which it goes as seen from the point.
    pub(crate) ends: [u32; 2],
    /// The cross product of both.
    pub(crate) cross: f64,
}

impl Ring {
    fn clear(&mut self) {
        self.vertices.clear();
        self.corners_seen.clear();
        self.order.clear();
        self.triangles.clear();
        self.pending.clear();
    }
}

impl<T: Triangulation + ?Sized> Default for Around<T> {
    fn default() -> Self {
        Self {
            cavity: Vec::new(),
            border: Vec::new(),
            is_at_hull: false,
            seen: Seen::default(),
            pending: Vec::new(),
            ring: Ring::default(),
        }
    }
}

impl<T: Triangulation + ?Sized> Around<T> {
    /// The simplices whose circles hold the point, in the sense of the canonical rule.
    pub fn cavity(&self) -> &[T::Simplex] {
        &self.cavity
    }

    /// The facets around them, seen counter-clockwise from the point, each with the simplex beyond it; that is the one inside where
    /// there is nothing beyond.
    pub fn border(&self) -> &[(T::Facet, T::Simplex)] {
        &self.border
    }

    /// Whether the point is on the hull, where it would take from cells without end; the rest is left empty then.
    pub fn is_at_hull(&self) -> bool {
        self.is_at_hull
    }

    /// Its natural neighbors, by id, into a buffer.
    pub(crate) fn neighbors(&self, ids: &mut Vec<VertexId>) {
        ids.clear();
        ids.extend(self.border.iter().flat_map(|(facet, _)| facet.as_ref().iter().copied()));
        ids.sort_unstable();
        ids.dedup();
    }

    pub(crate) fn clear(&mut self) {
        self.cavity.clear();
        self.border.clear();
        self.pending.clear();
        self.ring.clear();
        self.is_at_hull = false;
    }

    /// The point was found to be on the hull.
    pub(crate) fn stop_at_hull(&mut self) {
        self.clear();
        self.is_at_hull = true;
    }
}

/// A small set of indices, emptied at a cost of its size.
#[derive(Clone, Debug, Default)]
pub(crate) struct Seen {
    /// Each index plus one at a slot that its hash begins with; a power of two of them, half of them empty at least.
    slots: Vec<u32>,
    count: usize,
}

impl Seen {
    pub(crate) fn clear(&mut self) {
        self.slots.iter_mut().for_each(|slot| *slot = 0);
        self.count = 0;
        if self.slots.len() > 1 << 12 {
            self.slots.truncate(1 << 12);
        }
    }

    /// Adds an index; whether it is new.
    pub(crate) fn add(&mut self, index: usize) -> bool {
        if 2 * self.count >= self.slots.len() {
            self.grow();
        }
        let is_new = self.put(index as u32 + 1);
        self.count += usize::from(is_new);
        is_new
    }

    pub(crate) fn contains(&self, index: usize) -> bool {
        !self.slots.is_empty() && self.slots[self.slot(index as u32 + 1)] != 0
    }

    fn put(&mut self, key: u32) -> bool {
        let at = self.slot(key);
        let is_new = self.slots[at] == 0;
        self.slots[at] = key;
        is_new
    }

    /// Where a key is, or where it would be.
    fn slot(&self, key: u32) -> usize {
        let mask = self.slots.len() - 1;
        let mut at = (key.wrapping_mul(0x9E37_79B9) >> 7) as usize & mask;
        while self.slots[at] != 0 && self.slots[at] != key {
            at = (at + 1) & mask;
        }
        at
    }

    #[cold]
    fn grow(&mut self) {
        let larger = vec![0; (2 * self.slots.len()).max(128)];
        let keys = std::mem::replace(&mut self.slots, larger);
        for key in keys.into_iter().filter(|&key| key != 0) {
            self.put(key);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Seen;

    #[test]
    fn a_set_holds_what_was_added() {
        let mut seen = Seen::default();
        for round in 0..5 {
            seen.clear();
            let indices: Vec<usize> = (0..3000).map(|i| i * i * 7919 % 100_003).collect();
            let fresh = indices.iter().filter(|&&i| seen.add(i)).count();
            let mut known = indices.clone();
            known.sort_unstable();
            known.dedup();
            assert_eq!(fresh, known.len(), "{round}");
            assert!(indices.iter().all(|&i| seen.contains(i) && !seen.add(i)));
            assert!(!seen.contains(100_004));
        }
    }
}
