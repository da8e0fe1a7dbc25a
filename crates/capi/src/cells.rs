//! Voronoi cells in a box.

use delone::{Bounds, Cells2, Delaunay2, Region2, VertexId};

use crate::failure::{CError, Failure, Status, guard};
use crate::plane::{Kind, Tri2};
use crate::points::{clear, give, handle, list, write};
use crate::run::run;

/// Without a box, cells reach beyond the box around all points by this part of its larger side: enough to see those of the hull.
const MARGIN_PART: f64 = 0.1;

/// `delone_cells`: cells by point, with the vertices that they use.
pub(crate) struct Cells {
    vertices: Vec<[f64; 2]>,
    /// Where the corners of each cell start, and the end of the last.
    starts: Vec<usize>,
    corners: Vec<u32>,
    areas: Vec<f64>,
}

impl Cells {
    /// Cells in a box are convex: each has one ring, or none.
    fn new(cells: &Cells2, count: usize) -> Self {
        let mut made = Self { vertices: vec![], starts: vec![0], corners: vec![], areas: vec![] };
        let mut numbers: Vec<Option<u32>> = vec![None; cells.vertices().len()];
        for site in (0..count).map(VertexId::new) {
            for &corner in cells.rings(site).flat_map(|ring| ring.indices()) {
                let number = *numbers[corner as usize].get_or_insert_with(|| {
                    made.vertices.push(cells.vertices()[corner as usize]);
                    made.vertices.len() as u32 - 1
                });
                made.corners.push(number);
            }
            made.starts.push(made.corners.len());
            made.areas.push(cells.area(site));
        }
        made
    }
}

/// The box of a caller, or one around all vertices.
fn region(given: &[f64], d: &Delaunay2) -> Result<Region2, Failure> {
    if let Some(at) = given.iter().position(|x| !x.is_finite()) {
        return Err(Failure::new(Status::NotFinite, format!("box: number {at} must be finite")).at(at));
    }
    if let &[x0, y0, x1, y1] = given {
        return Ok(Region2::rectangle([x0, y0], [x1, y1])?);
    }
    let bounds = Bounds::of(d.vertices().map(|v| d.point(v)));
    let extent = [0, 1].map(|k| MARGIN_PART * bounds.high[k] - MARGIN_PART * bounds.low[k]);
    let margin = extent.into_iter().fold(0.0, f64::max);
    let finite = |x: f64| x.clamp(f64::MIN, f64::MAX);
    let (low, high) = (bounds.low.map(|x| finite(x - margin)), bounds.high.map(|x| finite(x + margin)));
    let no_box = || Failure::new(Status::Dimension, "there is no box around the vertices: give one");
    if d.vertex_count() == 0 {
        return Err(no_box());
    }
    Region2::rectangle(low, high).map_err(|_| no_box())
}

#[unsafe(no_mangle)]
pub(crate) unsafe extern "C" fn delone_tri2_voronoi(
    t: *const Tri2,
    corners: *const f64,
    out: *mut *mut Cells,
    error: *mut CError,
) -> i32 {
    guard(error, || {
        // SAFETY: `delone.h` promises a handle, four numbers or NULL, and room for the handle.
        unsafe {
            clear(out)?;
            let t = handle(t)?;
            let given = list(corners, if corners.is_null() { 0 } else { 4 }, "box")?;
            let Kind::Plain(d) = &t.kind else {
                return Err(Failure::argument("cells are for triangulations without segments and weights"));
            };
            let region = region(given, d)?;
            give(out, run(d.points().len(), || Ok(Cells::new(&d.voronoi().clip(&region), d.points().len()))))
        }
    })
}

#[unsafe(no_mangle)]
pub(crate) unsafe extern "C" fn delone_cells_free(cells: *mut Cells) {
    if !cells.is_null() {
        // SAFETY: `delone.h` promises a handle of this library that was not freed.
        drop(unsafe { Box::from_raw(cells) });
    }
}

#[unsafe(no_mangle)]
pub(crate) unsafe extern "C" fn delone_cells_counts(
    cells: *const Cells,
    cell_count: *mut usize,
    corner_count: *mut usize,
    vertex_count: *mut usize,
) -> i32 {
    guard(std::ptr::null_mut(), || {
        // SAFETY: `delone.h` promises a handle, and a number behind each pointer that is not NULL.
        unsafe {
            let cells = handle(cells)?;
            write(cell_count, std::iter::once(cells.areas.len()));
            write(corner_count, std::iter::once(cells.corners.len()));
            write(vertex_count, std::iter::once(cells.vertices.len()));
        }
        Ok(())
    })
}

#[unsafe(no_mangle)]
pub(crate) unsafe extern "C" fn delone_cells_vertices(cells: *const Cells, xy: *mut f64) -> i32 {
    guard(std::ptr::null_mut(), || {
        // SAFETY: `delone.h` promises a handle, and room for two numbers a vertex.
        unsafe { write(xy, handle(cells)?.vertices.iter().flatten().copied()) };
        Ok(())
    })
}

#[unsafe(no_mangle)]
pub(crate) unsafe extern "C" fn delone_cells_rings(
    cells: *const Cells,
    starts: *mut usize,
    corners: *mut u32,
) -> i32 {
    guard(std::ptr::null_mut(), || {
        // SAFETY: `delone.h` promises a handle, and room for a number a cell and one more, and for all corners.
        unsafe {
            let cells = handle(cells)?;
            write(starts, cells.starts.iter().copied());
            write(corners, cells.corners.iter().copied());
        }
        Ok(())
    })
}

#[unsafe(no_mangle)]
pub(crate) unsafe extern "C" fn delone_cells_areas(cells: *const Cells, areas: *mut f64) -> i32 {
    guard(std::ptr::null_mut(), || {
        // SAFETY: `delone.h` promises a handle, and room for a number a cell.
        unsafe {
            write(areas, handle(cells)?.areas.iter().copied());
        }
        Ok(())
    })
}
