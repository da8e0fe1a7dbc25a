//! The levels of the Delaunay hierarchy at work: descents, insertion and removal.
//!
//! Source: Devillers, "Improved incremental randomized Delaunay triangulation", SoCG 1998, §2.2 and §2.3.
//!
//! Cost: a query one descent; an insertion the descent that located the point and, with probability 1 / ratio for each level
//! above, a cavity there, where the descent has left the triangle; a removal a hole on each level of the vertex.

use super::links::Links;
use super::nearest::{self, Metric};
use super::{Ground, Hierarchy, Level, Start, Strategy, Walk};
use crate::ids::Place;
use crate::order::random::SplitMix;
use crate::tally::Tally;

/// A level above the triangulation itself.
#[derive(Clone, Debug, Default)]
struct Sample<L> {
    ground: L,
    links: Links,
}

/// Where the last descent came through.
#[derive(Clone, Debug)]
struct Trail<L: Ground> {
    /// The point that it led to, as long as no level has changed since.
    goal: Option<L::Point>,
    /// For each sample that it went through, the highest first, where the goal falls.
    hints: Vec<L::Hint>,
}

/// All levels above the triangulation itself, the lowest first.
#[derive(Clone, Debug)]
pub(crate) struct Levels<L: Ground> {
    options: Hierarchy,
    samples: Vec<Sample<L>>,
    random: SplitMix,
    /// The vertex inserted last, where the search starts if there is neither level nor sample.
    last: Option<Place>,
    trail: Trail<L>,
}

impl<L: Level> Levels<L> {
    /// Levels over all vertices that there are.
    pub(crate) fn build<G: Ground<Point = L::Point, Hint = L::Hint>>(options: Hierarchy, ground: &G) -> Self {
        let trail = Trail { goal: None, hints: Vec::new() };
        let random = SplitMix(options.seed);
        let mut levels = Self { options, samples: Vec::new(), random, last: None, trail };
        for v in ground.inhabited() {
            levels.lift(ground, v, &mut ());
        }
        levels
    }

    /// A vertex that is near to a point: the nearest one of the lowest sample, down along edges on each of them.
    pub(crate) fn nearest<T: Tally>(&self, q: L::Point, tally: &mut T) -> Option<Place>
    where
        L: Metric,
    {
        self.samples.iter().rev().fold(None, |above, sample| {
            let from = above.or_else(|| sample.ground.any_vertex())?;
            Some(sample.links.below(nearest::descend(&sample.ground, from, q, tally)))
        })
    }

    /// The number of vertices of each level above the triangulation.
    pub(crate) fn sizes(&self) -> Vec<usize> {
        self.samples.iter().map(|sample| sample.ground.vertex_count()).collect()
    }

    /// Memory of all levels, given that of one triangulation.
    pub(crate) fn bytes(&self, ground: impl Fn(&L) -> usize) -> usize {
        self.samples.iter().map(|sample| ground(&sample.ground) + sample.links.bytes()).sum()
    }

    /// The number of samples that a descent goes through.
    fn used(&self) -> usize {
        let is_used = |sample: &&Sample<L>| {
            sample.ground.vertex_count() >= self.options.smallest_level && sample.ground.leads()
        };
        self.samples.iter().take_while(is_used).count()
    }

    /// Descends to the triangulation: where to start there. `each` is told where `q` falls in each sample on the way.
    fn descend<G: Ground<Point = L::Point, Hint = L::Hint>, T: Tally>(
        &self,
        base: &G,
        q: L::Point,
        each: &mut dyn FnMut(L::Hint),
        tally: &mut T,
    ) -> Start<L::Hint> {
        let mut level = self.used();
        tally.level(level);
        let Some(top) = level.checked_sub(1).map(|top| &self.samples[top]) else {
            return self.start_at_base(base, q, tally);
        };
        let mut start = self.enter(&top.ground, q, tally);
        while let Some(sample) = level.checked_sub(1).map(|k| &self.samples[k]) {
            let (v, hint) = sample.ground.near(start, q, self.options.nearest, tally);
            each(hint);
            level -= 1;
            tally.level(level);
            let below = sample.links.below(v);
            start = match level.checked_sub(1) {
                Some(k) => self.start_at_vertex(&self.samples[k].ground, below),
                None => self.start_at_vertex(base, below),
            };
        }
        start
    }

