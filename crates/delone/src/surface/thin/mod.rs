//! Thinning: few of many points with heights, such that the triangles of these few are nowhere far from any of the others.
//!
//! Greedy insertion (Garland & Heckbert, "Fast polygonal approximation of terrains and height fields", CMU-CS-95-181, 1995, algorithm
//! III): the corners of the hull first, then round after round the point of each triangle that is furthest from it, if it is too far. Only
//! triangles that a round made are measured. When nothing is too far away, points that those after them made superfluous are taken out
//! again, an eighth or more of all. Ties go to the lexicographically least point and the triangulation is
//! the canonical one, so the result is that of the set of points: neither their order nor threads show.
//!
//! Cost: O(log n) for each point that is chosen, its cavity, and the points in the triangles of its star, of which boxes leave most out
//! where triangles are large; in the end its star once more.

mod cloud;
mod greedy;
mod lattice;
mod mesh;
mod plane;
mod prune;
mod sides;
#[cfg(test)]
mod tests;

use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

use delone_predicates::{Filter, Grid as Steps};

use super::Grid;
use crate::error::Error;
use crate::hull::Hull2;
use crate::ids::MAX_POINTS;
use crate::order::morton;
use crate::parallel;
use crate::plane::Constrained2;
use crate::points::{check_count, check_finite, survey};
use cloud::Cloud;
use greedy::Greedy;
use lattice::{HIGHEST, Lattice};
use mesh::Mesh;
use plane::LOW;

/// The factor of all heights if one exceeds [`HIGHEST`]: 2^-64.
const LOWERED: f64 = f64::from_bits((1023 - 64) << 52);

/// Three samples: the corners of a triangle.
type Triple = [u32; 3];

/// Points with heights that are chosen from, by number.
trait Samples: Sync {
    /// The worst sample of a triangle, as what is sorted: by its error, of equal ones the lexicographically least sample last.
    type Entry: Copy + Ord + Send + Sync;
    /// The entry of a sample with a positive error in a triangle.
    fn entry(&self, error: f64, sample: u32, triangle: u32) -> Self::Entry;
    /// The result that an entry was made of.
    fn found(&self, entry: &Self::Entry) -> Found;
    /// The numbers are below this one.
    fn count(&self) -> usize;
    /// Whether there is a sample of a number.
    fn is_there(&self, sample: u32) -> bool;
    /// Where a sample is.
    fn point(&self, sample: u32) -> [f64; 2];
    /// Its height.
    fn height(&self, sample: u32) -> f64;
    /// The sample in a triangle that is furthest from its plane, if it is as far as a floor; of several the lexicographically least.
    fn worst(&self, corners: Triple, floor: f64) -> Option<(f64, u32)>;
    /// Measures every sample in a triangle.
    fn judge(&self, corners: Triple, triangle: u32, verdict: &mut Verdict<'_>);
    /// The error of a sample in a triangle.
    fn error(&self, corners: Triple, sample: u32) -> f64;
}

/// The worst sample of a triangle.
struct Found {
    error: f64,
    sample: u32,
    triangle: u32,
}

/// The result of measuring all samples of some triangles once more.
struct Verdict<'a> {
    allowed: f64,
    /// The largest error so far.
    largest: f64,
    /// Which samples were in a triangle, of these or of others.
    seen: &'a [AtomicBool],
    /// Samples that are further away than allowed, after a triangle that each is in.
    missed: Vec<(u32, u32)>,
}

impl<'a> Verdict<'a> {
    fn new(allowed: f64, seen: &'a [AtomicBool]) -> Self {
        Self { allowed, largest: 0.0, seen, missed: Vec::new() }
    }

    fn take(&mut self, triangle: u32, sample: u32, error: f64) {
        self.seen[sample as usize].store(true, Relaxed);
        self.largest = if error > self.largest { error } else { self.largest };
        if error > self.allowed {
            self.missed.push((triangle, sample));
        }
    }
}

