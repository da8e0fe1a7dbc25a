//! Parts of a constrained triangulation that gets vertices and constraints inside of its parts: boundary layers.
//!
//! Borders of parts stay what they are. So the part of each side of a border is noted before, and spread over what is between borders
//! afterwards.
//!
//! Cost: O(n log m) for m borders.

use std::collections::BTreeMap;

use super::domains::NONE;
use super::refined::Origin;
use super::{Constrained2, Domains2};
use crate::ids::{EdgeId, TriangleId, VertexId};

/// The part to the left of each constraint and hull edge, by its ends.
type Beside = BTreeMap<[VertexId; 2], u32>;

impl Constrained2 {
    /// Notes the parts beside borders.
    pub(in crate::plane) fn parts_beside(&self, domains: &Domains2) -> Beside {
        let mesh = self.mesh();
        let borders = self.constraint_edges().chain(self.hull_edges()).flat_map(|e| [e, mesh.twin(e)]);
        let part = |e: EdgeId| domains.of.get(e.triangle().index()).copied().unwrap_or(NONE);
        borders.map(|e| ([mesh.origin(e), mesh.destination(e)], part(e))).collect()
    }

    /// Spreads the parts that were beside borders over what is between them now, and makes layers parts of their own.
    pub(in crate::plane) fn spread_parts(
        &self,
        beside: &Beside,
        layers: &[TriangleId],
        domains: &mut Domains2,
    ) {
        let mesh = self.mesh();
        let mut of = vec![NONE; mesh.slot_count()];
        let mut rest: Vec<(TriangleId, u32)> = Vec::new();
        for (&[v, w], &part) in beside.iter().filter(|entry| *entry.1 != NONE) {
            let edge = mesh.place(v).zip(mesh.place(w)).and_then(|(v, w)| mesh.edge_between(v, w));
            rest.extend(edge.map(|e| (e.triangle(), part)));
        }
        while let Some((t, part)) = rest.pop() {
            if mesh.is_ghost(t) || of[t.index()] != NONE {
                continue;
            }
            of[t.index()] = part;
            let open = [0, 1, 2].map(|k| t.edge(k)).into_iter().filter(|&e| {
                !mesh.is_fixed(e) || !beside.contains_key(&[mesh.origin(e), mesh.destination(e)])
            });
            rest.extend(open.map(|e| (mesh.twin(e).triangle(), part)));
        }
        let mut layer_of: BTreeMap<u32, u32> = BTreeMap::new();
        let mut around: Vec<u32> =
            layers.iter().map(|t| of[t.index()]).filter(|&part| part != NONE).collect();
        around.sort_unstable();
        around.dedup();
        for part in around {
            layer_of.insert(part, domains.parts.len() as u32);
            domains.parts.push(super::Part2 { is_layer: true, ..domains.parts[part as usize] });
        }
        for t in layers {
            let part = &mut of[t.index()];
            *part = layer_of.get(part).copied().unwrap_or(*part);
        }
        domains.parts.iter_mut().for_each(|part| part.triangles = 0);
        of.iter().filter(|part| **part != NONE).for_each(|&part| domains.parts[part as usize].triangles += 1);
        domains.of = of;
    }

    /// Notes the scale of new vertices, for the next refinement.
    pub(in crate::plane) fn note_scales(&self, scales: &[(VertexId, f64)], domains: &mut Domains2) {
        let unknown = Origin { on: [VertexId::GHOST; 2], scale: 0.0 };
        domains.origins.resize(self.points().len().max(domains.origins.len()), unknown);
        for &(v, scale) in scales {
            domains.origins[v.index()] = Origin { on: [v; 2], scale };
        }
    }
}
