//! The cells of a raster: around points, over an area, or those of another raster.

use std::ops::Range;

use delone::Bounds;
use delone::surface::Grid;

use crate::error::{Error, MAX_CELLS};
use crate::remark::Remark;

/// Cells for each point that are made without being asked for. Evenly spread points have one, n of them in a strip that is L times as long
/// as wide sqrt(L / n); a few points far from the others have any number.
const CELLS_A_POINT: f64 = 1000.0;

/// Where the cells of a raster are to be.
///
/// ```
/// use delone::Bounds;
/// use delone_terrain::Cells;
///
/// let points = Bounds { low: [0.3, 10.2], high: [8.4, 17.6] };
/// let grid = Cells::new().size(0.5).grid(&points, 100)?;
/// assert_eq!((grid.columns(), grid.rows(), grid.corner()), (17, 16, [0.0, 18.0]));
/// # Ok::<(), delone_terrain::Error>(())
/// ```
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct Cells {
    /// The side of a cell; without it there is about one point a cell.
    pub size: Option<f64>,
    /// The area that cells cover; without it that of the points.
    pub extent: Option<Bounds<2>>,
    /// A corner of cells, which the others are multiples of their size away from.
    pub origin: [f64; 2],
    /// The cells of another raster, which are taken as they are.
    pub like: Option<Grid>,
}

impl Cells {
    /// Square cells around the points, at multiples of their size.
    pub fn new() -> Self {
        Self::default()
    }

    /// Sets [`Self::size`].
    #[must_use]
    pub fn size(self, size: impl Into<Option<f64>>) -> Self {
        Self { size: size.into(), ..self }
    }

    /// Sets [`Self::extent`].
    #[must_use]
    pub fn extent(self, extent: impl Into<Option<Bounds<2>>>) -> Self {
        Self { extent: extent.into(), ..self }
    }

    /// Sets [`Self::origin`].
    #[must_use]
    pub fn origin(self, origin: [f64; 2]) -> Self {
        Self { origin, ..self }
    }

    /// Sets [`Self::like`].
    ///
    /// # Errors
    /// [`Error::NotNorthUp`] if its rows do not go from north to south, or its columns not to the east.
    pub fn like(self, grid: Grid) -> Result<Self, Error> {
        if grid.step()[0] > 0.0 && grid.step()[1] < 0.0 {
            Ok(Self { like: Some(grid), ..self })
        } else {
            Err(Error::NotNorthUp)
        }
    }

    /// The area that cells cover, for points within bounds.
    pub fn area(&self, points: &Bounds<2>) -> Bounds<2> {
        self.extent.unwrap_or(*points)
    }

    /// Cells of a size over the area, for points within bounds.
    ///
    /// # Errors
    /// If the size is not positive and finite, or there would be more cells than are counted.
    pub fn squares(&self, points: &Bounds<2>, size: f64) -> Result<Grid, delone::Error> {
        Grid::aligned_at(&self.area(points), size, self.origin)
    }

    /// The cells of a raster of so many points within bounds.
    ///
    /// # Errors
    /// [`Error::Cells`], [`Error::TooManyCells`] and [`Error::FarPoints`].
    pub fn grid(&self, points: &Bounds<2>, count: u64) -> Result<Grid, Error> {
        if let Some(grid) = self.like {
            return Ok(grid);
        }
        let [width, height] = self.size_of_area(points);
        let size = self.size.unwrap_or_else(|| round((width * height / (count as f64).max(1.0)).sqrt()));
        let grid = self.squares(points, size).map_err(Error::Cells)?;
        let (cells, columns, rows) = (grid.cells(), grid.columns(), grid.rows());
        if cells > MAX_CELLS {
            return Err(Error::TooManyCells { size, columns, rows });
        }
        if self.size.is_none() && cells > CELLS_A_POINT * count as f64 {
            return Err(Error::FarPoints { size, cells, points: count });
        }
        Ok(grid)
    }

    /// A remark on cells that were made for points within bounds, if there is one.
    pub fn remark(&self, points: &Bounds<2>, grid: &Grid) -> Option<Remark> {
        let (size, area) = (grid.step()[0], self.size_of_area(points));
        (self.like.is_none() && size > area[0].max(area[1])).then_some(Remark::LargeCell { size, area })
    }

    fn size_of_area(&self, points: &Bounds<2>) -> [f64; 2] {
        let area = self.area(points);
        [0, 1].map(|k| area.high[k] - area.low[k])
    }
}

/// The box around points, by x and y.
///
/// # Errors
/// [`Error::Points`] with the first point whose x or y is not finite; [`Error::NoPoints`].
pub fn bounds<P: AsRef<[f64]>>(points: &[P]) -> Result<Bounds<2>, Error> {
    if points.is_empty() {
        return Err(Error::NoPoints);
    }
    let coordinates = |p: &P| [p.as_ref()[0], p.as_ref()[1]];
    for (index, p) in points.iter().enumerate() {
        let p = coordinates(p);
        if let Some(axis) = p.iter().position(|x| !x.is_finite()) {
            return Err(Error::Points(delone::Error::NotFinite { index, axis, value: p[axis] }));
        }
    }
    Ok(Bounds::of(points.iter().map(coordinates)))
}

/// The least of 1, 2 and 5 times a power of ten that is not smaller.
pub(crate) fn round(size: f64) -> f64 {
    if !(size > 0.0 && size.is_finite()) {
        return 1.0;
    }
    let power = libm::pow(10.0, libm::log10(size).floor());
    [1.0, 2.0, 5.0, 10.0].into_iter().map(|k| k * power).find(|&x| x >= size).unwrap_or(size)
}

/// Rows in bands of so many.
pub(crate) fn even(grid: &Grid, rows: usize) -> Vec<Range<usize>> {
    (0..grid.rows()).step_by(rows).map(|first| first..(first + rows).min(grid.rows())).collect()
}
