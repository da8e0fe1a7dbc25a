//! Jump-and-walk: start at the nearest of a few vertices drawn at random.
//!
//! Source: Devroye, Mücke & Zhu, "A note on point location in Delaunay triangulations of random points",
//! Algorithmica 1998; Mücke, Saias & Zhu, SoCG 1996. Sample: m = ceil(rho n^(1/(d+1))) vertices in d dimensions.
//!
//! Cost: O(m + sqrt(n / m)) expected on evenly spread points in the plane, so O(n^(1/3)); no memory, nothing to
//! keep up to date, so insertion and removal cost nothing more. Choose it when memory is short, or for sets
//! that change wholesale between a few queries.

use std::cmp::Ordering;

use super::{Ground, Start, Strategy};
use crate::error::Error;
use crate::ids::Place;
use crate::order::random::SplitMix;
use crate::tally::{Phase, Tally};

/// Parameters of jump-and-walk.
///
/// ```
/// use delone::{JumpAndWalk, Locate};
///
/// let few = Locate::JumpAndWalk(JumpAndWalk::default().sample(32).seed(1));
/// # let _ = few;
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct JumpAndWalk {
    /// The factor rho of the sample size rho n^(1/(d+1)).
    pub rho: f64,
    /// A fixed sample size instead, not zero.
    pub sample: Option<usize>,
    /// Whether a vertex may be drawn twice, which saves remembering what has been drawn. The paper draws without replacement.
    pub with_replacement: bool,
    /// Decides the samples, together with the query: the same query has the same sample.
    pub seed: u64,
}

impl Default for JumpAndWalk {
    fn default() -> Self {
        Self { rho: 1.0, sample: None, with_replacement: false, seed: 0 }
    }
}

impl JumpAndWalk {
    /// Sets [`Self::rho`].
    #[must_use]
    pub fn rho(self, rho: f64) -> Self {
        Self { rho, ..self }
    }

    /// Sets [`Self::sample`]: a number, or `None`.
    #[must_use]
    pub fn sample(self, sample: impl Into<Option<usize>>) -> Self {
        Self { sample: sample.into(), ..self }
    }

    /// Sets [`Self::with_replacement`].
    #[must_use]
    pub fn with_replacement(self, with_replacement: bool) -> Self {
        Self { with_replacement, ..self }
    }

    /// Sets [`Self::seed`].
    #[must_use]
    pub fn seed(self, seed: u64) -> Self {
        Self { seed, ..self }
    }

    pub(super) fn validate(&self) -> Result<(), Error> {
        if self.sample == Some(0) {
            return Err(Error::Parameter { name: "sample", value: 0.0, range: "at least 1" });
        }
        if !(self.rho > 0.0 && self.rho.is_finite()) {
            return Err(Error::Parameter { name: "rho", value: self.rho, range: "positive and finite" });
        }
        Ok(())
    }

    /// The number of vertices to draw out of `n`.
    pub(crate) fn sample_size(&self, n: usize, dimensions: usize) -> usize {
        let size = (self.rho * libm::pow(n as f64, 1.0 / (dimensions + 1) as f64)).ceil();
        self.sample.unwrap_or(size as usize).clamp(1, n.max(1))
    }

    /// The nearest to `q` of vertices drawn at random.
    pub(super) fn jump<G: Ground, T: Tally>(&self, ground: &G, q: G::Point, tally: &mut T) -> Option<Place> {
        let places = ground.place_count();
        if places == 0 {
            return None;
        }
        tally.phase(Phase::Sample);
        let mix = |seed: u64, axis| SplitMix(seed ^ G::coordinate(q, axis).to_bits()).next();
        let mut random = SplitMix((0..G::DIMENSIONS).fold(self.seed, mix));
        let mut best: Option<Place> = None;
        let mut left = self.sample_size(ground.vertex_count(), G::DIMENSIONS);
        let mut drawn = Drawn::new(if self.with_replacement { 0 } else { left });
        // Free places are skipped. Where nearly all are free, or all have been drawn, fewer draws have to do: any start is right.
        for _ in 0..16 * left {
            let v = Place::new(random.below(places));
            if ground.hint(v) == G::NOWHERE || !drawn.is_new(v) {
                continue;
            }
            tally.compared();
            tally.saw(|| vec![(0..G::DIMENSIONS).map(|axis| G::coordinate(ground.point(v), axis)).collect()]);
            if best.is_none_or(|b| ground.compare_distances(q, v, b) == Ordering::Less) {
                best = Some(v);
            }
            left -= 1;
            if left == 0 {
                break;
            }
        }
        best
    }
}

