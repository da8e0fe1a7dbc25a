//! What refinement needs of a constrained triangulation: its triangles put into domains, and afterwards names for new vertices
//! and chains for segments that were split.
//!
//! While it is refined all is known by places. Segments need not be known then: each new vertex on a constraint knows the ends of
//! the input edge that it is on.

use std::collections::BTreeMap;

use delone_predicates::orient2d;

use super::domains::NONE;
use super::segments::{Ends, SegmentId};
use super::{Constrained2, Domains2};
use crate::error::Error;
use crate::ids::{MAX_POINTS, Place, TriangleId, VertexId};
use crate::plane::layer::Layer;
use crate::sorting;

/// What is remembered while a triangulation is refined.
#[derive(Debug)]
pub(in crate::plane) struct Before {
    /// The vertices along the segments that are no single edge.
    chains: BTreeMap<SegmentId, Vec<VertexId>>,
    /// For each domain, from 1 on, its part: first those that are inside.
    pub(in crate::plane) parts: Vec<usize>,
    /// How many of them are.
    pub(in crate::plane) inside: usize,
    /// How many points there are.
    pub(in crate::plane) given: usize,
    /// How many vertices may be added.
    pub(in crate::plane) room: usize,
}

/// The new vertices on an edge of the input: its ends, by increasing id, and whether all are exactly on it.
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
        sorting::by_key(&mut parts, |&part| !domains.parts()[part].is_inside);
        let inside = parts.partition_point(|&part| domains.parts()[part].is_inside);
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
        Before { chains, inside, parts, given, room: MAX_POINTS - given }
    }

    /// The triangulation itself.
    pub(in crate::plane) fn layer(&mut self) -> &mut Layer {
        &mut self.graph.base
    }

    /// Gives new vertices their names, in their order, and segments their chains. `on` says of those on constraints between
    /// which input vertices they are.
    pub(in crate::plane) fn end_refinement(
        &mut self,
        before: &Before,
        new: &[Place],
        on: &[([Place; 2], Place)],
    ) -> Result<[usize; 2], Error> {
        self.graph.end_bulk(new)?;
        let named = |&(ends, p): &([Place; 2], Place)| {
            let mut ends = ends.map(|end| self.mesh().name(end));
            ends.sort_unstable();
            (ends, p)
        };
        let mut along: Vec<(Ends, Place)> = on.iter().map(named).collect();
        along.sort_unstable();
        let counts = [new.len() - along.len(), along.len()];
        let along: Vec<Along> = along.chunk_by(|p, q| p.0 == q.0).map(|on| self.chain_on(on)).collect();
        self.has_chains |= !along.is_empty();
        self.bend(before, &along);
        Ok(counts)
    }

    /// The chain of new vertices on an edge of the input.
    fn chain_on(&self, on: &[(Ends, Place)]) -> Along {
        let mesh = self.mesh();
        let (ends, some) = on[0];
        let [first, last] = ends.map(|v| mesh.place(v).expect("a vertex"));
        // From any of them to both ends. At the last one of each way the end of the input edge follows.
        let way = |k: usize| {
            let (mut chain, mut from, mut at) = (Vec::new(), Place::GHOST, some);
            loop {
                let mut next = mesh.spokes(at).filter(|&e| mesh.is_fixed(e)).map(|e| mesh.head(e));
                let next = if at == some { next.nth(k) } else { next.find(|&w| w != from) };
                match next {
                    Some(next) if next != first && next != last => {
                        chain.push(next);
                        (from, at) = (at, next);
                    }
                    end => return (chain, end),
                }
            }
        };
        let ((mut chain, end), (rest, _)) = (way(0), way(1));
        chain.reverse();
        chain.push(some);
        chain.extend(rest);
        if end != Some(first) {
            chain.reverse();
        }
        let [a, b] = ends.map(|v| self.point(v));
        let is_on = |p: &Place| orient2d(a, b, self.graph.base.points[p.index()]).is_zero();
        let is_straight = chain.iter().all(is_on);
        (ends, chain.into_iter().map(|p| mesh.name(p)).collect(), is_straight)
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
