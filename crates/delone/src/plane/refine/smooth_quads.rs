//! Smoothing of quadrilaterals: free points move towards the mean of their neighbors.
//!
//! A move stays only if the worst quadrilateral around gets better and all of them stay convex, which is decided exactly. A quadrilateral is
//! as bad as its worst corner: for sides u and v there it is (u.u + v.v) / 2 (u x v), which is 1 at a right angle between equal sides.
//!
//! A round moves vertices of the triangulation, then centers, then middles, each group at once: so no order shows. No two vertices, and no
//! two centers, are of one quadrilateral. Two middles are: where a move is no gain together with those around, it is undone, and these are
//! judged again.
//!
//! Cost: O(1) for each point and round.

use super::Refined2;
use super::all_quads::{AllQuads2, is_convex};
use crate::ids::VertexId;
use crate::plane::Constrained2;

/// Parts of the way to the mean that are tried.
const PARTS_OF_WAY: [f64; 3] = [1.0, 0.5, 0.25];

impl AllQuads2 {
    /// Moves points in rounds to where quadrilaterals are better. Points on constraints, on the border and in boundary layers stay, and so do
    /// vertices that were there before the refinement. Each move makes the worst quadrilateral around a point better.
    ///
    /// Cost: O(n) a round.
    ///
    /// ```
    /// use delone::{AllQuads2, Constrained2, Quads2, Refinement};
    ///
    /// let mut c = Constrained2::from_parts(&[[0, 0], [3, 0], [3, 2], [0, 2]], &[])?;
    /// let refined = Refinement::new().edge(0.5).run(&mut c)?;
    /// let mut all = AllQuads2::of(&c, &Quads2::of(&c, &refined));
    /// let before = all.angles();
    /// all.smooth(&c, &refined, 3);
    /// assert!(before.unwrap()[0] < all.angles().unwrap()[0]);
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn smooth(&mut self, c: &Constrained2, refined: &Refined2, rounds: usize) {
        let is_free = self.free(c, refined);
        let centers = self.first + self.middles.len();
        let count = self.points.len();
        let groups = [0..self.first, centers..count, self.first..centers];
        let groups = groups.map(|group| group.filter(|&i| is_free[i]).collect::<Vec<usize>>());
        let mut smoothing = Smoothing::new(self);
        for _ in 0..rounds {
            groups.iter().for_each(|group| smoothing.improve(group));
        }
        self.judge();
    }

    /// Whether each point may move.
    fn free(&self, c: &Constrained2, refined: &Refined2) -> Vec<bool> {
        let mesh = c.mesh();
        let origins = &refined.domains.origins;
        let is_new = |i: usize| origins.get(i).is_some_and(|origin| origin.on == [VertexId::GHOST; 2]);
        let mut is_free: Vec<bool> = (0..self.points.len()).map(|i| i >= self.first || is_new(i)).collect();
        let mut fix = |ends: [VertexId; 2]| {
            let [v, w] = ends;
            ends.iter().for_each(|v| is_free[v.index()] = false);
            if let Ok(at) = self.middles.binary_search(&[v.min(w), v.max(w)]) {
                is_free[self.first + at] = false;
            }
        };
        for t in c.triangle_ids().filter(|&t| refined.domains.is_inside(t)) {
            let is_layer = refined.domains.is_layer(t);
            for e in [0, 1, 2].map(|k| t.edge(k)) {
                let is_wall = c.is_constraint(e) && !refined.only_keeps(c, e);
                if is_layer || is_wall || !refined.domains.is_inside(mesh.twin(e).triangle()) {
                    fix([mesh.origin(e), mesh.destination(e)]);
                }
            }
        }
        for (corners, &t) in self.corners.iter().zip(&self.triangles) {
            if refined.domains.is_layer(t) {
                is_free[corners[2]] = false;
            }
        }
        is_free
    }
}

/// A mesh whose points move.
struct Smoothing<'a> {
    points: &'a mut [[f64; 2]],
    corners: &'a [[usize; 4]],
    /// Where the quadrilaterals around each point begin in the next list.
    starts: Vec<usize>,
    around: Vec<usize>,
    /// Whether something near a point has changed since no move was a gain there.
    may_gain: Vec<bool>,
}

impl<'a> Smoothing<'a> {
    fn new(quads: &'a mut AllQuads2) -> Self {
        let (points, corners) = (&mut quads.points[..], &quads.corners[..]);
        let mut starts = vec![0; points.len() + 1];
        corners.iter().flatten().for_each(|&i| starts[i + 1] += 1);
        (0..points.len()).for_each(|i| starts[i + 1] += starts[i]);
        let mut around = vec![0; 4 * corners.len()];
        let mut next = starts.clone();
        for (row, corners) in corners.iter().enumerate() {
            for &i in corners {
                around[next[i]] = row;
                next[i] += 1;
            }
        }
        let may_gain = vec![true; points.len()];
        Self { points, corners, starts, around, may_gain }
    }

