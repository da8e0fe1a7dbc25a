//! The visibility walk: from simplex to simplex, across any facet that strictly separates the simplex from the goal.
//!
//! Source: Devillers, Pion & Teillaud, "Walking in a triangulation", IJFCS 2002. In a Delaunay or regular triangulation each step goes
//! to a circle or sphere of smaller power, so no simplex is visited twice. In others the facets must be asked in random order.
//!
//! The walk does not know how a side is decided. Its caller knows: by exact orientation, by the filter of a box, or from
//! coordinates and products seen in the step before. Each caller is compiled to a loop of its own.
//!
//! Others are written out, for a reason each:
//!
//! - `visibility` in `plane/layer/walk.rs` is this loop by hand, because location in the plane is a sixth faster by it;
//! - `straight` there and `cross` in `plane/constrained/trace.rs` follow one line, and its side of each apex decides;
//! - `hull_edge_nearest_to` and `nearest_hull_facet` go along the hull by distance.

use crate::ids::EdgeId;

/// The end of a walk.
#[derive(Clone, Copy, Debug)]
pub(crate) struct End<S> {
    /// The last simplex, or the edge of it that was crossed to it.
    pub(crate) at: S,
    /// Whether the walk arrived. If not, it was given up.
    pub(crate) has_arrived: bool,
}

/// Walks from a simplex, which is the first one visited, and gives up after `most` simplices. `onward` crosses a facet that separates
/// a simplex from the goal; it returns `None` at the goal, beyond the hull, and where no more may be crossed.
#[inline]
pub(crate) fn walk<S: Copy>(from: S, most: usize, mut onward: impl FnMut(S) -> Option<S>) -> End<S> {
    let mut at = from;
    for _ in 0..most {
        let Some(next) = onward(at) else { return End { at, has_arrived: true } };
        at = next;
    }
    End { at, has_arrived: false }
}

/// The edge by which a walk leaves a triangle that it has entered across `from`; `None` if the goal is beyond neither of the other two.
/// They are asked counter-clockwise, or clockwise if `is_turned`.
#[inline]
pub(crate) fn exit(
    from: EdgeId,
    is_turned: bool,
    mut is_beyond: impl FnMut(EdgeId) -> bool,
) -> Option<EdgeId> {
    let (first, second) =
        if is_turned { (from.previous(), from.next()) } else { (from.next(), from.previous()) };
    if is_beyond(first) {
        return Some(first);
    }
    is_beyond(second).then_some(second)
}
