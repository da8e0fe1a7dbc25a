//! The vertices that points of a segment are rounded to.
//!
//! Triangles are looked at from those that the segment passes on, across edges that come as near to it as roundings go: what is
//! that near is a convex band, so it is connected. Two convex sets are apart if a side of one of them parts them, which exact tests
//! say of the segment and of the edge, and the boxes of both.
//!
//! All edges at an end of the segment come near to it there, thousands at a hub. Where the next edges around the end are clear of
//! it, no vertex is so near, and an edge that turns away is passed over.
//!
//! Cost: a few tests for each triangle at the band; once for each vertex that is an end, its degree.

use delone_predicates::{orient2d, segment_rounds_to};

use super::trace::Ground;
use crate::ids::{Place, TriangleId, VertexId};
use crate::plane::Delaunay2;

/// Finds them, for one segment after the other.
pub(super) struct Bands<'a> {
    graph: &'a Delaunay2,
    ground: Ground<'a>,
    /// For each place how far the edges around it are away, at least, if that was asked.
    clear: Vec<Option<f64>>,
    /// For each triangle the last segment, counted from 1, that it was seen for.
    seen: Vec<u32>,
    segment: u32,
    /// How many triangles have been looked at, which tests bound.
    looked: usize,
}

impl<'a> Bands<'a> {
    pub(super) fn new(graph: &'a Delaunay2) -> Self {
        let ground = Ground { mesh: graph.mesh(), points: &graph.base.points };
        Self {
            graph,
            ground,
            clear: vec![None; graph.base.points.len()],
            seen: vec![0; graph.mesh().slot_count()],
            segment: 0,
            looked: 0,
        }
    }

    /// The wanted vertices in the box of a segment, ends apart, that points of it are rounded to.
    pub(super) fn touched(
        &mut self,
        ends: [VertexId; 2],
        is_wanted: impl Fn(&VertexId) -> bool,
    ) -> Vec<VertexId> {
        let (graph, ground) = (self.graph, self.ground);
        let mesh = ground.mesh;
        let (Some(a), Some(b)) = (mesh.place(ends[0]), mesh.place(ends[1])) else { return Vec::new() };
        let (mut along, mut across) = (Vec::new(), Vec::new());
        ground.follow(
            [a, b],
            |e, _| along.push(e),
            |e| {
                across.push(e);
                true
            },
        );
        let met = along.into_iter().chain(across);
        let mut pending: Vec<TriangleId> =
            met.flat_map(|e| [e.triangle(), mesh.twin(e).triangle()]).collect();
        self.segment += 1;
        pending.retain(|&t| self.is_new(t));
        let band = Band::around([a, b].map(|v| ground.point(v)));
        let clear = [a, b].map(|v| self.clear_of_edges(v));
        let turns_away = |v: Place, w: Place| {
            let end = [a, b].iter().position(|&end| end == v);
            end.is_some_and(|end| band.is_left_by(end, ground.point(w), clear[end]))
        };
        let mut corners = Vec::new();
        while let Some(t) = pending.pop() {
            self.looked += 1;
            corners.extend(mesh.places(t).into_iter().filter(|v| !v.is_ghost()));
            for e in [0, 1, 2].map(|k| t.edge(k)) {
                let [v, w] = [mesh.tail(e), mesh.head(e)];
                let next = mesh.twin(e).triangle();
                if !v.is_ghost()
                    && !w.is_ghost()
                    && self.seen[next.index()] != self.segment
                    && !turns_away(v, w)
                    && !turns_away(w, v)
                    && band.may_meet(ground.point(v), ground.point(w))
                {
                    self.seen[next.index()] = self.segment;
                    pending.push(next);
                }
            }
        }
        corners.sort_unstable();
        corners.dedup();
        let is_touched = |v: &VertexId| {
            let point = graph.point(*v);
            let in_box = (0..2).all(|k| band.low[k] <= point[k] && point[k] <= band.high[k]);
            in_box
                && !ends.contains(v)
                && is_wanted(v)
                && segment_rounds_to(band.ends[0], band.ends[1], point)
        };
        corners.into_iter().map(|v| mesh.name(v)).filter(is_touched).collect()
    }

