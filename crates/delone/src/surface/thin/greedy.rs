//! The choice: in rounds, from a heap of the worst sample of each triangle.
//!
//! A round takes all that are too far away, the worst first; those whose triangle has gone in the same round only if they are at least half
//! as far from the one they are in now. Then the new triangles are measured, on all threads. With always the worst of all alone as many
//! are left in the end, and a sixth more triangles are measured that are gone before their turn comes. Where the number of points is bounded
//! it matters who comes first, so there a round takes one.

use std::collections::BinaryHeap;
use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

use super::mesh::Mesh;
use super::{Found, Samples, Thinned, Triple, Verdict};
use crate::parallel;

/// Rounding of errors, in parts of the largest height.
const ROUNDING: f64 = f64::from_bits((1023 - 48) << 52);

/// Triangles that are measured by one task.
const TASK: usize = 24;

/// See the module.
pub(super) struct Greedy<'a, S: Samples> {
    pub(super) samples: &'a S,
    pub(super) mesh: Mesh,
    /// The samples that are vertices, by vertex.
    pub(super) vertices: Vec<u32>,
    heap: BinaryHeap<S::Entry>,
    /// The worst sample of each triangle and its error, if that is more than allowed: other entries are those of triangles that are gone.
    worst: Vec<Option<(f64, u32)>>,
    /// Triangles of this round, which are not measured yet; some more than once.
    fresh: Vec<u32>,
}

impl<'a, S: Samples> Greedy<'a, S> {
    pub(super) fn new(samples: &'a S, mesh: Mesh, vertices: &[u32]) -> Self {
        let count = mesh.triangles.len();
        let (worst, fresh) = (vec![None; count], (0..count as u32).collect());
        Self { samples, mesh, vertices: vertices.to_vec(), heap: BinaryHeap::new(), worst, fresh }
    }

    fn corners(&self, t: u32) -> Triple {
        self.mesh.triangles[t as usize].corners.map(|v| self.vertices[v as usize])
    }

    /// Chooses until nothing is further away than allowed, or there are enough.
    pub(super) fn run(mut self, max_error: f64, max_points: usize) -> Thinned {
        let largest = self.vertices.iter().map(|&s| self.samples.height(s).abs()).fold(0.0, f64::max);
        let allowed = max_error + ROUNDING * largest;
        let (first, mut is_pruned) = (self.vertices.len(), false);
        loop {
            self.measure(allowed);
            while self.vertices.len() < max_points && !self.heap.is_empty() {
                self.round(max_points, allowed);
                self.measure(allowed);
            }
            if self.heap.is_empty() && !std::mem::replace(&mut is_pruned, true) {
                self.prune(first, allowed);
            }
            // All samples once more, without a bound: what was left out wrongly would be seen here.
            let (error, missed) = self.prove(allowed);
            let before = self.vertices.len();
            for (t, sample) in missed {
                if self.vertices.len() < max_points {
                    self.choose(sample, t);
                }
            }
            if self.vertices.len() == before {
                return Thinned { vertices: self.vertices.into_iter().map(|s| s as usize).collect(), error };
            }
        }
    }

    /// Chooses what is in the heap, or the worst alone.
    fn round(&mut self, max_points: usize, allowed: f64) {
        let is_bounded = max_points < self.samples.count();
        let entries = if is_bounded {
            self.heap.pop().into_iter().collect()
        } else {
            std::mem::take(&mut self.heap).into_sorted_vec()
        };
        for entry in entries.into_iter().rev() {
            let Found { error, sample, triangle: t } = self.samples.found(&entry);
            let is_left = || !is_bounded && self.error_near(sample, t) > allowed.max(error / 2.0);
            if self.worst[t as usize] == Some((error, sample)) || is_left() {
                self.choose(sample, t);
            }
        }
    }

    /// The error of a sample now, near to a triangle that it was in; where it is between two, of both the larger.
    fn error_near(&self, sample: u32, t: u32) -> f64 {
        let error = |t: u32| self.samples.error(self.corners(t), sample);
        self.mesh.around(t, self.samples.point(sample)).into_iter().flatten().map(error).fold(0.0, f64::max)
    }

    /// Makes a sample a vertex, from a triangle that it is in or was in.
    fn choose(&mut self, sample: u32, t: u32) {
        if !self.mesh.insert(self.samples.point(sample), t) {
            return;
        }
        self.vertices.push(sample);
        self.worst.resize(self.mesh.triangles.len(), None);
        for &t in &self.mesh.star {
            self.worst[t as usize] = None;
            self.fresh.push(t);
        }
    }

    /// Measures the triangles of the last round.
    fn measure(&mut self, allowed: f64) {
        let mut fresh = std::mem::take(&mut self.fresh);
        fresh.sort_unstable();
        fresh.dedup();
        let this = &*self;
        let worst = |&t: &u32| this.samples.worst(this.corners(t), allowed);
        let all = |task: &[u32]| -> Vec<Option<(f64, u32)>> { task.iter().map(worst).collect() };
        let found = parallel::share(self.samples.count(), fresh.chunks(TASK).collect(), all);
        for (&t, worst) in fresh.iter().zip(found.into_iter().flatten()) {
            if let Some((error, sample)) = worst
                && error > allowed
            {
                self.worst[t as usize] = worst;
                self.heap.push(self.samples.entry(error, sample, t));
            }
        }
    }

    /// Forgets the triangles there were: others have their numbers, and nothing is too far from them.
    pub(super) fn renumber(&mut self) {
        self.worst = vec![None; self.mesh.triangles.len()];
    }

    /// The largest error of all samples, and those that are further away than allowed, with a triangle each.
    fn prove(&self, allowed: f64) -> (f64, Vec<(u32, u32)>) {
        let count = self.samples.count();
        let seen: Vec<AtomicBool> = std::iter::repeat_with(AtomicBool::default).take(count).collect();
        let triangles = self.mesh.triangles.len();
        let tasks = parallel::even_ranges(triangles, parallel::parts(count));
        let judge = |triangles: Range<usize>| {
            let mut verdict = Verdict::new(allowed, &seen);
            triangles.map(|t| t as u32).for_each(|t| self.samples.judge(self.corners(t), t, &mut verdict));
            verdict
        };
        let mut verdict = Verdict::new(allowed, &seen);
        for part in parallel::map(tasks, judge) {
            verdict.largest = verdict.largest.max(part.largest);
            verdict.missed.extend(part.missed);
        }
        self.vertices.iter().for_each(|&s| verdict.take(0, s, 0.0));
        let mut near = 0;
        for sample in 0..count as u32 {
            if seen[sample as usize].load(Relaxed) || !self.samples.is_there(sample) {
                continue;
            }
            if let [Some(t), _] = self.mesh.around(near, self.samples.point(sample)) {
                near = t;
                verdict.take(t, sample, self.samples.error(self.corners(t), sample));
            }
        }
        (verdict.largest, verdict.missed)
    }
}
