//! Errors of terrain models.

use std::path::PathBuf;

use delone_io::Crs;

/// The largest number of cells of a raster, 2^34. More are refused.
pub(crate) const MAX_CELLS: f64 = 17_179_869_184.0;

/// Why there is no terrain model.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A point, or its height, is wrong.
    #[error(transparent)]
    Points(delone::Error),
    /// Points and lines cannot be triangulated.
    #[error(transparent)]
    Lines(delone::Error),
    /// The contours cannot be drawn.
    #[error(transparent)]
    Levels(delone::Error),
    /// The place of the cells is wrong.
    #[error(transparent)]
    Cells(delone::Error),
    /// There is nothing to triangulate.
    #[error("there are no points")]
    NoPoints,
    /// Points have x and y alone.
    #[error("the points have no heights")]
    NoHeights,
    /// Points without an area.
    #[error("the points are on one line, which has no surface")]
    OneLine,
    /// A file of lines has none.
    #[error("there is no line in it")]
    NoLine,
    /// A file of polygons has none.
    #[error("there is no polygon in it")]
    NoPolygon,
    /// A raster has more cells than are made.
    #[error("cells of {size} would be {:e}: {columns} columns and {rows} rows; at most {MAX_CELLS:e} are made", *columns as f64 * *rows as f64)]
    TooManyCells {
        /// The side of a cell.
        size: f64,
        /// The columns there would be.
        columns: usize,
        /// The rows there would be.
        rows: usize,
    },
    /// Cells of a size that nobody asked for would be very many for few points.
    #[error("cells of {size} would be {cells:e} for {points} points, of which some are far from the others")]
    FarPoints {
        /// The side of a cell.
        size: f64,
        /// The cells there would be.
        cells: f64,
        /// The number of points.
        points: u64,
    },
    /// The cells of another raster go another way.
    #[error("its rows do not go from north to south, or its columns to the east")]
    NotNorthUp,
    /// Points and what lies beside them have different systems of coordinates.
    #[error("its coordinates are {theirs}, those of the points {ours}")]
    Systems {
        /// The system of the points.
        ours: Box<Crs>,
        /// The other one.
        theirs: Box<Crs>,
    },
    /// Something needs all triangles in memory.
    #[error("{0} needs all triangles in memory")]
    NeedsMemory(&'static str),
    /// Not even a row of the raster fits into memory.
    #[error("a row of {columns} cells does not fit into memory")]
    LargeRow {
        /// The columns of the raster.
        columns: usize,
    },
    /// A folder of tiles cannot be made or read.
    #[error(transparent)]
    Store(#[from] delone_store::Error),
    /// A file cannot be read or written.
    #[error(transparent)]
    File(#[from] delone_io::Error),
    /// An error, and the file that it is about.
    #[error("{}: {error}", path.display())]
    In {
        /// The file.
        path: PathBuf,
        /// The error.
        error: Box<Self>,
    },
    /// Whoever was told of the progress wanted no more.
    #[error("the work was stopped")]
    Stopped,
}

impl Error {
    /// The error with the file that it is about.
    #[must_use]
    pub fn at(self, path: impl Into<PathBuf>) -> Self {
        Self::In { path: path.into(), error: Box::new(self) }
    }
}
