//! The vertices that points of a segment are rounded to.
//!
//! A k-d tree of vertices is searched with a segment. What lies in the box of the segment and surely on one side of its line, by
//! more than roundings go, is passed by: a point, or all points of a node. Exact tests decide about the rest.
//!
//! Cost: O(n log n) to build, up to 40 bytes a point; O(sqrt(n)) boxes and the points near a segment, on evenly spread points.

use crate::ids::VertexId;
use crate::powers::power_below;

/// Points a leaf, at most.
const LEAF_POINTS: usize = 8;

/// A vertex and its point.
pub(super) type Named = ([f64; 2], VertexId);

/// A box: the least coordinates, and the greatest.
type Bounds = [[f64; 2]; 2];

/// The tree.
pub(super) struct Cells {
    /// Leaf by leaf.
    vertices: Vec<Named>,
    /// For each node, from the root at 1, the box of its points. The points of a node are halved for the two below it.
    boxes: Vec<Bounds>,
    /// How many boxes and points have been looked at, which tests bound.
    looked: usize,
}

impl Cells {
    pub(super) fn new(mut vertices: Vec<Named>) -> Self {
        let leaves = vertices.len().div_ceil(LEAF_POINTS).next_power_of_two();
        let mut boxes = vec![[[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]]; 2 * leaves];
        halve(&mut vertices, 1, &mut boxes);
        Self { vertices, boxes, looked: 0 }
    }

    /// Tells of all vertices in the box of a segment that points of it may be rounded to: of those that are, and of few others.
    pub(super) fn each_near(&mut self, ends: [[f64; 2]; 2], each: &mut impl FnMut(&Named)) {
        let band = Band::around(ends);
        let mut pending = vec![(1, 0..self.vertices.len())];
        while let Some((node, range)) = pending.pop() {
            self.looked += 1;
            if band.misses(self.boxes[node]) {
                continue;
            }
            if 2 * node < self.boxes.len() {
                let middle = range.start + range.len() / 2;
                pending.push((2 * node + 1, middle..range.end));
                pending.push((2 * node, range.start..middle));
                continue;
            }
            self.looked += range.len();
            let near = self.vertices[range].iter().filter(|(p, _)| !band.misses([*p, *p]));
            near.for_each(&mut *each);
        }
    }
}

/// Makes the nodes below a node, and its own box.
fn halve(vertices: &mut [Named], node: usize, boxes: &mut [Bounds]) {
    let [low, high] = &mut boxes[node];
    for (p, _) in &*vertices {
        for k in 0..2 {
            low[k] = low[k].min(p[k]);
            high[k] = high[k].max(p[k]);
        }
    }
    let axis = usize::from(high[1] - low[1] > high[0] - low[0]);
    if 2 * node < boxes.len() {
        let middle = vertices.len() / 2;
        vertices.select_nth_unstable_by(middle, |(p, _), (q, _)| p[axis].total_cmp(&q[axis]));
        let (first, second) = vertices.split_at_mut(middle);
        halve(first, 2 * node, boxes);
        halve(second, 2 * node + 1, boxes);
    }
}

/// A bound above the rounding errors of a product of differences, relative to it: 2^-40, where six roundings make less than 2^-50.
const PRODUCT_ROUNDING: f64 = f64::from_bits((1023 - 40) << 52);
/// All that underflow can take away from a product of differences and from its bound: 2^-1072, where each of seven products loses at
/// most 2^-1075.
const UNDERFLOW: f64 = f64::from_bits(4);

/// The length of a vector, at most its square root of two times as much.
fn span([x, y]: [f64; 2]) -> f64 {
    x.abs() + y.abs()
}

/// The band around a segment, a little wider than the cells of points in its box.
struct Band {
    from: [f64; 2],
    /// The direction, with a length near 1, so that no product overflows.
    along: [f64; 2],
    low: [f64; 2],
    high: [f64; 2],
    /// A point moved by the width of the band changes its cross product with the direction by no more than half of this.
    margin: f64,
}

