//! The triangulation of a run of places, in memory that is one task's own; and which of its tetrahedra are sure to be those
//! of all points.
//!
//! A tetrahedron whose sphere holds no point of the other runs is one of the triangulation of all points. The others are
//! the *border*. A point elsewhere is in conflict with tetrahedra that hang together and include a ghost that it is
//! beyond, so the border is found from the ghosts, and nearly all tetrahedra are never looked at.
//!
//! With weights a sphere is clear of the others only if it is of the heaviest of them, wherever that is. What a site of
//! the part hides stays hidden, because more sites only lower the hull of the lifted ones.

use std::ops::Range;

use delone_predicates::{Filter3, Sign, orient3d};

use super::super::layer::arena::{Arena, Memory, View};
use super::super::layer::cavity::Cavity;
use super::super::layer::filter_of;
use super::super::layer::kernel::{Lift, Region};
use super::super::layer::scaffold::{first_cells, spanning};
use super::{Rest, insert_all};
use crate::ids::{FacetId, Place, TetrahedronId};
use crate::mesh::tetrahedra::{FACETS, Tetrahedron};
use crate::order;
use crate::tally::Tally;

/// Marks while the border is found: bits.
const BORDER: u8 = 1;
const SURE: u8 = 2;

/// See the module. Its ids are its own until [`Self::settle`].
pub(super) struct Part<'a, W> {
    points: &'a [[f64; 3]],
    weights: &'a [W],
    filter: Filter3,
    cells: &'a mut [Tetrahedron],
    marks: &'a mut [u8],
    incident: &'a mut [TetrahedronId],
    /// Slots that were used at some time.
    used: usize,
    free: Vec<TetrahedronId>,
    /// Sites that are no vertices.
    rest: Rest,
}

/// The summary of a part, with the ids of the whole.
pub(super) struct Done {
    /// The slots that were never used, and those that are free again.
    pub(super) unused: Range<usize>,
    pub(super) free: Vec<TetrahedronId>,
    /// Sites that are no vertices.
    pub(super) rest: Rest,
    /// The border, and its vertices.
    pub(super) border: Vec<TetrahedronId>,
    pub(super) vertices: Vec<Place>,
    /// The facets between the border and the rest: their corners, as seen from the border, and their other sides.
    pub(super) seam: Vec<([Place; 3], FacetId)>,
}

impl<W: Lift> Arena for Part<'_, W> {
    type Weight = W;

    #[inline]
    fn view(&self) -> View<'_, W> {
        View { cells: self.cells, points: self.points, weights: self.weights, filter: &self.filter }
    }

    #[inline]
    fn memory(&mut self) -> Memory<'_, W> {
        let Self { cells, marks, incident, points, weights, filter, .. } = self;
        Memory { cells, marks, incident, points, weights, filter }
    }

    fn room(&self) -> usize {
        self.free.len() + self.cells.len() - self.used
    }

    #[inline]
    fn new_cell(&mut self) -> Option<TetrahedronId> {
        self.free.pop().or_else(|| {
            let fresh = self.used;
            (fresh < self.cells.len()).then(|| {
                self.used += 1;
                TetrahedronId::new(fresh)
            })
        })
    }

    #[inline]
    fn free_cell(&mut self, t: TetrahedronId) {
        self.memory().records().clear(t);
        self.free.push(t);
    }
}

impl<'a, W: Lift> Part<'a, W> {
    /// Sites and memory for their tetrahedra, all of it free.
    pub(super) fn new(
        (points, weights): (&'a [[f64; 3]], &'a [W]),
        cells: &'a mut [Tetrahedron],
        marks: &'a mut [u8],
        incident: &'a mut [TetrahedronId],
    ) -> Self {
        let (filter, rest) = (Filter3::default(), Rest::default());
        Self { points, weights, filter, cells, marks, incident, used: 0, free: Vec::new(), rest }
    }

    /// Triangulates the sites. `None` if they span less than space, or have more tetrahedra than there is room for.
    pub(super) fn build<T: Tally>(&mut self, seed: u64, tally: &mut T) -> Option<()> {
        self.filter = filter_of(self.points, self.weights);
        let order = order::space::rounds(self.points.len(), seed);
        let first = spanning(self.points, &order);
        let &[a, b, c, d] = &first[..] else { return None };
        first_cells(self, [a, b, c, d])?;
        let mut rest = Rest::default();
        let start = self.incident[a.index()];
        let others = order.iter().map(|&i| Place::new(i as usize)).filter(|v| !first.contains(v));
        insert_all(self, &mut Cavity::default(), start, others, &mut rest, tally)?;
        self.rest = rest;
        Some(())
    }

