//! The surroundings of a point of space: the tetrahedra whose spheres contain it.

use super::Delaunay3;
use super::layer::arena::View;
use crate::around::{Around, Surround};
use crate::error::Error;
use crate::ids::TetrahedronId;
use crate::locate::conflict::{self, Beyond};
use crate::locate::walk::End;
use crate::mesh::Dimension;
use crate::mesh::tetrahedra::FACETS;
use crate::points::finite;
use crate::triangulation::Found;

/// The other facets, by facet.
const FACETS_BESIDE: [[usize; 3]; 4] = [[1, 2, 3], [0, 2, 3], [0, 1, 3], [0, 1, 2]];

/// Steps, after which a walk from a hint is given up and the point is located anew.
const HINTED_STEPS: usize = 24;

impl Surround for Delaunay3 {
    fn find_near(&self, near: Option<TetrahedronId>, q: [f64; 3]) -> Result<Found<TetrahedronId>, Error> {
        let q = finite(q)?;
        let near = near.filter(|&t| self.mesh().is_cell(t) && self.dimension() == Dimension::Space);
        let filter = self.base.filter_with(q);
        let view = View { filter: &filter, ..self.base.view() };
        let hinted = near.map(|t| view.walk_within(t, q, HINTED_STEPS, &mut ()));
        let t = match hinted {
            Some(End { at, has_arrived: true }) => Some(at),
            _ => self.walk_to(q, &mut ()),
        };
        Ok(match t {
            Some(t) if !self.mesh().is_ghost(t) => self.found(self.base.classify(t, q, &mut ())),
            _ => Found::beyond(&[]),
        })
    }

    fn surround(
        &self,
        near: Option<TetrahedronId>,
        q: [f64; 3],
        around: &mut Around<Self>,
    ) -> Result<Found<TetrahedronId>, Error> {
        let found = self.find_near(near, q)?;
        around.clear();
        if let (Some(seed), 2.., Dimension::Space) = (found.simplex, found.face().len(), self.dimension()) {
            self.dig(seed, q, around);
        }
        Ok(found)
    }
}

impl Delaunay3 {
    fn dig(&self, seed: TetrahedronId, q: [f64; 3], around: &mut Around<Self>) {
        let mesh = self.mesh();
        let filter = self.base.filter_with(q);
        let view = View { filter: &filter, ..self.base.view() };
        around.seen.clear();
        around.seen.add(seed.index());
        around.cavity.push(seed);
        around.pending.extend((0..4).map(|k| (seed, k)));
        let mut border = Vec::new();
        let has_ended = conflict::search(&mut around.pending, |&(inner, k)| {
            let facet = mesh.twin(inner.facet(k));
            let t = facet.tetrahedron();
            if around.seen.contains(t.index()) {
                return Beyond::Outside;
            }
            if !view.conflicts(t, (&q, ())) {
                border.push(facet);
                return Beyond::Outside;
            }
            if mesh.is_ghost(t) {
                return Beyond::End;
            }
            around.seen.add(t.index());
            around.cavity.push(t);
            let [a, b, c] = FACETS_BESIDE[facet.corner()];
            Beyond::Inside((t, c), [(t, a), (t, b)])
        });
        if !has_ended {
            return around.stop_at_hull();
        }
        for facet in border {
            let t = facet.tetrahedron();
            let beyond = if mesh.is_ghost(t) { mesh.twin(facet).tetrahedron() } else { t };
            // Seen from the other side, which is where the point is.
            let [a, b, c] = FACETS[facet.corner()].map(|k| mesh.name(mesh.cells[t.index()].corners[k]));
            around.border.push(([a, c, b], beyond));
        }
    }
}
