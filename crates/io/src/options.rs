//! How files are read.

use crate::LasFilter;

/// How to read points.
///
/// ```
/// use delone_io::{LasFilter, ReadOptions};
///
/// let ground = ReadOptions::default().dimension(3).las(LasFilter::default().classes([2]));
/// assert_eq!(ground.las.classes, [2]);
/// let table = ReadOptions::default().columns(["easting", "northing"]).attributes(true);
/// assert_eq!((table.columns.len(), table.dimension), (2, 0));
/// ```
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct ReadOptions {
    /// Which points of LAS files are taken.
    pub las: LasFilter,
    /// Columns of text that are x, y and perhaps z: names of the header, or numbers from 1. Of LAS files `x`, `y` and perhaps the dimension
    /// that is the height, as in `x`, `y`, `intensity`.
    pub columns: Vec<String>,
    /// Dimensions of LAS files that are attributes: those of records (`intensity`, `gps_time`, ...), and those of extra bytes.
    pub dimensions: Vec<String>,
    /// Coordinates of a point where the format does not tell (raw numbers): 2 or 3.
    pub dimension: usize,
    /// Attributes of features are read, not their names alone.
    pub attributes: bool,
    /// Closed lines of drawings are polygons.
    pub closed: bool,
    /// Rows of text without coordinates are left out, and a remark says which: a coordinate is empty, or a word such as NA, NaN or null.
    pub skip_missing: bool,
}

impl ReadOptions {
    /// Sets which points of LAS files are taken.
    #[must_use]
    pub fn las(mut self, las: LasFilter) -> Self {
        self.las = las;
        self
    }

    /// Sets the columns that are x, y and perhaps z.
    #[must_use]
    pub fn columns<S: Into<String>>(mut self, columns: impl IntoIterator<Item = S>) -> Self {
        self.columns = columns.into_iter().map(Into::into).collect();
        self
    }

    /// Sets the dimensions of LAS files that are attributes.
    #[must_use]
    pub fn dimensions<S: Into<String>>(mut self, dimensions: impl IntoIterator<Item = S>) -> Self {
        self.dimensions = dimensions.into_iter().map(Into::into).collect();
        self
    }

    /// Sets how many coordinates a point has where the format does not tell: 2 or 3.
    #[must_use]
    pub fn dimension(mut self, dimension: usize) -> Self {
        self.dimension = dimension;
        self
    }

    /// Sets whether attributes of features are read.
    #[must_use]
    pub fn attributes(mut self, attributes: bool) -> Self {
        self.attributes = attributes;
        self
    }

    /// Sets whether rows of text without coordinates are left out.
    #[must_use]
    pub fn skip_missing(mut self, skip_missing: bool) -> Self {
        self.skip_missing = skip_missing;
        self
    }

    /// Sets whether closed lines of drawings are polygons.
    #[must_use]
    pub fn closed(mut self, closed: bool) -> Self {
        self.closed = closed;
        self
    }
}
