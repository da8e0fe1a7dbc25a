//! The points of one region, triangulated by themselves, and what of it is final.
//!
//! Cost: as for [`crate::Delaunay2`], and O(k) for k open triangles: only these, and those at their side, are asked for a
//! certificate. About 120 bytes a point at the most.

use super::along::Along;
use super::{Border, Fingerprint, Region};
use crate::error::Error;
use crate::ids::{Duplicate, TriangleId};
use crate::plane::InOrder;
use crate::points::{check_count, check_finite, survey};

/// The triangulation of the points of a region, with vertices along a curve: what is near in the plane is near in memory, and in
/// the lists of points and triangles. See [`super`].
///
/// ```
/// use delone::tiles::{Region, Tile};
///
/// let points: Vec<[f64; 2]> = (0..100).map(|i| [f64::from(i % 10), f64::from(i / 10)]).collect();
/// // What is beyond x = 12 is somebody else's.
/// let region = Region { high: [12.0, f64::INFINITY], ..Region::ALL };
/// let tile = Tile::new(&points, &region)?;
/// assert_eq!((tile.finals().count(), tile.open().count()), (162, 0));
/// assert_eq!(tile.border(u64::from).points.len(), 36); // the hull, which may still change
/// # Ok::<(), delone::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Tile {
    along: InOrder,
    /// By increasing index.
    open: Vec<TriangleId>,
}

impl Tile {
    /// Triangulates the points of a region: all that there are.
    ///
    /// # Errors
    /// [`Error::NotFinite`] names the first NaN or infinite coordinate, [`Error::OutsideRegion`] the first point that is not in the
    /// region; [`Error::TooManyPoints`] is returned beyond [`crate::MAX_POINTS`].
    pub fn new(points: &[[f64; 2]], region: &Region) -> Result<Self, Error> {
        let (along, open) = certified::<InOrder, 2, 3>(points, region)?;
        Ok(Self { along, open })
    }

    /// The vertices: the points that differ, along the curve.
    pub fn points(&self) -> &[[f64; 2]] {
        &self.along.points
    }

    /// For each vertex the index of its point in the input: of equal ones the first.
    pub fn order(&self) -> &[u32] {
        &self.along.indices
    }

    /// The points that equal an earlier one, by increasing index: both are indices of the input.
    pub fn duplicates(&self) -> &[Duplicate] {
        &self.along.duplicates
    }

    /// The triangles that nothing outside of the region can change, along the curve: indices of [`Self::points`], counter-clockwise.
    pub fn finals(&self) -> impl Iterator<Item = [u32; 3]> + '_ {
        finals(&self.along, &self.open)
    }

    /// The other triangles, as [`Self::finals`].
    pub fn open(&self) -> impl Iterator<Item = [u32; 3]> + '_ {
        self.open.iter().map(|&t| self.along.corners(t))
    }

    /// The fingerprint of the final triangles.
    pub fn fingerprint(&self) -> Fingerprint {
        fingerprint(self.points(), self.finals())
    }

    /// The border, to be joined with those of other tiles. `name` gives the global name of a vertex by its index.
    pub fn border(&self, name: impl Fn(u32) -> u64) -> Border {
        Border::of(&self.along, &self.open, name)
    }
}

/// Triangulates the points of a region, and finds what is open, by increasing id.
pub(super) fn certified<A: Along<D, C>, const D: usize, const C: usize>(
    points: &[[f64; D]],
    region: &Region<D>,
) -> Result<(A, Vec<A::Id>), Error> {
    check_count(points.len(), A::POINT_LIMIT)?;
    let (bounds, are_finite) = survey(points);
    if !are_finite {
        check_finite(points.iter().copied())?;
    }
    if !(region.contains(bounds.low) && region.contains(bounds.high)) {
        region.check(points)?;
    }
    let along = A::of(points)?;
    let open = along.open(region);
    Ok((along, open))
}

/// The simplices that are not open, by increasing id.
pub(super) fn finals<'a, A: Along<D, C>, const D: usize, const C: usize>(
    along: &'a A,
    open: &'a [A::Id],
) -> impl Iterator<Item = [u32; C]> + use<'a, A, D, C> {
    let mut open = open.iter().copied().peekable();
    let is_final = move |t: &A::Id| open.next_if_eq(t).is_none();
    along.simplices().filter(is_final).map(|t| along.corners(t))
}

pub(super) fn fingerprint<const D: usize, const C: usize>(
    points: &[[f64; D]],
    simplices: impl Iterator<Item = [u32; C]>,
) -> Fingerprint {
    let mut all = Fingerprint::default();
    simplices.for_each(|t| all.add(t.map(|v| points[v as usize])));
    all
}
