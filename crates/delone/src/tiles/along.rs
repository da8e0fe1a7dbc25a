//! Triangulations as tiles and joins see them, in the plane and in space, and the search for open simplices.
//!
//! Cost of the search: O(k) certificates for k open simplices, and a byte a simplex.

use delone_predicates::{stays_within, stays_within3};

use super::Region;
use crate::error::Error;
use crate::ids::{Duplicate, MAX_POINTS, MAX_POINTS_IN_SPACE, Place, TetrahedronId, TriangleId};
use crate::plane::{self, InOrder};
use crate::space::{self, InOrder3};

/// A triangulation with its vertices along a curve, of points with `D` coordinates and simplices with `C` corners.
pub(super) trait Along<const D: usize, const C: usize>: Sized {
    /// The id of a simplex. Ids of near simplices are near.
    type Id: Copy + Ord;
    /// The largest number of points.
    const POINT_LIMIT: usize;

    /// Of finite points, not more than may be.
    fn of(points: &[[f64; D]]) -> Result<Self, Error>;

    /// Whether no point outside of a region can be in the sphere through the corners of a simplex, or on it.
    fn certifies(region: &Region<D>, corners: [[f64; D]; C]) -> bool;

    /// The vertices.
    fn points(&self) -> &[[f64; D]];

    /// The indices that they have among what was given, of equal points the first.
    fn indices(&self) -> &[u32];

    /// The other equal points, by increasing index.
    fn duplicates(&self) -> &[Duplicate];

    /// The finite simplices, by increasing id. None if the points span less.
    fn simplices(&self) -> impl Iterator<Item = Self::Id>;

    /// The ghosts; none where there are no finite simplices.
    fn ghosts(&self) -> impl Iterator<Item = Self::Id>;

    /// Whether a simplex is one.
    fn is_ghost(&self, t: Self::Id) -> bool;

    /// The simplices across the sides of another one.
    fn adjacent(&self, t: Self::Id) -> [Self::Id; C];

    /// The vertices of a finite simplex, in positive order.
    fn corners(&self, t: Self::Id) -> [u32; C];

    /// The number of a simplex, less than that of slots.
    fn slot(t: Self::Id) -> usize;

    /// See [`Self::slot`].
    fn slot_count(&self) -> usize;

    /// The vertices of the hull, perhaps several times; all if the points span less.
    fn hull(&self) -> impl Iterator<Item = u32>;

    /// Where the corners of a finite simplex are.
    fn positions(&self, t: Self::Id) -> [[f64; D]; C] {
        self.corners(t).map(|v| self.points()[v as usize])
    }

    /// The simplices that are met from outside without crossing one that a region certifies, by increasing id.
    fn open(&self, region: &Region<D>) -> Vec<Self::Id> {
        let mut open: Vec<Self::Id> = Vec::new();
        let mut is_known = vec![false; self.slot_count()];
        let mut meet = |t: Self::Id, open: &mut Vec<Self::Id>| {
            for next in self.adjacent(t) {
                if !is_known[Self::slot(next)] && !self.is_ghost(next) {
                    is_known[Self::slot(next)] = true;
                    if !Self::certifies(region, self.positions(next)) {
                        open.push(next);
                    }
                }
            }
        };
        self.ghosts().for_each(|ghost| meet(ghost, &mut open));
        let mut done = 0;
        while let Some(&t) = open.get(done) {
            done += 1;
            meet(t, &mut open);
        }
        open.sort_unstable();
        open
    }
}

impl Along<2, 3> for InOrder {
    type Id = TriangleId;
    const POINT_LIMIT: usize = MAX_POINTS;

    fn of(points: &[[f64; 2]]) -> Result<Self, Error> {
        Ok(plane::in_order(points))
    }

    #[inline]
    fn certifies(region: &Region, corners: [[f64; 2]; 3]) -> bool {
        stays_within(corners, region.low, region.high)
    }

    fn points(&self) -> &[[f64; 2]] {
        &self.points
    }

    fn indices(&self) -> &[u32] {
        &self.indices
    }

    fn duplicates(&self) -> &[Duplicate] {
        &self.duplicates
    }

    fn simplices(&self) -> impl Iterator<Item = TriangleId> {
        self.mesh.triangles()
    }

    fn ghosts(&self) -> impl Iterator<Item = TriangleId> {
        self.mesh.star_from(self.mesh.ghost_edge).map(|e| e.triangle())
    }

    #[inline]
    fn is_ghost(&self, t: TriangleId) -> bool {
        self.mesh.is_ghost(t)
    }

    #[inline]
    fn adjacent(&self, t: TriangleId) -> [TriangleId; 3] {
        self.mesh.adjacent(t)
    }

    #[inline]
    fn corners(&self, t: TriangleId) -> [u32; 3] {
        self.mesh.places(t).map(|p| p.index() as u32)
    }

    #[inline]
    fn slot(t: TriangleId) -> usize {
        t.index()
    }

    fn slot_count(&self) -> usize {
        self.mesh.slot_count()
    }

    fn hull(&self) -> impl Iterator<Item = u32> {
        self.mesh.border().map(|p| p.index() as u32)
    }
}

impl Along<3, 4> for InOrder3 {
    type Id = TetrahedronId;
    const POINT_LIMIT: usize = MAX_POINTS_IN_SPACE;

    fn of(points: &[[f64; 3]]) -> Result<Self, Error> {
        space::in_order(points)
    }

    #[inline]
    fn certifies(region: &Region<3>, corners: [[f64; 3]; 4]) -> bool {
        stays_within3(corners, region.low, region.high)
    }

    fn points(&self) -> &[[f64; 3]] {
        &self.points
    }

    fn indices(&self) -> &[u32] {
        &self.indices
    }

    fn duplicates(&self) -> &[Duplicate] {
        &self.duplicates
    }

    fn simplices(&self) -> impl Iterator<Item = TetrahedronId> {
        self.mesh.cells().filter(|&t| !self.mesh.is_ghost(t))
    }

    fn ghosts(&self) -> impl Iterator<Item = TetrahedronId> {
        self.mesh.cells().filter(|&t| self.mesh.is_ghost(t))
    }

    #[inline]
    fn is_ghost(&self, t: TetrahedronId) -> bool {
        self.mesh.is_ghost(t)
    }

    #[inline]
    fn adjacent(&self, t: TetrahedronId) -> [TetrahedronId; 4] {
        self.mesh.adjacent(t)
    }

    #[inline]
    fn corners(&self, t: TetrahedronId) -> [u32; 4] {
        self.mesh.cells[t.index()].corners.map(|p| p.index() as u32)
    }

    #[inline]
    fn slot(t: TetrahedronId) -> usize {
        t.index()
    }

    fn slot_count(&self) -> usize {
        self.mesh.slot_count()
    }

    fn hull(&self) -> impl Iterator<Item = u32> {
        let of_ghosts = self.ghosts().flat_map(|t| self.mesh.cells[t.index()].corners);
        let all = if self.mesh.cells.is_empty() { self.points.len() } else { 0 };
        of_ghosts.filter(|p| !p.is_ghost()).chain((0..all).map(Place::new)).map(|p| p.index() as u32)
    }
}
