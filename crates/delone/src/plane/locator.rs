//! The strategies of location at work in the plane.

use std::sync::OnceLock;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

use super::Delaunay2;
#[cfg(feature = "histories")]
use super::histories::Histories;
use super::layer::Layer;
use super::layer::insert::Spot;
use crate::ids::{EdgeId, Place, TriangleId};
use crate::locate::from_last::FromLast;
use crate::locate::levels::Levels;
use crate::locate::nearest::{descend, descend_within};
use crate::locate::tree::Tree;
use crate::locate::{Footprint, Hierarchy, JumpAndWalk, Locate, Start, Strategy};
use crate::tally::Tally;

/// The structure behind a [`Locate`].
#[derive(Clone, Debug)]
pub(super) enum Locator {
    Tree(Hints),
    FromLast(FromLast),
    JumpAndWalk(JumpAndWalk),
    Hierarchy(Box<Levels<Layer>>),
    #[cfg(feature = "histories")]
    Histories(Box<Histories>),
}

impl Locator {
    /// The structure for the vertices that there are.
    pub(super) fn build(locate: Locate, layer: &Layer) -> Self {
        #[cfg(feature = "histories")]
        if let Some(histories) = Histories::build(locate, layer) {
            return Self::Histories(Box::new(histories));
        }
        match locate {
            Locate::Walk(walk) => Self::FromLast(FromLast::new(walk)),
            Locate::JumpAndWalk(options) => Self::JumpAndWalk(options),
            Locate::Hierarchy(options) => Self::Hierarchy(Box::new(Levels::build(options, layer))),
            // Histories without their feature too: the answers are the same.
            Locate::Tree | Locate::History | Locate::Stars | Locate::DelaunayTree => {
                Self::Tree(Hints::build(layer))
            }
        }
    }
}

macro_rules! each {
    ($locator:expr, $strategy:ident => $do:expr) => {
        match $locator {
            Locator::Tree($strategy) => $do,
            Locator::FromLast($strategy) => $do,
            Locator::JumpAndWalk($strategy) => $do,
            Locator::Hierarchy($strategy) => $do,
            #[cfg(feature = "histories")]
            Locator::Histories($strategy) => $do,
        }
    };
}

impl Strategy<Layer> for Locator {
    #[inline]
    fn start<T: Tally>(&self, layer: &Layer, q: [f64; 2], tally: &mut T) -> Start {
        each!(self, strategy => strategy.start(layer, q, tally))
    }

    #[inline]
    fn start_to_insert<T: Tally>(&mut self, layer: &Layer, q: [f64; 2], tally: &mut T) -> Start {
        each!(self, strategy => strategy.start_to_insert(layer, q, tally))
    }

    #[inline]
    fn inserted<T: Tally>(&mut self, layer: &Layer, v: Place, start: Start, tally: &mut T) {
        each!(self, strategy => strategy.inserted(layer, v, start, tally));
    }

    fn removing<T: Tally>(&mut self, layer: &Layer, v: Place, tally: &mut T) {
        each!(self, strategy => strategy.removing(layer, v, tally));
    }

    fn rearranged(&mut self, layer: &Layer, moved: &[Place]) {
        each!(self, strategy => strategy.rearranged(layer, moved));
    }
}

/// A tree of hints and, when walks from them have taken as long as it takes to make them, the levels of a hierarchy.
///
/// A hint is near the goal, but where triangles are long and thin, as between two curves with many points, there may be any
/// number of them between two points that are near each other. The levels do not care, but cost each insertion an eighth: a
/// long walk beside the hull of evenly spread points, one in a hundred thousand, is no reason for them.
#[derive(Debug)]
pub(super) struct Hints {
    tree: Tree<EdgeId>,
    levels: OnceLock<Box<Levels<Layer>>>,
    /// The steps of long walks since the hints were made.
    spent: AtomicUsize,
}

impl Clone for Hints {
    fn clone(&self) -> Self {
        let spent = self.spent.load(Relaxed).into();
        Self { tree: self.tree.clone(), levels: self.levels.clone(), spent }
    }
}

impl Hints {
    /// Steps, after which a walk from a hint is given up if there are levels. On evenly spread points it takes four on average.
    const HINTED_STEPS: usize = 64;
    /// Steps along the hull, after which it is given up: mostly the first edge is the nearest one.
    const HINTED_STEPS_ALONG_HULL: usize = 16;
    /// A walk that takes more steps is long.
    const LONG: usize = 300;

    /// Hints at the vertices that there are.
    pub(super) fn build(layer: &Layer) -> Self {
        Self { tree: Tree::build(layer), levels: OnceLock::new(), spent: 0.into() }
    }

    /// Other hints, and the levels that there are.
    pub(super) fn renew(&mut self, layer: &Layer) {
        self.tree = Tree::build(layer);
        *self.spent.get_mut() = 0;
    }

