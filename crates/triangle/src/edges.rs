//! Segments and edges of the results.
//!
//! Each edge is told once, with the triangle that has the least row of the two beside it.

#![allow(unsafe_code, reason = "results are lists of C")]

use std::ffi::c_int;
use std::mem::MaybeUninit;

use rayon::prelude::*;

use crate::built::Side;
use crate::fault::Fault;
use crate::layout::TriangulateIo;
use crate::memory::{Fresh, copy, fill};
use crate::output::Output;

/// A list that nothing is to be written into.
pub(crate) fn nothing(count: usize) -> Vec<MaybeUninit<()>> {
    vec![MaybeUninit::new(()); count]
}

impl Output<'_> {
    /// Writes two values for each edge, in their order; for none if there is no room for any.
    pub(crate) fn fill_sides<A: Send, B: Send>(
        &self,
        to: &mut [MaybeUninit<A>],
        and: &mut [MaybeUninit<B>],
        values: impl Fn(&Side) -> (A, B) + Sync,
    ) {
        if to.is_empty() {
            return;
        }
        let (mut to, mut and) = (to, and);
        let mut blocks = Vec::with_capacity(self.built.starts.len());
        for pair in self.built.starts.windows(2) {
            let ((first, rest), (second, others)) =
                (to.split_at_mut(pair[1] - pair[0]), and.split_at_mut(pair[1] - pair[0]));
            blocks.push((first, second));
            (to, and) = (rest, others);
        }
        blocks.into_par_iter().enumerate().for_each(|(block, (to, and))| {
            for (side, (to, and)) in self.built.sides_of_block(block).zip(to.iter_mut().zip(and)) {
                let (a, b) = values(&side);
                to.write(a);
                and.write(b);
            }
        });
    }

    /// The nodes in the middles of the edges opposite to corners, by triangle.
    pub(crate) fn middles(&self) -> Vec<[c_int; 3]> {
        let (built, first) = (self.built, self.point_count() as c_int + self.s.base);
        let mut middles = vec![[0; 3]; built.triangles.len()];
        // Edge k is opposite to the corner before it leaves its own.
        for (side, node) in built.all_sides().zip(first..) {
            middles[side.row][(side.edge.corner() + 2) % 3] = node;
            if let Ok(across) = usize::try_from(side.across) {
                middles[across][(built.mesh().twin(side.edge).corner() + 2) % 3] = node;
            }
        }
        middles
    }

    /// Writes segments and edges.
    ///
    /// # Safety
    /// As [`Self::write`].
    pub(crate) unsafe fn write_edges(&self, out: *mut TriangulateIo, fresh: &mut Fresh) -> Result<(), Fault> {
        let (built, s) = (self.built, self.s);
        if (s.poly || s.convex) && !s.no_segments {
            let count = built.segments.len();
            // SAFETY: as the caller says.
            let to =
                unsafe { fresh.room::<_, [c_int; 2]>(&raw mut (*out).segmentlist, count, "segmentlist")? };
            fill(to, &built.segments, |_, segment| segment.ends.map(|v| self.name(v)));
            if !s.no_markers {
                // SAFETY: as the caller says.
                let to =
                    unsafe { fresh.room(&raw mut (*out).segmentmarkerlist, count, "segmentmarkerlist")? };
                copy(to, &self.segment_markers);
            }
        }
        if s.edges {
            let count = built.edge_count();
            let ends = |side: &Side| built.ends(side).map(|v| self.name(v));
            // SAFETY: as the caller says.
            let to = unsafe { fresh.room::<_, [c_int; 2]>(&raw mut (*out).edgelist, count, "edgelist")? };
            if s.no_markers {
                self.fill_sides(to, &mut nothing(count), |side| (ends(side), ()));
            } else {
                // SAFETY: as the caller says.
                let and = unsafe { fresh.room(&raw mut (*out).edgemarkerlist, count, "edgemarkerlist")? };
                self.fill_sides(to, and, |side| (ends(side), self.marker(side)));
            }
        }
        Ok(())
    }
}
