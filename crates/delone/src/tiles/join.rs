//! The borders of the parts of a region, triangulated together.
//!
//! Cost: O(b log b) for b points; about 250 bytes a point at the most, in space some 400.

use super::along::Along;
use super::{Border, Border3, BorderOf, Fingerprint, Region};
use crate::error::{BorderProblem, Error};
use crate::plane::InOrder;
use crate::points::check_count;
use crate::space::InOrder3;

/// The result of a join of borders.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Seam {
    /// The triangles that are final now and were not before, counter-clockwise, by the ids that the borders give.
    pub triangles: Vec<[u64; 3]>,
    /// Their fingerprint.
    pub fingerprint: Fingerprint,
    /// The rest that further joins decide. Of the whole plane it is the hull, and nothing is open.
    pub border: Border,
}

/// The result of a join of borders in space.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Seam3 {
    /// The tetrahedra that are final now and were not before, in positive order: the first three corners are seen counter-clockwise
    /// from the fourth. By the ids that the borders give.
    pub tetrahedra: Vec<[u64; 4]>,
    /// Their fingerprint.
    pub fingerprint: Fingerprint,
    /// The rest that further joins decide. Of the whole space it is the hull, and nothing is open.
    pub border: Border3,
}

/// Joins the borders of parts that make a region: of all its tiles, of its halves, or of whatever it is cut into. Each part is there once,
/// whole, also if it has no point. See [`super`] for why it is right.
///
/// # Errors
/// [`Error::Border`] for a border that is none, that has a point outside of the region, or one that another border has;
/// [`Error::TooManyPoints`] beyond [`crate::MAX_POINTS`].
pub fn join(borders: &[Border], region: &Region) -> Result<Seam, Error> {
    let (triangles, fingerprint, border) = joined::<InOrder, 2, 3>(borders, region)?;
    Ok(Seam { triangles, fingerprint, border })
}

/// Joins the borders of parts of space, as [`join`] does it in the plane; [`super::Tile3`] has an example.
///
/// # Errors
/// As [`join`], with [`crate::MAX_POINTS_IN_SPACE`]; [`Error::TooManyTetrahedra`] as for [`crate::Delaunay3`].
pub fn join3(borders: &[Border3], region: &Region<3>) -> Result<Seam3, Error> {
    let (tetrahedra, fingerprint, border) = joined::<InOrder3, 3, 4>(borders, region)?;
    Ok(Seam3 { tetrahedra, fingerprint, border })
}

/// The simplices that are final now, by ids, their fingerprint, and the border.
type Joined<const D: usize, const C: usize> = (Vec<[u64; C]>, Fingerprint, BorderOf<D, C>);

fn joined<A: Along<D, C>, const D: usize, const C: usize>(
    borders: &[BorderOf<D, C>],
    region: &Region<D>,
) -> Result<Joined<D, C>, Error> {
    let (starts, points) = gather::<A, D, C>(borders, region)?;
    // The border that a point is from, and its index there.
    let origin = |point: usize| {
        let border = starts.partition_point(|&start| start <= point) - 1;
        (border, point - starts[border])
    };
    let along = A::of(&points)?;
    drop(points);
    if let Some(duplicate) = along.duplicates().first() {
        let (index, point) = origin(duplicate.point);
        return Err(Error::Border { index, problem: BorderProblem::Twice { point } });
    }
    let mut was_open: Vec<[u32; C]> =
        Vec::with_capacity(borders.iter().map(|border| border.open.len()).sum());
    for (border, &start) in borders.iter().zip(&starts) {
        was_open.extend(border.open.iter().map(|t| sorted(t.map(|v| start as u32 + v))));
    }
    was_open.sort_unstable();

    let indices = along.indices();
    let id = |point: u32| {
        let (border, point) = origin(point as usize);
        borders[border].ids[point]
    };
    let (mut simplices, mut fingerprint) = (Vec::new(), Fingerprint::default());
    let mut open: Vec<A::Id> = Vec::new();
    for t in along.simplices() {
        let corners = along.corners(t).map(|v| indices[v as usize]);
        let of = corners.map(|v| origin(v as usize).0);
        let is_across = of.iter().any(|&border| border != of[0]);
        if !is_across && was_open.binary_search(&sorted(corners)).is_err() {
            continue;
        }
        let at = along.positions(t);
        if A::certifies(region, at) {
            simplices.push(corners.map(id));
            fingerprint.add(at);
        } else {
            open.push(t);
        }
    }
    let border = BorderOf::of(&along, &open, |v| id(indices[v as usize]));
    Ok((simplices, fingerprint, border))
}

/// Where the points of each border begin among those of all, and these.
type Gathered<const D: usize> = (Vec<usize>, Vec<[f64; D]>);

fn gather<A: Along<D, C>, const D: usize, const C: usize>(
    borders: &[BorderOf<D, C>],
    region: &Region<D>,
) -> Result<Gathered<D>, Error> {
    let count = borders.iter().map(|border| border.points.len()).sum();
    check_count(count, A::POINT_LIMIT)?;
    let (mut starts, mut points) = (Vec::with_capacity(borders.len()), Vec::with_capacity(count));
    for (index, border) in borders.iter().enumerate() {
        border.check().map_err(|problem| Error::Border { index, problem })?;
        if let Some(point) = border.points.iter().position(|&p| !region.contains(p)) {
            return Err(Error::Border { index, problem: BorderProblem::Outside { point } });
        }
        starts.push(points.len());
        points.extend(&border.points);
    }
    Ok((starts, points))
}

/// Sorts corners by index: no two simplices of a triangulation have equal corners.
fn sorted<const C: usize>(mut corners: [u32; C]) -> [u32; C] {
    corners.sort_unstable();
    corners
}