    /// The largest number of steps: any number, where there are no levels.
    #[inline]
    fn most(&self, with_levels: usize) -> usize {
        if self.levels.get().is_some() { with_levels } else { usize::MAX }
    }

    /// Finds a point, and tells how many steps that took, and where from.
    #[inline]
    pub(super) fn spot<T: Tally>(&self, layer: &Layer, q: [f64; 2], tally: &mut T) -> (Spot, usize, Start) {
        let start = self.tree.start(layer, q, tally);
        let most = self.most(Self::HINTED_STEPS);
        let (spot, steps) = match layer.spot_within(start, q, most, tally) {
            Some(found) => found,
            None => self.rescue(layer, q, tally),
        };
        if steps > Self::LONG && most == usize::MAX {
            self.spend(layer, steps);
        }
        (spot, steps, start)
    }

    /// Finds a point that the tree's hint is far from.
    #[cold]
    fn rescue<T: Tally>(&self, layer: &Layer, q: [f64; 2], tally: &mut T) -> (Spot, usize) {
        let (spot, steps) = layer.spot(self.levels(layer).start(layer, q, tally), q, tally);
        (spot, steps + Self::HINTED_STEPS)
    }

    /// The hull edge that is nearest to a point beyond that of a ghost.
    pub(super) fn hull_edge<T: Tally>(
        &self,
        layer: &Layer,
        ghost: TriangleId,
        q: [f64; 2],
        tally: &mut T,
    ) -> EdgeId {
        let most = self.most(Self::HINTED_STEPS_ALONG_HULL);
        let (edge, steps) = layer.nearest_hull_edge(ghost, q, most);
        (0..steps).for_each(|_| tally.visited());
        if steps > most {
            return match self.rescue(layer, q, tally).0 {
                Spot::Triangle(ghost) => layer.hull_edge_nearest_to(q, ghost, tally),
                _ => edge,
            };
        }
        if steps > Self::LONG {
            self.spend(layer, steps);
        }
        edge
    }

    /// The vertex that is nearest to a point, down along edges from one that may be.
    pub(super) fn nearest<T: Tally>(&self, layer: &Layer, from: Place, q: [f64; 2], tally: &mut T) -> Place {
        let most = self.most(Self::LONG);
        let (nearest, compared) = descend_within(layer, from, q, most, tally);
        if compared > most {
            let from = self.levels(layer).nearest(q, tally).unwrap_or(nearest);
            return descend(layer, from, q, tally);
        }
        if compared > Self::LONG {
            self.spend(layer, compared);
        }
        nearest
    }

    /// Keeps account of a long walk.
    #[cold]
    fn spend(&self, layer: &Layer, steps: usize) {
        // To make the levels takes as long as some such steps a vertex.
        if self.spent.fetch_add(steps, Relaxed) + steps > layer.mesh.vertex_count {
            self.levels(layer);
        }
    }

    fn levels(&self, layer: &Layer) -> &Levels<Layer> {
        self.levels.get_or_init(|| Box::new(Levels::build(Hierarchy::default(), layer)))
    }
}

impl Strategy<Layer> for Hints {
    #[inline]
    fn start<T: Tally>(&self, layer: &Layer, q: [f64; 2], tally: &mut T) -> Start {
        self.tree.start(layer, q, tally)
    }

    #[inline]
    fn inserted<T: Tally>(&mut self, layer: &Layer, v: Place, start: Start, tally: &mut T) {
        self.tree.inserted(layer, v, start, tally);
        if let Some(levels) = self.levels.get_mut() {
            levels.inserted(layer, v, start, tally);
        }
    }

    fn removing<T: Tally>(&mut self, layer: &Layer, v: Place, tally: &mut T) {
        if let Some(levels) = self.levels.get_mut() {
            levels.removing(layer, v, tally);
        }
    }

    fn rearranged(&mut self, layer: &Layer, moved: &[Place]) {
        self.renew(layer);
        if let Some(levels) = self.levels.get_mut() {
            levels.rearranged(layer, moved);
        }
    }
}

impl Delaunay2 {
    /// Memory of the triangulation and of the structure of its strategy. Makes the structure if need be.
    pub fn footprint(&self) -> Footprint {
        let mut footprint = Footprint { base: self.base.bytes(), ..Footprint::default() };
        match self.locator() {
            Locator::Tree(Hints { tree, levels, .. }) => {
                footprint.strategy = tree.bytes();
                if let Some(levels) = levels.get() {
                    footprint.levels = levels.sizes();
                    footprint.strategy += levels.bytes(Layer::bytes);
                }
            }
            Locator::FromLast(_) | Locator::JumpAndWalk(_) => {}
            Locator::Hierarchy(levels) => {
                footprint.levels = levels.sizes();
                footprint.strategy = levels.bytes(Layer::bytes);
            }
            #[cfg(feature = "histories")]
            Locator::Histories(histories) => {
                footprint.versions = histories.count();
                footprint.strategy = histories.bytes();
            }
        }
        footprint
    }
}

