//! The Delaunay hierarchy: triangulations of ever larger random samples, the last of them of all points.
//!
//! Source: Devillers, "Improved incremental randomized Delaunay triangulation", SoCG 1998 (INRIA report 3298).
//! Each vertex of a level belongs to the level above with probability 1 / ratio. A query is located from the
//! top: at each level in three phases from the vertex found above,
//!
//! 1. turn around the vertex to the triangle on the line to the query,
//! 2. walk along the line to the triangle that contains the query,
//! 3. find the nearest vertex: exactly, by searching outwards from that triangle and crossing an edge only if
//!    the angle at its nearer end, towards the query, is acute; or the nearest of the triangle's corners (the
//!    modified phase of §4.3, which is cheaper).
//!
//! At the top a few vertices are drawn at random and the nearest of them is the start (the mixed method of
//! §4.5).
//!
//! Cost: O(ratio log n / log ratio) expected for any data, the randomness being the sample's, if the query is a
//! random one of the points; O(n ratio / (ratio - 1)) memory. Insertion and removal work on all levels of a
//! vertex, O(1) of them expected. Choose it where points come in adversarial order or many are removed.

use std::collections::BTreeMap;

use super::{Ground, JumpAndWalk, Level, Start, Strategy};
use crate::error::Error;
use crate::ids::Place;
use crate::order::random::SplitMix;
use crate::tally::Tally;

/// Levels that shrink less would be without number.
const SMALLEST_RATIO: f64 = 1.25;

/// Parameters of the hierarchy: those of §5.4 of the paper, with its defaults.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hierarchy {
    /// How many times smaller each level is than the one below; at least 1.25, so that all levels together have at most
    /// five times the vertices.
    pub ratio: f64,
    /// The largest number of levels, the triangulation itself included; unlimited if `None`.
    pub levels: Option<usize>,
    /// A level with fewer vertices is not used to locate points; one, at least.
    pub smallest_level: usize,
    /// From this number of vertices on, the search in the highest level starts from a random sample; `None`
    /// never samples.
    pub smallest_sampled: Option<usize>,
    /// The factor of the sample's size, as in [`JumpAndWalk::rho`].
    pub rho: f64,
    /// Search for the nearest vertex exactly, or content with the nearest corner of the triangle found.
    pub exact_nearest: bool,
    /// Decides the levels of vertices.
    pub seed: u64,
}

impl Default for Hierarchy {
    fn default() -> Self {
        Self {
            ratio: 30.0,
            levels: None,
            smallest_level: 20,
            smallest_sampled: Some(20),
            rho: 1.0,
            exact_nearest: false,
            seed: 0,
        }
    }
}

impl Hierarchy {
    /// The paper's mode "walk": one level, no sample.
    pub fn only_walk() -> Self {
        Self { levels: Some(1), smallest_sampled: None, ..Self::default() }
    }

    /// The paper's mode "MSZ": one level, with a sample.
    pub fn only_sample() -> Self {
        Self { levels: Some(1), ..Self::default() }
    }

    /// The paper's mode "hierarchy": levels, no sample.
    pub fn only_levels() -> Self {
        Self { smallest_sampled: None, ..Self::default() }
    }

    pub(super) fn validate(&self) -> Result<(), Error> {
        if !(self.ratio >= SMALLEST_RATIO && self.ratio.is_finite()) {
            return Err(Error::Parameter {
                name: "ratio",
                value: self.ratio,
                range: "at least 1.25 and finite",
            });
        }
        if self.levels == Some(0) {
            return Err(Error::Parameter { name: "levels", value: 0.0, range: "at least 1" });
        }
        self.sampling().validate()
    }

    fn sampling(&self) -> JumpAndWalk {
        JumpAndWalk { rho: self.rho, sample: None, seed: self.seed }
    }
}

/// A level above the triangulation itself.
#[derive(Clone, Debug, Default)]
struct Sample<L> {
    ground: L,
    /// For each vertex its place in the level below.
    down: Vec<Place>,
    /// For each vertex of the level below that is here, its place here.
    up: BTreeMap<Place, Place>,
}

/// All levels above the triangulation itself, the lowest first.
#[derive(Clone, Debug)]
pub(crate) struct Levels<L> {
    options: Hierarchy,
    samples: Vec<Sample<L>>,
    random: SplitMix,
    /// The vertex inserted last, where the search starts if there is neither level nor sample.
    last: Option<Place>,
}

impl<L: Level> Levels<L> {
    /// Levels over all vertices that there are.
    pub(crate) fn build<G: Ground<Point = L::Point, Hint = L::Hint>>(options: Hierarchy, ground: &G) -> Self {
        let mut levels = Self { options, samples: Vec::new(), random: SplitMix(options.seed), last: None };
        for v in ground.inhabited() {
            levels.lift(ground, v);
        }
        levels
    }

    /// The number of vertices of each level above the triangulation.
    pub(crate) fn sizes(&self) -> Vec<usize> {
        self.samples.iter().map(|sample| sample.ground.vertex_count()).collect()
    }

