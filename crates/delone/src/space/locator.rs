//! The strategies of location at work in space.

use super::Delaunay3;
use super::layer::Layer;
use crate::error::Error;
use crate::ids::{Place, TetrahedronId};
#[cfg(feature = "histories")]
use crate::locate::delaunay_tree::DelaunayTree;
use crate::locate::from_last::FromLast;
use crate::locate::levels::Levels;
use crate::locate::tree::Tree;
use crate::locate::{Footprint, Hierarchy, JumpAndWalk, Locate, Nearest, Start, Strategy, Walk};
use crate::tally::Tally;

/// The structure behind a [`Locate`].
#[derive(Clone, Debug)]
pub(super) enum Locator {
    Tree(Tree<TetrahedronId>),
    FromLast(FromLast),
    JumpAndWalk(JumpAndWalk),
    Hierarchy(Box<Levels<Layer>>),
    #[cfg(feature = "histories")]
    DelaunayTree(Box<DelaunayTree<[f64; 3], 4>>),
}

impl Locator {
    /// Whether there is such a strategy in space.
    pub(super) fn validate(locate: Locate) -> Result<(), Error> {
        match locate {
            Locate::History
            | Locate::Stars
            | Locate::Walk(Walk::Stochastic { .. } | Walk::Straight)
            | Locate::Hierarchy(
                Hierarchy { walk: Some(Walk::Stochastic { .. } | Walk::Straight), .. }
                | Hierarchy { nearest: Nearest::InCircle, .. },
            ) => Err(Error::OnlyInThePlane),
            _ => locate.validate(),
        }
    }

    /// The structure for the vertices that there are.
    pub(super) fn build(locate: Locate, layer: &Layer) -> Self {
        match locate {
            Locate::Tree | Locate::History | Locate::Stars => Self::Tree(Tree::build(layer)),
            Locate::Walk(walk) => Self::FromLast(FromLast::new(walk)),
            Locate::JumpAndWalk(options) => Self::JumpAndWalk(options),
            Locate::Hierarchy(options) => Self::Hierarchy(Box::new(Levels::build(options, layer))),
            #[cfg(feature = "histories")]
            Locate::DelaunayTree => Self::DelaunayTree(Box::new(DelaunayTree::build(layer))),
            #[cfg(not(feature = "histories"))]
            Locate::DelaunayTree => Self::Tree(Tree::build(layer)),
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
            Locator::DelaunayTree($strategy) => $do,
        }
    };
}

impl Strategy<Layer> for Locator {
    #[inline]
    fn start<T: Tally>(&self, layer: &Layer, q: [f64; 3], tally: &mut T) -> Start<TetrahedronId> {
        each!(self, strategy => strategy.start(layer, q, tally))
    }

    #[inline]
    fn start_to_insert<T: Tally>(
        &mut self,
        layer: &Layer,
        q: [f64; 3],
        tally: &mut T,
    ) -> Start<TetrahedronId> {
        each!(self, strategy => strategy.start_to_insert(layer, q, tally))
    }

    #[inline]
    fn inserted<T: Tally>(&mut self, layer: &Layer, v: Place, start: Start<TetrahedronId>, tally: &mut T) {
        each!(self, strategy => strategy.inserted(layer, v, start, tally));
    }

    fn removing<T: Tally>(&mut self, layer: &Layer, v: Place, tally: &mut T) {
        each!(self, strategy => strategy.removing(layer, v, tally));
    }

    fn rearranged(&mut self, layer: &Layer, moved: &[Place]) {
        each!(self, strategy => strategy.rearranged(layer, moved));
    }
}

impl Delaunay3 {
    /// Memory of the triangulation and of the structure of its strategy. Makes the structure if need be.
    pub fn footprint(&self) -> Footprint {
        let mut footprint = Footprint { base: self.base.bytes(), ..Footprint::default() };
        match self.locator() {
            Locator::Tree(tree) => footprint.strategy = tree.bytes(),
            Locator::FromLast(_) | Locator::JumpAndWalk(_) => {}
            Locator::Hierarchy(levels) => {
                footprint.levels = levels.sizes();
                footprint.strategy = levels.bytes(Layer::bytes);
            }
            #[cfg(feature = "histories")]
            Locator::DelaunayTree(tree) => {
                footprint.versions = tree.count();
                footprint.strategy = tree.bytes();
            }
        }
        footprint
    }
}