    /// Where to start if no sample is used.
    fn start_at_base<G: Ground<Point = L::Point, Hint = L::Hint>, T: Tally>(
        &self,
        base: &G,
        q: L::Point,
        tally: &mut T,
    ) -> Start<L::Hint> {
        let last = self.last.filter(|&v| base.hint(v) != G::NOWHERE);
        match last {
            Some(v) if self.options.smallest_sampled.is_none() => self.start_at_vertex(base, v),
            _ => self.enter(base, q, tally),
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
        let v = if sampled.is_some_and(|least| ground.vertex_count() >= least) {
            self.options.sampling().jump(ground, q, tally)
        } else {
            ground.any_vertex()
        };
        v.map_or(Start::Anywhere, |v| self.start_at_vertex(ground, v))
    }

    /// The walk of choice from a vertex.
    fn start_at_vertex<G: Ground<Hint = L::Hint>>(&self, ground: &G, v: Place) -> Start<L::Hint> {
        match self.options.walk {
            None | Some(Walk::Straight) => Start::Vertex(v),
            Some(walk) => Start::At(ground.hint(v), walk),
        }
    }

    /// Gives the vertex its levels: one more with probability 1 / ratio each.
    fn lift<G: Ground<Point = L::Point, Hint = L::Hint>, T: Tally>(
        &mut self,
        base: &G,
        v: Place,
        tally: &mut T,
    ) {
        self.last = Some(v);
        let most = self.options.levels.map_or(usize::MAX, |levels| levels - 1);
        let mut height = 0;
        while height < most && self.random.unit() * self.options.ratio < 1.0 {
            height += 1;
        }
        if height > 0 {
            self.insert_above(base, v, height, tally);
        }
    }

    /// Makes a vertex of the triangulation one of so many samples.
    #[cold]
    fn insert_above<G: Ground<Point = L::Point, Hint = L::Hint>, T: Tally>(
        &mut self,
        base: &G,
        v: Place,
        height: usize,
        tally: &mut T,
    ) {
        let q = base.point(v);
        if self.trail.goal != Some(q) {
            // Located by others.
            self.descend_to_insert(base, q, tally);
        }
        self.trail.goal = None;
        let used = self.trail.hints.len();
        let mut below = v;
        for level in 0..height {
            if level == self.samples.len() {
                self.samples.push(Sample::default());
            }
            tally.level(level + 1);
            let start = match used.checked_sub(level + 1) {
                Some(k) => Start::At(self.trail.hints[k], Walk::Visibility),
                None => self.enter(&self.samples[level].ground, q, tally),
            };
            let sample = &mut self.samples[level];
            let Some(place) = sample.ground.add(q, start, tally) else { break };
            sample.links.join(place, below);
            below = place;
        }
        tally.level(0);
    }

    /// Descends, and remembers the way.
    fn descend_to_insert<G: Ground<Point = L::Point, Hint = L::Hint>, T: Tally>(
        &mut self,
        base: &G,
        q: L::Point,
        tally: &mut T,
    ) -> Start<L::Hint> {
        let mut hints = std::mem::take(&mut self.trail.hints);
        hints.clear();
        let start = self.descend(base, q, &mut |hint| hints.push(hint), tally);
        self.trail = Trail { goal: Some(q), hints };
        start
    }
}

impl<L: Level, G: Ground<Point = L::Point, Hint = L::Hint>> Strategy<G> for Levels<L> {
    fn start<T: Tally>(&self, ground: &G, q: L::Point, tally: &mut T) -> Start<L::Hint> {
        self.descend(ground, q, &mut |_| {}, tally)
    }

    fn start_to_insert<T: Tally>(&mut self, ground: &G, q: L::Point, tally: &mut T) -> Start<L::Hint> {
        self.descend_to_insert(ground, q, tally)
    }

    fn inserted<T: Tally>(&mut self, ground: &G, v: Place, _: Start<L::Hint>, tally: &mut T) {
        self.lift(ground, v, tally);
    }

    fn removing<T: Tally>(&mut self, ground: &G, v: Place, tally: &mut T) {
        self.trail.goal = None;
        let mut below = v;
        let mut full = None;
        for (level, sample) in self.samples.iter_mut().enumerate() {
            let Some(place) = sample.links.cut(below) else { break };
            tally.level(level + 1);
            if sample.ground.take(place, tally).is_none() {
                // A level without room is better none, nor those above it.
                full = Some(level);
                break;
            }
            below = place;
        }
        tally.level(0);
        self.samples.truncate(full.unwrap_or(usize::MAX));
        while self.samples.pop_if(|sample| sample.ground.vertex_count() == 0).is_some() {}
        if self.last == Some(v) {
            self.last = ground.neighbor(v);
        }
    }

    fn rearranged(&mut self, _: &G, moved: &[Place]) {
        if let Some(lowest) = self.samples.first_mut() {
            lowest.links.rearranged(moved);
        }
        self.last = self.last.and_then(|v| moved.get(v.index()).copied());
    }
}
