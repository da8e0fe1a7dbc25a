//! The triangulation of space as strategies of location see it.

use std::cmp::Ordering;

use delone_predicates::compare_distances3;

use super::kernel::Lift;
use super::{Layer, Refusal};
use crate::ids::{Place, TetrahedronId};
use crate::locate::{Ground, Level, Nearest, Start, nearest};
use crate::mesh::Dimension;
use crate::prefetch::prefetch;
use crate::tally::{Phase, Tally};

impl<W: Lift> Layer<W> {
    /// The tetrahedron where a walk starts.
    #[inline]
    pub(in crate::space) fn start_cell(&self, start: Start<TetrahedronId>) -> TetrahedronId {
        match start {
            Start::At(t, _) | Start::Hint(t, _) => t,
            Start::Vertex(v) => self.mesh.incident[v.index()],
            Start::Anywhere => self.any_cell(),
        }
    }

    /// The vertices joined to one, scaffold not counted, into a buffer. `star` is another.
    pub(in crate::space) fn neighbors(
        &self,
        v: Place,
        star: &mut Vec<TetrahedronId>,
        joined: &mut Vec<Place>,
    ) {
        self.mesh.star(v, star);
        let corners = star.iter().flat_map(|t| self.mesh.cells[t.index()].corners);
        joined.clear();
        joined.extend(corners.filter(|&p| p != v && !p.is_ghost() && !self.is_scaffold(p)));
        joined.sort_unstable();
        joined.dedup();
    }
}

impl<W: Lift> Ground for Layer<W> {
    type Point = [f64; 3];
    type Hint = TetrahedronId;
    const DIMENSIONS: usize = 3;
    const NOWHERE: TetrahedronId = TetrahedronId::NONE;

    fn is_spanned(&self) -> bool {
        self.dimension() == Dimension::Space
    }

    fn vertex_count(&self) -> usize {
        self.mesh.vertex_count
    }

    fn place_count(&self) -> usize {
        self.mesh.incident.len()
    }

    fn inhabited(&self) -> impl Iterator<Item = Place> {
        self.mesh.inhabited().filter(|p| !self.is_scaffold(*p))
    }

    #[inline]
    fn hint(&self, v: Place) -> TetrahedronId {
        self.mesh.incident[v.index()]
    }

    #[inline]
    fn is_alive(&self, hint: TetrahedronId) -> bool {
        self.mesh.is_cell(hint)
    }

    fn any_vertex(&self) -> Option<Place> {
        self.inhabited().next()
    }

    fn neighbor(&self, v: Place) -> Option<Place> {
        let corners = self.mesh.cells.get(self.mesh.incident[v.index()].index())?.corners;
        corners.into_iter().find(|&p| p != v && !p.is_ghost() && !self.is_scaffold(p))
    }

    #[inline]
    fn point(&self, v: Place) -> [f64; 3] {
        self.points[v.index()]
    }

    #[inline]
    fn coordinate(q: [f64; 3], axis: usize) -> f64 {
        q[axis]
    }

    #[inline]
    fn prefetch_around(&self, hint: TetrahedronId) {
        prefetch(&self.mesh.cells, hint.index());
    }

    #[inline]
    fn compare_distances(&self, q: [f64; 3], a: Place, b: Place) -> Ordering {
        compare_distances3(q, self.points[a.index()], self.points[b.index()])
    }

    fn near<T: Tally>(
        &self,
        start: Start<TetrahedronId>,
        q: [f64; 3],
        nearest: Nearest,
        tally: &mut T,
    ) -> (Place, TetrahedronId) {
        let t = self.walk(self.start_cell(start), q, tally);
        tally.phase(Phase::Nearest);
        // Beyond the hull, at the facet of it that is nearest.
        let t =
            if self.is_spanned() && self.mesh.is_ghost(t) { self.nearest_hull_facet(t, q, tally) } else { t };
        let nearer = |a: Place, b: Place| if self.compare_distances(q, b, a).is_lt() { b } else { a };
        let corners = self.mesh.cells[t.index()].corners.into_iter().filter(|p| !p.is_ghost());
        let best = corners.reduce(nearer).expect("a tetrahedron has a finite corner");
        (0..4).for_each(|_| tally.compared());
        (if nearest == Nearest::Corner { best } else { nearest::descend(self, best, q, tally) }, t)
    }
}

impl Level for Layer {
    fn add<T: Tally>(&mut self, q: [f64; 3], start: Start<TetrahedronId>, tally: &mut T) -> Option<Place> {
        let from = self.start_cell(start);
        match self.add_point(from, q, tally) {
            Ok(place) | Err(Refusal::Vertex(place)) => Some(place),
            Err(Refusal::Full) => None,
        }
    }

    fn take<T: Tally>(&mut self, v: Place, tally: &mut T) -> Option<()> {
        self.remove(v, tally)
    }
}