    /// Whether a triangle has not been seen for the segment at hand; it is now.
    fn is_new(&mut self, t: TriangleId) -> bool {
        std::mem::replace(&mut self.seen[t.index()], self.segment) != self.segment
    }

    /// A bound of the distance of a vertex from the edges across its triangles, from below. No other vertex is nearer.
    fn clear_of_edges(&mut self, v: Place) -> f64 {
        if let Some(known) = self.clear[v.index()] {
            return known;
        }
        let (mesh, p) = (self.ground.mesh, self.ground.point(v));
        let from = |w: Place| self.ground.point(w);
        let mut least = f64::INFINITY;
        for spoke in mesh.spokes(v) {
            self.looked += 1;
            let (head, tip) = (mesh.head(spoke), mesh.tip(spoke));
            if head.is_ghost() || tip.is_ghost() {
                continue;
            }
            let [q, r] = [head, tip].map(|w| [0, 1].map(|k| from(w)[k] - p[k]));
            let along = [r[0] - q[0], r[1] - q[1]];
            let dot = |u: [f64; 2]| u[0] * along[0] + u[1] * along[1];
            let size = span(q) * span(r);
            // Thin triangles point at the vertex, with the nearer end.
            let distance = if dot(q) >= 0.0 {
                span(q) / 2.0
            } else if dot(r) <= 0.0 {
                span(r) / 2.0
            } else {
                ((q[0] * r[1] - q[1] * r[0]).abs() - PRODUCT_ROUNDING * size) / span(along)
            };
            let is_told = size > TINY && distance.is_finite();
            least = least.min(if is_told { distance } else { 0.0 });
        }
        let least = if least.is_finite() { least.max(0.0) / 2.0 } else { 0.0 };
        self.clear[v.index()] = Some(least);
        least
    }
}

/// Below it products of differences may have lost more than roundings.
const TINY: f64 = 1e-290;

/// A bound above the rounding errors of a product of differences, relative to it: 2^-40, where six roundings make less than 2^-50.
const PRODUCT_ROUNDING: f64 = f64::from_bits((1023 - 40) << 52);

/// The length of a vector, at most its square root of two times as much.
fn span([x, y]: [f64; 2]) -> f64 {
    x.abs() + y.abs()
}

/// The band around a segment, a little wider than the cells of points in its box.
struct Band {
    ends: [[f64; 2]; 2],
    low: [f64; 2],
    high: [f64; 2],
    width: [f64; 2],
}

impl Band {
    fn around(ends: [[f64; 2]; 2]) -> Self {
        let [a, b] = ends;
        let step = |x: f64| x.abs() - x.abs().next_down();
        Self {
            ends,
            low: [0, 1].map(|k| a[k].min(b[k])),
            high: [0, 1].map(|k| a[k].max(b[k])),
            width: [0, 1].map(|k| 4.0 * step(a[k].abs().max(b[k].abs()).next_up())),
        }
    }

    /// Whether the edge from an end to a point is in the band only where it is surely nearer to that end than half of this.
    fn is_left_by(&self, end: usize, p: [f64; 2], near: f64) -> bool {
        let from = |q: [f64; 2]| [0, 1].map(|k| q[k] - self.ends[end][k]);
        let (d, u) = (from(p), from(self.ends[1 - end]));
        // Sixteen times as wide as it is, for all that is rounded and all that is moved.
        let slope = (16.0 * span(self.width) / near).max(PRODUCT_ROUNDING);
        let size = span(d) * span(u);
        let is_told = slope < 0.5 && size > TINY && size.is_finite();
        let (cross, dot) = (d[0] * u[1] - d[1] * u[0], d[0] * u[0] + d[1] * u[1]);
        is_told && (cross.abs() > slope * size || dot < -PRODUCT_ROUNDING * size)
    }

    /// Whether an edge may come into it: false only if it surely does not.
    fn may_meet(&self, v: [f64; 2], w: [f64; 2]) -> bool {
        let apart = |k: usize| {
            v[k].max(w[k]) < self.low[k] - self.width[k] || v[k].min(w[k]) > self.high[k] + self.width[k]
        };
        let may_part = |line, points| !self.is_clear(line, points) && self.may_part(line, points);
        !apart(0) && !apart(1) && may_part(self.ends, [v, w]) && may_part([v, w], self.ends)
    }