    fn star(&self, i: usize) -> &[usize] {
        &self.around[self.starts[i]..self.starts[i + 1]]
    }

    fn places(&self, row: usize) -> [[f64; 2]; 4] {
        self.corners[row].map(|i| self.points[i])
    }

    /// How bad the worst quadrilateral around a point is.
    fn worst(&self, i: usize) -> f64 {
        self.star(i).iter().map(|&row| badness(self.places(row))).fold(0.0, f64::max)
    }

    /// A place on the way from a point to the mean of its neighbors.
    fn goal(&self, i: usize, part: f64) -> [f64; 2] {
        let own = self.points[i];
        let step = |k: usize| {
            // Each neighbor follows the point in one quadrilateral. Halves, because a difference may be too large.
            let half = |row: &usize| {
                let corners = &self.corners[*row];
                let at = (0..4).find(|&at| corners[at] == i).unwrap_or_default();
                0.5 * self.points[corners[(at + 1) % 4]][k] - 0.5 * own[k]
            };
            let mut halves: Vec<f64> = self.star(i).iter().map(half).collect();
            // In an order that neither names nor mirrors change.
            halves.sort_unstable_by(|x, y| x.abs().total_cmp(&y.abs()).then(x.total_cmp(y)));
            2.0 * part * (halves.iter().sum::<f64>() / halves.len() as f64)
        };
        [0, 1].map(|k| own[k] + step(k))
    }

    /// Whether a move of a point was a gain.
    fn is_better(&self, i: usize, before: f64) -> bool {
        let is_finite = self.points[i].iter().all(|x| x.is_finite());
        is_finite && self.worst(i) < before && self.star(i).iter().all(|&row| is_convex(self.places(row)))
    }

    /// Moves a group of points at once, as far as that is a gain around each.
    fn improve(&mut self, group: &[usize]) {
        let mut waiting: Vec<usize> = group.iter().copied().filter(|&i| self.may_gain[i]).collect();
        let mut moved: Vec<usize> = Vec::new();
        for part in PARTS_OF_WAY {
            let moves = waiting.iter().map(|&i| (self.points[i], self.worst(i), self.goal(i, part)));
            let moves: Vec<_> = moves.collect();
            waiting.iter().zip(&moves).for_each(|(&i, &(_, _, goal))| self.points[i] = goal);
            let mut is_moved = vec![true; waiting.len()];
            let mut judged: Vec<usize> = (0..waiting.len()).collect();
            while !judged.is_empty() {
                let is_bad = |&at: &usize| is_moved[at] && !self.is_better(waiting[at], moves[at].1);
                let bad: Vec<usize> = judged.into_iter().filter(is_bad).collect();
                for &at in &bad {
                    is_moved[at] = false;
                    self.points[waiting[at]] = moves[at].0;
                }
                let beside =
                    bad.iter().flat_map(|&at| self.star(waiting[at])).flat_map(|&row| self.corners[row]);
                judged = beside.filter_map(|i| waiting.binary_search(&i).ok()).collect();
                judged.sort_unstable();
                judged.dedup();
            }
            moved.extend(waiting.iter().zip(&is_moved).filter(|one| *one.1).map(|one| *one.0));
            waiting = waiting.into_iter().zip(is_moved).filter(|one| !one.1).map(|one| one.0).collect();
        }
        waiting.iter().for_each(|&i| self.may_gain[i] = false);
        for i in moved {
            for at in self.starts[i]..self.starts[i + 1] {
                self.corners[self.around[at]].iter().for_each(|&near| self.may_gain[near] = true);
            }
        }
    }
}

/// How bad the worst corner is: 1 at best, infinite if it is not convex.
fn badness(p: [[f64; 2]; 4]) -> f64 {
    let sides = [0, 1, 2, 3].map(|k| {
        let q = p[(k + 1) % 4];
        [0, 1].map(|axis| 0.5 * q[axis] - 0.5 * p[k][axis])
    });
    // As parts of the largest, so that squares stay in the range of numbers.
    let largest = sides.as_flattened().iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
    let sides = sides.map(|side| side.map(|x| x / largest));
    let mut sum = 0.0;
    for k in 0..4 {
        let (u, v) = (sides[k], sides[(k + 3) % 4]);
        // The side before leads to the corner.
        let cross = v[0] * u[1] - v[1] * u[0];
        let squares = (u[0] * u[0] + u[1] * u[1]) + (v[0] * v[0] + v[1] * v[1]);
        sum += if cross > 0.0 { squares / cross } else { f64::INFINITY };
    }
    sum / 8.0
}