/// How far thinning goes.
///
/// ```
/// use delone::surface::Thinning;
///
/// // A roof: its ridge and its corners are all of it.
/// let points: Vec<[f64; 2]> = (0..25).map(|i| [f64::from(i % 5), f64::from(i / 5)]).collect();
/// let heights: Vec<f64> = points.iter().map(|p| 2.0 - (p[0] - 2.0).abs()).collect();
/// let thinned = Thinning::new().max_error(1e-9).points(&points, &heights, &[])?;
/// assert_eq!((thinned.vertices.len(), thinned.error), (6, 0.0));
/// # Ok::<(), delone::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Thinning {
    max_error: f64,
    max_points: usize,
}

/// The points that are left.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Thinned {
    /// The points that are left, by their indices in the input, cells of a raster row by row: those that there were to begin with (the
    /// corners of the hull, the ends of segments and where they meet, by index), then in the order in which they were chosen, but for those that later ones made
    /// superfluous. Their canonical triangulation, with the segments, is what the others were measured against.
    pub vertices: Vec<usize>,
    /// The largest distance in height of any input point from the triangles, computed for all of them in the end.
    pub error: f64,
}

impl Default for Thinning {
    fn default() -> Self {
        Self::new()
    }
}

impl Thinning {
    /// As far as no point is off, with as many points as that takes.
    pub fn new() -> Self {
        Self { max_error: 0.0, max_points: usize::MAX }
    }

    /// How far the height of a point may be from the triangles, in the units of heights. Errors are computed in floating point: what is
    /// above by less than 2^-40 of the largest height is rounding, and is left; so are points over triangles with an area of less than 2^-56 of their box.
    #[must_use]
    pub fn max_error(self, max_error: f64) -> Self {
        Self { max_error, ..self }
    }

    /// The number of points to stop at, all of which are left if they are not enough for the largest error. The corners of the hull and the
    /// ends of segments stay, be they more, and all points where these are on a line.
    #[must_use]
    pub fn max_points(self, max_points: usize) -> Self {
        Self { max_points, ..self }
    }

    /// Thins points with heights. Segments are between points by index; they are edges of what is left, and their ends and the points where
    /// they meet are among its vertices. Of points that are equal the first counts.
    ///
    /// # Errors
    /// [`Error::Parameter`] for a largest error that is NaN or negative, [`Error::Values`] for other than one height a point,
    /// [`Error::NotFinite`] and [`Error::Height`] for numbers that are none, [`Error::TooManyPoints`], and those of segments:
    /// [`Error::NoSuchPoint`], [`Error::SegmentsCross`].
    pub fn points(
        &self,
        points: &[[f64; 2]],
        heights: &[f64],
        segments: &[[usize; 2]],
    ) -> Result<Thinned, Error> {
        self.check()?;
        if points.len() != heights.len() {
            return Err(Error::Values { expected: points.len(), found: heights.len() });
        }
        check_count(points.len(), MAX_POINTS)?;
        check_finite(points.iter().copied())?;
        if let Some(index) = heights.iter().position(|z| !z.is_finite()) {
            return Err(Error::Height { index, value: heights[index] });
        }
        let count = points.len();
        for (segment, ends) in segments.iter().enumerate() {
            if let Some(&index) = ends.iter().find(|&&end| end >= count) {
                return Err(Error::NoSuchPoint { segment, index, count });
            }
        }
        let (bounds, _) = survey(points);
        let sorted = morton::sort(points, &bounds);
        let mut place = vec![0_u32; count];
        for (at, &i) in sorted.indices.iter().enumerate() {
            place[i as usize] = at as u32;
        }
        for &(duplicate, first) in &sorted.duplicates {
            place[duplicate as usize] = place[first as usize];
        }
        let first = |i: usize| sorted.indices[place[i] as usize] as usize;
        let hull = Hull2::from_points(points)?;
        let ends = || hull.corners().iter().chain(segments.as_flattened());
        let begin = |junctions: &[usize]| {
            let mut start: Vec<usize> = ends().chain(junctions).map(|&i| first(i)).collect();
            start.sort_unstable();
            start.dedup();
            let at = |i: usize| start.partition_point(|&j| j < first(i));
            let segments: Vec<[usize; 2]> = segments.iter().map(|ends| ends.map(at)).collect();
            (start.into_iter().map(|i| place[i]).collect::<Vec<u32>>(), segments)
        };
        // Planes over higher ones, and differences of them, may be beyond all numbers.
        let scale = if heights.iter().all(|z| z.abs() < HIGHEST) { 1.0 } else { LOWERED };
        let heights = sorted.indices.iter().map(|&i| heights[i as usize] * scale).collect();
        let filter =
            filter(bounds.high[0] - bounds.low[0], bounds.high[1] - bounds.low[1], points.as_flattened());
        let samples = Cloud::new(sorted.points, heights, filter);
        let scaled = Self { max_error: self.max_error * scale, ..*self };
        let at = |start: &[u32]| start.iter().map(|&s| samples.point(s)).collect::<Vec<_>>();
        let (mut start, between) = begin(&[]);
        // Mostly they meet at ends of theirs alone. To be told where else takes long where many do.
        let meet_at_ends = Constrained2::if_uncrossed(at(&start), &between);
        let c = if let Some(c) = meet_at_ends {
            c
        } else {
            let between;
            (start, between) = begin(&junctions(points, segments)?);
            Constrained2::from_parts(&at(&start), &between)?
        };
        let all = 0..samples.points.len() as u32;
        let thinned = scaled
            .thin(&samples, &start, c, filter)
            .unwrap_or_else(|| Thinned { vertices: all.map(|s| s as usize).collect(), error: 0.0 })
            .named(&sorted.indices);
        Ok(Thinned { error: thinned.error / scale, ..thinned })
    }

