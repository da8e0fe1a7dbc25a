//! A segment becomes an edge, or a chain of edges through the vertices on it.
//!
//! Between two vertices it crosses a channel of triangles, whose two sides are filled anew. The apex of a side of such
//! a polygon is the vertex of its chain whose circle with the side contains no other: all of a chain see the segment across the
//! side, through the edges that they had across it, so that no visibility has to be asked. Where a chain comes to one vertex
//! twice, around what hangs into the channel, either occurrence may be the apex of a side only if the other one is not between
//! the side's ends: what hangs between them is in the circle.
//!
//! Sources: Anglada, "An improved incremental algorithm for constructing restricted Delaunay triangulations", Computers &
//! Graphics 1997; Shewchuk & Brown, "Fast segment insertion and incremental construction of constrained Delaunay
//! triangulations", CGTA 2015, for the order of segments and for what hangs into a channel.
//!
//! Cost: O(k) for k edges crossed up to two, O(k log k) for more: large sides have a triangulation of their own (see `patch`).

use delone_predicates::{Filter, Pencil, orient2d};

use super::patch::Patch;
use super::trace::{Beginning, Ground, Leaves};
use crate::ids::{EdgeId, Place};
use crate::mesh::Mesh2;
use crate::mesh::triangles::channel::Channel;
use crate::mesh::triangles::surgery::BorderEdge;
use crate::plane::layer::Layer;

/// Vertices of a border, above which each side has a triangulation of its own; below, scanning all of them is faster.
const PATCHED_BORDER: usize = 64;

/// An edge of a segment.
pub(super) struct Laid {
    /// It leaves one of the ends.
    pub(super) e: EdgeId,
    /// Whether that is the second end.
    pub(super) at_second: bool,
    /// Whether it was free.
    pub(super) is_new: bool,
}

impl Layer {
    pub(super) fn ground(&self) -> Ground<'_> {
        Ground { mesh: &self.mesh, points: &self.points }
    }

    /// Makes the segment between two different vertices a chain of fixed edges, each of which is told in the segment's
    /// direction. The channel is a buffer.
    ///
    /// # Errors
    /// The first fixed edge found that it crosses. What comes before it is fixed then.
    pub(super) fn force(
        &mut self,
        [mut a, mut b]: [Place; 2],
        channel: &mut Channel,
        mut each: impl FnMut(&Mesh2, EdgeId),
    ) -> Result<(), EdgeId> {
        while a != b {
            let Laid { e, at_second, .. } = self.lay([a, b], channel)?;
            each(&self.mesh, if at_second { self.mesh.twin(e) } else { e });
            *(if at_second { &mut b } else { &mut a }) = self.mesh.head(e);
        }
        Ok(())
    }

    /// Makes what of a segment is between one of its ends and the first vertex on it a fixed edge, from the end where that
    /// is cheaper.
    ///
    /// # Errors
    /// A fixed edge that it crosses.
    pub(super) fn lay(&mut self, [a, b]: [Place; 2], channel: &mut Channel) -> Result<Laid, EdgeId> {
        let Beginning { leaves, at_second } = self.ground().begin(a, b);
        let (e, is_new) = match leaves {
            Leaves::Along(e) => (e, !self.mesh.is_fixed(e)),
            // Its mark is that of an edge that was in its place.
            Leaves::Across(across) => {
                (self.dig(if at_second { [b, a] } else { [a, b] }, across, channel)?, true)
            }
        };
        self.mesh.set_fixed(e, true);
        Ok(Laid { e, at_second, is_new })
    }

    /// Replaces the edges that a segment crosses up to the first vertex on it. Returns its edge, from the near end on.
    fn dig(&mut self, [a, b]: [Place; 2], across: EdgeId, channel: &mut Channel) -> Result<EdgeId, EdgeId> {
        let end = self.ground().channel([a, b], across, channel)?;
        if channel.triangles.len() == 2 {
            // Both sides are triangles: nothing is to be tested.
            self.mesh.flip(across);
            let e = across;
            return Ok(if self.mesh.tail(e) == a { e } else { self.mesh.twin(e) });
        }
        let points = &self.points;
        let filter = filter(points, channel);
        let mut patch = None;
        let e = self.mesh.fill_channel([a, end], channel, |border, first, last| {
            if (first, last) == (0, border.len() - 1) {
                patch = (border.len() > PATCHED_BORDER).then(|| Patch::new(points, border)).flatten();
            }
            let known = patch.as_ref().and_then(|patch| patch.apex(first, last));
            known.unwrap_or_else(|| apex(points, &filter, border, first, last))
        });
        Ok(if self.mesh.tail(e) == a { e } else { self.mesh.twin(e) })
    }

    /// The fixed edges that the segment between two vertices crosses.
    pub(super) fn obstacles(&self, ends: [Place; 2]) -> Vec<EdgeId> {
        let mut found = Vec::new();
        self.ground().follow(
            ends,
            |_, _| {},
            |e| {
                found.extend(Some(e).filter(|&e| self.mesh.is_fixed(e)));
                true
            },
        );
        found
    }

    /// Whether a point is on the line of an edge.
    pub(super) fn is_on(&self, e: EdgeId, q: [f64; 2]) -> bool {
        let [a, b] = [self.mesh.tail(e), self.mesh.head(e)].map(|v| self.points[v.index()]);
        orient2d(a, b, q).is_zero()
    }
}

/// Bounds for all points of a channel.
fn filter(points: &[[f64; 2]], channel: &Channel) -> Filter {
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for (v, _) in channel.left.iter().chain(&channel.right) {
        let p = points[v.index()];
        for k in 0..2 {
            low[k] = low[k].min(p[k]);
            high[k] = high[k].max(p[k]);
        }
    }
    Filter::for_box(high[0] - low[0], high[1] - low[1], None)
}

/// The apex of the side from `last` to `first` among the vertices of the chain between them.
pub(super) fn apex(
    points: &[[f64; 2]],
    filter: &Filter,
    border: &[BorderEdge],
    first: usize,
    last: usize,
) -> usize {
    if last == first + 2 {
        return first + 1;
    }
    let ends = [border[first].0, border[last].0];
    let point = |v: Place| points[v.index()];
    let pencil = Pencil::new(point(ends[1]), point(ends[0]));
    let mut best = None;
    for k in first + 1..last {
        let place = border[k].0;
        if ends.contains(&place) {
            continue;
        }
        let candidate = pencil.member(point(place));
        let is_better = best.is_none_or(|(at, member): (usize, _)| {
            border[at].0 != place && pencil.in_circle(&member, &candidate, filter).is_positive()
        });
        if is_better {
            best = Some((k, candidate));
        }
    }
    best.expect("a side has an apex, unless it is a side of what hangs in the channel").0
}
