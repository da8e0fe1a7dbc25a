//! Which segments pass which triangles, and which of them may cross there.
//!
//! Cost: that of following segments, as many triangles as they cross; and for each triangle the number of pairs that come together
//! there: from different sides, or from a corner.

use super::trace::Ground;
use crate::ids::{EdgeId, TriangleId, VertexId};
use crate::plane::Delaunay2;

/// No edge of a triangle.
const NO_EDGE: u8 = 3;

/// A segment in a triangle. Ordered by that, so that those that cross the same two of its edges follow each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Pass {
    triangle: TriangleId,
    /// The edge that it does not cross, if it crosses the others.
    not_crossed: u8,
    segment: u32,
    /// The edge that it comes in by, if it does not begin at a corner.
    entry: u8,
}

impl Pass {
    fn beginning(triangle: TriangleId, segment: u32) -> Self {
        Self { triangle, not_crossed: NO_EDGE, segment, entry: NO_EDGE }
    }

    /// Leaves by an edge.
    fn leave(&mut self, by: EdgeId) {
        if self.entry != NO_EDGE {
            self.not_crossed = 3 - self.entry - by.corner() as u8;
        }
    }
}

/// Calls for each two segments that may cross, once or a few times: two that come into a triangle by the same edge are together in
/// the one before.
pub(super) fn each_pair(passes: &[Pass], mut each: impl FnMut(u32, u32)) {
    for at_one in passes.chunk_by(|p, q| p.triangle == q.triangle) {
        for others in at_one.chunk_by(|p, q| p.not_crossed == q.not_crossed) {
            let k = others[0].not_crossed;
            for p in at_one.iter().filter(|p| p.entry == NO_EDGE || k == NO_EDGE || p.entry == k) {
                let start = others.partition_point(|q| q.segment <= p.segment);
                others[start..].iter().for_each(|q| each(p.segment, q.segment));
            }
        }
    }
}

/// All that some segments pass.
#[derive(Debug, Default)]
pub(super) struct Passes {
    /// In their order.
    pub(super) passes: Vec<Pass>,
    /// Constraints, each by the lesser of its two edges, and a segment that crosses them.
    pub(super) crossed: Vec<(EdgeId, u32)>,
}

impl Passes {
    pub(super) fn of(graph: &Delaunay2, segments: &[[VertexId; 2]], some: &[u32]) -> Self {
        let mesh = graph.mesh();
        let ground = Ground { mesh, points: &graph.base.points };
        let Self { mut passes, mut crossed } = Self::default();
        for &s in some {
            let mut along = Vec::new();
            let first = passes.len();
            ground.follow(
                segments[s as usize].map(|v| mesh.place(v).expect("a vertex")),
                |e, _| along.extend([e, mesh.twin(e)]),
                |e| {
                    if passes[first..].last().is_none_or(|pass| pass.triangle != e.triangle()) {
                        passes.push(Pass::beginning(e.triangle(), s));
                    }
                    let entered = mesh.twin(e);
                    passes.last_mut().expect("where it comes from").leave(e);
                    let entry = entered.corner() as u8;
                    passes.push(Pass { entry, ..Pass::beginning(entered.triangle(), s) });
                    if mesh.is_fixed(e) {
                        crossed.push((e.min(entered), s));
                    }
                    true
                },
            );
            passes.extend(along.into_iter().map(|e| Pass::beginning(e.triangle(), s)));
        }
        passes.sort_unstable();
        crossed.sort_unstable();
        Self { passes, crossed }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plane::constrained::ConstraintReport2;
    use crate::plane::constrained::build::constrained;
    use crate::plane::constrained::crossings::meet;

    /// Segments through one point cross each other in all triangles around it; each two come together in few of them.
    #[test]
    fn each_pair_is_looked_at_a_few_times() {
        let count = 100;
        let end = |i: u32, sign: f64| [sign * f64::from(i + 1), sign * f64::from(count)];
        let points: Vec<[f64; 2]> = (0..count).flat_map(|i| [end(i, 1.0), end(i, -1.0)]).collect();
        let segments: Vec<[usize; 2]> = (0..count as usize).map(|i| [2 * i, 2 * i + 1]).collect();
        let (graph, ends, refused) = constrained(points, &segments, &mut ConstraintReport2::default());
        let Passes { passes, .. } = Passes::of(&graph, &ends, &refused);
        let mut looks = 0;
        each_pair(&passes, |_, _| looks += 1);
        assert!(looks < 3 * refused.len().pow(2), "{looks} for {}", refused.len());
        assert_eq!(meet(&graph, &ends, &refused).crossings.len(), segments.len() * (segments.len() - 1) / 2);
    }
}
