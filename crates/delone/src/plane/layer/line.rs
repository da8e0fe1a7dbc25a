//! Location while all vertices are on one line: a walk in lexicographic order.
//!
//! Cost: O(1) for each vertex on the way.

use delone_predicates::lexicographic;

use crate::ids::{EdgeId, Place};
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
