//! All crossings of segments, and all vertices inside of them.
//!
//! The triangulation is what they are found by. Segments are made constraints of it as far as they cross none before them; the
//! others, which are refused, are followed: they cross constraints, and two of them that cross pass through one triangle.
//! Decisions are exact.
//!
//! Cost: that of following what is refused, as many triangles as it crosses; and for each triangle the number of pairs that come
//! together there: from different sides, or from a corner.

use delone_predicates::{Line, Spot, orient2d};

use super::overlaps::sorted;
use super::passes::Passes;
use super::trace::Ground;
use crate::ids::{EdgeId, Place, VertexId};
use crate::plane::Delaunay2;

/// Two segments that cross strictly inside of both, at no vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Crossing {
    pub(super) first: u32,
    pub(super) second: u32,
}

/// The crossings that segments meet on their way through a triangulation.
#[derive(Debug, Default)]
pub(super) struct Met {
    pub(super) crossings: Vec<Crossing>,
    /// A segment and a vertex strictly inside of it.
    pub(super) through: Vec<(u32, VertexId)>,
}

impl Met {
    /// Whether two segments pass through one vertex: there they are cut, and do not cross.
    fn have_vertex(&self, Crossing { first, second }: Crossing) -> bool {
        let start = self.through.partition_point(|through| through.0 < first);
        let on_first = self.through[start..].iter().take_while(|through| through.0 == first);
        on_first.into_iter().any(|&(_, v)| self.through.binary_search(&(second, v)).is_ok())
    }
}

/// All that segments between vertices meet: pairs that cross at no vertex, each once, in increasing order, and vertices. Those
/// that are not refused are constraints of the triangulation.
pub(super) fn meet(graph: &Delaunay2, segments: &[[VertexId; 2]], refused: &[u32]) -> Met {
    let mesh = graph.mesh();
    let ground = Ground { mesh, points: &graph.base.points };
    let mut met = Met::default();
    let passes = Passes::of(graph, segments, refused);
    let crossed = &passes.crossed;
    let places = |s: u32| segments[s as usize].map(|v| mesh.place(v).expect("a vertex"));
    let undirected = |e: EdgeId| e.min(mesh.twin(e));
    for &s in refused {
        met.through.extend(ground.vertices_on(places(s)).into_iter().map(|v| (s, mesh.name(v))));
    }
    let mut last = ([Place::GHOST; 2], None);
    let is_accepted = |s: &u32| refused.binary_search(s).is_err();
    for s in (0..segments.len() as u32).filter(is_accepted) {
        let [a, b] = places(s);
        if a == b {
            continue;
        }
        // The same segment once more needs no look at its ends, which may be hubs.
        if last.0 != sorted([a, b]) {
            last = (sorted([a, b]), mesh.edge_between(a, b));
        }
        let edges = last.1.map_or_else(|| ground.chain([a, b]), |e| vec![e]);
        let inner = edges.iter().map(|&e| mesh.head(e)).filter(|&v| v != a && v != b);
        met.through.extend(inner.map(|v| (s, mesh.name(v))));
        for e in edges.into_iter().map(undirected) {
            let start = crossed.partition_point(|c| c.0 < e);
            let by = crossed[start..].iter().take_while(|c| c.0 == e).map(|c| c.1);
            met.crossings.extend(by.map(|other| Crossing { first: s.min(other), second: s.max(other) }));
        }
    }
    met.through.sort_unstable();
    let mut crossings = Vec::new();
    let points: Vec<Segment> =
        refused.iter().map(|&s| segments[s as usize].map(|v| graph.point(v))).collect();
    passes.each_pair(|i, j| {
        let crossing = Crossing { first: refused[i], second: refused[j] };
        if cross(points[i], points[j]) && !met.have_vertex(crossing) {
            crossings.push(crossing);
        }
    });
    met.crossings.append(&mut crossings);
    met.crossings.sort_unstable();
    met.crossings.dedup();
    met
}

/// The points at both ends of a segment.
pub(super) type Segment = [[f64; 2]; 2];

/// Whether two segments cross strictly inside of both.
fn cross([a, b]: Segment, [c, d]: Segment) -> bool {
    let are_apart = |p, q, r, s| (orient2d(p, q, r) * orient2d(p, q, s)).is_negative();
    are_apart(a, b, c, d) && are_apart(c, d, a, b)
}

/// Where two segments that cross do so, rounded once.
pub(super) fn place([a, b]: Segment, [c, d]: Segment) -> [f64; 2] {
    let meeting = Spot::Meeting(Line::Through(a, b), Line::Through(c, d));
    meeting.rounded().expect("between the ends of both")
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use delone_generators::{Kind, Random};
    use delone_oracle::exact::orient2d as side;

    use super::*;
    use crate::plane::constrained::ConstraintReport2;
    use crate::plane::constrained::build::constrained;

    /// Also those in one point, along each other, and through vertices.
    #[test]
    fn crossings_are_those_by_definition() {
        let mut random = Random::new(5);
        let mut met_count = 0;
        for round in 0..200 {
            let few = [8, 20, 60][round % 3];
            let points = match round % 4 {
                0 => Kind::Grid.points(few, 1),
                1 => Kind::Circle.points(few, round as u64),
                2 => (0..few).map(|i| [f64::from(i as u32 % 3), f64::from(i as u32 / 3)]).collect(),
                _ => Kind::Uniform.points(few, round as u64),
            };
            let count = points.len();
            let segments: Vec<[usize; 2]> = if round % 8 == 1 {
                (0..count / 2).map(|i| [i, i + count / 2]).collect()
            } else {
                (0..2 * few).map(|_| [0; 2].map(|_| random.below(count))).collect()
            };
            let (graph, ends, refused) = constrained(points, &segments, &mut ConstraintReport2::default());
            let met = meet(&graph, &ends, &refused);
            let at = |s: usize| ends[s].map(|v| graph.point(v));
            let inside = |[a, b]: [[f64; 2]; 2], q: [f64; 2]| {
                let is_in_box = (0..2).all(|k| (a[k].min(b[k])..=a[k].max(b[k])).contains(&q[k]));
                q != a && q != b && is_in_box && side(a, b, q) == 0
            };
            let vertices: Vec<VertexId> = graph.vertices().collect();
            let on = |s: usize| -> BTreeSet<VertexId> {
                vertices.iter().copied().filter(|&v| inside(at(s), graph.point(v))).collect()
            };
            let on: Vec<BTreeSet<VertexId>> = (0..ends.len()).map(on).collect();
            let mut crossings = Vec::new();
            for second in 0..ends.len() {
                for first in 0..second {
                    let ([a, b], [c, d]) = (at(first), at(second));
                    let is_crossed = side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
                    if is_crossed && on[first].is_disjoint(&on[second]) {
                        crossings.push(Crossing { first: first as u32, second: second as u32 });
                    }
                }
            }
            crossings.sort_unstable();
            assert_eq!(met.crossings, crossings, "round {round}");
            met_count += crossings.len();
        }
        assert!(met_count > 10_000, "{met_count}");
    }
}
