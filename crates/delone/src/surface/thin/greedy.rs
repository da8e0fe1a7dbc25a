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
use crate::ids::TriangleId;
use crate::parallel;

/// Rounding of errors, in parts of the largest height.
const ROUNDING: f64 = f64::from_bits((1023 - 48) << 52);

/// Triangles that are measured by one task.
const TASK: usize = 24;

/// See the module.
pub(super) struct Greedy<'a, S: Samples> {
    pub(super) samples: &'a S,
    pub(super) mesh: Mesh,
    /// The samples that are vertices, or were, by place.
    pub(super) vertices: Vec<u32>,
    heap: BinaryHeap<S::Entry>,
    /// The worst sample of each triangle and its error, if that is more than allowed: other entries are those of triangles that are gone.
    worst: Vec<Option<(f64, u32)>>,
    /// Triangles of this round, which are not measured yet; some more than once.
    fresh: Vec<TriangleId>,
}

impl<'a, S: Samples> Greedy<'a, S> {
    pub(super) fn new(samples: &'a S, mesh: Mesh, vertices: &[u32]) -> Self {
        let count = mesh.base.slot_count();
        let fresh = mesh.triangles(0..count).collect();
        let worst = vec![None; count];
        Self { samples, mesh, vertices: vertices.to_vec(), heap: BinaryHeap::new(), worst, fresh }
    }

    fn corners(&self, t: TriangleId) -> Triple {
        self.mesh.base.places(t).map(|v| self.vertices[v.index()])
    }

    /// The samples that are vertices.
    fn chosen(&self) -> impl Iterator<Item = u32> {
        self.mesh.base.inhabited().map(|v| self.vertices[v.index()])
    }

    /// Chooses until nothing is further away than allowed, or there are enough.
    pub(super) fn run(mut self, max_error: f64, max_points: usize) -> Thinned {
        let largest = self.vertices.iter().map(|&s| self.samples.height(s).abs()).fold(0.0, f64::max);
        let allowed = max_error + ROUNDING * largest;
        let (first, mut is_pruned) = (self.vertices.len(), false);
        loop {
            self.measure(allowed);
            while self.mesh.base.vertex_count < max_points && !self.heap.is_empty() {
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
                if self.mesh.base.vertex_count < max_points {
                    self.choose(sample, TriangleId::new(t as usize));
                }
            }
            if self.vertices.len() == before {
                return Thinned { vertices: self.chosen().map(|s| s as usize).collect(), error };
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
            let Found { error, sample, triangle } = self.samples.found(&entry);
            let t = TriangleId::new(triangle as usize);
            let is_left = || !is_bounded && self.error_near(sample, t) > allowed.max(error / 2.0);
            if self.worst[t.index()] == Some((error, sample)) || is_left() {
                self.choose(sample, t);
            }
        }
    }

    /// The error of a sample now, near to a triangle that it was in; where it is between two, of both the larger.
    fn error_near(&self, sample: u32, t: TriangleId) -> f64 {
        let error = |t: TriangleId| self.samples.error(self.corners(t), sample);
        self.mesh.around(t, self.samples.point(sample)).into_iter().flatten().map(error).fold(0.0, f64::max)
    }

    /// Makes a sample a vertex, from a triangle that it is in or was in.
    fn choose(&mut self, sample: u32, t: TriangleId) {
        if !self.mesh.insert(self.samples.point(sample), t) {
            return;
        }
        self.vertices.push(sample);
        self.worst.resize(self.mesh.base.slot_count(), None);
        for &t in self.mesh.star() {
            self.worst[t.index()] = None;
            self.fresh.push(t);
        }
    }

    /// Measures the triangles of the last round.
    fn measure(&mut self, allowed: f64) {
        let mut fresh = std::mem::take(&mut self.fresh);
        fresh.sort_unstable();
        fresh.dedup();
        // Those beside the hull may be ghosts.
        fresh.retain(|&t| !self.mesh.base.is_ghost(t));
        let this = &*self;
        let worst = |&t: &TriangleId| this.samples.worst(this.corners(t), allowed);
        let all = |task: &[TriangleId]| -> Vec<Option<(f64, u32)>> { task.iter().map(worst).collect() };
        let found = parallel::share(self.samples.count(), fresh.chunks(TASK).collect(), all);
        for (&t, worst) in fresh.iter().zip(found.into_iter().flatten()) {
            if let Some((error, sample)) = worst
                && error > allowed
            {
                self.worst[t.index()] = worst;
                self.heap.push(self.samples.entry(error, sample, t.index() as u32));
            }
        }
    }

    /// Forgets the triangles there were: others have their slots, and nothing is too far from them.
    pub(super) fn forget(&mut self) {
        self.worst.fill(None);
    }

    /// The largest error of all samples, and those that are further away than allowed, with a triangle each.
    fn prove(&self, allowed: f64) -> (f64, Vec<(u32, u32)>) {
        let count = self.samples.count();
        let seen: Vec<AtomicBool> = std::iter::repeat_with(AtomicBool::default).take(count).collect();
        let tasks = parallel::even_ranges(self.mesh.base.slot_count(), parallel::parts(count));
        let judge = |slots: Range<usize>| {
            let mut verdict = Verdict::new(allowed, &seen);
            for t in self.mesh.triangles(slots) {
                self.samples.judge(self.corners(t), t.index() as u32, &mut verdict);
            }
            verdict
        };
        let mut verdict = Verdict::new(allowed, &seen);
        for part in parallel::map(tasks, judge) {
            verdict.largest = verdict.largest.max(part.largest);
            verdict.missed.extend(part.missed);
        }
        self.chosen().for_each(|s| verdict.take(0, s, 0.0));
        let mut near = self.mesh.base.ghost_edge.triangle();
        for sample in 0..count as u32 {
            if seen[sample as usize].load(Relaxed) || !self.samples.is_there(sample) {
                continue;
            }
            if let [Some(t), _] = self.mesh.around(near, self.samples.point(sample)) {
                near = t;
                verdict.take(t.index() as u32, sample, self.samples.error(self.corners(t), sample));
            }
        }
        (verdict.largest, verdict.missed)
    }
}
