//! Where the cells of a raster are.
//!
//! Centers are computed from the whole raster's origin and a cell's absolute number, so a window of a raster has the bits of the raster:
//! tiles that are made apart fit.

use std::ops::Range;

use crate::error::Error;
use crate::points::Bounds;

/// The largest number of cells along an axis, 2^52: the centers of more could not be told from their neighbors.
const MAX_CELLS_ALONG: f64 = 4_503_599_627_370_496.0;

/// The cells of a raster: columns along x and rows along y, each of one size. A value belongs to the center of its cell. In the
/// units of the points. Rows go from north to south where the step along y is negative, which is what files of rasters expect.
///
/// ```
/// use delone::surface::Grid;
///
/// let grid = Grid::new([0.0, 10.0], [2.0, -5.0], 3, 2)?;
/// assert_eq!((grid.center(0, 0), grid.center(2, 1)), ([1.0, 7.5], [5.0, 2.5]));
/// let window = grid.window(1..3, 1..2);
/// assert_eq!((window.center(0, 0), window.corner()), (grid.center(1, 1), [2.0, 5.0]));
/// # Ok::<(), delone::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    origin: [f64; 2],
    step: [f64; 2],
    /// The numbers of the first column and the first row, counted from the origin.
    first: [i64; 2],
    columns: usize,
    rows: usize,
}

impl Grid {
    /// The cells that begin at a corner and go on by steps, none of which is zero.
    ///
    /// # Errors
    /// [`Error::Parameter`] for a corner or a step that is not finite, a step of zero, and more than 2^52 columns or rows.
    pub fn new(corner: [f64; 2], step: [f64; 2], columns: usize, rows: usize) -> Result<Self, Error> {
        let refuse = |name, value, range| Err(Error::Parameter { name, value, range });
        if let Some(&value) = corner.iter().find(|x| !x.is_finite()) {
            return refuse("the corner of the raster", value, "finite");
        }
        if let Some(&value) = step.iter().find(|x| !x.is_finite() || **x == 0.0) {
            return refuse("the size of a cell", value, "finite and not zero");
        }
        if let Some(count) = [columns, rows].into_iter().find(|&n| n as f64 > MAX_CELLS_ALONG) {
            return refuse("the number of columns or rows", count as f64, "at most 2^52");
        }
        Ok(Self { origin: corner, step, first: [0; 2], columns, rows })
    }

    /// Square cells whose edges are multiples of their size and which hold a box, rows from north to south: from
    /// floor(x / size) to ceil(x / size) along each axis, and at least one. Rasters of the same size of cell fit each other.
    ///
    /// # Errors
    /// [`Error::Parameter`] for a size that is not positive and finite, and where a box has more than 2^52 cells along an axis or
    /// is so far from the origin.
    ///
    /// ```
    /// use delone::{Bounds, surface::Grid};
    ///
    /// let grid = Grid::aligned(&Bounds { low: [3.5, -2.0], high: [11.0, 7.1] }, 2.0)?;
    /// assert_eq!((grid.columns(), grid.rows(), grid.corner()), (5, 5, [2.0, 8.0]));
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn aligned(bounds: &Bounds<2>, size: f64) -> Result<Self, Error> {
        Self::aligned_at(bounds, size, [0.0; 2])
    }

    /// Covers the bounds by cells whose edges are multiples of their size away from an origin.
    ///
    /// # Errors
    /// Those of [`Grid::aligned`], and [`Error::Parameter`] for an origin that is not finite.
    ///
    /// ```
    /// use delone::{Bounds, surface::Grid};
    ///
    /// let grid = Grid::aligned_at(&Bounds { low: [3.5, -2.0], high: [11.0, 7.1] }, 2.0, [0.5, -1.0])?;
    /// assert_eq!((grid.columns(), grid.rows(), grid.corner()), (5, 6, [2.5, 9.0]));
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn aligned_at(bounds: &Bounds<2>, size: f64, origin: [f64; 2]) -> Result<Self, Error> {
        if !(size > 0.0 && size.is_finite()) {
            return Err(Error::Parameter {
                name: "the size of a cell",
                value: size,
                range: "positive and finite",
            });
        }
        if let Some(&value) = origin.iter().find(|x| !x.is_finite()) {
            return Err(Error::Parameter { name: "the origin of cells", value, range: "finite" });
        }
        let [low, high] = [bounds.low, bounds.high].map(|end| [0, 1].map(|k| (end[k] - origin[k]) / size));
        let (low, high) = (low.map(f64::floor), high.map(f64::ceil));
        let far = [low, high].concat().into_iter().find(|x| x.is_nan() || x.abs() > MAX_CELLS_ALONG);
        if let Some(value) = far {
            return Err(Error::Parameter {
                name: "the number of cells from the origin",
                value,
                range: "at most 2^52",
            });
        }
        let count = |k: usize| (high[k] - low[k]).max(1.0) as usize;
        let first = [low[0] as i64, -((low[1] + count(1) as f64) as i64)];
        Ok(Self { origin, step: [size, -size], first, columns: count(0), rows: count(1) })
    }

