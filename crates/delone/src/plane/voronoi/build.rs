//! Cells as they are made: rings of corners, each rounded and looked at as it comes.
//!
//! Rounding may turn a ring over, or make it touch itself. Every ring is asked whether it still is the border of something
//! (`region/rings.rs`); if one is not, corners are joined at the end until all are (`contract.rs`).
//!
//! Cost: O(k) for a ring of k corners, O(r k) for one that is not convex and has r rounded corners.

use delone_predicates::{Line, Spot};

use super::cells::Cells2;
use super::clip::cut_by;
use super::contract;
use crate::plane::region::tree::Relation;
use crate::plane::region::{Region2, clip, enlarged, rings};
use crate::points::Bounds;

/// See the module.
#[derive(Debug)]
pub(in crate::plane) struct Builder<'a> {
    region: &'a Region2,
    cells: Cells2,
    /// How many vertices there were at the beginning: centers of triangles or circles.
    centers: usize,
    /// Corners on the border of the region.
    border: Vec<[f64; 2]>,
    /// Rings that are no borders.
    bad: Vec<u32>,
    /// Of the corners of a ring that was cut out, which are exact.
    exact: Vec<bool>,
}

/// The relation of a ring to the region.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    /// It is a border of it, or has some of its corners: nothing was rounded.
    Exact,
    /// It has a corner of it.
    AtRegion,
    Rounded,
}

impl<'a> Builder<'a> {
    /// No cell yet, with the corners that there are, room for some cells, and as many ids.
    pub(in crate::plane) fn new(
        region: &'a Region2,
        ids: usize,
        room: usize,
        vertices: Vec<[f64; 2]>,
    ) -> Self {
        let mut starts = Vec::with_capacity(room + 1);
        starts.push(0);
        let centers = vertices.len();
        let cells =
            Cells2 { sites: vec![[0, 0]; ids], starts, corners: Vec::with_capacity(6 * room), vertices };
        Self { region, cells, centers, border: Vec::new(), bad: Vec::new(), exact: Vec::new() }
    }

    /// The cells so far.
    #[inline]
    pub(super) fn cells(&self) -> &Cells2 {
        &self.cells
    }

    /// Whether all rings so far are borders.
    pub(super) fn is_good(&self) -> bool {
        self.bad.is_empty()
    }

    /// Forgets all cells, but not that one was bad.
    #[inline]
    pub(super) fn forget(&mut self) {
        self.cells.starts.truncate(1);
        self.cells.corners.clear();
        self.cells.vertices.truncate(self.centers);
        self.border.clear();
        self.bad.truncate(1);
    }

    /// The corners that there were at the beginning.
    pub(super) fn into_centers(self) -> Vec<[f64; 2]> {
        let mut vertices = self.cells.vertices;
        vertices.truncate(self.centers);
        vertices
    }

    /// The cells, all of whose rings are borders.
    pub(in crate::plane) fn finish(mut self) -> Cells2 {
        if !self.bad.is_empty() {
            contract::mend(&mut self.cells, &self.bad, &self.border, self.region);
        }
        self.cells
    }

    /// Adds a cell: as it is by the indices of its corners, or cut out of the region by its borders.
    pub(in crate::plane) fn add<L: Iterator<Item = Line> + Clone>(
        &mut self,
        id: usize,
        corners: impl Iterator<Item = usize>,
        borders: impl FnOnce() -> L,
    ) {
        let first = self.cells.starts.len() - 1;
        self.push_cut(corners, borders);
        self.assign(id, first);
    }

    /// Says whose the rings are from one on.
    #[inline]
    pub(super) fn assign(&mut self, id: usize, first: usize) {
        self.cells.sites[id] = [first, self.cells.starts.len() - 1 - first].map(|n| n as u32);
    }

    /// The rings of a cell, whole or cut.
    pub(super) fn push_cut<L: Iterator<Item = Line> + Clone>(
        &mut self,
        corners: impl Iterator<Item = usize>,
        borders: impl FnOnce() -> L,
    ) {
        if !self.push_whole(corners) {
            self.push_rings(&cut_by(self.region, borders()));
        }
    }