impl Band {
    fn around([a, b]: [[f64; 2]; 2]) -> Self {
        let step = |x: f64| x.abs() - x.abs().next_down();
        let width = [0, 1].map(|k| 4.0 * step(a[k].abs().max(b[k].abs()).next_up()));
        let way = [0, 1].map(|k| b[k] - a[k]);
        let unit = power_below(span(way)).max(f64::MIN_POSITIVE);
        let along = way.map(|x| x / unit);
        Self {
            from: a,
            along,
            low: [0, 1].map(|k| a[k].min(b[k])),
            high: [0, 1].map(|k| a[k].max(b[k])),
            margin: 2.0 * span(width) * span(along) + UNDERFLOW,
        }
    }

    /// Whether no point of a box is both in that of the segment and in the band: true only if that is sure.
    #[inline]
    fn misses(&self, [low, high]: Bounds) -> bool {
        let low = [0, 1].map(|k| self.low[k].max(low[k]));
        let high = [0, 1].map(|k| self.high[k].min(high[k]));
        if low[0] > high[0] || low[1] > high[1] {
            return true;
        }
        // The corners that are furthest to the right and to the left of the direction.
        let [x, y] = self.along;
        let (rises, falls) = (x > 0.0, y > 0.0);
        let right = [if falls { high[0] } else { low[0] }, if rises { low[1] } else { high[1] }];
        let left = [if falls { low[0] } else { high[0] }, if rises { high[1] } else { low[1] }];
        self.is_clear(right, 1.0) || self.is_clear(left, -1.0)
    }

    /// Whether a point is surely on one side of the line, the left for 1, by more than the band is wide.
    #[inline]
    fn is_clear(&self, p: [f64; 2], side: f64) -> bool {
        let d = [p[0] - self.from[0], p[1] - self.from[1]];
        let cross = self.along[0] * d[1] - self.along[1] * d[0];
        side * cross > self.margin + PRODUCT_ROUNDING * span(d) * span(self.along)
    }
}

#[cfg(test)]
mod tests {
    use delone_generators::{Kind, Random};
    use delone_predicates::segment_rounds_to;

    use super::*;
    use crate::plane::constrained::ConstraintReport2;
    use crate::plane::constrained::build::constrained;

    /// The number of touched vertices, by definition, and the number of tests.
    fn judge(points: Vec<[f64; 2]>, segments: &[[usize; 2]]) -> (usize, usize) {
        let (graph, ends, _) = constrained(points, segments, &mut ConstraintReport2::default());
        let named = graph.vertices().map(|v| (graph.point(v), v)).collect();
        let (mut cells, mut count) = (Cells::new(named), 0);
        for &[v, w] in ends.iter().filter(|ends| ends[0] != ends[1]) {
            let [a, b] = [v, w].map(|v| graph.point(v));
            let is_touched = |u: &VertexId| {
                let p = graph.point(*u);
                let in_box = (0..2).all(|k| (a[k].min(b[k])..=a[k].max(b[k])).contains(&p[k]));
                in_box && ![v, w].contains(u) && segment_rounds_to(a, b, p)
            };
            let mut found = Vec::new();
            cells.each_near([a, b], &mut |&(p, u)| {
                if ![v, w].contains(&u) && segment_rounds_to(a, b, p) {
                    found.push(u);
                }
            });
            found.sort_unstable();
            let mut expected: Vec<VertexId> = graph.vertices().filter(is_touched).collect();
            expected.sort_unstable();
            assert_eq!(found, expected, "{a:?} {b:?}");
            count += found.len();
        }
        (count, cells.looked)
    }