    /// Finds and marks the tetrahedra whose spheres may hold sites of some regions. All sites of others must be in them.
    pub(super) fn find_border(&mut self, others: &[Region<W>]) -> Vec<TetrahedronId> {
        let is_ghost = |cell: &Tetrahedron| cell.corners[3].is_ghost() && !cell.corners[0].is_ghost();
        let first = self.cells[..self.used].iter().position(is_ghost);
        let mut ghosts: Vec<TetrahedronId> = first.map(TetrahedronId::new).into_iter().collect();
        // All ghosts: those that nothing is beyond are in the way to others.
        let mut done = 0;
        ghosts.iter().for_each(|t| self.marks[t.index()] = SURE);
        while let Some(&t) = ghosts.get(done) {
            done += 1;
            for f in self.cells[t.index()].across.into_iter().take(3) {
                let next = f.tetrahedron();
                if self.marks[next.index()] == 0 {
                    self.marks[next.index()] = SURE;
                    ghosts.push(next);
                }
            }
        }
        let mut border: Vec<TetrahedronId> = ghosts
            .iter()
            .copied()
            .filter(|&t| others.iter().any(|other| self.may_be_beyond(t, other)))
            .collect();
        border.iter().for_each(|t| self.marks[t.index()] = BORDER);
        let mut tested = ghosts;
        let mut done = 0;
        while let Some(&t) = border.get(done) {
            done += 1;
            for f in self.cells[t.index()].across {
                let next = f.tetrahedron();
                if self.marks[next.index()] == 0 {
                    tested.push(next);
                    if others.iter().any(|other| self.may_hold(next, other)) {
                        self.marks[next.index()] = BORDER;
                        border.push(next);
                    } else {
                        self.marks[next.index()] = SURE;
                    }
                }
            }
        }
        tested.iter().for_each(|t| self.marks[t.index()] &= BORDER);
        border
    }

    /// Whether the sphere of a finite tetrahedron may hold sites of a region.
    fn may_hold(&self, t: TetrahedronId, other: &Region<W>) -> bool {
        let view = self.view();
        !W::keeps_clear(self.cells[t.index()].corners.map(|p| view.site(p)), other)
    }

    /// Tests a ghost: some of the box may be beyond its facet, or in the plane of the facet and in its circle, which
    /// the sphere of the tetrahedron inside cuts out.
    fn may_be_beyond(&self, ghost: TetrahedronId, other: &Region<W>) -> bool {
        let Tetrahedron { corners: [a, b, c, _], across } = self.cells[ghost.index()];
        let [a, b, c] = [a, b, c].map(|p| self.points[p.index()]);
        let bounds = &other.bounds;
        let corner =
            |m: usize| [0, 1, 2].map(|k| if m >> k & 1 == 0 { bounds.low[k] } else { bounds.high[k] });
        let most = (0..8).map(|m| orient3d(a, b, c, corner(m))).max();
        match most {
            Some(Sign::Negative) | None => false,
            Some(Sign::Zero) => self.may_hold(across[3].tetrahedron(), other),
            Some(Sign::Positive) => true,
        }
    }

    /// How many sites others hide.
    pub(super) fn hidden(&self) -> usize {
        self.rest.hidden.len()
    }

    /// The vertices of the border, by place.
    pub(super) fn vertices_of(&self, border: &[TetrahedronId]) -> Vec<Place> {
        let mut is_at = vec![false; self.points.len()];
        let corners = border.iter().flat_map(|t| self.cells[t.index()].corners);
        corners.filter(|p| !p.is_ghost()).for_each(|p| is_at[p.index()] = true);
        (0..is_at.len()).filter(|&p| is_at[p]).map(Place::new).collect()
    }

    /// Says where its border is, and takes the ids of the whole, where its first place and its first slot for
    /// tetrahedra have these numbers.
    pub(super) fn settle(mut self, others: &[Region<W>], place: usize, slot: usize) -> Done {
        let places = |p: Place| if p.is_ghost() { p } else { Place::new(p.index() + place) };
        let slots = |t: TetrahedronId| TetrahedronId::new(t.index() + slot);
        let facets = |f: FacetId| slots(f.tetrahedron()).facet(f.corner());
        let border = self.find_border(others);
        let vertices = self.vertices_of(&border).into_iter().map(places).collect();
        let mut seam = Vec::new();
        for &t in &border {
            let cell = self.cells[t.index()];
            for (f, corners) in cell.across.into_iter().zip(FACETS) {
                if self.marks[f.tetrahedron().index()] == 0 {
                    seam.push((corners.map(|k| places(cell.corners[k])), facets(f)));
                }
            }
        }
        border.iter().for_each(|t| self.marks[t.index()] = 0);
        if slot > 0 {
            self.memory().records().renumber(places, slots);
        }
        Done {
            unused: slot + self.used..slot + self.cells.len(),
            free: self.free.into_iter().map(slots).collect(),
            rest: Rest {
                equal: self.rest.equal.into_iter().map(|(v, w)| (places(v), places(w))).collect(),
                hidden: self.rest.hidden.into_iter().map(places).collect(),
            },
            border: border.into_iter().map(slots).collect(),
            vertices,
            seam,
        }
    }
}