    /// Rings of exact corners, without those of which nothing is left.
    pub(super) fn push_rings(&mut self, rings: &[clip::Ring]) {
        let first = self.cells.starts.len() - 1;
        for ring in rings {
            let start = self.cells.corners.len();
            self.exact.clear();
            let mut last = [f64::NAN; 2];
            let mut is_side = ring.last().is_some_and(|corner| corner.side.is_some());
            for corner in ring {
                let was_side = std::mem::replace(&mut is_side, corner.side.is_some());
                let Some(at) = corner.spot.rounded() else { continue };
                if was_side || is_side {
                    self.border.push(at);
                }
                if at != last {
                    self.cells.corners.push(self.cells.vertices.len() as u32);
                    self.cells.vertices.push(at);
                    self.exact.push(matches!(corner.spot, Spot::Point(_)));
                }
                last = at;
            }
            let is_point = |corner: &clip::Corner| matches!(corner.spot, Spot::Point(_));
            let kind = match () {
                () if ring.iter().all(is_point) => Kind::Exact,
                () if ring.iter().any(is_point) => Kind::AtRegion,
                () => Kind::Rounded,
            };
            self.close(start, last, kind);
        }
        let count = self.cells.starts.len() - 1 - first;
        if count > 1 && self.bad.last().is_none_or(|&last| (last as usize) < first) {
            self.look_at_all(first);
        }
    }

    /// Whether rings that each are good are those of a cell together. All are bad if not.
    #[cold]
    fn look_at_all(&mut self, first: usize) {
        let cells = &self.cells;
        let ring = |ends: &[u32]| {
            cells.corners[ends[0] as usize..ends[1] as usize].iter().map(|&i| cells.vertices[i as usize])
        };
        let rings: Vec<Vec<[f64; 2]>> =
            cells.starts[first..].windows(2).map(|ends| ring(ends).collect()).collect();
        if !(self.region.are_border())(&rings) {
            self.bad.extend(first as u32..self.cells.starts.len() as u32 - 1);
        }
    }

    /// The ring of a cell all of whose corners are known to be inside of a region without dents. Says whether it is one: else nothing
    /// is added.
    #[inline]
    pub(super) fn push_inside(&mut self, corners: impl Iterator<Item = usize>, inside: &[bool]) -> bool {
        let start = self.cells.corners.len();
        let mut last = [f64::NAN; 2];
        for i in corners {
            if !inside.get(i).is_some_and(|&inside| inside) {
                self.cells.corners.truncate(start);
                return false;
            }
            let corner = self.cells.vertices[i];
            if corner != last {
                self.cells.corners.push(i as u32);
            }
            last = corner;
        }
        // The cell of a lone site has no corners, and is the plane.
        if self.cells.corners.len() == start {
            return false;
        }
        self.exact.clear();
        self.close(start, last, Kind::Rounded);
        true
    }

    /// The ring of a cell that is surely inside of the region. Says whether that is all: nothing is added of a cell surely outside.
    #[inline]
    fn push_whole(&mut self, corners: impl Iterator<Item = usize>) -> bool {
        let start = self.cells.corners.len();
        let mut bounds = Bounds::default();
        let mut last = [f64::NAN; 2];
        for i in corners {
            let corner = self.cells.vertices[i];
            bounds.include(corner);
            if corner != last {
                self.cells.corners.push(i as u32);
            }
            last = corner;
        }
        let relation = enlarged(bounds.low, bounds.high).map(|[low, high]| self.region.relation(low, high));
        if relation.is_none_or(|relation| relation != Relation::Inside) {
            self.cells.corners.truncate(start);
            return relation == Some(Relation::Outside);
        }
        self.exact.clear();
        self.close(start, last, Kind::Rounded);
        true
    }

    /// Ends a ring, the last corner of which is given. Of a cell of two places nothing is left, unless a corner of the region is to be kept.
    #[inline]
    fn close(&mut self, start: usize, last: [f64; 2], kind: Kind) {
        let Cells2 { starts, corners, vertices, .. } = &mut self.cells;
        if corners.len() > start + 1 && vertices[corners[start] as usize] == last {
            corners.pop();
        }
        if corners.len() <= start + 2 {
            if kind == Kind::AtRegion && corners.len() == start + 2 {
                self.bad.push(starts.len() as u32 - 1);
                starts.push(corners.len() as u32);
            } else {
                corners.truncate(start);
            }
            return;
        }
        let ring = corners[start..].iter().map(|&i| vertices[i as usize]);
        let is_exact = |i: usize| self.exact.get(i).is_some_and(|exact| *exact);
        let is_good = match kind {
            Kind::Exact => !rings::visits_twice(&ring.collect::<Vec<_>>()),
            _ => rings::is_border(ring, is_exact),
        };
        if !is_good {
            self.bad.push(starts.len() as u32 - 1);
        }
        starts.push(corners.len() as u32);
    }
}
