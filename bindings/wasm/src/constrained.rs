//! Segments that are edges: the constrained Delaunay triangulation of what is on the tray, and which of its triangles are inside.

use delone_library::{Constrained2, Crossings, Fill};

use crate::fault::answer;
use crate::memory;
use crate::tray;

export! {
    /// Triangulates the points on the tray with the segments on it, pairs of indices. `split`: segments that cross are split, else it
    /// is a fault. `fill`: 0 keeps all triangles, 1 those that an odd number of segments is around, 2 those that segments wind around.
    /// Leaves as integers corners (counter-clockwise with y down) and constraint edges, as numbers the points, those of splits at the end.
    fn constrain(split: i32, fill: i32) -> i32 {
        let (points, indices) = (tray::points(), tray::indices());
        let segments: Vec<[usize; 2]> =
            indices.chunks_exact(2).map(|ends| [ends[0] as usize, ends[1] as usize]).collect();
        let crossings = if split == 0 { Crossings::Refuse } else { Crossings::Split };
        let fill = [Fill::All, Fill::EvenOdd, Fill::NonZero][fill.clamp(0, 2) as usize];
        let made = memory::check(points.len() + segments.len(), memory::CONSTRAINED).and_then(|()| {
            let made = Constrained2::with_crossings(&points, &segments, crossings)?;
            let domains = made.domains(&fill)?;
            Ok((made, domains))
        });
        answer(made.map(|(made, domains)| {
            let inside = made.triangle_ids().filter(|&t| domains.is_inside(t));
            let corners = inside.flat_map(|t| {
                let [a, b, c] = made.mesh().corners(t).map(|v| v.index() as u32);
                [a, c, b]
            });
            tray::leave_ints(0, corners.collect());
            tray::leave_ints(1, made.constraints().flatten().map(|v| v.index() as u32).collect());
            tray::leave_floats(0, made.points().as_flattened().to_vec());
            0
        }))
    }
}
