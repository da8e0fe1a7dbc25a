//! The convex hull in space: what the points span, its flat faces, their corners.
//!
//! Three algorithms make the same hull, and judge each other: quickhull (`quickhull.rs`), which [`Hull3::from_points`] uses,
//! randomized incremental construction located by history (`history.rs`), which grows and answers queries, and the same by
//! flips (`flips.rs`). The first two cap a
//! shell of triangles (`shell.rs`), the third one flips its edges, by exact decisions; `faces.rs` joins coplanar triangles in the end, so that the
//! result is a function of the set.

mod columns;
mod faces;
mod flips;
mod history;
mod prune;
mod quickhull;
mod shell;
mod start;

pub use history::HullHistory3;

use std::ops::Range;

use crate::error::Error;
use crate::mesh::Dimension;
use crate::order::quantize::scaled;
use crate::points::{self, Position3};
use faces::Faces;
use start::{Start, turn};

/// Sizes of sets whose volumes are in the range of numbers, those of small facets too: without heights no point would be the furthest.
const SIZES: Range<f64> = 1e-60..1e60;

/// The convex hull of points in space.
///
/// ```
/// use delone::{Dimension, Hull3};
///
/// let cube: Vec<[f64; 3]> = (0..8).map(|i| [i & 1, i >> 1 & 1, i >> 2].map(f64::from)).collect();
/// let hull = Hull3::from_points(&cube)?;
/// assert_eq!(hull.dimension(), Dimension::Space);
/// assert_eq!(hull.corners().len(), 8);
/// assert_eq!((hull.faces().len(), hull.facets().count()), (6, 12));
/// # Ok::<(), delone::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Hull3 {
    span: Dimension,
    corners: Vec<usize>,
    faces: Faces,
}

impl Hull3 {
    /// Finds the hull. Of equal points the first stands for all. O(n log n) in practice.
    ///
    /// # Errors
    /// [`Error::NotFinite`] names the first NaN or infinite coordinate, [`Error::TooManyPoints`] is for more than
    /// [`crate::MAX_POINTS`].
    pub fn from_points<P: Position3>(points: &[P]) -> Result<Self, Error> {
        let points = &*P::all(points);
        check(points)?;
        let scaled = scaled(points.len(), |i| points[i], &SIZES);
        let points = scaled.as_ref().map_or(points, |(points, _)| points);
        Ok(match prune::candidates(points) {
            None => Self::of(points),
            Some(kept) => {
                let left: Vec<[f64; 3]> = kept.iter().map(|&i| points[i as usize]).collect();
                Self::named(&left, |i| kept[i] as usize)
            }
        })
    }

    /// The hull of points that are finite.
    fn of(points: &[[f64; 3]]) -> Self {
        Self::named(points, |i| i)
    }

    /// The same with names of the points, in their order.
    fn named(points: &[[f64; 3]], name: impl Fn(usize) -> usize) -> Self {
        let named = |corners: Vec<usize>| corners.into_iter().map(&name).collect::<Vec<_>>();
        match Start::of(points) {
            Start::Lower(span, corners) => Self { span, corners: named(corners), faces: Faces::none() },
            Start::Flat(corners) => {
                let corners = named(corners);
                Self { span: Dimension::Plane, faces: Faces::one(corners.clone()), corners }
            }
            Start::Tetrahedron(_) => Self::solid(quickhull::faces(points, name)),
        }
    }

    /// The hull with given faces.
    fn solid(faces: Faces) -> Self {
        let mut corners = faces.corners.clone();
        corners.sort_unstable();
        corners.dedup();
        Self { span: Dimension::Space, corners, faces }
    }

    /// What the points span: a hull of less than space has no facets.
    pub fn dimension(&self) -> Dimension {
        self.span
    }

    /// The extreme points: by increasing index; of a flat set in order around it, of one on a line from end to end.
    pub fn corners(&self) -> &[usize] {
        &self.corners
    }

    /// The flat faces as polygons, counter-clockwise seen from outside, each from its lexicographically smallest
    /// corner; sorted. The one face of a flat set may be seen from either side.
    pub fn faces(&self) -> impl ExactSizeIterator<Item = &[usize]> + '_ {
        self.faces.iter()
    }

    /// The faces cut into triangles, counter-clockwise seen from outside. None for less than space.
    pub fn facets(&self) -> impl Iterator<Item = [usize; 3]> + '_ {
        let solid = self.faces.iter().filter(|_| self.span == Dimension::Space);
        solid.flat_map(|face| face[1..].windows(2).map(|side| [face[0], side[0], side[1]]))
    }

    /// The facets that are seen from far below: the lower hull. `points` are those of the hull.
    pub fn lower<'a>(&'a self, points: &'a [[f64; 3]]) -> impl Iterator<Item = [usize; 3]> + 'a {
        self.facets().filter(|&facet| turn(points, facet, 2).is_lt())
    }

    /// The facets that are seen from far above: the upper hull. `points` are those of the hull.
    pub fn upper<'a>(&'a self, points: &'a [[f64; 3]]) -> impl Iterator<Item = [usize; 3]> + 'a {
        self.facets().filter(|&facet| turn(points, facet, 2).is_gt())
    }
}

/// Whether all points are finite, and not too many.
fn check(points: &[[f64; 3]]) -> Result<(), Error> {
    points::check_count(points.len(), crate::MAX_POINTS)?;
    points::check_finite(points.iter().copied())
}
