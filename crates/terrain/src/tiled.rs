//! Rows of a raster from tiles on disk.
//!
//! Linear: all triangles that meet the rows are painted. Natural neighbors need what is around a place: the triangles that meet the
//! rows and some more are taken, and their corners triangulated, which gives all of these again, since what is empty of all points is
//! empty of some. Where the triangles whose circles hold a place, and those at their border, are triangles of the whole, its natural
//! neighbors are those of the whole. Where they are not, more is taken, and these cells are asked again. The corners of the hull are
//! always there, so that its border is the border of the whole.
//!
//! Memory: some 600 bytes for each point of a band.

use delone_predicates::hypotenuse;
use std::ops::Range;

use delone::surface::{Grid, Interpolator, Raster};
use delone::{Around, Bounds, Delaunay2, Surround, TriangleId};
use delone_store::{Corner, Store, Surface as Held, Watch};
use rayon::prelude::*;

use crate::cells::even;
use crate::error::Error;
use crate::options::{Method, Options};

/// Bytes of a cell of the row that is made, at the most.
const ROW: f64 = 64.0;
/// The program itself, and what files are read and written through.
const ITSELF: u64 = 40 << 20;
/// Bytes of a point of a band, where neighbors are asked.
const OF_POINT: f64 = 700.0;

/// The surface of a folder of tiles: the heights are those of all points in memory, bit for bit.
///
/// It has linear heights, natural neighbors by Sibson and Laplace, and nearest points. The rule for equal points is that of the run that made
/// the folder.
#[derive(Debug)]
pub struct Tiled {
    held: Held,
    memory: u64,
    rows: Option<usize>,
    method: Method,
    longest: Option<f64>,
}

impl Tiled {
    /// Reads where the tiles of a folder are; bands of rows take as much memory as is said, in bytes.
    ///
    /// # Errors
    /// [`Error::NeedsMemory`] for methods with gradients, and for edges that go from the hull inwards; [`Error::OneLine`]; [`Error::Store`].
    pub fn new(store: Store, memory: u64, options: &Options, watch: &dyn Watch) -> Result<Self, Error> {
        let border = options.border;
        if options.method.needs_gradients() {
            return Err(Error::NeedsMemory("a method with gradients"));
        }
        if border.longest.is_some() && !border.is_anywhere {
            return Err(Error::NeedsMemory("to leave out long edges from the hull inwards"));
        }
        match store.summary() {
            summary if summary.points == 0 => return Err(Error::NoPoints),
            _ if !store.has_heights() => return Err(Error::NoHeights),
            summary if summary.triangles == 0 => return Err(Error::OneLine),
            _ => {}
        }
        let held = store.surface(watch)?;
        Ok(Self { held, memory, rows: None, method: options.method, longest: border.longest })
    }

    /// Sets the rows of a band, instead of as many as fit.
    #[must_use]
    pub fn rows(self, rows: impl Into<Option<usize>>) -> Self {
        Self { rows: rows.into(), ..self }
    }

    /// The box around all points.
    pub fn bounds(&self) -> &Bounds<2> {
        self.held.bounds()
    }

    /// The folder.
    pub fn store(&self) -> &Store {
        self.held.store()
    }

    /// The rows of a raster in bands that fit into memory.
    ///
    /// # Errors
    /// [`Error::LargeRow`] if not even one does.
    pub fn bands(&self, grid: &Grid, at_once: usize) -> Result<Vec<Range<usize>>, Error> {
        let (free, columns) = (self.memory.saturating_sub(ITSELF) as f64, grid.columns());
        // A band has its values twice, and where neighbors are asked its points.
        let rows = (free / 8.0 / 16.0 / columns as f64) as usize;
        if rows == 0 && free < ROW * columns as f64 {
            return Err(Error::LargeRow { columns });
        }
        let bands = even(grid, self.rows.unwrap_or(rows.max(1)).min(at_once));
        if self.method == Method::Linear {
            return Ok(bands);
        }
        let most = free / 2.0 / OF_POINT;
        Ok(bands.into_iter().flat_map(|rows| self.split(grid, rows, most)).collect())
    }

    /// Halves a band until it does not have more points than are allowed, about.
    fn split(&self, grid: &Grid, rows: Range<usize>, most: f64) -> Vec<Range<usize>> {
        let count = self.held.count_between([grid.y(rows.end - 1), grid.y(rows.start)]);
        if count <= most || rows.len() < 2 {
            return vec![rows];
        }
        let middle = usize::midpoint(rows.start, rows.end);
        let halves = [rows.start..middle, middle..rows.end];
        halves.into_iter().flat_map(|half| self.split(grid, half, most)).collect()
    }

    /// The heights at the centers of the cells of some rows; NaN where there is no triangle.
    ///
    /// # Errors
    /// [`Error::Store`] if a file of the folder was changed or lost.
    pub fn values(&self, cells: &Grid) -> Result<Vec<f64>, Error> {
        values(&self.held, self.method, self.longest, cells)
    }
}