    /// Whether two points are surely on one side of a line, with all that is as near to them as the band is wide. Moved by the width a point
    /// changes the cross product by no more than the spans of both, multiplied.
    fn is_clear(&self, [a, b]: [[f64; 2]; 2], points: [[f64; 2]; 2]) -> bool {
        let along = [b[0] - a[0], b[1] - a[1]];
        let [side, other] = points.map(|p| {
            let d = [p[0] - a[0], p[1] - a[1]];
            let size = span(d) * span(along);
            let cross = along[0] * d[1] - along[1] * d[0];
            let is_told = size > TINY && size.is_finite();
            if is_told && cross.abs() > 2.0 * span(self.width) * span(along) + PRODUCT_ROUNDING * size {
                cross
            } else {
                0.0
            }
        });
        side * other.signum() > 0.0 && other != 0.0
    }

    /// Whether a line may have points on both of its sides, or on it, or surroundings of one that are: as wide as the band.
    fn may_part(&self, line: [[f64; 2]; 2], points: [[f64; 2]; 2]) -> bool {
        let mut side = None;
        for p in points {
            for (x, y) in [(-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0)] {
                // At least to the next number.
                let moved = |k: usize, sign: f64| {
                    let by = p[k] + sign * self.width[k];
                    if by == p[k] && sign > 0.0 {
                        p[k].next_up()
                    } else if by == p[k] {
                        p[k].next_down()
                    } else {
                        by
                    }
                };
                let corner = [moved(0, x), moved(1, y)];
                if corner.iter().any(|x| !x.is_finite()) {
                    return true;
                }
                let of_corner = orient2d(line[0], line[1], corner);
                if of_corner.is_zero() || side.is_some_and(|side| side != of_corner) {
                    return true;
                }
                side = Some(of_corner);
            }
        }
        false
    }
}

#[cfg(test)]
mod tests {
    use delone_generators::{Kind, Random};

    use super::*;
    use crate::plane::constrained::ConstraintReport2;
    use crate::plane::constrained::build::constrained;

    /// The number of touched vertices, by definition, and the number of tests.
    fn judge(points: Vec<[f64; 2]>, segments: &[[usize; 2]]) -> (usize, usize) {
        let (graph, ends, _) = constrained(points, segments, &mut ConstraintReport2::default());
        let (mut bands, mut count) = (Bands::new(&graph), 0);
        for &[v, w] in ends.iter().filter(|ends| ends[0] != ends[1]) {
            let [a, b] = [v, w].map(|v| graph.point(v));
            let is_touched = |u: &VertexId| {
                let p = graph.point(*u);
                let in_box = (0..2).all(|k| (a[k].min(b[k])..=a[k].max(b[k])).contains(&p[k]));
                in_box && ![v, w].contains(u) && segment_rounds_to(a, b, p)
            };
            let mut found = bands.touched([v, w], |_| true);
            found.sort_unstable();
            let mut expected: Vec<VertexId> = graph.vertices().filter(is_touched).collect();
            expected.sort_unstable();
            assert_eq!(found, expected, "{a:?} {b:?}");
            count += found.len();
        }
        (count, bands.looked)
    }

    /// Points on coarse numbers far from the origin, hubs among them, where many segments round to many points.
    #[test]
    fn what_is_touched_is_that_by_definition() {
        let mut random = Random::new(1);
        let mut count = 0;
        for round in 0..300 {
            let last = [1.0, 2f64.powi(-52), 2f64.powi(52), 2f64.powi(-1074), 2f64.powi(-20)][round % 5];
            let offset = [2f64.powi(52), 1.0, 0.0, 0.0, 2f64.powi(32)][round % 5];
            let side = [6, 30, 200][round / 5 % 3];
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

    /// Boxes overlap and the edge crosses the line of the segment, but beyond its end; at the end; through the middle.
    #[test]
    fn edges_beside_the_ends_of_a_band_do_not_meet_it() {
        let band = Band::around([[0.0, 0.0], [1.0, 1.0]]);
        assert!(!band.may_meet([0.9, 2.0], [2.0, 0.95]));
        assert!(band.may_meet([0.9, 1.1], [1.1, 0.9]));
        assert!(band.may_meet([0.0, 1.0], [1.0, 0.0]));
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
