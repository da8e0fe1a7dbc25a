//! Contours: where a surface of triangles has given heights, and the areas between.
//!
//! A vertex exactly at a level counts as above it. Then each triangle has two of its corners on one side of a level or none, so a
//! line enters through one edge and leaves through another: lines never branch, never cross, and end at the border alone. What is
//! above is decided by comparing heights with levels and by nothing else; only the points are rounded, each from the ends of its
//! edge in lexicographic order, so that both triangles of an edge have the same bits, and in the order of their heights along it.
//!
//! The rule moves vertices at a level up by less than anything, so what is drawn may touch itself there; it is taken apart at such
//! points, and what has no area is dropped: a peak, a ridge, a plain at the level without anything below beside it.
//!
//! Triangles along the border that are thinner than what rounding may do to points, 2^-49 of their coordinates, are left out: between their
//! sides lines of several heights would cross. There the border is the other two sides.
//!
//! Cost: O(t + k log k) for t triangles and k points, and 40 bytes a triangle.

mod bands;
mod levels;
mod link;
mod loops;
mod sheet;
#[cfg(test)]
mod tests;
mod trace;

use crate::error::Error;
use crate::ids::VertexId;
use crate::sorting;
use crate::triangulation::Triangulation;

pub use levels::Levels;
use sheet::Sheet;

/// A line at one height.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct ContourLine {
    /// The height.
    pub level: f64,
    /// The points, no two of them equal, with the higher ground on the left. The last of a closed line is joined to the first, which is
    /// its lexicographically least.
    pub points: Vec<[f64; 2]>,
    /// Whether the line is closed; the others go from border to border.
    pub is_closed: bool,
}

/// The area between two heights: the lower one belongs to it, the upper one to the next.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct ContourBand {
    /// The lower height, -infinity below the first level.
    pub lower: f64,
    /// The upper height, infinity above the last level.
    pub upper: f64,
    /// The polygons: a ring around each, counter-clockwise, then its holes, clockwise. The last point of a ring is joined to the
    /// first, which is its lexicographically least.
    pub polygons: Vec<Vec<Vec<[f64; 2]>>>,
}

/// The surface over triangles with a height at each vertex, as contours see it.
///
/// ```
/// use delone::Delaunay2;
/// use delone::surface::{Contours, Levels};
///
/// // A pyramid on a square.
/// let d = Delaunay2::from_points(&[[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0], [2.0, 2.0]])?;
/// let heights = [0.0, 0.0, 0.0, 0.0, 2.0];
/// let surface = Contours::new(&d, &heights)?;
/// let lines = surface.lines(&Levels::given(&[1.0])?)?;
/// assert_eq!(lines[0].points, [[1.0, 1.0], [3.0, 1.0], [3.0, 3.0], [1.0, 3.0]]);
/// let bands = surface.bands(&Levels::given(&[1.0])?)?;
/// assert_eq!((bands.len(), bands[0].polygons[0].len()), (2, 2)); // below, with a hole, and above
/// # Ok::<(), delone::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Contours {
    sheet: Sheet,
    heights: Vec<f64>,
}

impl Contours {
    /// All triangles, with a height for each point of the triangulation by its index.
    ///
    /// # Errors
    /// [`Error::Values`] for another number of heights than of points, [`Error::Height`] for one of a vertex that is NaN or infinite.
    pub fn new<T>(triangulation: &T, heights: &[f64]) -> Result<Self, Error>
    where
        T: Triangulation<Point = [f64; 2], Corners = [VertexId; 3]>,
    {
        Self::of_triangles(triangulation, heights, |_| true)
    }

    /// Some of the triangles: those that the filter keeps. Lines end where others begin.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn of_triangles<T>(
        triangulation: &T,
        heights: &[f64],
        keep: impl Fn(T::Simplex) -> bool,
    ) -> Result<Self, Error>
    where
        T: Triangulation<Point = [f64; 2], Corners = [VertexId; 3]>,
    {
        let expected = triangulation.ids_given();
        if heights.len() != expected {
            return Err(Error::Values { expected, found: heights.len() });
        }
        let wrong = triangulation.vertices().find(|v| !heights[v.index()].is_finite());
        if let Some(v) = wrong {
            return Err(Error::Height { index: v.index(), value: heights[v.index()] });
        }
        Ok(Self { sheet: Sheet::new(triangulation, keep), heights: heights.to_vec() })
    }

    /// The least and the largest height of a corner of a triangle; `None` without triangles.
    pub fn range(&self) -> Option<[f64; 2]> {
        let heights = self.sheet.corners.iter().flatten().map(|&v| self.heights[v as usize]);
        heights.fold(None, |range, z| {
            Some(range.map_or([z; 2], |[low, high]: [f64; 2]| [low.min(z), high.max(z)]))
        })
    }

    /// The lines at the levels, by level, then by their first points.
    ///
    /// # Errors
    /// [`Error::Parameter`] for levels that would give more than 2^31 points.
    pub fn lines(&self, levels: &Levels) -> Result<Vec<ContourLine>, Error> {
        let cut = trace::Cut::new(&self.sheet, &self.heights, levels.values())?;
        let mut lines = Vec::new();
        let mut chains = cut.chains();
        sorting::by(&mut chains, |a, b| a.level.cmp(&b.level));
        for of_level in chains.chunk_by_mut(|a, b| a.level == b.level) {
            let level = levels.values()[of_level[0].level];
            let paths = of_level.iter_mut().map(|chain| link::Path {
                set: 0,
                points: std::mem::take(&mut chain.points),
                is_closed: chain.is_closed,
            });
            let parts = link::mend(paths.collect(), |_, _| ()).into_iter().flat_map(loops::simple);
            lines.extend(parts.map(|(points, is_closed)| ContourLine { level, points, is_closed }));
        }
        sorting::by(&mut lines, |a, b| {
            a.level.total_cmp(&b.level).then_with(|| loops::compare(&a.points, &b.points))
        });
        Ok(lines)
    }

    /// The areas below, between and above the levels, by height; those that are empty are left out. Together they are the triangles,
    /// but for slivers of the border that are thinner than 2^-49 of their coordinates.
    ///
    /// # Errors
    /// As [`Self::lines`].
    pub fn bands(&self, levels: &Levels) -> Result<Vec<ContourBand>, Error> {
        let cut = trace::Cut::new(&self.sheet, &self.heights, levels.values())?;
        Ok(bands::assemble(&cut))
    }
}