#[cfg(test)]
mod tests {
    use delone_generators::Kind;

    use super::*;
    use crate::{Nearest, Walk, Work};

    fn with(n: usize, locate: Locate) -> Delaunay2 {
        let mut d = Delaunay2::from_points(&Kind::Uniform.points(n, 1)).expect("finite");
        d.set_strategy(locate).expect("in range");
        d
    }

    /// Makes the levels behind hints as walks do that go too far.
    fn rescue(d: &Delaunay2) {
        let Locator::Tree(hints) = d.locator() else { panic!("hints") };
        hints.spend(&d.base, d.vertex_count());
        assert!(d.footprint().levels.is_empty());
        hints.spend(&d.base, 1);
    }

    const STEEP: Hierarchy = Hierarchy {
        ratio: 4.0,
        levels: None,
        smallest_level: 20,
        smallest_sampled: None,
        rho: 1.0,
        with_replacement: false,
        nearest: Nearest::Corner,
        walk: None,
        seed: 1,
    };

    /// A triangulation of n points has 2 (n - 1) triangles of 32 bytes; a point has 16, and an edge.
    #[test]
    fn footprints_are_what_is_kept() {
        let bytes = |n: usize| 64 * (n - 1) + 20 * n;
        for locate in [Locate::Walk(Walk::Visibility), Locate::JumpAndWalk(JumpAndWalk::default())] {
            assert_eq!(with(100, locate).footprint(), Footprint { base: bytes(100), ..Footprint::default() });
        }
        let hints = with(1000, Locate::Tree);
        let tree = hints.footprint();
        assert!(tree.strategy > 1000 && tree.levels.is_empty(), "{tree:?}");
        rescue(&hints);
        let more = hints.footprint();
        assert!(more.levels[0] > 10, "{more:?}");
        assert!(more.strategy >= tree.strategy + bytes(more.levels[0]), "{more:?} after {tree:?}");
        assert!(more.strategy < tree.strategy + 3 * bytes(more.levels[0]), "{more:?} after {tree:?}");
        let levels = with(1000, Locate::Hierarchy(STEEP)).footprint();
        let least: usize = levels.levels.iter().map(|&size| bytes(size)).sum();
        assert!(levels.strategy >= least && levels.strategy < 2 * least, "{levels:?}");
        // The triangle of the dummies, the one behind it, and the three that a point makes, each with what follows.
        let history = with(1, Locate::History).footprint();
        let bytes = 5 * 32 + (3 + 1) * (16 + 4) + 4 + 5 * 4;
        assert_eq!((history.versions, history.strategy), (4, bytes));
    }

    /// Whoever keeps them.
    #[test]
    fn levels_follow_the_vertices() {
        for locate in [Locate::Tree, Locate::Hierarchy(STEEP)] {
            let mut d = with(600, locate);
            if locate == Locate::Tree {
                rescue(&d);
            }
            let few = d.footprint().levels;
            assert!(locate == Locate::Tree || few.len() > 2, "{few:?}");
            for p in Kind::Uniform.points(1800, 2) {
                d.insert(p).expect("finite");
            }
            let mut levels = d.footprint().levels;
            assert!(levels[0] > 2 * few[0], "{levels:?} after {few:?}");
            let vertices: Vec<_> = d.vertices().collect();
            for &v in &vertices[10..] {
                d.remove(v).expect("a vertex");
                let left = d.footprint().levels;
                // A vertex that is the only one of a level ends it.
                let one_less = |k: usize| levels[k] - left.get(k).unwrap_or(&0) <= 1;
                assert!((0..levels.len()).all(one_less), "{left:?} after {levels:?}");
                levels = left;
            }
            assert!(levels.iter().all(|&size| size <= 10), "{levels:?}");
        }
    }

    #[test]
    fn strategies_shorten_walks_counted() {
        let visited = |locate| {
            let d = with(20_000, locate);
            let mut work = Work::default();
            for q in Kind::Uniform.points(300, 7) {
                d.locate_observed(q, &mut work).expect("finite");
            }
            work.visited / 300
        };
        let walk = visited(Locate::Walk(Walk::Visibility));
        let sample = visited(Locate::JumpAndWalk(JumpAndWalk::default()));
        let levels = visited(Locate::Hierarchy(Hierarchy { smallest_sampled: None, ..Hierarchy::default() }));
        assert!(2 * sample < walk && 2 * levels < walk, "{walk} {sample} {levels}");
    }
}
