//! All versions of the triangulation, made by splits and flips, with the history that leads through them.
//!
//! Source: Guibas, Knuth & Sharir, Algorithmica 1992, §3. In bulk this is the paper's algorithm: a point is traced, and
//! its triangle split and flipped (`build.rs`). Beside a triangulation that changes, the versions get each new
//! vertex where the search for it has ended.
//!
//! Cost: see `history.rs`; nine triangles a point of 36 bytes each.

use super::flips::Flips;
use super::history::History;
use crate::ids::{Place, TriangleId};
use crate::locate::{Ground, Start, Strategy};
use crate::order::random::SplitMix;
use crate::plane::layer::Layer;
use crate::tally::Tally;

/// See the module.
#[derive(Clone, Debug)]
pub(in crate::plane) struct Versions {
    pub(super) flips: Flips,
    pub(super) history: History,
    /// For each point of the versions the place of its vertex.
    pub(super) places: Vec<Place>,
}

impl Versions {
    /// Versions without vertices.
    pub(super) fn new() -> Self {
        Self { flips: Flips::new(), history: History::default(), places: Vec::new() }
    }

    /// Inserts the vertices that there are in random order, as the analysis wants it.
    pub(super) fn build(layer: &Layer) -> Self {
        let mut versions = Self::new();
        let mut order: Vec<Place> = layer.mesh.inhabited().collect();
        SplitMix(0).shuffle(&mut order);
        for v in order {
            versions.inserted(layer, v, Start::Anywhere, &mut ());
        }
        versions
    }

    /// Triangles past and present, those at the dummies included.
    pub(super) fn count(&self) -> usize {
        self.flips.count()
    }

    pub(super) fn bytes(&self) -> usize {
        let Self { flips, history, places } = self;
        flips.bytes() + size_of_val(&**places) + history.bytes()
    }

    pub(super) fn trace<T: Tally>(&self, q: [f64; 2], tally: &mut T) -> TriangleId {
        self.history.trace(&self.flips, q, tally)
    }
}

impl Strategy<Layer> for Versions {
    /// The walk starts in the triangle of the last version; the number is that triangle's.
    fn start<T: Tally>(&self, layer: &Layer, q: [f64; 2], tally: &mut T) -> Start {
        let t = self.trace(q, tally);
        Start::Hint(self.flips.hint(layer, &self.places, t, q, tally), t.index() as u32)
    }

    fn inserted<T: Tally>(&mut self, layer: &Layer, v: Place, start: Start, _: &mut T) {
        let q = layer.point(v);
        let t = match start {
            Start::Hint(_, number) => TriangleId::new(number as usize),
            _ => self.trace(q, &mut ()),
        };
        self.flips.points.push(q);
        self.places.push(v);
        let p = Place::new(self.flips.points.len() - 1);
        self.flips.insert(p, t, &mut self.history, &mut ());
    }

    fn removing<T: Tally>(&mut self, _: &Layer, _: Place, _: &mut T) {
        debug_assert!(false, "nothing is removed from a history");
    }

    fn rearranged(&mut self, _: &Layer, moved: &[Place]) {
        self.places.iter_mut().for_each(|place| *place = moved[place.index()]);
    }
}
