//! The convex hull in space: what the points span, its flat faces, their corners.
//!
//! Three algorithms make the same hull, and judge each other: quickhull (`quickhull.rs`), which [`Hull3::from_points`] uses,
//! randomized incremental construction located by history (`history.rs`), which grows and answers queries, and the same by
//! flips (`flips.rs`). The first two cap a
//! shell of triangles (`shell.rs`), the third one flips its edges, by exact decisions; `faces.rs` joins coplanar triangles in the end, so that the
//! result is a function of the set.
//!
//! A reader may ask for a hull without what rounding has made of it: corners within a length of the hull of the others are left out
//! (`merge.rs`), and faces in one plane within it are joined (`join.rs`).

mod columns;
mod faces;
mod fill;
mod flips;
mod history;
mod join;
mod merge;
mod prune;
mod quickhull;
mod rings;
mod shell;
mod sides;
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
    /// Faces that are joined; none in an exact hull.
    joined: Option<Joined>,
}

/// Faces joined to polygons that are flat within a length.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Joined {
    polygons: Faces,
    /// For each face its polygon.
    of: Vec<u32>,
}

impl Hull3 {
    /// Finds the hull. Of equal points the first stands for all. O(n log n) in practice.
    ///
    /// # Errors
    /// [`Error::NotFinite`] names the first NaN or infinite coordinate, [`Error::TooManyPoints`] is for more than
    /// [`crate::MAX_POINTS`].
    ///
    /// ```
    /// use delone::Hull3;
    ///
    /// let cube: Vec<[i32; 3]> = (0..8).map(|k| [k & 1, k >> 1 & 1, k >> 2]).collect();
    /// let hull = Hull3::from_points(&cube)?;
    /// assert_eq!((hull.corners().len(), hull.faces().len(), hull.facets().count()), (8, 6, 12));
    /// # Ok::<(), delone::Error>(())
    /// ```
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

    /// Builds with names of the points, in their order.
    fn named(points: &[[f64; 3]], name: impl Fn(usize) -> usize) -> Self {
        let named = |corners: Vec<usize>| corners.into_iter().map(&name).collect::<Vec<_>>();
        match Start::of(points) {
            Start::Lower(span, corners) => {
                Self { span, corners: named(corners), faces: Faces::none(), joined: None }
            }
            Start::Flat(corners) => {
                let corners = named(corners);
                Self { span: Dimension::Plane, faces: Faces::one(corners.clone()), corners, joined: None }
            }
            Start::Tetrahedron(_) => Self::solid(quickhull::faces(points, name)),
        }
    }

    /// The hull with given faces.
    fn solid(faces: Faces) -> Self {
        let mut corners = faces.corners.clone();
        corners.sort_unstable();
        corners.dedup();
        Self { span: Dimension::Space, corners, faces, joined: None }
    }

    /// The hull without corners and edges that only rounding has made: points of a turned grid are corners no more, and the faces of a
    /// turned part are whole. `points` are those of the hull, and `length` is in coordinate units: [`crate::MERGE_AUTO`] times the
    /// largest coordinate is a length of rounding.
    ///
    /// A corner within the length of the hull of the others is left out, the nearest one first, if all that were left out stay within
    /// the length of what is left. The hull of what is left is exact; of its faces those become one polygon whose corners are all
    /// within the length of the plane of the largest, if they have one ring around. [`Hull3::faces`] has these polygons, which are flat
    /// within the length, and [`Hull3::facets`] triangles of the exact hull.
    ///
    /// O(n log n) for n corners, and a little for each corner around one that is left out; less than the hull where nothing is. Distances are
    /// rounded upwards, so that lengths of a few last places leave nothing out.
    ///
    /// # Errors
    /// [`Error::Parameter`] for a length that is negative, not finite, or not below the thickness of the hull, which would be flat
    /// then.
    ///
    /// ```
    /// use delone::{Hull3, MERGE_AUTO};
    ///
    /// // A grid of 27 points, turned by 30 degrees around two axes.
    /// let (s, c) = (0.5, 0.75_f64.sqrt());
    /// let turned = |[x, y, z]: [f64; 3]| {
    ///     let [x, y] = [c * x - s * y, s * x + c * y];
    ///     [x, c * y - s * z, s * y + c * z]
    /// };
    /// let grid: Vec<[f64; 3]> =
    ///     (0..27).map(|i| turned([i % 3, i / 3 % 3, i / 9].map(f64::from))).collect();
    /// let hull = Hull3::from_points(&grid)?;
    /// assert!(hull.corners().len() > 8);
    /// let hull = hull.merged(&grid, 3.0 * MERGE_AUTO)?;
    /// assert_eq!((hull.corners().len(), hull.faces().len(), hull.facets().count()), (8, 6, 12));
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn merged<P: Position3>(&self, points: &[P], length: f64) -> Result<Self, Error> {
        crate::joining::check(length)?;
        merge::merged(self, &P::all(points), length)
    }

    /// The dimension of the span of the points: a hull of less than space has no facets.
    pub fn dimension(&self) -> Dimension {
        self.span
    }

    /// The extreme points: by increasing index; of a flat set in order around it, of one on a line from end to end.
    pub fn corners(&self) -> &[usize] {
        &self.corners
    }

    /// The flat faces as polygons, counter-clockwise seen from outside, each from its lexicographically smallest
    /// corner; sorted. The one face of a flat set may be seen from either side.
    ///
    /// ```
    /// use delone::Hull3;
    ///
    /// let hull = Hull3::from_points(&[[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0], [1, 1, 1]])?; // a pyramid
    /// let mut corners: Vec<_> = hull.faces().map(<[_]>::len).collect();
    /// corners.sort();
    /// assert_eq!(corners, [3, 3, 3, 3, 4]);
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn faces(&self) -> impl ExactSizeIterator<Item = &[usize]> + '_ {
        self.joined.as_ref().map_or(&self.faces, |joined| &joined.polygons).iter()
    }

    /// The faces cut into triangles, counter-clockwise seen from outside. None for less than space.
    pub fn facets(&self) -> impl Iterator<Item = [usize; 3]> + '_ {
        self.facets_of_faces().map(|(_, facet)| facet)
    }

    /// The facets, each after the index of the face that it is a part of.
    pub fn facets_of_faces(&self) -> impl Iterator<Item = (usize, [usize; 3])> + '_ {
        let solid = self.faces.iter().enumerate().filter(|_| self.span == Dimension::Space);
        solid.flat_map(|(face, corners)| {
            let face = self.joined.as_ref().map_or(face, |joined| joined.of[face] as usize);
            corners[1..].windows(2).map(move |side| (face, [corners[0], side[0], side[1]]))
        })
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
