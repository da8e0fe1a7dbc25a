//! Insertion while all vertices are on one line: the flat sphere of ghosts, two for each segment.
//!
//! The order along the line is lexicographic. Cost: O(1) beside the walk along the line.

use delone_predicates::lexicographic;

use crate::ids::{EdgeId, TriangleId, VertexId};
use crate::mesh::{HalfEdge, Mesh};

/// Where a point of the line falls.
pub(super) enum OnLine {
    /// On this vertex.
    Vertex(VertexId),
    /// Inside the segment of this edge.
    Segment(EdgeId),
    /// Beyond this end of the line.
    End(VertexId),
}

/// Walks along the line from `start` to the place of `q`, which is on the line.
pub(super) fn locate(mesh: &Mesh, points: &[[f64; 2]], start: VertexId, q: [f64; 2]) -> OnLine {
    let mut at = start;
    loop {
        let direction = lexicographic(points[at.index()], q);
        if direction.is_eq() {
            return OnLine::Vertex(at);
        }
        let towards = |e: &EdgeId| {
            let w = mesh.destination(*e);
            !w.is_ghost() && lexicographic(points[at.index()], points[w.index()]) == direction
        };
        let Some(e) = mesh.star(at).find(towards) else {
            return OnLine::End(at);
        };
        let w = mesh.destination(e);
        if lexicographic(points[w.index()], q) == direction.reverse() {
            return OnLine::Segment(e);
        }
        at = w;
    }
}

/// Adds two triangles, the ghosts on both sides of a segment u-v: the first left of u -> v, its edges u -> v,
/// v -> ghost, ghost -> u; the second left of v -> u, likewise.
fn add_segment(mesh: &mut Mesh, u: VertexId, v: VertexId) -> [TriangleId; 2] {
    let first = mesh.slot_count();
    for [a, b] in [[u, v], [v, u]] {
        let corner = |origin| HalfEdge { origin, twin: EdgeId::NONE };
        mesh.edges.extend([corner(a), corner(b), corner(VertexId::GHOST), HalfEdge::UNUSED]);
    }
    let ghosts = [TriangleId::new(first), TriangleId::new(first + 1)];
    mesh.link(ghosts[0].edge(0), ghosts[1].edge(0));
    ghosts
}

/// The line from the lone vertex to a second one.
pub(super) fn begin(mesh: &mut Mesh, v: VertexId) {
    let u = mesh.lone.take().expect("a line begins at a lone vertex");
    let [left, right] = add_segment(mesh, u, v);
    mesh.link(left.edge(1), right.edge(2));
    mesh.link(left.edge(2), right.edge(1));
    mesh.ghost_edge = left.edge(2);
    mesh.incident[u.index()] = left.edge(0);
    mesh.incident[v.index()] = right.edge(0);
    mesh.vertex_count += 1;
}

/// Makes `v` the new end beyond `end`.
pub(super) fn extend(mesh: &mut Mesh, end: VertexId, v: VertexId) {
    let outward = mesh.star(end).find(|&e| mesh.destination(e).is_ghost());
    let outward = outward.expect("an end of a line sees the ghost vertex");
    let inward = mesh.twin(outward);
    // The hull runs ... -> end -> v -> end -> ...
    let [left, right] = add_segment(mesh, end, v);
    mesh.link(left.edge(1), right.edge(2));
    mesh.link(left.edge(2), outward);
    mesh.link(right.edge(1), inward);
    mesh.incident[v.index()] = right.edge(0);
    mesh.vertex_count += 1;
}

/// Makes `v` a vertex inside the segment of an edge e = a -> b.
pub(super) fn split(mesh: &mut Mesh, e: EdgeId, v: VertexId) {
    let (f, b) = (mesh.twin(e), mesh.destination(e));
    let (b_ghost, ghost_b) = (e.next(), f.previous());
    let (across_left, across_right) = (mesh.twin(b_ghost), mesh.twin(ghost_b));
    let [left, right] = add_segment(mesh, v, b);
    // The old ghosts shrink to a-v: what left b leaves v.
    mesh.edges[b_ghost.index()].origin = v;
    mesh.edges[f.index()].origin = v;
    mesh.link(b_ghost, left.edge(2));
    mesh.link(ghost_b, right.edge(1));
    if across_left == ghost_b {
        mesh.link(left.edge(1), right.edge(2)); // b is an end
    } else {
        mesh.link(left.edge(1), across_left);
        mesh.link(right.edge(2), across_right);
    }
    mesh.ghost_edge = left.edge(2);
    mesh.incident[v.index()] = left.edge(0);
    mesh.incident[b.index()] = right.edge(0);
    mesh.vertex_count += 1;
}
