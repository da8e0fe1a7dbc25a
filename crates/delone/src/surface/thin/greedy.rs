//! The choice: always the worst, from a heap of the worst of each triangle.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use delone_predicates::lexicographic;

use super::mesh::Mesh;
use super::{Samples, Thinned, Triple};

/// Rounding of errors, in parts of the largest height.
const ROUNDING: f64 = f64::from_bits((1023 - 48) << 52);

/// See the module.
pub(super) struct Greedy<'a, S> {
    samples: &'a S,
    mesh: Mesh,
    /// The samples that are vertices, by vertex.
    vertices: Vec<u32>,
    heap: BinaryHeap<Entry>,
    /// How often a triangle was made anew: older entries of it are void.
    versions: Vec<u32>,
}

/// The worst sample of a triangle.
struct Entry {
    error: f64,
    point: [f64; 2],
    sample: u32,
    triangle: u32,
    version: u32,
}

impl Ord for Entry {
    fn cmp(&self, other: &Self) -> Ordering {
        self.error.total_cmp(&other.error).then_with(|| lexicographic(other.point, self.point))
    }
}

impl PartialOrd for Entry {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Entry {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Entry {}

impl<'a, S: Samples> Greedy<'a, S> {
    pub(super) fn new(samples: &'a S, mesh: Mesh, vertices: &[u32]) -> Self {
        let versions = vec![0; mesh.triangles.len()];
        Self { samples, mesh, vertices: vertices.to_vec(), heap: BinaryHeap::new(), versions }
    }

    fn corners(&self, t: u32) -> Triple {
        self.mesh.triangles[t as usize].corners.map(|v| self.vertices[v as usize])
    }

    /// Chooses until nothing is further away than allowed, or there are enough.
    pub(super) fn run(mut self, max_error: f64, max_points: usize) -> Thinned {
        let largest = self.vertices.iter().map(|&s| self.samples.height(s).abs()).fold(0.0, f64::max);
        let allowed = max_error + ROUNDING * largest;
        (0..self.versions.len() as u32).for_each(|t| self.measure(t, allowed));
        loop {
            while self.vertices.len() < max_points {
                let Some(entry) = self.heap.pop() else { break };
                if entry.version == self.versions[entry.triangle as usize] {
                    self.choose(entry.sample, entry.triangle, allowed);
                }
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
        self.versions.resize(self.mesh.triangles.len(), 0);
        for i in 0..self.mesh.star.len() {
            let t = self.mesh.star[i];
            self.versions[t as usize] += 1;
            self.measure(t, allowed);
        }
    }

    fn measure(&mut self, triangle: u32, allowed: f64) {
        let version = self.versions[triangle as usize];
        if let Some((error, sample)) = self.samples.worst(self.corners(triangle), allowed)
            && error > allowed
        {
            let point = self.samples.point(sample);
            self.heap.push(Entry { error, point, sample, triangle, version });
        }
    }

    /// The largest error of all samples, and those that are further away than allowed, with a triangle each.
    fn prove(&self, allowed: f64) -> (f64, Vec<(u32, u32)>) {
        let (mut largest, mut missed) = (0.0, Vec::new());
        let mut seen = vec![false; self.samples.count()];
        let mut take = |t: u32, sample: u32, error: f64| {
            seen[sample as usize] = true;
            largest = if error > largest { error } else { largest };
            if error > allowed {
                missed.push((t, sample));
            }
        };
        for t in 0..self.mesh.triangles.len() as u32 {
            self.samples.all(self.corners(t), &mut |sample, error| take(t, sample, error));
        }
        self.vertices.iter().for_each(|&s| take(0, s, 0.0));
        let mut near = 0;
        let rest: Vec<u32> = (0..)
            .zip(&seen)
            .filter(|(s, seen)| !**seen && self.samples.is_there(*s))
            .map(|(s, _)| s)
            .collect();
        for sample in rest {
            if let Some(t) = self.mesh.find(near, self.samples.point(sample)) {
                near = t;
                let error = self.samples.error(self.corners(t), sample);
                largest = if error > largest { error } else { largest };
                if error > allowed {
                    missed.push((t, sample));
                }
            }
        }
        (largest, missed)
    }
}
