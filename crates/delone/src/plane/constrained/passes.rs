//! Which segments pass which triangles, and which of them may cross there.
//!
//! Cost: that of following segments, as many triangles as they cross; and for each triangle the number of pairs that come together
//! there: from different sides, or from a corner.

use super::trace::Ground;
use crate::ids::{EdgeId, TriangleId, VertexId};
use crate::plane::Delaunay2;

/// No edge of a triangle.
const NO_EDGE: u8 = 3;
/// No number of a triangle or of a segment.
const NO_NUMBER: u32 = u32::MAX;

/// A segment in a triangle, both by their numbers among those that pass and are passed.
#[derive(Clone, Copy, Debug)]
struct Pass {
    triangle: u32,
    segment: u32,
    /// The edge that it does not cross, if it crosses the others.
    not_crossed: u8,
    /// The edge that it comes in by, if it does not begin at a corner.
    entry: u8,
}

impl Pass {
    fn beginning(triangle: u32, segment: u32) -> Self {
        Self { triangle, segment, not_crossed: NO_EDGE, entry: NO_EDGE }
    }

    /// Leaves by an edge.
    fn leave(&mut self, by: EdgeId) {
        if self.entry != NO_EDGE {
            self.not_crossed = 3 - self.entry - by.corner() as u8;
        }
    }

    /// The group of segments that cross the same edges of the triangle.
    fn group(&self) -> usize {
        4 * self.triangle as usize + usize::from(self.not_crossed)
    }
}

/// All that some segments pass.
#[derive(Debug, Default)]
pub(super) struct Passes {
    /// Segment by segment.
    all: Vec<Pass>,
    /// Where each group begins among the segments of all groups, and where the last ends.
    starts: Vec<usize>,
    /// The segments of each group, in increasing order.
    grouped: Vec<u32>,
    /// Constraints, each by the lesser of its two edges, and the index of a segment that crosses them.
    pub(super) crossed: Vec<(EdgeId, u32)>,
}

impl Passes {
    pub(super) fn of(graph: &Delaunay2, segments: &[[VertexId; 2]], some: &[u32]) -> Self {
        let mesh = graph.mesh();
        let ground = Ground { mesh, points: &graph.base.points };
        let (mut passes, mut crossed) = (Vec::new(), Vec::new());
        let (mut numbers, mut count) = (vec![NO_NUMBER; mesh.slot_count()], 0);
        let mut number = |t: TriangleId| {
            let number = &mut numbers[t.index()];
            if *number == NO_NUMBER {
                *number = count;
                count += 1;
            }
            *number
        };
        for (segment, &s) in (0..).zip(some) {
            let mut along = Vec::new();
            let first = passes.len();
            ground.follow(
                segments[s as usize].map(|v| mesh.place(v).expect("a vertex")),
                |e, _| along.extend([e, mesh.twin(e)]),
                |e| {
                    let left = number(e.triangle());
                    if passes[first..].last().is_none_or(|pass: &Pass| pass.triangle != left) {
                        passes.push(Pass::beginning(left, segment));
                    }
                    let entered = mesh.twin(e);
                    passes.last_mut().expect("where it comes from").leave(e);
                    let entry = entered.corner() as u8;
                    passes.push(Pass { entry, ..Pass::beginning(number(entered.triangle()), segment) });
                    if mesh.is_fixed(e) {
                        crossed.push((e.min(entered), s));
                    }
                    true
                },
            );
            passes.extend(along.into_iter().map(|e| Pass::beginning(number(e.triangle()), segment)));
        }
        crossed.sort_unstable();
        let mut starts = vec![0; 4 * count as usize + 1];
        passes.iter().for_each(|pass| starts[pass.group()] += 1);
        let mut sum = 0;
        for start in &mut starts {
            sum += *start;
            *start = sum;
        }
        let mut grouped = vec![0; passes.len()];
        for pass in passes.iter().rev() {
            let at = &mut starts[pass.group()];
            *at -= 1;
            grouped[*at] = pass.segment;
        }
        Self { all: passes, starts, grouped, crossed }
    }

    /// Calls for each two segments that may cross, once, with their places among those that pass, in increasing order of the first. Two
    /// that come into a triangle by the same edge are together in the one before.
    pub(super) fn each_pair(&self, mut each: impl FnMut(usize, usize)) {
        let segment_count = self.all.last().map_or(0, |pass| pass.segment as usize + 1);
        let mut last_seen_for = vec![NO_NUMBER; segment_count];
        for pass in &self.all {
            let is_from_a_corner = pass.entry == NO_EDGE;
            for k in (0..=NO_EDGE).filter(|&k| is_from_a_corner || k == NO_EDGE || k == pass.entry) {
                let group = Pass { not_crossed: k, ..*pass }.group();
                let others = self.grouped[self.starts[group]..self.starts[group + 1]].iter().rev();
                for &other in others.take_while(|&&other| other > pass.segment) {
                    let last = std::mem::replace(&mut last_seen_for[other as usize], pass.segment);
                    if last != pass.segment {
                        each(pass.segment as usize, other as usize);
                    }
                }
            }
        }
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
        let passes = Passes::of(&graph, &ends, &refused);
        let mut looks = 0;
        passes.each_pair(|_, _| looks += 1);
        assert!(looks < refused.len().pow(2), "{looks} for {}", refused.len());
        assert_eq!(meet(&graph, &ends, &refused).crossings.len(), segments.len() * (segments.len() - 1) / 2);
    }
}
