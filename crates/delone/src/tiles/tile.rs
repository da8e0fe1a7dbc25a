//! The points of one region, triangulated by themselves, and what of it is final.
//!
//! Cost: as for [`crate::Delaunay2`], and O(k) for k open triangles: only these, and those at their side, are asked for a
//! certificate. About 120 bytes a point at the most.

use super::{Border, Fingerprint, Region};
use crate::error::Error;
use crate::ids::{Duplicate, MAX_POINTS, TriangleId};
use crate::mesh::Mesh2;
use crate::plane::{InOrder, in_order};
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
    mesh: Mesh2,
    points: Vec<[f64; 2]>,
    order: Vec<u32>,
    duplicates: Vec<Duplicate>,
    /// By increasing index.
    open: Vec<TriangleId>,
}

impl Tile {
    /// Triangulates the points of a region: all that there are.
    ///
    /// # Errors
    /// [`Error::NotFinite`] names the first NaN or infinite coordinate, [`Error::OutsideRegion`] the first point that is not in the
    /// region; [`Error::TooManyPoints`] is returned beyond [`MAX_POINTS`].
    pub fn new(points: &[[f64; 2]], region: &Region) -> Result<Self, Error> {
        check_count(points.len(), MAX_POINTS)?;
        let (bounds, are_finite) = survey(points);
        if !are_finite {
            check_finite(points.iter().copied())?;
        }
        let are_inside = region.contains(bounds.low) && region.contains(bounds.high);
        let mut outside = points.iter().take_while(|_| !are_inside);
        if let Some(index) = outside.position(|&p| !region.contains(p)) {
            return Err(Error::OutsideRegion { index, at: points[index] });
        }
        let InOrder { mesh, points, indices, duplicates, .. } = in_order(points);
        let open = open(&mesh, &points, region);
        Ok(Self { mesh, points, order: indices, duplicates, open })
    }

    /// The vertices: the points that differ, along the curve.
    pub fn points(&self) -> &[[f64; 2]] {
        &self.points
    }

    /// For each vertex the index of its point in the input: of equal ones the first.
    pub fn order(&self) -> &[u32] {
        &self.order
    }

    /// The points that equal an earlier one, by increasing index: both are indices of the input.
    pub fn duplicates(&self) -> &[Duplicate] {
        &self.duplicates
    }

    /// The triangles that nothing outside of the region can change, along the curve: indices of [`Self::points`], counter-clockwise.
    pub fn finals(&self) -> impl Iterator<Item = [u32; 3]> + '_ {
        let mut open = self.open.iter().copied().peekable();
        let is_final = move |t: &TriangleId| open.next_if_eq(t).is_none();
        self.mesh.triangles().filter(is_final).map(|t| self.corners(t))
    }

    /// The other triangles, as [`Self::finals`].
    pub fn open(&self) -> impl Iterator<Item = [u32; 3]> + '_ {
        self.open.iter().map(|&t| self.corners(t))
    }

    /// The fingerprint of the final triangles.
    pub fn fingerprint(&self) -> Fingerprint {
        let mut finals = Fingerprint::default();
        self.finals().for_each(|t| finals.add(t.map(|v| self.points[v as usize])));
        finals
    }

    /// What is to be joined with the borders of other tiles. It names each vertex of it, given its index, as others shall know it.
    pub fn border(&self, name: impl Fn(u32) -> u64) -> Border {
        Border::of(&self.mesh, &self.points, &self.open, |v| name(v as u32))
    }

    fn corners(&self, t: TriangleId) -> [u32; 3] {
        self.mesh.places(t).map(|p| p.index() as u32)
    }
}

/// The triangles that are met from outside without crossing one that the region certifies, by increasing index.
fn open(mesh: &Mesh2, points: &[[f64; 2]], region: &Region) -> Vec<TriangleId> {
    let ghosts = mesh.star_from(mesh.ghost_edge).map(|e| e.triangle());
    let mut open: Vec<TriangleId> = Vec::new();
    let mut is_known = vec![false; mesh.slot_count()];
    let mut meet = |t: TriangleId, open: &mut Vec<TriangleId>| {
        for next in mesh.adjacent(t) {
            if !is_known[next.index()] && !mesh.is_ghost(next) {
                is_known[next.index()] = true;
                if !region.certifies(mesh.places(next).map(|p| points[p.index()])) {
                    open.push(next);
                }
            }
        }
    };
    ghosts.for_each(|ghost| meet(ghost, &mut open));
    let mut done = 0;
    while let Some(&t) = open.get(done) {
        done += 1;
        meet(t, &mut open);
    }
    open.sort_unstable();
    open
}