    /// Thins the cells of a raster that have data: values row by row, NaN where there is none. Vertices are numbers of cells.
    /// Errors are those over columns and rows, without the rounding of where centers are, which moves a place by a small part of a cell.
    ///
    /// # Errors
    /// [`Error::Parameter`] for a largest error that is NaN or negative, [`Error::Values`] for other than one value a cell,
    /// [`Error::Height`] for an infinite one, [`Error::TooManyPoints`].
    ///
    /// ```
    /// use delone::surface::{Grid, Thinning};
    ///
    /// let grid = Grid::new([0.0, 3.0], [1.0, -1.0], 4, 3)?;
    /// let slope: Vec<f64> = (0..12).map(|i| f64::from(i % 4) * 0.5).collect();
    /// let thinned = Thinning::new().max_error(0.1).raster(&grid, &slope)?;
    /// assert_eq!(thinned.vertices, [0, 3, 8, 11]);
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn raster(&self, grid: &Grid, values: &[f64]) -> Result<Thinned, Error> {
        self.check()?;
        let (columns, rows) = (grid.columns(), grid.rows());
        if values.len() as f64 != grid.cells() {
            return Err(Error::Values { expected: columns.saturating_mul(rows), found: values.len() });
        }
        check_count(values.len(), MAX_POINTS)?;
        if let Some(index) = values.iter().position(|z| z.is_infinite()) {
            return Err(Error::Height { index, value: values[index] });
        }
        // Planes over cells end before numbers do.
        let is_extreme = |z: f64| z != 0.0 && !z.is_nan() && !(LOW * 1e20..HIGHEST).contains(&z.abs());
        if values.iter().any(|&z| is_extreme(z)) || is_coarse(grid) {
            return self.cells(grid, values);
        }
        let start: Vec<u32> = corners(grid, values)?.into_iter().map(|i| i as u32).collect();
        let sides: Vec<f64> = (0..columns).map(|k| grid.x(k)).chain((0..rows).map(|k| grid.y(k))).collect();
        let [width, height] = [columns, rows].map(|n| n as f64);
        let [dx, dy] = grid.step().map(f64::abs);
        let filter = filter(width * dx, height * dy, &sides);
        let samples = Lattice::new(grid, values);
        let points: Vec<[f64; 2]> = start.iter().map(|&s| samples.point(s)).collect();
        let thinned = self.thin(&samples, &start, Constrained2::from_parts(&points, &[])?, filter);
        let all = || (0..values.len()).filter(|&i| !values[i].is_nan()).collect();
        Ok(thinned.unwrap_or_else(|| Thinned { vertices: all(), error: 0.0 }))
    }

    /// Thins the cells with data as points.
    fn cells(&self, grid: &Grid, values: &[f64]) -> Result<Thinned, Error> {
        let cells: Vec<u32> = (0..values.len() as u32).filter(|&i| !values[i as usize].is_nan()).collect();
        let center = |&i: &u32| grid.center(i as usize % grid.columns(), i as usize / grid.columns());
        let points: Vec<[f64; 2]> = cells.iter().map(center).collect();
        let heights: Vec<f64> = cells.iter().map(|&i| values[i as usize]).collect();
        Ok(self.points(&points, &heights, &[])?.named(&cells))
    }

