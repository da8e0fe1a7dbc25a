//! All crossings of segments, and all vertices inside of them.
//!
//! The triangulation is what they are found by: each segment is followed through it, and two segments that cross pass through
//! one triangle. Decisions are exact.
//!
//! Cost: that of following the segments, each as many triangles as it crosses; and for each triangle the square of the number
//! of segments in it.

use delone_predicates::{Line, Spot, orient2d};

use super::trace::Ground;
use crate::ids::{EdgeId, TriangleId, VertexId};
use crate::plane::Delaunay2;

/// Two segments that cross strictly inside of both, at no vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Crossing {
    pub(super) first: u32,
    pub(super) second: u32,
}

/// What segments meet on their way through a triangulation.
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

/// All pairs of segments that cross at no vertex, each once, in increasing order.
pub(super) fn between(graph: &Delaunay2, segments: &[[VertexId; 2]]) -> Vec<Crossing> {
    meet(graph, segments).crossings
}

/// All that segments between vertices meet.
pub(super) fn meet(graph: &Delaunay2, segments: &[[VertexId; 2]]) -> Met {
    let mesh = graph.mesh();
    let ground = Ground { mesh, points: &graph.base.points };
    let mut met = Met::default();
    let mut passes: Vec<(TriangleId, u32)> = Vec::new();
    for (s, ends) in segments.iter().enumerate() {
        let (s, ends) = (s as u32, *ends);
        let (Some(a), Some(b)) = (mesh.place(ends[0]), mesh.place(ends[1])) else { continue };
        let mut note = |e: EdgeId| passes.extend([e, mesh.twin(e)].map(|e| (e.triangle(), s)));
        let mut edges = Vec::new();
        ground.follow(
            [a, b],
            |e, _| edges.push(e),
            |e| {
                note(e);
                true
            },
        );
        edges.iter().for_each(|&e| note(e));
        let inner = ground.vertices_on([a, b]);
        met.through.extend(inner.into_iter().map(|v| (s, mesh.name(v))));
    }
    met.through.sort_unstable();
    passes.sort_unstable();
    passes.dedup();
    for at_one in passes.chunk_by(|p, q| p.0 == q.0) {
        for (i, &(_, first)) in at_one.iter().enumerate() {
            for &(_, second) in &at_one[i + 1..] {
                let crossing = Crossing { first, second };
                if cross(graph, segments[first as usize], segments[second as usize])
                    && !met.have_vertex(crossing)
                {
                    met.crossings.push(crossing);
                }
            }
        }
    }
    met.crossings.sort_unstable();
    met.crossings.dedup();
    met
}

/// Whether two segments cross strictly inside of both.
fn cross(graph: &Delaunay2, first: [VertexId; 2], second: [VertexId; 2]) -> bool {
    let [a, b] = first.map(|v| graph.point(v));
    let [c, d] = second.map(|v| graph.point(v));
    let are_apart = |p, q, r, s| (orient2d(p, q, r) * orient2d(p, q, s)).is_negative();
    are_apart(a, b, c, d) && are_apart(c, d, a, b)
}

/// A segment as a line, from its lesser end.
pub(super) fn line(graph: &Delaunay2, [v, w]: [VertexId; 2]) -> Line {
    Line::Through(graph.point(v), graph.point(w))
}

/// Where two segments cross, rounded once.
pub(super) fn place(graph: &Delaunay2, first: [VertexId; 2], second: [VertexId; 2]) -> [f64; 2] {
    let meeting = Spot::Meeting(line(graph, first), line(graph, second));
    meeting.rounded(0.0).expect("between the ends of both")
}
