//! Location and construction by what a triangulation was: the feature `histories`.
//!
//! | file | keeps | source |
//! | --- | --- | --- |
//! | `history` | all triangles of splits and flips, each with its successors | Guibas, Knuth & Sharir 1992, §3 |
//! | `stars` | the triangles that were Delaunay, in the stars that made them | the same, a remark after the unlucky site |
//! | `delaunay_tree` | the triangles that were Delaunay, found by their circles | Boissonnat & Teillaud 1986 |
//! | `conflict_lists` | for each triangle the points in it that are still to come | Clarkson & Shor 1989 |
//!
//! `flips` inserts a point by a split and flips, `versions` runs a history beside a triangulation that changes, and `build`
//! constructs in bulk. The Delaunay tree itself serves space too, and is in `locate/delaunay_tree/`.
//!
//! Cost: the head of each file. Choose them to study the randomized incremental construction: `Locate::Tree` is faster.

mod build;
mod conflict_lists;
mod delaunay_tree;
mod flips;
mod history;
mod stars;
mod versions;

use super::construct::Built;
use super::layer::Layer;
use crate::ids::Place;
use crate::locate::delaunay_tree::DelaunayTree;
use crate::locate::{Locate, Start, Strategy};
use crate::tally::{Counters, Tally};
use stars::Stars;
use versions::Versions;

/// A strategy of location that keeps a history.
#[derive(Clone, Debug)]
pub(super) enum Histories {
    DelaunayTree(DelaunayTree<[f64; 2], 3>),
    Versions(Versions),
    Stars(Stars),
}

impl Histories {
    /// The history of the vertices that there are, in random order; `None` for a strategy that keeps no history.
    pub(super) fn build(locate: Locate, layer: &Layer) -> Option<Self> {
        match locate {
            Locate::DelaunayTree => Some(Self::DelaunayTree(DelaunayTree::build(layer))),
            Locate::History => Some(Self::Versions(Versions::build(layer))),
            Locate::Stars => Some(Self::Stars(Stars::build(layer))),
            _ => None,
        }
    }

    /// Triangles past and present.
    pub(super) fn count(&self) -> usize {
        match self {
            Self::DelaunayTree(tree) => tree.count(),
            Self::Versions(versions) => versions.count(),
            Self::Stars(stars) => stars.count(),
        }
    }

    /// Memory in bytes.
    pub(super) fn bytes(&self) -> usize {
        match self {
            Self::DelaunayTree(tree) => tree.bytes(),
            Self::Versions(versions) => versions.bytes(),
            Self::Stars(stars) => stars.bytes(),
        }
    }
}

/// Does the same with each history.
macro_rules! each {
    ($histories:expr, $strategy:ident => $do:expr) => {
        match $histories {
            Histories::DelaunayTree($strategy) => $do,
            Histories::Versions($strategy) => $do,
            Histories::Stars($strategy) => $do,
        }
    };
}

impl Strategy<Layer> for Histories {
    fn start<T: Tally>(&self, layer: &Layer, q: [f64; 2], tally: &mut T) -> Start {
        each!(self, strategy => strategy.start(layer, q, tally))
    }

    fn start_to_insert<T: Tally>(&mut self, layer: &Layer, q: [f64; 2], tally: &mut T) -> Start {
        each!(self, strategy => strategy.start_to_insert(layer, q, tally))
    }

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

/// Constructs by conflict lists.
pub(super) fn by_conflict_lists(points: Vec<[f64; 2]>, seed: u64) -> Built {
    let (mesh, duplicates, work, moved) = build::by_lists(&points, seed);
    Built { points, mesh, duplicates, counters: Counters::ConflictLists { work, moved } }
}

/// Constructs by history, which stays for location.
pub(super) fn by_history(points: Vec<[f64; 2]>, seed: u64) -> (Built, Histories) {
    let (mesh, duplicates, work, versions) = build::by_history(&points, seed);
    (Built { points, mesh, duplicates, counters: Counters::Incremental(work) }, Histories::Versions(versions))
}