    /// Some of the columns and rows, with the same centers.
    ///
    /// # Panics
    /// For columns or rows that there are not.
    #[must_use]
    pub fn window(&self, columns: Range<usize>, rows: Range<usize>) -> Self {
        assert!(columns.start <= columns.end && columns.end <= self.columns, "columns of the raster");
        assert!(rows.start <= rows.end && rows.end <= self.rows, "rows of the raster");
        let first = [self.first[0] + columns.start as i64, self.first[1] + rows.start as i64];
        Self { first, columns: columns.len(), rows: rows.len(), ..*self }
    }

    /// The number of columns.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// The number of rows.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// The number of cells; as a float it cannot overflow.
    pub fn cells(&self) -> f64 {
        self.columns as f64 * self.rows as f64
    }

    /// The steps from column to column and from row to row.
    pub fn step(&self) -> [f64; 2] {
        self.step
    }

    /// The corner of the first cell that is not between cells: its west and, where rows go south, its north.
    pub fn corner(&self) -> [f64; 2] {
        [0, 1].map(|k| self.edge(k, self.first[k]))
    }

    /// The corner of the last cell that is not between cells.
    pub fn far_corner(&self) -> [f64; 2] {
        let counts = [self.columns as i64, self.rows as i64];
        [0, 1].map(|k| self.edge(k, self.first[k] + counts[k]))
    }

    /// The center of a cell.
    #[inline]
    pub fn center(&self, column: usize, row: usize) -> [f64; 2] {
        [self.x(column), self.y(row)]
    }

    /// Where the centers of a column are.
    #[inline]
    pub fn x(&self, column: usize) -> f64 {
        self.middle(0, column)
    }

    /// Where the centers of a row are.
    #[inline]
    pub fn y(&self, row: usize) -> f64 {
        self.middle(1, row)
    }

    #[inline]
    fn middle(&self, axis: usize, k: usize) -> f64 {
        self.origin[axis] + ((self.first[axis] + k as i64) as f64 + 0.5) * self.step[axis]
    }

    fn edge(&self, axis: usize, number: i64) -> f64 {
        self.origin[axis] + number as f64 * self.step[axis]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_aligned_and_windows_are_parts() {
        let mut random = crate::order::random::SplitMix(5);
        let mut next = move |scale: f64| (random.next() % 1_000_003) as f64 * scale;
        for _ in 0..2000 {
            let size = next(1e-4) + 1e-3;
            let low = [next(1e-2) - 5000.0, next(1e-2) + 4e5];
            let bounds = Bounds { low, high: [low[0] + next(1e-3), low[1] + next(1e-3)] };
            let grid = Grid::aligned(&bounds, size).expect("a raster");
            let [west, north] = grid.corner();
            let [east, south] = grid.far_corner();
            assert_eq!([west, south], bounds.low.map(|x| (x / size).floor() * size));
            assert!(east >= (bounds.high[0] / size).ceil() * size);
            assert!(north >= (bounds.high[1] / size).ceil() * size);
            let [columns, rows] = [grid.columns(), grid.rows()];
            let window = grid.window(columns / 3..columns, rows / 2..rows);
            for k in 0..window.columns() {
                assert_eq!(window.x(k).to_bits(), grid.x(columns / 3 + k).to_bits());
            }
            assert_eq!(window.y(0).to_bits(), grid.y(rows / 2).to_bits());
            assert_eq!(window.far_corner(), grid.far_corner());
        }
    }

    #[test]
    fn what_is_no_raster_is_refused() {
        let bounds = Bounds { low: [0.0; 2], high: [1e300; 2] };
        assert!(Grid::aligned(&bounds, 1.0).is_err());
        assert!(Grid::aligned(&Bounds { low: [f64::NAN; 2], high: [1.0; 2] }, 1.0).is_err());
        for size in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(Grid::aligned(&Bounds { low: [0.0; 2], high: [1.0; 2] }, size).is_err(), "{size}");
        }
        assert!(Grid::new([0.0; 2], [1.0, 0.0], 1, 1).is_err());
        assert!(Grid::new([f64::INFINITY, 0.0], [1.0, -1.0], 1, 1).is_err());
    }
}
