//! Values at many points, by all threads.
//!
//! Points are taken in their order, in parts, each by an interpolator of its own that walks from one to the next: results do not depend on
//! the number of threads. Cost: as for [`Interpolator`].

use super::grid::Grid;
use super::interpolator::{Interpolator, check_values};
use crate::around::Surround;
use crate::error::Error;
use crate::parallel;
use crate::triangulation::Ask;

/// Weights of many points, a row for each: a sparse matrix with compressed rows, which is these three arrays: no field
/// will be added.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Weights {
    /// Where each row begins in the others, and where the last one ends.
    pub starts: Vec<usize>,
    /// The indices of vertices, increasing in each row.
    pub columns: Vec<u32>,
    /// Their weights.
    pub values: Vec<f64>,
}

impl<T: Surround> Interpolator<'_, T> {
    /// Values at many points, a row of `columns` for each; NaN outside. `table` has a row for each id of a vertex.
    ///
    /// # Errors
    /// [`Error::NotFinite`] names the first point with NaN or infinity; [`Error::Values`] if the table has another size.
    ///
    /// ```
    /// use delone::{Delaunay2, surface::Interpolator};
    ///
    /// let d = Delaunay2::from_points(&[[0, 0], [2, 0], [0, 2]])?;
    /// let table = [0.0, 5.0, 2.0, 7.0, 4.0, 9.0]; // two values at each vertex
    /// let values = Interpolator::linear(&d).many(&[[1.0, 0.0], [9.0, 9.0]], &table, 2)?;
    /// assert_eq!(values[..2], [1.0, 6.0]);
    /// assert!(values[2].is_nan() && values[3].is_nan());
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn many(&self, points: &[T::Point], table: &[f64], columns: usize) -> Result<Vec<f64>, Error> {
        check_values(self.triangulation(), table.len(), columns)?;
        let work = |own: &mut Self, q: T::Point, values: &mut Vec<f64>| {
            let at = values.len();
            values.resize(at + columns, f64::NAN);
            if !own.values(q, table, &mut values[at..])? {
                values[at..].fill(f64::NAN);
            }
            Ok(())
        };
        Ok(self.each(points, work)?.concat())
    }

    /// Values at many points of a surface with gradients; NaN outside. `surface` is [`Interpolator::smooth`] or
    /// [`Interpolator::farin`].
    ///
    /// # Errors
    /// As [`Self::many`].
    pub fn many_bent(
        &self,
        points: &[T::Point],
        surface: impl Fn(&mut Self, T::Point) -> Result<Option<f64>, Error> + Sync,
    ) -> Result<Vec<f64>, Error> {
        let work = |own: &mut Self, q: T::Point, values: &mut Vec<f64>| {
            values.push(surface(own, q)?.unwrap_or(f64::NAN));
            Ok(())
        };
        Ok(self.each(points, work)?.concat())
    }

    /// The weights at many points; rows of points outside are empty.
    ///
    /// # Errors
    /// As [`Self::many`].
    ///
    /// ```
    /// use delone::{Delaunay2, surface::Interpolator};
    ///
    /// let d = Delaunay2::from_points(&[[0, 0], [4, 0], [4, 4], [0, 4]])?;
    /// let weights = Interpolator::sibson(&d).matrix(&[[2.0, 2.0], [9.0, 9.0]])?;
    /// assert_eq!(weights.starts, [0, 4, 4]); // a row of four, and an empty one
    /// assert_eq!(weights.values, [0.25; 4]);
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn matrix(&self, points: &[T::Point]) -> Result<Weights, Error> {
        let work = |own: &mut Self, q: T::Point, rows: &mut Vec<(usize, Vec<(u32, f64)>)>| {
            let mut row: Vec<_> =
                own.weights(q)?.iter().map(|&(v, weight)| (v.index() as u32, weight)).collect();
            row.sort_unstable_by_key(|entry| entry.0);
            rows.push((row.len(), row));
            Ok(())
        };
        let mut all = Weights { starts: vec![0], ..Weights::default() };
        for (count, row) in self.each(points, work)?.into_iter().flatten() {
            all.starts.push(all.starts[all.starts.len() - 1] + count);
            all.columns.extend(row.iter().map(|entry| entry.0));
            all.values.extend(row.iter().map(|entry| entry.1));
        }
        Ok(all)
    }

    /// Computes a value for each point, in their order.
    fn each<R: Send>(
        &self,
        points: &[T::Point],
        work: impl Fn(&mut Self, T::Point, &mut Vec<R>) -> Result<(), Error> + Sync,
    ) -> Result<Vec<Vec<R>>, Error> {
        let model = self.for_many(points.len());
        let part = |range: std::ops::Range<usize>| {
            let mut own = model.clone();
            let mut results = Vec::new();
            for index in range {
                let q = points[index];
                if let Some(axis) = q.as_ref().iter().position(|x| !x.is_finite()) {
                    return Err(Error::NotFinite { index, axis, value: q.as_ref()[axis] });
                }
                work(&mut own, q, &mut results)?;
            }
            Ok(results)
        };
        parallel::map(parallel::ranges(points.len()), part).into_iter().collect()
    }
}

