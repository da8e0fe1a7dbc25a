//! No structure: each search walks from the vertex inserted last, or from some vertex of what was built in bulk.
//!
//! Source: Devillers, Pion & Teillaud, "Walking in a triangulation", IJFCS 2002, for the walks. Choose this when every
//! query is near the one before, or near the vertex inserted last; it takes no memory.

use super::{Ground, Start, Strategy};
use crate::ids::Place;
use crate::tally::Tally;

/// Which walk.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Walk {
    /// Cross any edge that has the goal beyond it: the fewest tests.
    #[default]
    Visibility,
    /// Cross any edge that has the goal beyond it, asked in random order. For the plane.
    Stochastic {
        /// Decides the order.
        seed: u64,
    },
    /// Visit the triangles on the straight line to the goal. For the plane.
    Straight,
}

/// The strategy without a structure: a walk from the vertex inserted last.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct FromLast {
    pub(crate) walk: Walk,
    last: Option<Place>,
}

impl FromLast {
    pub(crate) fn new(walk: Walk) -> Self {
        Self { walk, last: None }
    }
}

impl<G: Ground> Strategy<G> for FromLast {
    fn start<T: Tally>(&self, ground: &G, _: G::Point, _: &mut T) -> Start<G::Hint> {
        let from = self.last.or_else(|| ground.any_vertex());
        match from.map(|v| ground.hint(v)) {
            Some(hint) if hint != G::NOWHERE => Start::At(hint, self.walk),
            _ => Start::Anywhere,
        }
    }

    fn inserted<T: Tally>(&mut self, _: &G, v: Place, _: Start<G::Hint>, _: &mut T) {
        self.last = Some(v);
    }

    fn removing<T: Tally>(&mut self, ground: &G, v: Place, _: &mut T) {
        if self.last == Some(v) {
            self.last = ground.neighbor(v);
        }
    }

    fn rearranged(&mut self, _: &G, moved: &[Place]) {
        self.last = self.last.and_then(|v| moved.get(v.index()).copied());
    }
}
