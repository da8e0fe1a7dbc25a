//! A triangulation as arrays, in the conventions of JavaScript's libraries.
//!
//! They call triangles counter-clockwise with y down: corners come as (a, c, b), slot k of a triangle is our edge 2 - k, and
//! the hull is reversed. There are no ghosts there: finite triangles are numbered by increasing index, and a twin beyond the hull is -1.
//! O(n).

use delone_library::{Dimension, TriangleId};

use crate::planes;
use crate::tray;

/// No twin: -1 as JavaScript reads it.
const NONE: u32 = u32::MAX;

export! {
    /// Leaves triangles, half-edges and the hull as integers. Returns what the points span: -1 is a fault, 0 to 2 is the dimension of
    /// a point, a line, the plane; 3 is no point.
    fn arrays(plane: usize) -> i32 {
        planes::with(plane, |plane| {
            let (triangulation, numbers) = plane.numbered();
            let mesh = triangulation.mesh();
            let size = 3 * triangulation.triangle_count();
            let mut corners = Vec::with_capacity(size);
            let mut twins = Vec::with_capacity(size);
            let edge = |t: TriangleId, k: usize| {
                let twin = mesh.twin(t.edge(2 - k));
                // Ghosts have no number.
                let number = numbers[twin.triangle().index()];
                if number == NONE { NONE } else { 3 * number + 2 - twin.corner() as u32 }
            };
            for t in mesh.triangles() {
                let [a, b, c] = mesh.corners(t).map(|v| v.index() as u32);
                corners.extend([a, c, b]);
                twins.extend([0, 1, 2].map(|k| edge(t, k)));
            }
            let mut hull: Vec<u32> = mesh.hull().map(|v| v.index() as u32).collect();
            let dimension = match triangulation.dimension() {
                Dimension::Empty => 3,
                Dimension::Point => 0,
                Dimension::Line => 1,
                Dimension::Plane | Dimension::Space => {
                    hull.reverse();
                    2
                }
            };
            [corners, twins, hull].into_iter().enumerate().for_each(|(k, array)| tray::leave_ints(k, array));
            Ok(dimension)
        })
    }

    /// Leaves the points that equal an earlier one, each with the vertex that stands for it.
    fn duplicates(plane: usize) -> i32 {
        planes::with(plane, |plane| {
            let pairs = plane.triangulation.duplicates();
            tray::leave_ints(0, pairs.flat_map(|d| [d.point as u32, d.vertex.index() as u32]).collect());
            Ok(0)
        })
    }
}