impl<T: Ask<Point = [f64; 2]> + Surround> Interpolator<'_, T> {
    /// Values at the centers of the cells of a raster that have one in `mask`, row by row, in its place; the others stay as they are.
    ///
    /// # Errors
    /// [`Error::Values`] if there are not as many values as ids of vertices.
    ///
    /// ```
    /// use delone::{Delaunay2, surface::{Grid, Interpolator, rasterize}};
    ///
    /// let d = Delaunay2::from_points(&[[0, 0], [4, 0], [4, 4], [0, 4]])?;
    /// let heights = [0.0, 4.0, 8.0, 4.0]; // x + y
    /// let grid = Grid::new([0.0, 4.0], [1.0, -1.0], 5, 4)?;
    /// let mut raster = rasterize(&d, &heights, &grid, |_| true)?; // NaN in the last column, which is outside
    /// Interpolator::sibson(&d).fill(&grid, &heights, &mut raster)?;
    /// assert!((raster[0] - 4.0).abs() < 1e-12 && raster[4].is_nan()); // at 0.5, 3.5 and at 4.5, 3.5
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn fill(&self, grid: &Grid, values: &[f64], mask: &mut [f64]) -> Result<(), Error> {
        check_values(self.triangulation(), values.len(), 1)?;
        self.fill_with(grid, mask, |own, q| own.value(q, values))
    }

    /// Fills a raster with the values of any surface.
    ///
    /// # Errors
    /// What `surface` returns.
    ///
    /// # Panics
    /// If the mask is no raster of this size.
    pub fn fill_with(
        &self,
        grid: &Grid,
        mask: &mut [f64],
        surface: impl Fn(&mut Self, [f64; 2]) -> Result<Option<f64>, Error> + Sync,
    ) -> Result<(), Error> {
        let columns = grid.columns();
        assert_eq!(mask.len(), columns * grid.rows(), "a value for each cell");
        if columns == 0 {
            return Ok(());
        }
        let rows = parallel::ranges(mask.len()).len().min(grid.rows());
        let ends: Vec<usize> =
            parallel::even_ends(grid.rows(), rows).iter().map(|end| end * columns).collect();
        let mut from = 0;
        let tasks: Vec<_> = parallel::split_at(mask, &ends)
            .into_iter()
            .zip(&ends)
            .map(|(part, &end)| (std::mem::replace(&mut from, end / columns), part))
            .collect();
        let part = |(first, part): (usize, &mut [f64])| {
            let mut own = self.clone();
            for (row, cells) in part.chunks_mut(columns).enumerate() {
                for (column, cell) in cells.iter_mut().enumerate() {
                    if !cell.is_nan()
                        && let Some(value) = surface(&mut own, grid.center(column, first + row))?
                    {
                        *cell = value;
                    }
                }
            }
            Ok(())
        };
        parallel::map(tasks, part).into_iter().collect()
    }
}
