//! Where does a point fall? Strategies of location, free of coordinates.
//!
//! A strategy proposes where to start; the exact walk alone decides, so that every strategy gives every
//! answer. What location needs to know of a triangulation is the port [`Ground`], which each dimension
//! implements with its predicates.
//!
//! Costs are for queries that are spread as the points are; one beside two curves, in a triangle that would have much of the
//! set for neighbors, may visit any number on the way.
//!
//! | strategy | source | expected cost of a query | choose it |
//! | --- | --- | --- | --- |
//! | [`Locate::Tree`] | Bentley 1975, Devillers 1998 | O(log n) | always, unless there is a reason |
//! | [`Locate::Walk`] | Devillers, Pion & Teillaud 2002 | O(sqrt n), O(1) from nearby | queries follow each other in space |
//! | [`Locate::JumpAndWalk`] | Devroye, Mücke & Zhu 1998 | O(n^(1/3)) | no memory to spare |
//! | [`Locate::Hierarchy`] | Devillers 1998 | O(log n), for any data with [`Nearest::InCircle`], queries like the points | adversarial data that change a lot |
//! | [`Locate::History`] | Guibas, Knuth & Sharir 1992 | O(log n), random order | to study it; insertion only |
//! | [`Locate::Stars`] | the same | O(log n) stars, random order | to study it; insertion only |
//! | [`Locate::DelaunayTree`] | Boissonnat & Teillaud 1986 | O(log n), random order | to study it; a history that forgets |

pub(crate) mod conflict;
#[cfg(feature = "histories")]
pub(crate) mod delaunay_tree;
pub(crate) mod from_last;
pub(crate) mod hierarchy;
pub(crate) mod jump_and_walk;
pub(crate) mod levels;
mod links;
pub(crate) mod nearest;
pub(crate) mod tree;
pub(crate) mod walk;

pub use from_last::Walk;
pub use hierarchy::{Hierarchy, Nearest};
pub use jump_and_walk::JumpAndWalk;

use std::cmp::Ordering;
use std::fmt::Debug;

use crate::error::Error;
use crate::ids::{EdgeId, Place};
use crate::tally::Tally;

/// How to find where a point falls. The answer is the same; only cost differs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub enum Locate {
    /// A k-d tree of hints, rebuilt when the number of points doubles. In the plane a walk that its hint sends too far is
    /// given up for the levels of a hierarchy, which are made when long walks have taken as many steps as there are vertices:
    /// where triangles are long and thin, near is not close by.
    #[default]
    Tree,
    /// No structure: a walk from the vertex inserted last.
    Walk(Walk),
    /// A walk from the nearest of a few random vertices.
    JumpAndWalk(JumpAndWalk),
    /// A descent through triangulations of ever larger random samples.
    Hierarchy(Hierarchy),
    /// A descent through all triangles that ever were. Removal is an error. Without the feature `histories`,
    /// this and the next two act as [`Self::Tree`]. In space, this and `Stars` are errors.
    History,
    /// A history without the triangles that came and went in one insertion. The triangles that an insertion left are searched by
    /// binary search around the new vertex. Removal is an error.
    Stars,
    /// A search by circles through all triangles that ever were; those of a vertex that is removed are forgotten.
    DelaunayTree,
}

impl Locate {
    /// Whether the parameters are in range.
    pub(crate) fn validate(&self) -> Result<(), Error> {
        match self {
            Self::JumpAndWalk(options) => options.validate(),
            Self::Hierarchy(options) => options.validate(),
            Self::Tree | Self::Walk(_) | Self::History | Self::Stars | Self::DelaunayTree => Ok(()),
        }
    }
}

/// The memory of a strategy of location.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Footprint {
    /// Bytes of the triangulation itself: topology, coordinates, names.
    pub base: usize,
    /// Bytes of the strategy's own structure.
    pub strategy: usize,
    /// Vertices of each level of a hierarchy above the triangulation, the largest first.
    pub levels: Vec<usize>,
    /// Triangles of a history, past and present, those at the dummies or ghosts included; tetrahedra in space.
    pub versions: usize,
}

