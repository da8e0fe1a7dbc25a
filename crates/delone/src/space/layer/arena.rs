//! The port between an insertion and the memory that it works in: a layer, or a part of the memory of a layer that is
//! one task's own.

use delone_predicates::Filter3;

use super::kernel::{Lift, SiteRef};
use crate::ids::{Place, TetrahedronId};
use crate::locate::walk::{self, End};
use crate::mesh::tetrahedra::Tetrahedron;
use crate::mesh::tetrahedra::surgery::Records;
use crate::prefetch::prefetch;
use crate::tally::{Phase, Tally};

/// The data that decisions read.
#[derive(Clone, Copy)]
pub(in crate::space) struct View<'a, W> {
    pub(in crate::space) cells: &'a [Tetrahedron],
    /// For each place its coordinates.
    pub(in crate::space) points: &'a [[f64; 3]],
    /// For each place its weight, if there are weights.
    pub(in crate::space) weights: &'a [W],
    /// For the box around them.
    pub(in crate::space) filter: &'a Filter3,
}

/// The data that an insertion reads and writes.
pub(in crate::space) struct Memory<'a, W> {
    pub(in crate::space) cells: &'a mut [Tetrahedron],
    /// For each tetrahedron a mark, zero between operations.
    pub(in crate::space) marks: &'a mut [u8],
    /// For each place a tetrahedron at its vertex.
    pub(in crate::space) incident: &'a mut [TetrahedronId],
    pub(in crate::space) points: &'a [[f64; 3]],
    pub(in crate::space) weights: &'a [W],
    pub(in crate::space) filter: &'a Filter3,
}

/// Memory for tetrahedra.
pub(in crate::space) trait Arena {
    type Weight: Lift;
    fn view(&self) -> View<'_, Self::Weight>;
    fn memory(&mut self) -> Memory<'_, Self::Weight>;
    /// How many more tetrahedra there is room for.
    fn room(&self) -> usize;
    /// A tetrahedron to be filled in, if there is room.
    fn new_cell(&mut self) -> Option<TetrahedronId>;
    /// Gives one back.
    fn free_cell(&mut self, t: TetrahedronId);
}

impl<W> Memory<'_, W> {
    #[inline]
    pub(in crate::space) fn view(&self) -> View<'_, W> {
        View { cells: self.cells, points: self.points, weights: self.weights, filter: self.filter }
    }

    /// The records that surgery writes.
    #[inline]
    pub(in crate::space) fn records(&mut self) -> Records<'_> {
        Records { cells: self.cells, marks: self.marks, incident: self.incident }
    }
}

impl<W: Lift> View<'_, W> {
    #[inline]
    fn corners(&self, t: TetrahedronId) -> &[Place; 4] {
        &self.cells[t.index()].corners
    }

    #[inline]
    fn at(&self, p: Place) -> &[f64; 3] {
        &self.points[p.index()]
    }

    /// The coordinates of four corners, none of them the ghost.
    #[inline]
    fn all(&self, &[a, b, c, d]: &[Place; 4]) -> [&[f64; 3]; 4] {
        [self.at(a), self.at(b), self.at(c), self.at(d)]
    }

    /// The site at a place.
    #[inline]
    pub(in crate::space) fn site(&self, p: Place) -> SiteRef<'_, W> {
        (self.at(p), W::at(self.weights, p))
    }

    /// Four of them.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "a call costs a twentieth of a construction with weights")]
    fn sites(&self, &[a, b, c, d]: &[Place; 4]) -> [SiteRef<'_, W>; 4] {
        [self.site(a), self.site(b), self.site(c), self.site(d)]
    }

    /// Whether the sphere of a tetrahedron contains `q`. That of a ghost is the half-space beyond its hull facet, with
    /// the inside of the facet's circle.
    #[inline]
    pub(in crate::space) fn conflicts(&self, t: TetrahedronId, q: SiteRef<'_, W>) -> bool {
        let corners = self.corners(t);
        if corners[3].is_ghost() { self.is_beyond_hull(t, q) } else { self.is_in_sphere(corners, q) }
    }

    /// Tests two tetrahedra against `q` at once, as two calls of `conflicts` would.
    #[inline]
    pub(in crate::space) fn both_conflict(
        &self,
        t: TetrahedronId,
        u: TetrahedronId,
        q: SiteRef<'_, W>,
    ) -> [bool; 2] {
        let (first, second) = (self.corners(t), self.corners(u));
        if first[3].is_ghost() || second[3].is_ghost() {
            return [self.conflicts(t, q), self.conflicts(u, q)];
        }
        let [first, second] = W::in_spheres(self.filter, [self.sites(first), self.sites(second)], q);
        [first.is_positive(), second.is_positive()]
    }

    #[inline]
    fn is_in_sphere(&self, corners: &[Place; 4], q: SiteRef<'_, W>) -> bool {
        W::in_sphere(self.filter, self.sites(corners), q).is_positive()
    }

    /// Tests a ghost: whether `q` is beyond its facet of the hull.
    fn is_beyond_hull(&self, t: TetrahedronId, q: SiteRef<'_, W>) -> bool {
        let Tetrahedron { corners: [a, b, c, _], across } = self.cells[t.index()];
        let side = self.filter.orient3d(*self.at(a), *self.at(b), *self.at(c), *q.0);
        if !side.is_zero() {
            return side.is_positive();
        }
        // In the plane of the facet the sphere of the tetrahedron inside cuts out its circle.
        self.is_in_sphere(self.corners(across[3].tetrahedron()), q)
    }

    /// Walks to `q` from a tetrahedron: to a finite one that contains it in its inside or on its border, or else to the
    /// ghost of a hull facet that it is strictly beyond. Visibility walk, which ends in every Delaunay triangulation.
    #[inline]
    pub(in crate::space) fn walk<T: Tally>(
        &self,
        from: TetrahedronId,
        q: [f64; 3],
        tally: &mut T,
    ) -> TetrahedronId {
        self.walk_within(from, q, usize::MAX, tally).at
    }

    /// A walk that is given up after more steps than `most`.
    #[inline]
    pub(in crate::space) fn walk_within<T: Tally>(
        &self,
        from: TetrahedronId,
        q: [f64; 3],
        most: usize,
        tally: &mut T,
    ) -> End<TetrahedronId> {
        tally.phase(Phase::Walk);
        let first = &self.cells[from.index()];
        let from = if first.corners[3].is_ghost() { first.across[3].tetrahedron() } else { from };
        walk::walk(from, most, |t| {
            tally.visited();
            let cell = &self.cells[t.index()];
            if cell.corners[3].is_ghost() {
                return None;
            }
            (0..4).for_each(|_| tally.orientation());
            if W::HIDES {
                // Walks are long where many sites tie, and without weights they are not.
                cell.across.iter().for_each(|f| prefetch(self.cells, f.tetrahedron().index()));
            }
            let k = self.filter.facet_towards(self.all(&cell.corners), &q)?;
            Some(cell.across[k].tetrahedron())
        })
    }

    /// The corner of a tetrahedron that a point equals.
    #[inline]
    pub(in crate::space) fn vertex_at(&self, t: TetrahedronId, q: [f64; 3]) -> Option<Place> {
        self.corners(t).iter().copied().find(|&p| !p.is_ghost() && *self.at(p) == q)
    }
}
