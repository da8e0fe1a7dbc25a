//! Triangles that are given and stay: edges of theirs that no Delaunay triangulation has are fixed, without being borders.
//!
//! An edge of a constrained Delaunay triangulation stays one when a constraint that does not cross it is added. So only edges
//! that are not there yet are laid, and the result is the constrained Delaunay triangulation with all of them.
//!
//! Cost: O(1) expected for an edge that is there; for others as for segments.

use std::collections::BTreeSet;

use delone_predicates::orient2d;

use super::force::Laid;
use super::segments::SegmentId;
use super::{Constrained2, Domains2};
use crate::error::Error;
use crate::ids::{Place, VertexId};
use crate::sorting;

/// The ends of an edge in order, and the first triangle that has it.
type Side = ([Place; 2], usize);

impl Constrained2 {
    /// Takes segments that only keep triangles out of the table, and gives their ends. Their edges stay fixed.
    pub(in crate::plane) fn take_kept(&mut self, kept: &[SegmentId]) -> Vec<[VertexId; 2]> {
        let known: Vec<(SegmentId, [VertexId; 2])> =
            kept.iter().filter_map(|&s| Some((s, self.segments.ends(s)?))).collect();
        known.iter().for_each(|known| self.segments.remove(known.0));
        self.cover.take();
        known.into_iter().map(|known| known.1).collect()
    }

    /// Fixes the edges of triangles that are no edges yet. Gives those that only keep triangles, by their ends in order: the new ones, and
    /// those that were `known`, which may be `freed` instead.
    pub(in crate::plane) fn keep_triangles(
        &mut self,
        triangles: &[[VertexId; 3]],
        known: Vec<[VertexId; 2]>,
        freed: bool,
    ) -> Result<BTreeSet<[Place; 2]>, Error> {
        if freed {
            let pending = self.free(known);
            self.graph.base.legalize(pending);
            return Ok(BTreeSet::new());
        }
        let sides = self.sides(triangles)?;
        let mesh = self.mesh();
        let places = |[a, b]: [VertexId; 2]| Some(sorted([mesh.place(a)?, mesh.place(b)?]));
        let mut kept: BTreeSet<[Place; 2]> = known.into_iter().filter_map(places).collect();
        if let Some((ends, triangle)) = self.lay_missing(&sides, &mut kept) {
            let [p, q] = ends.map(|v| self.graph.base.points[v.index()]);
            let near = [0, 1].map(|k| 0.5 * p[k] + 0.5 * q[k]);
            return Err(Error::KeptTriangle {
                triangle,
                near,
                flaw: "crosses a segment or another triangle",
            });
        }
        Ok(kept)
    }

    /// Fixes the sides that are no edges. A side through vertices is several edges; those that are constraints are not only kept. Gives the first
    /// that crosses a constraint or another side.
    fn lay_missing(&mut self, sides: &[Side], kept: &mut BTreeSet<[Place; 2]>) -> Option<Side> {
        for &side in sides {
            let layer = &mut self.graph.base;
            let [mut a, mut b] = side.0;
            if layer.mesh.edge_between(a, b).is_some() {
                continue;
            }
            while a != b {
                let Ok(Laid { e, at_second, is_new }) = layer.lay([a, b], &mut self.channel) else {
                    return Some(side);
                };
                if is_new {
                    kept.insert(sorted([layer.mesh.tail(e), layer.mesh.head(e)]));
                }
                *(if at_second { &mut b } else { &mut a }) = layer.mesh.head(e);
            }
        }
        // An edge that was there may have been crossed since.
        let layer = &self.graph.base;
        let is_crossed = |side: &&Side| {
            let [a, b] = side.0;
            layer.mesh.edge_between(a, b).is_none() && !layer.obstacles([a, b]).is_empty()
        };
        sides.iter().find(is_crossed).copied()
    }

    /// The edges of triangles that have an area: each once, by its ends in order, with the first triangle that has it.
    fn sides(&self, triangles: &[[VertexId; 3]]) -> Result<Vec<Side>, Error> {
        let mesh = self.mesh();
        let place = |v: VertexId| mesh.place(v).ok_or(Error::NoSuchVertex { vertex: v });
        let mut sides = Vec::with_capacity(3 * triangles.len());
        for (triangle, &[a, b, c]) in triangles.iter().enumerate() {
            let corners = [place(a)?, place(b)?, place(c)?];
            let [p, q, r] = corners.map(|v| self.graph.base.points[v.index()]);
            if orient2d(p, q, r).is_zero() {
                let near = [0, 1].map(|k| 0.5 * p[k] + 0.5 * q[k]);
                return Err(Error::KeptTriangle { triangle, near, flaw: "has no area" });
            }
            let [a, b, c] = corners;
            sides.extend([[a, b], [b, c], [c, a]].map(|ends| (sorted(ends), triangle)));
        }
        sorting::by_key(&mut sides, |&side| side);
        sides.dedup_by_key(|side| side.0);
        sorting::by_key(&mut sides, |side| side.1);
        Ok(sides)
    }

    /// Makes segments of edges that are still kept, and tells the domains.
    pub(in crate::plane) fn note_kept(
        &mut self,
        domains: &mut Domains2,
        kept: &BTreeSet<[Place; 2]>,
    ) -> Result<(), Error> {
        let mesh = self.mesh();
        let named = kept.iter().map(|ends| ends.map(|p| mesh.name(p)));
        let mut edges: Vec<[VertexId; 2]> = named.map(|[a, b]| [a.min(b), a.max(b)]).collect();
        edges.sort_unstable();
        domains.kept = edges.into_iter().map(|[a, b]| self.insert_segment(a, b)).collect::<Result<_, _>>()?;
        Ok(())
    }
}

/// The ends of an edge, the lesser one first.
pub(in crate::plane) fn sorted([a, b]: [Place; 2]) -> [Place; 2] {
    [a.min(b), a.max(b)]
}
