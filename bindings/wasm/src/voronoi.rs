//! Cells, clipped; exact where the library is.

use delone_library::{Region2, VertexId};

use crate::fault::Fault;
use crate::memory;
use crate::planes::{self, Plane};
use crate::tray;

#[cfg(feature = "regions")]
/// The rings on the tray: their corners, and where each ends.
fn polygon() -> Result<Region2, Fault> {
    let (points, ends) = (tray::points(), tray::indices());
    let mut start = 0;
    let mut rings = Vec::with_capacity(ends.len());
    for end in ends {
        rings.push(points.get(start..end as usize).unwrap_or_default().to_vec());
        start = end as usize;
    }
    Ok(Region2::polygon(&rings)?)
}

/// Cells clipped to a region. As integers: where the rings of each point end, where the corners of each ring end, corners. As
/// numbers: what corners are. Or, if `measured`: areas, and centroids, which are the point itself where there is no area.
fn leave(plane: &Plane, region: &Region2, measured: bool) -> Result<i32, Fault> {
    let d = &plane.triangulation;
    let count = d.points().len();
    memory::check(count, memory::CELLS)?;
    let cells = d.voronoi().clip(region);
    if measured {
        let ids = || (0..count).map(VertexId::new);
        tray::leave_floats(0, ids().map(|v| cells.area(v)).collect());
        let centroids = ids().flat_map(|v| cells.centroid(v).unwrap_or(d.points()[v.index()]));
        tray::leave_floats(1, centroids.collect());
        return Ok(0);
    }
    let (mut rings, mut ends) = (Vec::with_capacity(count), Vec::with_capacity(count));
    let mut corners = Vec::with_capacity(6 * count);
    for v in (0..count).map(VertexId::new) {
        for ring in cells.rings(v) {
            corners.extend_from_slice(ring.indices());
            ends.push(corners.len() as u32);
        }
        rings.push(ends.len() as u32);
    }
    [rings, ends, corners].into_iter().enumerate().for_each(|(k, array)| tray::leave_ints(k, array));
    tray::leave_floats(0, cells.vertices().as_flattened().to_vec());
    Ok(0)
}

export! {
    /// Leaves the centres of the circles of all triangles, in their order; infinite where they are beyond the range of numbers.
    fn circumcentres(plane: usize) -> i32 {
        planes::with(plane, |plane| {
            let centres = plane.triangulation.voronoi().vertices();
            tray::leave_floats(0, centres.flat_map(|c| c.unwrap_or([f64::INFINITY; 2])).collect());
            Ok(0)
        })
    }

    /// Leaves the cells of all points clipped to a rectangle, or what they measure.
    fn cells(plane: usize, xmin: f64, ymin: f64, xmax: f64, ymax: f64, measured: i32) -> i32 {
        planes::with(plane, |plane| {
            leave(plane, &Region2::rectangle([xmin, ymin], [xmax, ymax])?, measured != 0)
        })
    }
}

#[cfg(feature = "regions")]
export! {
    /// Leaves the cells of all points clipped to the polygon on the tray, or what they measure.
    fn cells_in_polygon(plane: usize, measured: i32) -> i32 {
        planes::with(plane, |plane| leave(plane, &polygon()?, measured != 0))
    }
}