/// The values of some rows.
fn values(held: &Held, method: Method, max_edge: Option<f64>, grid: &Grid) -> Result<Vec<f64>, Error> {
    let raster = Raster::new(*grid);
    let range = [grid.y(grid.rows() - 1), grid.y(0)];
    held.each(range, |t| {
        let corners = t.map(|corner| corner.0);
        if !max_edge.is_some_and(|longest| exceeds(corners, longest)) {
            raster.paint(corners, t.map(|corner| corner.1));
        }
    })?;
    let mut values = raster.into_values();
    if method == Method::Linear {
        return Ok(values);
    }
    // What is linear is asked again until all that it needs is known.
    let mut open: Vec<usize> = (0..values.len()).filter(|&k| !values[k].is_nan()).collect();
    let mut margin = 4.0 * grid.step()[1].abs();
    while !open.is_empty() {
        // Beyond the last points there is nothing, however far.
        let (low, high) = (range[0] - margin, range[1] + margin);
        let box_ = [
            if low <= held.bounds().low[1] { f64::NEG_INFINITY } else { low },
            if high >= held.bounds().high[1] { f64::INFINITY } else { high },
        ];
        let part = Part::read(held, box_)?;
        open = part.settle(method, grid, &open, &mut values).map_err(Error::Points)?;
        if box_.iter().all(|end| end.is_infinite()) {
            debug_assert!(open.is_empty(), "all triangles are those of the whole");
            break;
        }
        margin = (2.0 * margin).max((range[1] - range[0]) / 8.0);
    }
    Ok(values)
}

/// Whether a triangle has an edge that is longer.
fn exceeds(corners: [[f64; 2]; 3], longest: f64) -> bool {
    (0..3).any(|k| {
        let (p, q) = (corners[k], corners[(k + 1) % 3]);
        hypotenuse(p[0] - q[0], p[1] - q[1]) > longest
    })
}

/// Cells with their values, and those that are not known yet.
type Settled = (Vec<(usize, f64)>, Vec<usize>);

/// The triangles of a part, as a triangulation of their corners.
struct Part {
    d: Delaunay2,
    heights: Vec<f64>,
    /// For each triangle, by index, whether it is one of the whole.
    is_real: Vec<bool>,
    range: [f64; 2],
}

impl Part {
    fn read(held: &Held, range: [f64; 2]) -> Result<Self, Error> {
        let mut triangles: Vec<[Corner; 3]> = Vec::new();
        held.each(range, |t| triangles.push(t))?;
        let key = |corner: &Corner| corner.0.map(ordered);
        let mut corners: Vec<Corner> = triangles.iter().flatten().chain(held.hull()).copied().collect();
        corners.sort_unstable_by_key(key);
        corners.dedup_by_key(|corner| corner.0);
        let points: Vec<[f64; 2]> = corners.iter().map(|corner| corner.0).collect();
        let number =
            |corner: &Corner| corners.binary_search_by_key(&key(corner), key).map_or(u32::MAX, |k| k as u32);
        let sorted = |mut t: [u32; 3]| {
            t.sort_unstable();
            t
        };
        let mut real: Vec<[u32; 3]> =
            triangles.iter().map(|t| sorted([&t[0], &t[1], &t[2]].map(number))).collect();
        drop(triangles);
        real.sort_unstable();
        let d = Delaunay2::from_points(&points).map_err(Error::Points)?;
        let mut is_real = vec![false; d.mesh().slot_count()];
        for t in d.triangle_ids() {
            let corners = sorted(d.mesh().corners(t).map(|v| v.index() as u32));
            is_real[t.index()] = real.binary_search(&corners).is_ok();
        }
        let heights = corners.iter().map(|corner| corner.1).collect();
        Ok(Self { d, heights, is_real, range })
    }

    /// Settles the cells that can be, on all threads, and gives back the others.
    fn settle(
        &self,
        method: Method,
        grid: &Grid,
        open: &[usize],
        values: &mut [f64],
    ) -> Result<Vec<usize>, delone::Error> {
        /// Cells that follow each other, for walks from one to the next.
        const PART: usize = 1 << 12;
        let parts: Vec<Settled> =
            open.par_chunks(PART).map(|part| self.ask(method, grid, part)).collect::<Result<_, _>>()?;
        let mut rest = Vec::new();
        for (settled, mut open) in parts {
            settled.into_iter().for_each(|(cell, value)| values[cell] = value);
            rest.append(&mut open);
        }
        Ok(rest)
    }

    /// The cells that are settled, and the others.
    fn ask(&self, method: Method, grid: &Grid, open: &[usize]) -> Result<Settled, delone::Error> {
        let mut settled = Vec::new();
        let mut surface = match method {
            Method::Laplace => Interpolator::laplace(&self.d),
            Method::Nearest => Interpolator::nearest(&self.d),
            _ => Interpolator::sibson(&self.d),
        };
        let mut around = Around::default();
        let mut near = None;
        let mut rest = Vec::new();
        for &cell in open {
            let q = grid.center(cell % grid.columns(), cell / grid.columns());
            let found = self.d.surround(near, q, &mut around)?;
            near = found.simplex.or(near);
            let is_real = |t: TriangleId| self.is_real[t.index()];
            let mut is_known = match found.simplex {
                None => false,
                Some(t) if around.cavity().is_empty() => found.face().len() == 1 || is_real(t),
                Some(_) => {
                    around.cavity().iter().all(|&t| is_real(t))
                        && around.border().iter().all(|&(_, t)| is_real(t))
                }
            };
            if method == Method::Nearest && around.is_at_hull() {
                // All points of the part's range are there, so what is nearer is too.
                let nearest = self.d.nearest(q)?.map(|v| self.d.point(v));
                let far =
                    nearest.map_or(f64::INFINITY, |p| hypotenuse(p[0] - q[0], p[1] - q[1]) * (1.0 + 1e-9));
                is_known = q[1] - far >= self.range[0] && q[1] + far <= self.range[1];
            }
            if is_known {
                settled.extend(surface.value(q, &self.heights)?.map(|value| (cell, value)));
            } else {
                rest.push(cell);
            }
        }
        Ok((settled, rest))
    }
}

/// Bits that are ordered as numbers are.
fn ordered(x: f64) -> u64 {
    let bits = (x + 0.0).to_bits();
    if bits >> 63 == 1 { !bits } else { bits | 1 << 63 }
}
