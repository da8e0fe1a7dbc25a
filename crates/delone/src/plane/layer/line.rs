//! Insertion while all vertices are on one line: the flat sphere of ghosts, two for each segment.
//!
//! The order along the line is lexicographic. Cost: O(1) beside the walk along the line.

use delone_predicates::lexicographic;

use crate::ids::{EdgeId, Place, TriangleId};
use crate::mesh::Mesh2;

/// Where a point of the line falls.
pub(in crate::plane) enum OnLine {
    /// On this vertex.
    Vertex(Place),
    /// Inside the segment of this edge.
    Segment(EdgeId),
    /// Beyond this end of the line.
    End(Place),
}

/// Walks along the line from `start` to the place of `q`, which is on the line. Returns also the steps taken.
pub(in crate::plane) fn locate(
    mesh: &Mesh2,
    points: &[[f64; 2]],
    start: Place,
    q: [f64; 2],
) -> (OnLine, usize) {
    let mut at = start;
    let mut steps = 0;
    loop {
        steps += 1;
        let direction = lexicographic(points[at.index()], q);
        if direction.is_eq() {
            return (OnLine::Vertex(at), steps);
        }
        let towards = |e: &EdgeId| {
            let w = mesh.head(*e);
            !w.is_ghost() && lexicographic(points[at.index()], points[w.index()]) == direction
        };
        let Some(e) = mesh.spokes(at).find(towards) else {
            return (OnLine::End(at), steps);
        };
        let w = mesh.head(e);
        if lexicographic(points[w.index()], q) == direction.reverse() {
            return (OnLine::Segment(e), steps);
        }
        at = w;
    }
}

/// Adds two triangles, the ghosts on both sides of a segment u-v: the first left of u -> v, its edges u -> v,
/// v -> ghost, ghost -> u; the second left of v -> u, likewise.
fn add_segment(mesh: &mut Mesh2, u: Place, v: Place) -> [TriangleId; 2] {
    let ghosts = [[u, v], [v, u]].map(|[a, b]| {
        let t = mesh.new_triangle(TriangleId::new(0));
        mesh.set_corners(t, [a, b, Place::GHOST]);
        t
    });
    mesh.link(ghosts[0].edge(0), ghosts[1].edge(0));
    ghosts
}

/// The line from the lone vertex to a second one.
pub(in crate::plane) fn begin(mesh: &mut Mesh2, v: Place) {
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
pub(in crate::plane) fn extend(mesh: &mut Mesh2, end: Place, v: Place) {
    let outward = mesh.spokes(end).find(|&e| mesh.head(e).is_ghost());
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
pub(in crate::plane) fn split(mesh: &mut Mesh2, e: EdgeId, v: Place) {
    let (f, b) = (mesh.twin(e), mesh.head(e));
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

/// Removes a vertex of the line; its place stays.
pub(in crate::plane) fn remove(mesh: &mut Mesh2, v: Place) {
    let along: Vec<EdgeId> = mesh.spokes(v).filter(|&e| !mesh.head(e).is_ghost()).collect();
    mesh.vertex_count -= 1;
    match along[..] {
        [e] if mesh.vertex_count == 1 => {
            let left = mesh.head(e);
            mesh.lone = Some(left);
            mesh.incident[left.index()] = EdgeId::NONE;
            for t in [e.triangle(), mesh.twin(e).triangle()] {
                mesh.free_triangle(t);
            }
            mesh.ghost_edge = EdgeId::NONE;
        }
        // The end of the line: e runs from it to its neighbour a, one ghost on either side.
        [e] => {
            let f = mesh.twin(e);
            let (out_of_a, into_a) = (mesh.twin(f.previous()), mesh.twin(e.next()));
            mesh.link(out_of_a, into_a);
            mesh.remember(out_of_a);
            mesh.remember(into_a);
            for t in [e.triangle(), f.triangle()] {
                mesh.free_triangle(t);
            }
        }
        // Between a and c: the ghosts of a-v grow to a-c, those of v-c go.
        [to_a, to_c] => {
            let c = mesh.head(to_c);
            let (left, right) = (mesh.twin(to_a), to_a); // a -> v and v -> a
            let (left_gone, right_gone) = (to_c, mesh.twin(to_c)); // v -> c and c -> v
            let (across_left, across_right) = (mesh.twin(left_gone.next()), mesh.twin(right_gone.previous()));
            let is_end = across_left == right_gone.previous();
            mesh.edges[left.next().index()].origin = c;
            mesh.edges[right.index()].origin = c;
            if is_end {
                mesh.link(left.next(), right.previous());
            } else {
                mesh.link(left.next(), across_left);
                mesh.link(right.previous(), across_right);
            }
            mesh.remember(right);
            mesh.remember(left.previous());
            for t in [left_gone.triangle(), right_gone.triangle()] {
                mesh.free_triangle(t);
            }
        }
        _ => unreachable!("a vertex of a line has one or two neighbours"),
    }
}

/// The line through vertices given from end to end.
pub(in crate::plane) fn build(mesh: &mut Mesh2, chain: impl IntoIterator<Item = Place>) {
    let mut end = None;
    for v in chain {
        match end {
            None => {
                mesh.lone = Some(v);
                mesh.vertex_count = 1;
            }
            Some(_) if mesh.vertex_count == 1 => begin(mesh, v),
            Some(end) => extend(mesh, end, v),
        }
        end = Some(v);
    }
}
