//! The facet of the hull that is nearest to a point outside.
//!
//! A walk that leaves the hull ends at whichever it meets first of the facets that the point is beyond, which depends on where it began.
//! From there to the nearest one: if the nearest point of a facet is on its border, a facet beside it has a nearer one, or none has.
//!
//! Cost: O(1) for each facet in between; where the nearest point of one is a corner, the facets there.

use std::iter::successors;

use delone_predicates::{angle3, orient3d, side_in_plane};

use super::Layer;
use super::kernel::Lift;
use crate::ids::{Place, TetrahedronId};
use crate::tally::Tally;

/// The face of a triangle that has its nearest point inside.
pub(crate) enum NearestFace {
    Whole,
    /// The side opposite to a corner.
    Side(usize),
    Corner(usize),
}

impl<W: Lift> Layer<W> {
    /// Of the facets of the hull that a point is strictly beyond, given the ghost of one, that with the nearest point to it, as its ghost;
    /// of several that have this point, the one with the smallest vertices.
    pub(in crate::space) fn nearest_hull_facet<T: Tally>(
        &self,
        ghost: TetrahedronId,
        q: [f64; 3],
        tally: &mut T,
    ) -> TetrahedronId {
        let mut at = ghost;
        loop {
            tally.visited();
            let cell = &self.mesh.cells[at.index()];
            let corners = self.facet(at);
            at = match nearest_face(corners, q) {
                NearestFace::Whole => return at,
                NearestFace::Side(k) => {
                    let across = cell.across[k];
                    let next = across.tetrahedron();
                    if !self.is_beyond(next, q) {
                        return at;
                    }
                    let apex = self.facet(next)[across.corner()];
                    if !side_in_plane(corners[(k + 1) % 3], corners[(k + 2) % 3], apex, q).is_positive() {
                        return self.first([at, next].into_iter()).unwrap_or(at);
                    }
                    next
                }
                NearestFace::Corner(k) => {
                    let (v, corner) = (cell.corners[k], corners[k]);
                    let is_nearer = |t: &TetrahedronId| {
                        let mut others = self.facet(*t).into_iter().filter(|&p| p != corner);
                        others.any(|p| angle3(corner, p, q).is_positive()) && self.is_beyond(*t, q)
                    };
                    let Some(next) = self.hull_star(at, v).find(is_nearer) else {
                        let beyond = self.hull_star(at, v).filter(|t| self.is_beyond(*t, q));
                        return self.first(beyond).unwrap_or(at);
                    };
                    next
                }
            };
        }
    }

    /// The corners of the facet of a ghost, counter-clockwise seen from outside.
    fn facet(&self, ghost: TetrahedronId) -> [[f64; 3]; 3] {
        let [a, b, c, _] = self.mesh.cells[ghost.index()].corners;
        [a, b, c].map(|p| self.points[p.index()])
    }

    fn is_beyond(&self, ghost: TetrahedronId, q: [f64; 3]) -> bool {
        let [a, b, c] = self.facet(ghost);
        orient3d(a, b, c, q).is_positive()
    }

    /// The ghosts at a vertex of the hull, in turn, from one of them on.
    fn hull_star(&self, first: TetrahedronId, v: Place) -> impl Iterator<Item = TetrahedronId> {
        let cells = &self.mesh.cells;
        let index = move |t: TetrahedronId| (0..3).find(|&k| cells[t.index()].corners[k] == v).unwrap_or(0);
        let turn = move |&(t, leaving): &(TetrahedronId, usize)| {
            let entered = cells[t.index()].across[leaving];
            let next = entered.tetrahedron();
            // Of its three corners one is the vertex, and one is across from where it was entered.
            (next != first).then(|| (next, 3 - index(next) - entered.corner()))
        };
        successors(Some((first, (index(first) + 1) % 3)), turn).map(|(t, _)| t)
    }

    /// The ghost of the facet with the smallest vertices.
    fn first(&self, ghosts: impl Iterator<Item = TetrahedronId>) -> Option<TetrahedronId> {
        ghosts.min_by_key(|&t| {
            let mut vertices = self.mesh.corners(t);
            vertices.sort_unstable();
            vertices
        })
    }
}

/// The face of a triangle that the nearest point to another one is on. Exact.
pub(crate) fn nearest_face(corners: [[f64; 3]; 3], q: [f64; 3]) -> NearestFace {
    let next = |k: usize| corners[(k + 1) % 3];
    let previous = |k: usize| corners[(k + 2) % 3];
    let towards = |from, to| angle3(from, to, q).is_positive();
    let is_inside = [0, 1, 2].map(|k| side_in_plane(next(k), previous(k), corners[k], q).is_positive());
    if is_inside == [true; 3] {
        return NearestFace::Whole;
    }
    let is_beside =
        |k: &usize| !is_inside[*k] && towards(next(*k), previous(*k)) && towards(previous(*k), next(*k));
    if let Some(k) = (0..3).find(is_beside) {
        return NearestFace::Side(k);
    }
    let is_past = |k: &usize| !towards(corners[*k], next(*k)) && !towards(corners[*k], previous(*k));
    (0..3).find(is_past).map_or(NearestFace::Whole, NearestFace::Corner)
}
