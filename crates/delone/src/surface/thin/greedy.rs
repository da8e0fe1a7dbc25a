//! The choice: always the worst, from a heap of the worst of each triangle.

use std::collections::BinaryHeap;

use super::mesh::Mesh;
use super::{Samples, Thinned, Triple, Verdict};

/// Rounding of errors, in parts of the largest height.
const ROUNDING: f64 = f64::from_bits((1023 - 48) << 52);

/// See the module.
pub(super) struct Greedy<'a, S: Samples> {
    pub(super) samples: &'a S,
    pub(super) mesh: Mesh,
    /// The samples that are vertices, by vertex.
    pub(super) vertices: Vec<u32>,
    heap: BinaryHeap<S::Entry>,
    /// The worst sample of each triangle and its error, if that is more than allowed: other entries are those of triangles that are gone.
    pub(super) worst: Vec<Option<(f64, u32)>>,
}

impl<'a, S: Samples> Greedy<'a, S> {
    pub(super) fn new(samples: &'a S, mesh: Mesh, vertices: &[u32]) -> Self {
        let worst = vec![None; mesh.triangles.len()];
        Self { samples, mesh, vertices: vertices.to_vec(), heap: BinaryHeap::new(), worst }
    }

    fn corners(&self, t: u32) -> Triple {
        self.mesh.triangles[t as usize].corners.map(|v| self.vertices[v as usize])
    }

    /// Chooses until nothing is further away than allowed, or there are enough.
    pub(super) fn run(mut self, max_error: f64, max_points: usize) -> Thinned {
        let largest = self.vertices.iter().map(|&s| self.samples.height(s).abs()).fold(0.0, f64::max);
        let allowed = max_error + ROUNDING * largest;
        (0..self.worst.len() as u32).for_each(|t| self.measure(t, allowed));
        let (first, mut is_pruned) = (self.vertices.len(), false);
        loop {
            while self.vertices.len() < max_points {
                let Some(entry) = self.heap.pop() else { break };
                let t = S::triangle_of(&entry);
                if let Some((error, sample)) = self.worst[t as usize]
                    && self.samples.entry(error, sample, t) == entry
                {
                    self.choose(sample, t, allowed);
                }
            }
            if self.heap.is_empty() && !std::mem::replace(&mut is_pruned, true) {
                self.prune(first, allowed);
            }
            // All samples once more, without a bound: what was left out wrongly would be seen here.
            let (error, missed) = self.prove(allowed);
            if missed.is_empty() || self.vertices.len() >= max_points {
                return Thinned { vertices: self.vertices.into_iter().map(|s| s as usize).collect(), error };
            }
            let before = self.vertices.len();
            for (t, sample) in missed {
                self.choose(sample, t, allowed);
            }
            if self.vertices.len() == before {
                return Thinned { vertices: self.vertices.into_iter().map(|s| s as usize).collect(), error };
            }
        }
    }

    /// Makes a sample a vertex, from a triangle that it is in or was in.
    fn choose(&mut self, sample: u32, t: u32, allowed: f64) {
        if !self.mesh.insert(self.samples.point(sample), t) {
            return;
        }
        self.vertices.push(sample);
        self.worst.resize(self.mesh.triangles.len(), None);
        for i in 0..self.mesh.star.len() {
            let t = self.mesh.star[i];
            self.measure(t, allowed);
        }
    }

    fn measure(&mut self, triangle: u32, allowed: f64) {
        let worst = self.samples.worst(self.corners(triangle), allowed).filter(|worst| worst.0 > allowed);
        self.worst[triangle as usize] = worst;
        if let Some((error, sample)) = worst {
            self.heap.push(self.samples.entry(error, sample, triangle));
        }
    }

    /// The largest error of all samples, and those that are further away than allowed, with a triangle each.
    fn prove(&self, allowed: f64) -> (f64, Vec<(u32, u32)>) {
        let seen = vec![false; self.samples.count()];
        let mut verdict = Verdict { allowed, largest: 0.0, seen, missed: Vec::new() };
        for t in 0..self.mesh.triangles.len() as u32 {
            self.samples.judge(self.corners(t), t, &mut verdict);
        }
        self.vertices.iter().for_each(|&s| verdict.take(0, s, 0.0));
        let mut near = 0;
        for sample in 0..self.samples.count() as u32 {
            if verdict.seen[sample as usize] || !self.samples.is_there(sample) {
                continue;
            }
            if let Some(t) = self.mesh.find(near, self.samples.point(sample)) {
                near = t;
                verdict.take(t, sample, self.samples.error(self.corners(t), sample));
            }
        }
        (verdict.largest, verdict.missed)
    }
}
