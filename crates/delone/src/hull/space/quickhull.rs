//! The hull by distance: the fastest way to it.
//!
//! Source: Barber, Dobkin & Huhdanpaa, "The quickhull algorithm for convex hulls", TOMS 1996: each point that is
//! outside waits at one facet that it sees; the furthest of a facet's points is joined to the horizon of what it
//! sees. Which point comes next is a matter of rounded distances and of speed alone.
//!
//! Cost: O(n log n) in practice; inner points are dropped as soon as no facet is left that they see, and most of them before
//! (`prune.rs`).

use super::faces::Faces;
use super::shell::{Facet, NONE, Shell};
use super::start::Start;

/// The faces of points that span space, with names for these. They are sorted along a curve first: neighbors in space are neighbors in
/// memory then, which halves the time for a million corners.
pub(super) fn faces(points: &[[f64; 3]], name: impl Fn(usize) -> usize) -> Faces {
    let mut order: Vec<(u32, u32)> = morton_keys(points).zip(0..).collect();
    order.sort_unstable();
    let sorted: Vec<[f64; 3]> = order.iter().map(|&(_, i)| points[i as usize]).collect();
    let Start::Tetrahedron(corners) = Start::of(&sorted) else { return Faces::none() };
    Faces::of(&Quickhull::new(sorted, corners).finish(), |i| name(order[i].1 as usize))
}

/// The interleaved bits of the cells that points are in, 1024 along each axis.
fn morton_keys(points: &[[f64; 3]]) -> impl Iterator<Item = u32> + '_ {
    let range = [0, 1, 2].map(|k| {
        let of = points.iter().map(|p| p[k]);
        (of.clone().fold(f64::MAX, f64::min), of.fold(f64::MIN, f64::max))
    });
    let spread = |x: u32| {
        let x = (x | x << 16) & 0x0300_00ff;
        let x = (x | x << 8) & 0x0300_f00f;
        let x = (x | x << 4) & 0x030c_30c3;
        (x | x << 2) & 0x0924_9249
    };
    points.iter().map(move |p| {
        let cell = |k: usize| {
            let (low, high) = range[k];
            let share = (p[k] / 2.0 - low / 2.0) / (high / 2.0 - low / 2.0);
            spread((share * 1024.0).clamp(0.0, 1023.0) as u32)
        };
        cell(0) << 2 | cell(1) << 1 | cell(2)
    })
}

pub(super) struct Quickhull {
    /// Points wait in lists that begin at their facets.
    shell: Shell,
    /// For each point the one that waits after it.
    next: Vec<u32>,
    /// Facets where points may wait.
    pending: Vec<u32>,
}

impl Quickhull {
    pub(super) fn new(points: Vec<[f64; 3]>, corners: [usize; 4]) -> Self {
        let next = vec![NONE; points.len()];
        let mut hull = Self { shell: Shell::new(points, corners), next, pending: vec![0, 1, 2, 3] };
        for p in 0..hull.next.len() as u32 {
            hull.wait(p, &[0, 1, 2, 3]);
        }
        hull
    }

    /// Lets a point wait at the first of some facets that it sees, if any.
    fn wait(&mut self, p: u32, facets: &[u32]) {
        let q = self.shell.points[p as usize];
        if let Some(&f) = facets.iter().find(|&&f| self.shell.sees(q, f)) {
            self.next[p as usize] = std::mem::replace(&mut self.shell.facets[f as usize].head, p);
        }
    }

    /// Of the points that wait at a facet the furthest, as far as rounding tells; of equal ones the first.
    fn furthest(&self, facet: &Facet) -> u32 {
        let height = |p: u32| facet.height(self.shell.points[p as usize]);
        let (mut best, mut highest) = (facet.head, height(facet.head));
        let mut p = self.next[best as usize];
        while p != NONE {
            let h = height(p);
            if h > highest || (h == highest && p < best) {
                (best, highest) = (p, h);
            }
            p = self.next[p as usize];
        }
        best
    }

    pub(super) fn finish(mut self) -> Shell {
        while let Some(f) = self.pending.pop() {
            let facet = &self.shell.facets[f as usize];
            if !facet.alive || facet.head == NONE {
                continue;
            }
            let p = self.furthest(facet);
            self.shell.look(p, f);
            self.shell.cap(p);
            let fresh = std::mem::take(&mut self.shell.fresh);
            for k in 0..self.shell.seen.len() {
                let s = self.shell.seen[k];
                let mut q = self.shell.facets[s as usize].head;
                while q != NONE {
                    let after = self.next[q as usize];
                    if q != p {
                        self.wait(q, &fresh);
                    }
                    q = after;
                }
                self.shell.free.push(s);
            }
            self.pending.extend(&fresh);
            self.shell.fresh = fresh;
        }
        self.shell
    }
}