/// A triangulation as strategies of location see it, of the plane or of space.
pub(crate) trait Ground {
    /// A point that is looked for.
    type Point: Copy + Debug + PartialEq;
    /// Where a walk can start: an edge in the plane, a tetrahedron in space.
    type Hint: Copy + Debug + PartialEq + Send + Sync;
    /// The number of coordinates.
    const DIMENSIONS: usize;
    /// No hint.
    const NOWHERE: Self::Hint;

    /// Whether there are triangles, or tetrahedra.
    fn is_spanned(&self) -> bool;

    /// Whether [`Self::near`] finds what is near quickly.
    fn leads(&self) -> bool {
        self.is_spanned()
    }

    fn vertex_count(&self) -> usize;

    /// One more than the largest place.
    fn place_count(&self) -> usize;

    /// The places in use.
    fn inhabited(&self) -> impl Iterator<Item = Place>;

    /// A hint at the vertex of a place, or [`Self::NOWHERE`].
    fn hint(&self, v: Place) -> Self::Hint;

    /// Whether a walk can start at a hint.
    fn is_alive(&self, hint: Self::Hint) -> bool;

    /// Some vertex.
    fn any_vertex(&self) -> Option<Place>;

    /// Some vertex that is joined to another one.
    fn neighbor(&self, v: Place) -> Option<Place>;

    /// The point of a vertex.
    fn point(&self, v: Place) -> Self::Point;

    /// A coordinate, for trees and hashes; no decision hangs on it.
    fn coordinate(q: Self::Point, axis: usize) -> f64;

    /// Asks memory for the neighborhood of a hint all at once; a walk would ask piece by piece, and wait each
    /// time.
    fn prefetch_around(&self, hint: Self::Hint);

    /// Compares the distances of two vertices from `q`.
    fn compare_distances(&self, q: Self::Point, a: Place, b: Place) -> Ordering;

    /// Walks to `q`, then finds a vertex near it. Returns it, and a hint where `q` falls.
    fn near<T: Tally>(
        &self,
        start: Start<Self::Hint>,
        q: Self::Point,
        nearest: Nearest,
        tally: &mut T,
    ) -> (Place, Self::Hint);
}

/// A triangulation that changes: what a level of the hierarchy must be able to do.
pub(crate) trait Level: Ground + Default {
    /// Makes a point a vertex, and returns its place, if there is room; `start` is near it. The point is not a vertex yet.
    fn add<T: Tally>(&mut self, q: Self::Point, start: Start<Self::Hint>, tally: &mut T) -> Option<Place>;

    /// Removes the vertex at a place, if there is room for what takes its place.
    fn take<T: Tally>(&mut self, v: Place, tally: &mut T) -> Option<()>;
}

/// Where a walk starts, and which walk.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Start<H = EdgeId> {
    /// Here, by the walk given.
    At(H, Walk),
    /// Here. The number is the key of the strategy: a leaf of the tree, or a triangle of the history.
    Hint(H, u32),
    /// At this vertex, along the straight line to the goal.
    Vertex(Place),
    /// Anywhere.
    Anywhere,
}

/// A strategy of location. It is told of every change.
pub(crate) trait Strategy<G: Ground> {
    /// Where to start the walk to `q`.
    fn start<T: Tally>(&self, ground: &G, q: G::Point, tally: &mut T) -> Start<G::Hint>;

    /// Proposes a start for a point that will be inserted if it is no vertex yet: the way may be remembered.
    fn start_to_insert<T: Tally>(&mut self, ground: &G, q: G::Point, tally: &mut T) -> Start<G::Hint> {
        self.start(ground, q, tally)
    }

    /// A vertex has appeared, found from this start.
    fn inserted<T: Tally>(&mut self, ground: &G, v: Place, start: Start<G::Hint>, tally: &mut T);

    /// A vertex is about to go.
    fn removing<T: Tally>(&mut self, ground: &G, v: Place, tally: &mut T);

    /// The ground has been laid out anew: `moved` gives for each old place the new one.
    fn rearranged(&mut self, ground: &G, moved: &[Place]);
}