    /// What all levels take, given what one triangulation does.
    pub(crate) fn bytes(&self, ground: impl Fn(&L) -> usize) -> usize {
        let links = |sample: &Sample<L>| {
            // A tree's nodes are about two thirds full.
            size_of_val(&*sample.down) + sample.up.len() * size_of::<(Place, Place)>() * 3 / 2
        };
        self.samples.iter().map(|sample| ground(&sample.ground) + links(sample)).sum()
    }

    /// The number of levels from `level` on (0 is the lowest sample) that a descent goes through.
    fn used_from(&self, level: usize) -> usize {
        let is_used = |sample: &&Sample<L>| {
            sample.ground.vertex_count() >= self.options.smallest_level && sample.ground.is_spanned()
        };
        self.samples[level..].iter().take_while(is_used).count()
    }

    /// Descends until the vertex of level `stop` (1 is the lowest sample) near `q` is found; returns its place
    /// in the level below.
    fn descend<T: Tally>(&self, from: usize, stop: usize, q: L::Point, tally: &mut T) -> Place {
        let top = &self.samples[from - 1];
        let mut start = self.enter(&top.ground, q, tally);
        let mut level = from;
        loop {
            let sample = &self.samples[level - 1];
            let v = sample.ground.near(start, q, self.options.exact_nearest, tally);
            let below = sample.down[v.index()];
            if level == stop {
                return below;
            }
            start = Start::Vertex(below);
            level -= 1;
        }
    }

    /// Where to start in the highest level.
    fn enter<G: Ground<Point = L::Point, Hint = L::Hint>, T: Tally>(
        &self,
        ground: &G,
        q: L::Point,
        tally: &mut T,
    ) -> Start<L::Hint> {
        let sampled = self.options.smallest_sampled;
        if sampled.is_some_and(|least| ground.vertex_count() >= least) {
            return self.options.sampling().jump(ground, q, tally).map_or(Start::Anywhere, Start::Vertex);
        }
        ground.any_vertex().map_or(Start::Anywhere, Start::Vertex)
    }

    /// Gives the vertex its levels: one more with probability 1 / ratio each.
    fn lift<G: Ground<Point = L::Point, Hint = L::Hint>>(&mut self, ground: &G, v: Place) {
        let q = ground.point(v);
        let mut below = v;
        let highest = self.options.levels.map_or(usize::MAX, |levels| levels - 1);
        let mut level = 0;
        while level < highest && self.random.unit() * self.options.ratio < 1.0 {
            if level == self.samples.len() {
                self.samples.push(Sample::default());
            }
            let start = self.start_at(level, q);
            let sample = &mut self.samples[level];
            let Some(place) = sample.ground.add(q, start) else { break };
            if sample.down.len() <= place.index() {
                sample.down.resize(place.index() + 1, Place::GHOST);
            }
            sample.down[place.index()] = below;
            sample.up.insert(below, place);
            below = place;
            level += 1;
        }
        self.last = Some(v);
    }

    /// Where to start looking for `q` in a sample.
    fn start_at(&self, level: usize, q: L::Point) -> Start<L::Hint> {
        let here = &self.samples[level].ground;
        match self.used_from(level + 1) {
            0 => self.enter(here, q, &mut ()),
            used => Start::Vertex(self.descend(level + 1 + used, level + 2, q, &mut ())),
        }
    }
}

impl<L: Level, G: Ground<Point = L::Point, Hint = L::Hint>> Strategy<G> for Levels<L> {
    fn start<T: Tally>(&self, ground: &G, q: L::Point, tally: &mut T) -> Start<L::Hint> {
        match self.used_from(0) {
            0 if self.options.smallest_sampled.is_some() => self.enter(ground, q, tally),
            0 => self
                .last
                .filter(|&v| ground.hint(v) != G::NOWHERE)
                .map_or_else(|| self.enter(ground, q, tally), Start::Vertex),
            used => Start::Vertex(self.descend(used, 1, q, tally)),
        }
    }

    fn inserted(&mut self, ground: &G, v: Place, _: Start<L::Hint>) {
        self.lift(ground, v);
    }

    fn removing(&mut self, ground: &G, v: Place) {
        let mut below = v;
        let mut full = None;
        for (level, sample) in self.samples.iter_mut().enumerate() {
            let Some(place) = sample.up.remove(&below) else { break };
            if sample.ground.take(place).is_none() {
                // A level without room is better none, nor those above it.
                full = Some(level);
                break;
            }
            sample.down[place.index()] = Place::GHOST;
            below = place;
        }
        self.samples.truncate(full.unwrap_or(usize::MAX));
        while self.samples.pop_if(|sample| sample.ground.vertex_count() == 0).is_some() {}
        if self.last == Some(v) {
            self.last = ground.neighbor(v);
        }
    }

    fn rearranged(&mut self, _: &G, moved: &[Place]) {
        if let Some(lowest) = self.samples.first_mut() {
            let up = std::mem::take(&mut lowest.up);
            lowest.up = up.into_iter().map(|(below, place)| (moved[below.index()], place)).collect();
            for (&below, place) in &lowest.up {
                lowest.down[place.index()] = below;
            }
        }
        self.last = self.last.and_then(|v| moved.get(v.index()).copied());
    }
}
