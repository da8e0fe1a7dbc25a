//! Cells, clipped; exact where the library is.

#[cfg(feature = "regions")]
use crate::fault::Fault;
use delone_library::{Cell2, Delaunay2, Region2, Ring, VertexId};

use crate::memory;
use crate::planes;
use crate::tray;

/// The rings on the tray: their corners, and where each ends.
#[cfg(feature = "regions")]
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

/// Points in a row whose rings are stored together.
const GROUP: usize = 4096;

/// Rings by point, coordinates in a row.
///
/// Cells come in the order of the plane and are read in that of the points. Where points come in any order, each would be a miss
/// of the cache, so rings are laid down by groups of points, and a group is small enough for the cache.
struct Rings {
    /// For each point where its ring starts and ends.
    spans: Vec<[u32; 2]>,
    corners: Vec<[f64; 2]>,
    /// Rings that have no room, counted on beyond the others: an array that grows for a few of them would take twice the memory.
    others: Vec<[f64; 2]>,
    /// For each group where the next ring goes, and where its room ends.
    rooms: Vec<[usize; 2]>,
}

impl Rings {
    /// Room for the cells of all points: each has as many corners as triangles, if it is not cut.
    fn room(d: &Delaunay2) -> Self {
        let count = d.points().len();
        let mut rooms = vec![[0; 2]; count.div_ceil(GROUP)];
        for v in d.mesh().triangles().flat_map(|t| d.mesh().corners(t)) {
            rooms[v.index() / GROUP][1] += 1;
        }
        let mut end = 0;
        for room in &mut rooms {
            end += room[1];
            *room = [end - room[1], end];
        }
        Self { spans: vec![[0; 2]; count], corners: vec![[0.0; 2]; end], others: Vec::new(), rooms }
    }

    fn add(&mut self, v: VertexId, ring: Ring<'_>) {
        let count = ring.points().len();
        let [next, end] = &mut self.rooms[v.index() / GROUP];
        let mut start = *next;
        if start + count <= *end {
            *next += count;
            for (to, corner) in self.corners[start..start + count].iter_mut().zip(ring.points()) {
                *to = corner;
            }
        } else {
            // Cut cells may have more.
            start = self.corners.len() + self.others.len();
            self.others.extend(ring.points());
        }
        self.spans[v.index()] = [start, start + count].map(|at| at as u32);
    }
}

/// Areas and centroids, which are the point itself where there is no area.
struct Measures {
    areas: Vec<f64>,
    centroids: Vec<[f64; 2]>,
}

impl Measures {
    fn room(d: &Delaunay2) -> Self {
        Self { areas: vec![0.0; d.points().len()], centroids: d.points().to_vec() }
    }

    fn add(&mut self, v: VertexId, cell: Cell2<'_>) {
        self.areas[v.index()] = cell.area();
        if let Some(centroid) = cell.centroid() {
            self.centroids[v.index()] = centroid;
        }
    }

    fn leave(self) {
        tray::leave_floats(0, self.areas);
        tray::leave_floats(1, self.centroids.into_flattened());
    }
}

export! {
    /// Leaves the centers of the circles of all triangles, in their order; infinite where they are beyond the range of numbers.
    fn circumcenters(plane: usize) -> i32 {
        planes::with(plane, |plane| {
            let centers = plane.triangulation.voronoi().vertices();
            tray::leave_floats(0, centers.flat_map(|c| c.unwrap_or([f64::INFINITY; 2])).collect());
            Ok(0)
        })
    }

    /// Leaves the cells of all points clipped to a rectangle: as integers where the ring of each starts and ends, as numbers corners, first
    /// those that lie together by groups. Or, if `measured`, areas and centroids.
    fn cells(plane: usize, xmin: f64, ymin: f64, xmax: f64, ymax: f64, measured: i32) -> i32 {
        planes::with(plane, |plane| {
            let region = Region2::rectangle([xmin, ymin], [xmax, ymax])?;
            let d = &plane.triangulation;
            memory::check(d.points().len(), memory::CELLS)?;
            if measured != 0 {
                let mut measures = Measures::room(d);
                d.voronoi().clip_each(&region, |v, cell| measures.add(v, cell));
                measures.leave();
                return Ok(0);
            }
            let mut rings = Rings::room(d);
            d.voronoi().clip_each(&region, |v, cell| cell.rings().for_each(|ring| rings.add(v, ring)));
            tray::leave_ints(0, rings.spans.into_flattened());
            tray::leave_floats(0, rings.corners.into_flattened());
            tray::leave_floats(1, rings.others.into_flattened());
            Ok(0)
        })
    }
}

#[cfg(feature = "regions")]
export! {
    /// Leaves the cells of all points clipped to the polygon on the tray: as integers for each point its first ring and the end of its
    /// rings, for each ring where it ends, as numbers corners. Or, if `measured`, areas and centroids.
    fn cells_in_polygon(plane: usize, measured: i32) -> i32 {
        planes::with(plane, |plane| {
            let region = polygon()?;
            let d = &plane.triangulation;
            memory::check(d.points().len(), memory::CELLS)?;
            let cells = d.voronoi().clip(&region);
            let sites = (0..d.points().len()).map(VertexId::new);
            if measured != 0 {
                let mut measures = Measures::room(d);
                sites.for_each(|v| measures.add(v, cells.cell(v)));
                measures.leave();
                return Ok(0);
            }
            let (mut rings, mut ends, mut corners) = (Vec::new(), Vec::new(), Vec::<[f64; 2]>::new());
            for v in sites {
                let first = ends.len() as u32;
                for ring in cells.rings(v) {
                    corners.extend(ring.points());
                    ends.push(corners.len() as u32);
                }
                rings.push([first, ends.len() as u32]);
            }
            tray::leave_ints(0, rings.into_flattened());
            tray::leave_ints(1, ends);
            tray::leave_floats(0, corners.into_flattened());
            Ok(0)
        })
    }
}
