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

use super::Layer;
use super::kernel::Kernel;
use crate::ids::{EdgeId, Place, TriangleId};
use crate::locate::{Start, Walk};
use crate::order::random::SplitMix;
use crate::tally::{Phase, Tally};

/// For walks that must be random and need not be chosen.
const ANY_SEED: u64 = 1;

/// The end of a walk.
#[derive(Clone, Copy, Debug)]
pub(in crate::plane) struct Goal {
    /// The finite triangle that contains the goal in its inside or on its border, or else the ghost triangle of
    /// a hull edge that the goal is strictly beyond.
    pub(in crate::plane) triangle: TriangleId,
    /// Triangles visited.
    pub(in crate::plane) steps: usize,
}

/// Walks to `q`. The triangulation must span the plane.
#[inline]
pub(in crate::plane) fn walk<K: Kernel, T: Tally>(
    layer: &Layer<K>,
    start: Start,
    q: [f64; 2],
    tally: &mut T,
) -> Goal {
    let mesh = &layer.mesh;
    match start {
        Start::At(e, Walk::Visibility) | Start::Hint(e, _) => walk_within(layer, e, q, usize::MAX, tally),
        Start::At(e, Walk::Stochastic { seed }) => {
            let mut random = SplitMix(seed);
            visibility(layer, e, q, usize::MAX, move |_| random.next() & 1 == 1, tally)
        }
        Start::At(e, Walk::Straight) => match mesh.tail(mesh.finite_side(e)) {
            Place::GHOST => walk_within(layer, e, q, usize::MAX, tally),
            v => straight(layer, v, q, tally),
        },
        Start::Vertex(v) => straight(layer, v, q, tally),
        Start::Anywhere => walk_within(layer, mesh.ghost_edge, q, usize::MAX, tally),
    }
}

/// A visibility walk that gives up after more than `most` steps (at least 2), wherever it is. Where edges are fixed the triangulation
/// need not be Delaunay, and the walk is stochastic.
#[inline]
pub(in crate::plane) fn walk_within<K: Kernel, T: Tally>(
    layer: &Layer<K>,
    start: EdgeId,
    q: [f64; 2],
    most: usize,
    tally: &mut T,
) -> Goal {
    if layer.mesh.is_tagged {
        let mut random = SplitMix(ANY_SEED);
        return visibility(layer, start, q, most, move |_| random.next() & 1 == 1, tally);
    }
    visibility(layer, start, q, most, |_| false, tally)
}

/// Tells of a triangle.
#[inline]
fn visit<K: Kernel, T: Tally>(layer: &Layer<K>, t: TriangleId, tally: &mut T) {
    tally.visited();
    tally.saw(|| corners(layer, t));
}

fn corners<K: Kernel>(layer: &Layer<K>, t: TriangleId) -> Vec<Vec<f64>> {
    let corners = layer.mesh.places(t).into_iter().filter(|v| !v.is_ghost());
    corners.map(|v| layer.points[v.index()].to_vec()).collect()
}

/// `turned` says for each triangle whether its edges are asked clockwise. This is the loop of `locate/walk.rs` written out: location is
/// a sixth faster by it (`compare -- --changes`).
#[inline]
fn visibility<K: Kernel, T: Tally>(
    layer: &Layer<K>,
    start: EdgeId,
    q: [f64; 2],
    most: usize,
    mut turned: impl FnMut(TriangleId) -> bool,
    tally: &mut T,
) -> Goal {
    let mesh = &layer.mesh;
    tally.phase(Phase::Walk);
    let mut from = mesh.finite_side(start);
    let mut steps = 1;
    visit(layer, from.triangle(), tally);
    tally.orientation();
    if layer.is_beyond(from, q) {
        from = mesh.twin(from);
        steps += 1;
        visit(layer, from.triangle(), tally);
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
        layer.prefetch_triangle(mesh.twin(first));
        layer.prefetch_triangle(mesh.twin(second));
        tally.orientation();
        let crossed = if layer.is_beyond(first, q) {
            first
        } else {
            tally.orientation();
            if !layer.is_beyond(second, q) {
                return Goal { triangle: from.triangle(), steps };
            }
            second
        };
        from = mesh.twin(crossed);
        steps += 1;
        visit(layer, from.triangle(), tally);
        if mesh.tip(from).is_ghost() || steps > most {
            return Goal { triangle: from.triangle(), steps };
        }
    }
}

/// From a vertex along the segment to `q`. A vertex on the line counts as being on its right.
fn straight<K: Kernel, T: Tally>(layer: &Layer<K>, v: Place, q: [f64; 2], tally: &mut T) -> Goal {
    let mesh = &layer.mesh;
    let from = layer.points[v.index()];
    tally.phase(Phase::Turn);
    let mut steps = 0;
    let mut is_left = |w: Place| {
        tally.orientation();
        layer.side(from, q, w) == Ordering::Greater
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
            (1..steps).for_each(|_| tally.visited());
            return walk_within(layer, spoke, q, usize::MAX, tally);
        }
        if is_left(head) == turns_left {
            break if turns_left { spoke.next() } else { next.next() };
        }
        spoke = next;
    };
    (0..steps).for_each(|_| tally.visited());
    tally.phase(Phase::Walk);
    tally.saw(|| corners(layer, side.triangle()));
    loop {
        tally.orientation();
        if !layer.is_beyond(side, q) {
            return Goal { triangle: side.triangle(), steps };
        }
        let entered = mesh.twin(side);
        steps += 1;
        visit(layer, entered.triangle(), tally);
        let tip = mesh.tip(entered);
        if tip.is_ghost() {
            return Goal { triangle: entered.triangle(), steps };
        }
        tally.orientation();
        let is_left = layer.side(from, q, tip) == Ordering::Greater;
        side = if is_left { entered.next() } else { entered.previous() };
    }
}
