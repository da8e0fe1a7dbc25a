//! Walks from triangle to triangle: visibility, stochastic, straight. They alone decide where a point is.
//!
//! Source: Devillers, Pion & Teillaud, "Walking in a triangulation", IJFCS 2002.
//!
//! - The *visibility* walk crosses any edge that separates the triangle from the goal. In a Delaunay
//!   triangulation it cannot visit a triangle twice, because each step goes to a circle of smaller power, so it
//!   ends without randomness.
//! - The *stochastic* walk asks the edges of each triangle in random order, which ends in any triangulation.
//! - The *straight* walk visits the triangles on the segment from a vertex to the goal.
//!
//! Cost: O(sqrt n) triangles on evenly spread points, O(n) at worst; from a near start, O(1). One or two
//! orientation tests a triangle. Choose a walk alone when every query is near the one before, or near the vertex
//! inserted last; it takes no memory.

use std::cmp::Ordering;

use crate::tally::Tally;
use super::{Ground, Start, Strategy, Surface};
use crate::ids::{EdgeId, Place, TriangleId};
use crate::mesh::Mesh2;
use crate::order::random::SplitMix;

/// Which walk.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Walk {
    /// Cross any edge that has the goal beyond it: the fewest tests.
    #[default]
    Visibility,
    /// The same, edges in random order.
    Stochastic {
        /// Decides the order.
        seed: u64,
    },
    /// Visit the triangles on the straight line to the goal.
    Straight,
}

/// The end of a walk.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Goal {
    /// The finite triangle that contains the goal in its inside or on its border, or else the ghost triangle of
    /// a hull edge that the goal is strictly beyond.
    pub(crate) triangle: TriangleId,
    /// Triangles visited.
    pub(crate) steps: usize,
}

/// Walks to `q`. The triangulation must span the plane.
#[inline]
pub(crate) fn walk<G: Surface, T: Tally>(ground: &G, start: Start, q: G::Point, tally: &mut T) -> Goal {
    let mesh = ground.mesh();
    match start {
        Start::At(e, Walk::Visibility) | Start::Hint(e, _) => walk_within(ground, e, q, usize::MAX, tally),
        Start::At(e, Walk::Stochastic { seed }) => {
            let mut random = SplitMix(seed);
            visibility(ground, e, q, usize::MAX, move |_| random.next() & 1 == 1, tally)
        }
        Start::At(e, Walk::Straight) => match mesh.tail(finite_side(mesh, e)) {
            Place::GHOST => walk_within(ground, e, q, usize::MAX, tally),
            v => straight(ground, v, q, tally),
        },
        Start::Vertex(v) => straight(ground, v, q, tally),
        Start::Anywhere => walk_within(ground, mesh.ghost_edge, q, usize::MAX, tally),
    }
}

/// A visibility walk, which ends, anywhere, after more steps than `most`, at least 2.
#[inline]
pub(crate) fn walk_within<G: Surface, T: Tally>(
    ground: &G,
    start: EdgeId,
    q: G::Point,
    most: usize,
    tally: &mut T,
) -> Goal {
    visibility(ground, start, q, most, |_| false, tally)
}

/// The edge itself, or for an edge of a ghost triangle the hull edge, from inside.
fn finite_side(mesh: &Mesh2, e: EdgeId) -> EdgeId {
    let t = e.triangle();
    match mesh.places(t).iter().position(|v| v.is_ghost()) {
        Some(k) => mesh.twin(t.edge(k).next()),
        None => e,
    }
}

/// `turned` says for each triangle whether its edges are asked clockwise.
#[inline]
fn visibility<G: Surface, T: Tally>(
    ground: &G,
    start: EdgeId,
    q: G::Point,
    most: usize,
    mut turned: impl FnMut(TriangleId) -> bool,
    tally: &mut T,
) -> Goal {
    let mesh = ground.mesh();
    let mut from = finite_side(mesh, start);
    let mut steps = 1;
    tally.visited();
    tally.orientation();
    if ground.is_beyond(from, q) {
        from = mesh.twin(from);
        steps += 1;
        tally.visited();
        if mesh.tip(from).is_ghost() {
            return Goal { triangle: from.triangle(), steps };
        }
    }
    loop {
        // `q` is not beyond `from`: it came from there.
        let (mut first, mut second) = (from.next(), from.previous());
        if turned(from.triangle()) {
            (first, second) = (second, first);
        }
        ground.prefetch(mesh.twin(first));
        ground.prefetch(mesh.twin(second));
        tally.orientation();
        let crossed = if ground.is_beyond(first, q) {
            first
        } else {
            tally.orientation();
            if !ground.is_beyond(second, q) {
                return Goal { triangle: from.triangle(), steps };
            }
            second
        };
        from = mesh.twin(crossed);
        steps += 1;
        tally.visited();
        if mesh.tip(from).is_ghost() || steps > most {
            return Goal { triangle: from.triangle(), steps };
        }
    }
}

/// From a vertex along the segment to `q`. A vertex on the line counts as being on its right.
fn straight<G: Surface, T: Tally>(ground: &G, v: Place, q: G::Point, tally: &mut T) -> Goal {
    let mesh = ground.mesh();
    let from = ground.point(v);
    let mut steps = 0;
    let mut is_left = |w: Place| {
        tally.orientation();
        ground.side(from, q, w) == Ordering::Greater
    };
    // The line leaves between a spoke on its right and the next one, counter-clockwise, on its left. From a spoke on
    // the right it is found counter-clockwise, from one on the left clockwise, never further than half around. At a
    // vertex of the hull there may be none, and at `q` itself: the visibility walk knows what to do.
    let first = mesh.incident[v.index()];
    let mut spoke = first;
    let turns_left = !mesh.head(spoke).is_ghost() && !is_left(mesh.head(spoke));
    // The walk is in the triangle of the first spoke, and going clockwise leaves it.
    steps += usize::from(!turns_left);
    let mut side = loop {
        let next = if turns_left { mesh.spin(spoke) } else { mesh.twin(spoke).next() };
        let head = mesh.head(next);
        steps += 1;
        if next == first || head.is_ghost() || mesh.head(spoke).is_ghost() {
            return walk_within(ground, spoke, q, usize::MAX, tally);
        }
        if is_left(head) == turns_left {
            break if turns_left { spoke.next() } else { next.next() };
        }
        spoke = next;
    };
    (0..steps).for_each(|_| tally.visited());
    loop {
        tally.orientation();
        if !ground.is_beyond(side, q) {
            return Goal { triangle: side.triangle(), steps };
        }
        let entered = mesh.twin(side);
        steps += 1;
        tally.visited();
        let tip = mesh.tip(entered);
        if tip.is_ghost() {
            return Goal { triangle: entered.triangle(), steps };
        }
        tally.orientation();
        let is_left = ground.side(from, q, tip) == Ordering::Greater;
        side = if is_left { entered.next() } else { entered.previous() };
    }
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
        match self.last.map(|v| ground.hint(v)) {
            Some(hint) if hint != G::NOWHERE => Start::At(hint, self.walk),
            _ => Start::Anywhere,
        }
    }

    fn inserted(&mut self, _: &G, v: Place, _: Start<G::Hint>) {
        self.last = Some(v);
    }

    fn removing(&mut self, ground: &G, v: Place) {
        if self.last == Some(v) {
            self.last = ground.neighbor(v);
        }
    }

    fn rearranged(&mut self, _: &G, moved: &[Place]) {
        self.last = self.last.and_then(|v| moved.get(v.index()).copied());
    }
}
