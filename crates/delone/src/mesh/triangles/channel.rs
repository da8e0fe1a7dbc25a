//! The triangles that a segment crosses become those on its two sides.
//!
//! A border edge of a side may have the other side of itself in the same channel: an edge that hangs into it from a vertex,
//! with crossed triangles on both sides. Such a pair is parted while the sides are filled, each half glued to a triangle that
//! is there for nothing else, and joined again afterwards.
//!
//! Cost: O(k log k) for k triangles, and what choosing apexes takes.

use super::Mesh2;
use super::surgery::{BorderEdge, Part};
use crate::ids::{EdgeId, Place, TriangleId};

/// The channel of a segment between two vertices: the borders of the polygons on its left and on its right, both without the
/// segment itself, counter-clockwise, and the triangles.
#[derive(Clone, Debug, Default)]
pub(crate) struct Channel {
    /// From the far end of the segment back to the near one.
    pub(crate) left: Vec<BorderEdge>,
    /// From the near end to the far one.
    pub(crate) right: Vec<BorderEdge>,
    pub(crate) triangles: Vec<TriangleId>,
    /// A buffer.
    pending: Vec<Part<()>>,
}

/// Whether the border of a channel may pass a vertex twice: an edge then hangs into the channel from it.
fn may_hang(border: &[BorderEdge]) -> bool {
    /// Vertices, up to which repetitions are searched, in quadratic time; a longer border is assumed to have one.
    const SCANNED_BORDER: usize = 16;
    border.len() > SCANNED_BORDER
        || (1..border.len()).any(|i| border[..i].iter().any(|&(v, _)| v == border[i].0))
}

impl Mesh2 {
    /// Puts the segment from `a` to `b` in the place of the edges that it crosses, two or more, none of them fixed. `apex` says
    /// which vertex of a border is joined to the side from `last` to `first`, one between them. Returns the segment's edge.
    pub(crate) fn fill_channel(
        &mut self,
        [a, b]: [Place; 2],
        channel: &mut Channel,
        mut apex: impl FnMut(&[BorderEdge], usize, usize) -> usize,
    ) -> EdgeId {
        let Channel { left, right, triangles, pending } = channel;
        let stand_ins =
            if may_hang(left) || may_hang(right) { self.part(left, right, triangles) } else { Vec::new() };
        // As many triangles as vertices between the ends.
        let (on_left, on_right) = triangles.split_at(left.len() - 1);
        // Until the right side is there, any edge that will be written then stands for it.
        left.push((a, on_right[0].edge(0)));
        self.fill_hole(left, on_left, pending, (), |first, last, ()| (apex(left, first, last), (), ()));
        let inner = self.twin(on_right[0].edge(0));
        right.push((b, inner));
        self.fill_hole(right, on_right, pending, (), |first, last, ()| (apex(right, first, last), (), ()));
        for t in stand_ins {
            let [e, f] = [0, 1].map(|k| self.twin(t.edge(k)));
            self.link(e, f);
            self.remember(e);
            self.remember(f);
            self.free_triangle(t);
        }
        inner
    }

    /// Parts the edges that hang into a channel: both halves get an edge of a new triangle for twin.
    fn part(
        &mut self,
        left: &mut [BorderEdge],
        right: &mut [BorderEdge],
        triangles: &[TriangleId],
    ) -> Vec<TriangleId> {
        triangles.iter().for_each(|&t| self.mark(t));
        let mut hanging: Vec<(EdgeId, usize, usize)> = Vec::new();
        for (side, border) in [&*left, &*right].into_iter().enumerate() {
            for (i, &(_, outside)) in border.iter().enumerate() {
                if self.is_marked(outside.triangle()) {
                    hanging.push((outside.min(self.twin(outside)), side, i));
                }
            }
        }
        hanging.sort_unstable();
        let mut stand_ins = Vec::new();
        for pair in hanging.chunks_exact(2) {
            debug_assert_eq!(pair[0].0, pair[1].0, "both halves are on the border");
            let t = self.new_triangle(triangles[0]);
            let fixed = self.is_fixed(pair[0].0);
            for (k, &(_, side, i)) in pair.iter().enumerate() {
                let border = if side == 0 { &mut *left } else { &mut *right };
                border[i].1 = t.edge(k);
            }
            if fixed {
                let tags = [0, 1].iter().fold(self.tags(t), |tags, &k| tags.with(t.edge(k), true));
                self.set_tags(t, tags);
            }
            stand_ins.push(t);
        }
        stand_ins
    }
}
