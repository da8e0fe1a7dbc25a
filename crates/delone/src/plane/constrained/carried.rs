//! The parts of a triangulation after vertices went: each is one of before, because no constraint moved.
//!
//! Cost: O(n log n).

use std::collections::BTreeMap;

use super::domains::NONE;
use super::{Constrained2, Domains2};
use crate::ids::VertexId;
use crate::plane::Location2;

impl Constrained2 {
    /// Parts as they were in a triangulation of more vertices with the same constraints.
    pub(in crate::plane) fn carried(&self, old: &Self, domains: &Domains2) -> Domains2 {
        let sorted = |mut corners: [VertexId; 3]| {
            corners.sort_unstable();
            corners
        };
        let known = old.triangle_ids().map(|t| (sorted(old.mesh().corners(t)), domains.part(t)));
        let known: BTreeMap<[VertexId; 3], Option<usize>> = known.collect();
        let mut now = self.parts();
        let mut part_of: Vec<Option<Option<usize>>> = vec![None; now.parts.len()];
        for t in self.triangle_ids() {
            let part = &mut part_of[now.of[t.index()] as usize];
            if part.is_none() {
                *part = known.get(&sorted(self.mesh().corners(t))).copied();
            }
        }
        // Of a part without a triangle of before one is found at a place of the largest triangle.
        let mut largest = vec![(0.0, None); now.parts.len()];
        for t in self.triangle_ids().filter(|t| part_of[now.of[t.index()] as usize].is_none()) {
            let (area, place) = &mut largest[now.of[t.index()] as usize];
            if place.is_none() || self.area(t) > *area {
                let corners = self.mesh().corners(t).map(|v| self.point(v));
                let centroid = [0, 1].map(|k| corners.iter().map(|p| p[k] / 3.0).sum::<f64>());
                (*area, *place) = (self.area(t), Some(centroid));
            }
        }
        for (part, (_, place)) in part_of.iter_mut().zip(largest) {
            let holding = place.and_then(|at| match old.locate(at) {
                Ok(Location2::Triangle(t)) => domains.part(t),
                Ok(Location2::Edge(e)) => domains.part(e.triangle()),
                // One that went: no constraint passes strictly inside of a triangle, so all around it is of one part.
                Ok(Location2::Vertex(v)) => old.mesh().star(v).find_map(|e| domains.part(e.triangle())),
                _ => None,
            });
            part.get_or_insert(holding);
        }
        now.of.iter_mut().filter(|part| **part != NONE).for_each(|part| {
            *part = part_of[*part as usize].flatten().map_or(NONE, |part| part as u32);
        });
        let mut carried = domains.clone();
        carried.of = now.of;
        carried.parts.iter_mut().for_each(|part| part.triangles = 0);
        for &part in carried.of.iter().filter(|part| **part != NONE) {
            carried.parts[part as usize].triangles += 1;
        }
        carried
    }
}