    fn check(&self) -> Result<(), Error> {
        if self.max_error >= 0.0 {
            return Ok(());
        }
        Err(Error::Parameter { name: "the largest error", value: self.max_error, range: "zero or positive" })
    }

    /// Chooses samples, from those that a triangulation is of; `None` where there are no triangles, so that nothing can be left out.
    fn thin<S: Samples>(
        &self,
        samples: &S,
        start: &[u32],
        c: Constrained2,
        filter: Filter,
    ) -> Option<Thinned> {
        if c.triangle_count() == 0 {
            return None;
        }
        let mesh = Mesh::new(c, filter);
        let greedy = Greedy::new(samples, mesh, start);
        Some(parallel::inside(samples.count(), || greedy.run(self.max_error, self.max_points)))
    }
}

impl Thinned {
    /// With other names of the samples.
    fn named(mut self, names: &[u32]) -> Self {
        self.vertices.iter_mut().for_each(|v| *v = names[*v] as usize);
        self
    }
}

/// The points where segments meet: with more than two edges of theirs. Segments that cross elsewhere are an error.
fn junctions(points: &[[f64; 2]], segments: &[[usize; 2]]) -> Result<Vec<usize>, Error> {
    let c = Constrained2::from_parts(points, segments)?;
    let mesh = c.mesh();
    let mut edges = vec![0_u32; points.len()];
    let fixed = c.triangle_ids().flat_map(|t| [0, 1, 2].map(|k| t.edge(k))).filter(|&e| mesh.is_fixed(e));
    for e in fixed {
        // An edge is met from both of its sides, one of the hull once.
        edges[mesh.origin(e).index()] += 1;
        edges[mesh.destination(e).index()] += 1;
    }
    Ok((0..points.len()).filter(|&i| edges[i] > 4).collect())
}

/// The filter of a box of this size, for coordinates on a lattice or not.
fn filter(width: f64, height: f64, coordinates: &[f64]) -> Filter {
    Filter::for_box(width, height, Steps::of(coordinates))
}

/// Whether centers are rounded so much, in parts of a cell, that a triangle may turn over by it.
fn is_coarse(grid: &Grid) -> bool {
    let count = [grid.columns(), grid.rows()];
    let most = |k: usize, place: fn(&Grid, usize) -> f64| {
        place(grid, 0).abs().max(place(grid, count[k].saturating_sub(1)).abs()) / grid.step()[k].abs()
    };
    let rounding = f64::EPSILON * most(0, Grid::x).max(most(1, Grid::y));
    // Twice the area of a triangle of cells is one cell at least, and no side is longer than both sides of the raster.
    rounding * (count[0] as f64 + count[1] as f64) > 1.0 / 256.0
}

/// The cells at the corners of the hull of those with data, by number.
fn corners(grid: &Grid, values: &[f64]) -> Result<Vec<usize>, Error> {
    let (columns, count) = (grid.columns(), values.len());
    let four = [0, columns.wrapping_sub(1), count.wrapping_sub(columns), count.wrapping_sub(1)];
    if four.iter().all(|&i| values.get(i).is_some_and(|z| !z.is_nan())) {
        let mut four = four.to_vec();
        four.dedup();
        return Ok(four);
    }
    // The outermost of each row are enough.
    let mut cells = Vec::new();
    for (r, row) in values.chunks_exact(columns.max(1)).enumerate() {
        let first = row.iter().position(|z| !z.is_nan());
        let last = row.iter().rposition(|z| !z.is_nan());
        cells.extend(first.into_iter().chain(last).map(|c| r * columns + c));
    }
    cells.dedup();
    let centers: Vec<[f64; 2]> = cells.iter().map(|&i| grid.center(i % columns, i / columns)).collect();
    let hull = Hull2::from_points(&centers)?;
    let mut corners: Vec<usize> = hull.corners().iter().map(|&i| cells[i]).collect();
    corners.sort_unstable();
    Ok(corners)
}
