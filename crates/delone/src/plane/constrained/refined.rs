//! A constrained triangulation before and after refinement: triangles are put into domains, then new vertices get names,
//! and split segments get chains.
//!
//! While it is refined all is known by places. Segments need not be known then: new vertices on a constraint have two constraint
//! edges each, so these lead to the ends of the input edge that was split.

use std::collections::BTreeMap;

use delone_predicates::orient2d;

use super::domains::NONE;
use super::segments::{Ends, SegmentId};
use super::{Constrained2, Domains2};
use crate::error::Error;
use crate::ids::{MAX_POINTS, Place, TriangleId, VertexId};
use crate::plane::layer::Layer;
use crate::sorting;

/// The origin of a vertex, which the next refinement asks for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::plane) struct Origin {
    /// The ends of the constraint that it was put on; twice itself for a vertex that was there before, the ghost for a free one.
    pub(in crate::plane) on: [VertexId; 2],
    /// How near others may come, see `refine/mesher`.
    pub(in crate::plane) scale: f64,
}

/// The state of a triangulation while it is refined.
#[derive(Debug)]
pub(in crate::plane) struct Before {
    /// The vertices along the segments that are no single edge.
    chains: BTreeMap<SegmentId, Vec<VertexId>>,
    /// For each domain, from 1 on, its part: first those that are refined, then boundary layers, then those outside.
    pub(in crate::plane) parts: Vec<usize>,
    /// How many of them are refined, and how many are inside.
    pub(in crate::plane) inside: usize,
    pub(in crate::plane) with_layers: usize,
    /// How many points there are.
    pub(in crate::plane) given: usize,
    /// How many vertices may be added.
    pub(in crate::plane) room: usize,
}

/// The new vertices on an edge of the input: its ends, by increasing id, the vertices in between, and whether all are exactly on it.
type Along = (Ends, Vec<VertexId>, bool);

impl Constrained2 {
    /// Makes hull edges segments where the hull is the border of what is inside.
    pub(in crate::plane) fn close(&mut self, domains: &Domains2) -> Result<(), Error> {
        let mesh = self.mesh();
        let hull = self.hull_edges().filter(|&e| !mesh.is_fixed(e) && domains.is_inside(e.triangle()));
        let open: Vec<Ends> = hull.map(|e| [mesh.origin(e), mesh.destination(e)]).collect();
        open.into_iter().try_for_each(|[a, b]| self.insert_segment(a, b).map(|_| ()))
    }

    /// Puts all triangles into domains, whose tags say it from then on, and what is near in the plane near in memory, with room between.
    pub(in crate::plane) fn begin_refinement(&mut self, domains: &mut Domains2) -> Before {
        let is_single = |ends: Ends| {
            let [a, b] = ends.map(|v| self.mesh().place(v));
            a.zip(b).is_some_and(|(a, b)| self.mesh().edge_between(a, b).is_some())
        };
        let longer = |&(s, ends): &(SegmentId, Ends)| self.segments.is_bent(s) || !is_single(ends);
        let with_chain = |(s, _)| Some((s, self.chain(s)?));
        let candidates = self.segments().filter(|_| self.has_chains);
        let chains = candidates.filter(longer).filter_map(with_chain).collect();
        let mut parts: Vec<usize> = (0..domains.parts().len()).collect();
        let kind = |&part: &usize| {
            let part = &domains.parts()[part];
            if part.is_inside { usize::from(part.is_layer) } else { 2 }
        };
        sorting::by_key(&mut parts, kind);
        let [inside, with_layers] = [1, 2].map(|bound| parts.partition_point(|part| kind(part) < bound));
        let mut number = vec![0; parts.len()];
        parts.iter().enumerate().for_each(|(k, &part)| number[part] = k + 1);
        let triangles: Vec<TriangleId> = self.triangle_ids().collect();
        for t in triangles {
            let domain = domains.part(t).map_or(0, |part| number[part]);
            self.graph.base.mesh.set_domain(t, domain);
        }
        domains.of = Vec::new();
        self.cover.take();
        self.graph.begin_bulk();
        let given = self.points().len();
        Before { chains, inside, with_layers, parts, given, room: MAX_POINTS - given }
    }

    /// The triangulation itself.
    pub(in crate::plane) fn layer(&mut self) -> &mut Layer {
        &mut self.graph.base
    }

