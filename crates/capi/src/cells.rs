//! Voronoi cells in a box.

use delone::{Bounds, Cells2, Region2, VertexId};

use crate::failure::{CError, Failure, Status, guard};
use crate::plane::{Kind, Tri2};
use crate::points::{clear, give, handle, list, write};
use crate::run::run;

/// Without a box, cells reach beyond the box around all points by this part of its larger side: enough to see those of the hull.
const MARGIN_PART: f64 = 0.1;

/// `delone_cells`.
pub(crate) struct Cells {
    cells: Cells2,
    /// How many there are: one a point.
    count: usize,
}

impl Cells {
    fn sites(&self) -> impl Iterator<Item = VertexId> {
        (0..self.count).map(VertexId::new)
    }

    /// The corners of a cell in a box, which is convex: one ring.
    fn corners(&self, site: VertexId) -> impl Iterator<Item = u32> {
        self.cells.rings(site).flat_map(|ring| ring.indices().iter().copied())
    }
}

/// The box of a caller, or one around all points.
fn region(given: &[f64], points: &[[f64; 2]]) -> Result<Region2, Failure> {
    if let &[x0, y0, x1, y1] = given {
        return Ok(Region2::rectangle([x0, y0], [x1, y1])?);
    }
    let bounds = Bounds::of(points.iter().copied());
    let margin = MARGIN_PART * bounds.extent().into_iter().fold(0.0, f64::max);
    let (low, high) = (bounds.low.map(|x| x - margin), bounds.high.map(|x| x + margin));
    Region2::rectangle(low, high)
        .map_err(|_| Failure::new(Status::Dimension, "the points span no box: give one"))
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
            let region = region(given, d.points())?;
            give(
                out,
                run(d.points().len(), || {
                    Ok(Cells { cells: d.voronoi().clip(&region), count: d.points().len() })
                }),
            )
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
            let corners = cells.sites().map(|site| cells.corners(site).count()).sum();
            write(cell_count, std::iter::once(cells.count));
            write(corner_count, std::iter::once(corners));
            write(vertex_count, std::iter::once(cells.cells.vertices().len()));
        }
        Ok(())
    })
}

#[unsafe(no_mangle)]
pub(crate) unsafe extern "C" fn delone_cells_vertices(cells: *const Cells, xy: *mut f64) -> i32 {
    guard(std::ptr::null_mut(), || {
        // SAFETY: `delone.h` promises a handle, and room for two numbers a vertex.
        unsafe { write(xy, handle(cells)?.cells.vertices().iter().flatten().copied()) };
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
            let mut next = 0;
            let ends = cells.sites().map(|site| {
                next += cells.corners(site).count();
                next
            });
            write(starts, std::iter::once(0).chain(ends));
            write(corners, cells.sites().flat_map(|site| cells.corners(site)));
        }
        Ok(())
    })
}

#[unsafe(no_mangle)]
pub(crate) unsafe extern "C" fn delone_cells_areas(cells: *const Cells, areas: *mut f64) -> i32 {
    guard(std::ptr::null_mut(), || {
        // SAFETY: `delone.h` promises a handle, and room for a number a cell.
        unsafe {
            let cells = handle(cells)?;
            write(areas, cells.sites().map(|site| cells.cells.area(site)));
        }
        Ok(())
    })
}