/// The places that have been drawn, hashed by linear probing; those of small samples without a memory to be asked for.
struct Drawn {
    few: [Place; Self::INLINE_SLOTS],
    many: Vec<Place>,
    /// The number of slots, a power of two, at most half full; 1 if nothing is remembered.
    slots: usize,
}

impl Drawn {
    /// Slots of a table that is stored in place; a larger table is allocated.
    const INLINE_SLOTS: usize = 32;

    /// Remembers at most so many; nothing, if that is zero.
    fn new(most: usize) -> Self {
        let slots = (2 * most).next_power_of_two();
        let many = if slots > Self::INLINE_SLOTS { vec![Place::GHOST; slots] } else { Vec::new() };
        Self { few: [Place::GHOST; Self::INLINE_SLOTS], many, slots }
    }

    /// Remembers a place, unless it has been drawn before.
    #[inline]
    fn is_new(&mut self, v: Place) -> bool {
        if self.slots == 1 {
            return true;
        }
        let slots = if self.many.is_empty() { &mut self.few[..self.slots] } else { &mut self.many[..] };
        let hash = (v.index() as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        let mut slot = (hash >> (64 - slots.len().trailing_zeros())) as usize;
        while !slots[slot].is_ghost() {
            if slots[slot] == v {
                return false;
            }
            slot = (slot + 1) & (slots.len() - 1);
        }
        slots[slot] = v;
        true
    }
}

impl<G: Ground> Strategy<G> for JumpAndWalk {
    fn start<T: Tally>(&self, ground: &G, q: G::Point, tally: &mut T) -> Start<G::Hint> {
        self.jump(ground, q, tally).map_or(Start::Anywhere, Start::Vertex)
    }

    fn inserted<T: Tally>(&mut self, _: &G, _: Place, _: Start<G::Hint>, _: &mut T) {}

    fn removing<T: Tally>(&mut self, _: &G, _: Place, _: &mut T) {}

    fn rearranged(&mut self, _: &G, _: &[Place]) {}
}

#[cfg(test)]
mod tests {
    use super::{Drawn, JumpAndWalk, Place};

    #[test]
    fn what_has_been_drawn_is_not_new() {
        for most in [1, 2, 16, 17, 1000] {
            let mut drawn = Drawn::new(most);
            for k in 0..most {
                assert!(drawn.is_new(Place::new(7 * k)) && !drawn.is_new(Place::new(7 * k)), "{k} of {most}");
            }
            assert!((0..most).all(|k| !drawn.is_new(Place::new(7 * k))));
        }
        let mut none = Drawn::new(0);
        assert!(none.is_new(Place::new(1)) && none.is_new(Place::new(1)));
    }

    #[test]
    fn samples_are_as_large_as_asked() {
        let size = |rho, sample, n, dimensions| {
            JumpAndWalk { rho, sample, ..JumpAndWalk::default() }.sample_size(n, dimensions)
        };
        assert_eq!((size(1.0, None, 1001, 2), size(1.0, None, 10_001, 3)), (11, 11));
        assert_eq!((size(2.5, None, 27, 2), size(1e300, None, 27, 2), size(1e-300, None, 27, 2)), (8, 27, 1));
        assert_eq!(
            (size(1.0, Some(32), 100, 2), size(1.0, Some(32), 10, 2), size(1.0, None, 0, 2)),
            (32, 10, 1)
        );
    }
}