    /// Gives new vertices their names, in their order, and segments their chains. Gives how many are free, and on constraints.
    pub(in crate::plane) fn end_refinement(
        &mut self,
        before: &Before,
        new: &[Place],
    ) -> Result<[usize; 2], Error> {
        self.graph.end_bulk(new)?;
        let along = self.chains_along(before, new);
        let on: usize = along.iter().map(|along| along.1.len()).sum();
        self.has_chains |= !along.is_empty();
        self.bend(before, &along);
        Ok([new.len() - on, on])
    }

    /// The chains of new vertices on edges of the input, by the ends of these.
    fn chains_along(&self, before: &Before, new: &[Place]) -> Vec<Along> {
        let mut is_met = vec![false; self.graph.base.points.len()];
        let mut along = Vec::new();
        for &p in new {
            if !is_met[p.index()] && self.mesh().spokes(p).any(|e| self.mesh().is_fixed(e)) {
                let found = self.chain_through(p, before.given);
                let places = found.1.iter().filter_map(|&v| self.mesh().place(v));
                places.for_each(|p| is_met[p.index()] = true);
                along.push(found);
            }
        }
        sorting::by_key(&mut along, |along| along.0);
        along
    }

    /// The chain of new vertices that one of them is in.
    fn chain_through(&self, some: Place, given: usize) -> Along {
        let mesh = self.mesh();
        let fixed = |at: Place| mesh.spokes(at).filter(|&e| mesh.is_fixed(e)).map(|e| mesh.head(e));
        // To one end, and back from there to the other one.
        let way = |mut from: Place, mut at: Place| {
            let mut chain = vec![mesh.name(at)];
            while let Some(next) = fixed(at).find(|&next| next != from) {
                (from, at) = (at, next);
                chain.push(mesh.name(at));
                if mesh.name(at).index() < given {
                    break;
                }
            }
            (chain, from, at)
        };
        let (_, last, end) = way(Place::GHOST, some);
        let (mut chain, ..) = way(end, last);
        chain.insert(0, mesh.name(end));
        if chain.first() > chain.last() {
            chain.reverse();
        }
        let ends = [chain[0], chain[chain.len() - 1]];
        let inner = chain[1..chain.len() - 1].to_vec();
        let [a, b] = ends.map(|v| self.point(v));
        let is_straight = inner.iter().all(|&v| orient2d(a, b, self.point(v)).is_zero());
        (ends, inner, is_straight)
    }

    /// Bends the segments that have new vertices beside their line.
    fn bend(&mut self, before: &Before, along: &[Along]) {
        let mut bent = Vec::new();
        for (s, ends) in self.segments.iter() {
            let chain = before.chains.get(&s).map_or(&ends[..], |chain| chain);
            let mut longer = Vec::new();
            let mut bends = self.segments.is_bent(s);
            for link in chain.windows(2) {
                longer.push(link[0]);
                let sorted = [link[0].min(link[1]), link[0].max(link[1])];
                if let Ok(at) = along.binary_search_by_key(&sorted, |along| along.0) {
                    let (_, inner, is_straight) = &along[at];
                    bends |= !is_straight;
                    if link[0] == sorted[0] {
                        longer.extend(inner);
                    } else {
                        longer.extend(inner.iter().rev());
                    }
                }
            }
            if bends {
                longer.extend(chain.last());
                bent.push((s, longer));
            }
        }
        bent.into_iter().for_each(|(s, chain)| self.segments.bend(s, chain));
    }

    /// The parts, from the domains that triangles are in; these are forgotten.
    pub(in crate::plane) fn domains_of_tags(&mut self, before: &Before, domains: Domains2) -> Domains2 {
        let mesh = &mut self.graph.base.mesh;
        let mut domains = domains;
        domains.of = vec![NONE; mesh.slot_count()];
        domains.parts.iter_mut().for_each(|part| part.triangles = 0);
        for slot in 0..mesh.slot_count() {
            let t = TriangleId::new(slot);
            let domain = mesh.domain(t);
            if mesh.is_triangle(t) && domain > 0 {
                let part = before.parts[domain - 1];
                domains.of[slot] = part as u32;
                domains.parts[part].triangles += 1;
                mesh.set_domain(t, 0);
            }
        }
        domains
    }
}