    /// Points on coarse numbers far from the origin, hubs among them, where many segments round to many points.
    #[test]
    fn what_is_touched_is_that_by_definition() {
        let mut random = Random::new(1);
        let mut count = 0;
        for round in 0..300 {
            let (last, offset) = [
                (1.0, 2f64.powi(52)),
                (2f64.powi(-52), 1.0),
                (2f64.powi(52), 0.0),
                (f64::from_bits(1), 0.0),
                (2f64.powi(-20), 2f64.powi(32)),
                (2f64.powi(500), 0.0),
                (2f64.powi(-500), 0.0),
                (1e-200, 0.0),
                (1e200, 0.0),
            ][round % 9];
            let side = [6, 30, 200][round / 9 % 3];
            let mut points: Vec<[f64; 2]> =
                (0..40).map(|_| [0; 2].map(|_| offset + random.below(side) as f64 * last)).collect();
            points.extend(
                Kind::Uniform.points(20, round as u64).into_iter().map(|p| p.map(|x| offset + x * last)),
            );
            let hub = random.below(points.len());
            let mut segments: Vec<[usize; 2]> = (0..30).map(|_| [hub, random.below(points.len())]).collect();
            segments.extend((0..30).map(|_| [0; 2].map(|_| random.below(points.len()))));
            count += judge(points, &segments).0;
        }
        assert!(count > 2000, "{count}");
    }

    /// Beside the line, beyond an end, in the box of both but on one side; on the line, around it, at an end: at all scales.
    #[test]
    fn boxes_beside_a_band_are_passed_by() {
        for scale in [1.0, 2f64.powi(500), 2f64.powi(-500), 2f64.powi(1020), f64::from_bits(1 << 44)] {
            for (sx, sy) in [(1.0, 1.0), (-1.0, 1.0), (1.0, -1.0), (-1.0, -1.0)] {
                let at = |[x, y]: [f64; 2]| [sx * x * scale, sy * y * scale];
                let band = Band::around([[0.0, 0.0], [1.0, 1.0]].map(at));
                let misses = |p: [f64; 2], q: [f64; 2]| {
                    let [p, q] = [at(p), at(q)];
                    band.misses([[0, 1].map(|k| p[k].min(q[k])), [0, 1].map(|k| p[k].max(q[k]))])
                };
                assert!(misses([0.5, 0.75], [0.5, 0.75]) && misses([0.75, 0.5], [0.75, 0.5]));
                assert!(misses([0.25, 0.5], [0.375, 2.0]) && misses([0.5, 0.25], [2.0, 0.375]));
                assert!(misses([1.25, 0.0], [2.0, 1.0]) && misses([0.0, -2.0], [1.0, -0.25]));
                assert!(!misses([0.5, 0.5], [0.5, 0.5]) && !misses([1.0, 1.0], [2.0, 2.0]));
                assert!(!misses([0.25, 0.5], [0.75, 0.75]) && !misses([-1.0, -1.0], [2.0, 2.0]));
            }
        }
    }

    /// A hub of segments that cross a wall; a long segment beside others whose ends are level.
    #[test]
    fn fans_are_not_looked_at_for_each_of_their_segments() {
        let looks = |n: usize| {
            let step = |i: usize| (i as f64 + 0.5) / n as f64 - 0.5;
            let mut hub = vec![[0.0, 0.0], [400.0, -300.0], [400.0, 300.0]];
            hub.extend((0..n).map(|i| [1000.0 * step(i).cos(), 1000.0 * step(i).sin()]));
            let mut segments = vec![[1, 2]];
            segments.extend((0..n).map(|i| [0, i + 3]));
            // With points where they cross, as a round has them, beside which triangles are as thin as can be.
            hub.extend((0..n).map(|i| [400.0, 400.0 * step(i).tan()]));
            let (_, looked) = judge(hub, &segments);
            let mut row = vec![[0.0, -1.0], [n as f64, -1.0]];
            row.extend((0..n).flat_map(|i| [[i as f64 + 0.1, 0.1], [i as f64 + 0.9, 0.9]]));
            let segments: Vec<[usize; 2]> = (0..=n).map(|i| [2 * i, 2 * i + 1]).collect();
            looked + judge(row, &segments).1
        };
        let [few, many] = [200, 800].map(looks);
        assert!(many < 5 * few, "{few} looks and {many}");
    }
}
