//! The borders of the parts of a region, triangulated together.
//!
//! Cost: O(b log b) for b points; about 250 bytes a point at the most.

use super::{Border, Fingerprint, Region};
use crate::error::{BorderProblem, Error};
use crate::ids::{MAX_POINTS, TriangleId};
use crate::plane::in_order;
use crate::points::check_count;

/// What joining borders gives.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Seam {
    /// The triangles that are final now and were not before, counter-clockwise, by the ids that the borders give.
    pub triangles: Vec<[u64; 3]>,
    /// Their fingerprint.
    pub fingerprint: Fingerprint,
    /// What is still to be decided. Of the plane as a whole it is the hull, and nothing is open.
    pub border: Border,
}

/// Joins the borders of parts that make a region: of all its tiles, of its halves, or of whatever it is cut into. Each part is there once,
/// whole, also if it has no point. See [`super`] for why it is right.
///
/// # Errors
/// [`Error::Border`] for a border that is none, that has a point outside of the region, or one that another border has;
/// [`Error::TooManyPoints`] beyond [`MAX_POINTS`].
pub fn join(borders: &[Border], region: &Region) -> Result<Seam, Error> {
    let (starts, points) = gather(borders, region)?;
    // The border that a point is from, and its index there.
    let origin = |point: usize| {
        let border = starts.partition_point(|&start| start <= point) - 1;
        (border, point - starts[border])
    };
    let ordered = in_order(&points);
    if let Some(duplicate) = ordered.duplicates.first() {
        let (index, point) = origin(duplicate.point);
        return Err(Error::Border { index, problem: BorderProblem::Twice { point } });
    }
    let (mesh, sorted) = (&ordered.mesh, &ordered.points);
    let mut was_open: Vec<[u32; 3]> =
        Vec::with_capacity(borders.iter().map(|border| border.open.len()).sum());
    for (border, &start) in borders.iter().zip(&starts) {
        was_open.extend(border.open.iter().map(|t| turned(t.map(|v| start as u32 + v))));
    }
    was_open.sort_unstable();

    let ids = |point: u32| {
        let (border, point) = origin(point as usize);
        borders[border].ids[point]
    };
    let mut seam = Seam::default();
    let mut open: Vec<TriangleId> = Vec::new();
    for t in mesh.triangles() {
        let places = mesh.places(t);
        let corners = places.map(|p| ordered.indices[p.index()]);
        let [a, b, c] = corners.map(|v| origin(v as usize).0);
        let is_across = a != b || b != c;
        if !is_across && was_open.binary_search(&turned(corners)).is_err() {
            continue;
        }
        let at = places.map(|p| sorted[p.index()]);
        if region.certifies(at) {
            seam.triangles.push(corners.map(ids));
            seam.fingerprint.add(at);
        } else {
            open.push(t);
        }
    }
    seam.border = Border::of(mesh, sorted, &open, |place| ids(ordered.indices[place]));
    Ok(seam)
}

/// The points of all borders, and where those of each begin.
fn gather(borders: &[Border], region: &Region) -> Result<(Vec<usize>, Vec<[f64; 2]>), Error> {
    let count = borders.iter().map(|border| border.points.len()).sum();
    check_count(count, MAX_POINTS)?;
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

/// The same triangle from its least corner on.
fn turned([a, b, c]: [u32; 3]) -> [u32; 3] {
    if a < b && a < c {
        [a, b, c]
    } else if b < c {
        [b, c, a]
    } else {
        [c, a, b]
    }
}
