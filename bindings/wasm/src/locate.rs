//! Where points fall, and what is near.

use delone_library::{Ask, Found, TriangleId, Triangulation, VertexId};
use delone_predicates::compare_distances;

use crate::planes;
use crate::tray;

/// Leaves indices of vertices.
fn leave(vertices: Vec<VertexId>) -> i32 {
    let count = vertices.len() as i32;
    tray::leave_ints(0, vertices.into_iter().map(|v| v.index() as u32).collect());
    count
}

export! {
    /// The nearest vertex; -2 if there is none.
    fn nearest(plane: usize, x: f64, y: f64) -> i32 {
        planes::with(plane, |plane| Ok(plane.triangulation.nearest([x, y])?.map_or(-2, |v| v.index() as i32)))
    }

    /// Whether a vertex is as near as any: 1 or 0, which it is for what is no vertex.
    fn is_nearest(plane: usize, vertex: usize, x: f64, y: f64) -> i32 {
        planes::with(plane, |plane| {
            let (d, q) = (&plane.triangulation, [x, y]);
            let (Some(p), Some(nearest)) = (d.position(VertexId::new(vertex)), d.nearest(q)?) else { return Ok(0) };
            Ok(i32::from(compare_distances(q, p, d.point(nearest)).is_le()))
        })
    }

    /// Leaves the k nearest vertices, and gives their number.
    fn k_nearest(plane: usize, x: f64, y: f64, k: usize) -> i32 {
        planes::with(plane, |plane| Ok(leave(Ask::k_nearest(&plane.triangulation, [x, y], k)?)))
    }

    /// Leaves the vertices within a circle, and gives their number.
    fn within(plane: usize, x: f64, y: f64, radius: f64) -> i32 {
        planes::with(plane, |plane| Ok(leave(Ask::within(&plane.triangulation, [x, y], radius)?)))
    }

    /// Finds where a point falls. Gives 0 for a triangle, 1 for an edge, 2 for a vertex, 3 outside, 4 where there is no triangle. Leaves as
    /// integers the number of a triangle that holds the point (or -1), and the vertices that it is on or beyond.
    fn locate(plane: usize, x: f64, y: f64) -> i32 {
        planes::with(plane, |plane| {
            let (triangulation, numbers) = plane.numbered();
            let found = Ask::find(triangulation, [x, y])?;
            Ok(leave_found(&found, numbers))
        })
    }
}

/// Leaves what was found, and gives its kind.
pub fn leave_found(found: &Found<TriangleId>, numbers: &[u32]) -> i32 {
    let mut ints = vec![found.simplex.map_or(u32::MAX, |t| numbers[t.index()])];
    ints.extend(found.face().iter().map(|v| v.index() as u32));
    let kind = match found.face().len() {
        0 => 4,
        _ if found.is_outside => 3,
        corners => 3 - corners as i32,
    };
    tray::leave_ints(0, ints);
    kind
}
