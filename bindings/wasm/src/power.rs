//! Points with weights: the regular triangulation, and the power cells dual to it.

use delone_library::{Region2, Regular2, Ring, VertexId};

use crate::fault::{Fault, answer};
use crate::memory;
use crate::tray;

/// Triangles, hidden sites and cells in a rectangle, all left on the tray.
fn leave(xmin: f64, ymin: f64, xmax: f64, ymax: f64) -> Result<i32, Fault> {
    let (points, weights) = (tray::points(), tray::numbers());
    memory::check(points.len(), memory::WEIGHTED)?;
    let region = Region2::rectangle([xmin, ymin], [xmax, ymax])?;
    let regular = Regular2::from_parts(&points, &weights)?;
    // Corners are counter-clockwise with y down, as elsewhere.
    let triangles = regular.triangles().flat_map(|[a, b, c]| [a, c, b]);
    tray::leave_ints(0, triangles.map(|v| v.index() as u32).collect());
    let duplicates = regular.duplicates().map(|duplicate| duplicate.point);
    let mut hidden: Vec<usize> = regular.hidden().map(VertexId::index).chain(duplicates).collect();
    hidden.sort_unstable();
    hidden.dedup();
    tray::leave_ints(1, hidden.into_iter().map(|i| i as u32).collect());
    let cells = regular.power().clip(&region);
    let (mut ends, mut corners, mut areas) = (Vec::new(), Vec::new(), Vec::new());
    for cell in (0..points.len()).map(|i| cells.cell(VertexId::new(i))) {
        corners.extend(cell.rings().flat_map(Ring::points));
        ends.push(corners.len() as u32);
        areas.push(cell.area());
    }
    tray::leave_ints(2, ends);
    tray::leave_floats(0, corners.into_flattened());
    tray::leave_floats(1, areas);
    Ok(0)
}

export! {
    /// Of the points on the tray, with as many numbers as weights. Leaves as integers triangles, the sites that have no cell because others
    /// are heavier, and where the ring of each cell ends; as numbers corners, and areas.
    fn power(xmin: f64, ymin: f64, xmax: f64, ymax: f64) -> i32 {
        answer(leave(xmin, ymin, xmax, ymax))
    }
}
