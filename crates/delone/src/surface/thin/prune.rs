//! Vertices that are not needed in the end: what is chosen early is often made superfluous by what is chosen later.
//!
//! The triangles around a vertex are a hole, and each edge of it gets the corner whose circle is empty of the others, as in the removal
//! from any Delaunay triangulation; if no sample is too far from the triangles that come of it, the vertex goes. The last ones that were
//! chosen are asked first, and each once, so what is left is again a matter of the set of points alone.
//!
//! Cost: for a vertex the samples in its star, and O(k^2) for k neighbors; one with many is left, which bounds that.

use super::Samples;
use super::greedy::Greedy;
use super::mesh::{Mesh, NONE, Triangle, next};

/// A vertex with more neighbors stays.
const NEIGHBOURS: usize = 64;

/// The place of a vertex that may go: its triangles, and what shall be there.
#[derive(Debug, Default)]
pub(super) struct Hole {
    star: Vec<u32>,
    /// The edges around it, counter-clockwise: where each begins, what is across, whether it is fixed.
    link: Vec<(u32, u32, bool)>,
    fill: Vec<Part>,
    pending: Vec<([usize; 2], u32)>,
}

/// A triangle between three corners of the hole, counter-clockwise, by number; and the edge of another triangle of the hole that it is
/// across of with its side from the last one to the first: three times that triangle and the edge's number.
#[derive(Clone, Copy, Debug)]
struct Part {
    corners: [usize; 3],
    across: u32,
}

impl Hole {
    /// The corners of the triangles that shall be there.
    fn triangles(&self) -> impl Iterator<Item = [u32; 3]> {
        self.fill.iter().map(|part| part.corners.map(|i| self.link[i].0))
    }
}

impl Mesh {
    /// Looks at the triangles around a vertex, from one of them on. Says whether there is one on all sides, no fixed edge ends there, and
    /// they are not too many.
    fn open(&self, v: u32, first: u32, hole: &mut Hole) -> bool {
        hole.star.clear();
        hole.link.clear();
        let mut t = first;
        loop {
            let Triangle { corners, across, fixed } = self.triangles[t as usize];
            let Some(k) = corners.iter().position(|&w| w == v) else { return false };
            hole.star.push(t);
            hole.link.push((corners[next(k)], across[k], fixed >> k & 1 == 1));
            let side = next(k);
            if across[side] == NONE || fixed >> side & 1 == 1 || hole.star.len() > NEIGHBOURS {
                return false;
            }
            t = across[side] / 3;
            if t == first {
                return true;
            }
        }
    }

    /// The corner of the triangle on the left of the edge from a corner of the hole back to an earlier one.
    fn apex(&self, hole: &Hole, [i, j]: [usize; 2]) -> Option<usize> {
        let at = |k: usize| self.point(hole.link[k].0);
        let (from, to) = (at(j), at(i));
        let inside = (i + 1..j).filter(|&m| self.filter.orient2d(from, to, at(m)).is_positive());
        inside.reduce(
            |best, m| {
                if self.filter.in_circle(from, to, at(best), at(m)).is_positive() { m } else { best }
            },
        )
    }

    /// The corners of the triangle that will be where the vertex is.
    fn above(&self, v: u32, hole: &Hole) -> Option<[u32; 3]> {
        let q = self.point(v);
        let [mut i, mut j] = [0, hole.link.len() - 1];
        loop {
            let m = self.apex(hole, [i, j])?;
            let is_beyond = |a: usize, b: usize| {
                self.filter.orient2d(self.point(hole.link[a].0), self.point(hole.link[b].0), q).is_negative()
            };
            if is_beyond(i, m) {
                j = m;
            } else if is_beyond(m, j) {
                i = m;
            } else {
                return Some([i, m, j].map(|k| hole.link[k].0));
            }
        }
    }

    /// Finds all triangles that will be in a hole; whether there are some.
    fn cover(&self, hole: &mut Hole) -> bool {
        hole.fill.clear();
        hole.pending.clear();
        hole.pending.push(([0, hole.link.len() - 1], NONE));
        while let Some(([i, j], across)) = hole.pending.pop() {
            let Some(m) = self.apex(hole, [i, j]) else { return false };
            let t = hole.fill.len() as u32;
            hole.fill.push(Part { corners: [i, m, j], across });
            let sides = [([i, m], 3 * t), ([m, j], 3 * t + 1)];
            hole.pending.extend(sides.into_iter().filter(|([i, j], _)| j - i > 1));
        }
        true
    }

    /// Puts the triangles of a hole in the place of those around its vertex.
    fn close(&mut self, hole: &Hole, begins: &mut [u32]) {
        let Hole { star, link, fill, .. } = hole;
        for (&t, part) in star.iter().zip(fill) {
            let [i, m, j] = part.corners;
            let corners = [j, i, m].map(|i| link[i].0);
            self.triangles[t as usize] = Triangle { corners, across: [NONE; 3], fixed: 0 };
            let mut glue = |k: u32, across: u32, is_fixed: bool| {
                let triangle = &mut self.triangles[t as usize];
                triangle.across[k as usize] = across;
                triangle.fixed |= u8::from(is_fixed) << k;
                if across != NONE {
                    self.triangles[(across / 3) as usize].across[(across % 3) as usize] = 3 * t + k;
                }
            };
            for (k, first, last) in [(0, i, m), (1, m, j)] {
                if last - first == 1 {
                    glue(k, link[first].1, link[first].2);
                }
            }
            match part.across {
                NONE => glue(2, link[j].1, link[j].2),
                across => glue(2, 3 * star[(across / 3) as usize] + across % 3, false),
            }
            corners.iter().for_each(|&w| begins[w as usize] = t);
        }
        // Two are left over, whose places the last ones take.
        let [a, b] = [star[fill.len()], star[fill.len() + 1]];
        self.vacate(a.max(b), begins);
        self.vacate(a.min(b), begins);
    }

    /// Moves the last triangle to where one is that is not needed.
    fn vacate(&mut self, t: u32, begins: &mut [u32]) {
        let last = self.triangles.len() as u32 - 1;
        let moved = self.triangles[last as usize];
        self.triangles.pop();
        self.stamps.pop();
        if t == last {
            return;
        }
        self.triangles[t as usize] = moved;
        for (k, (&across, &v)) in (0..).zip(moved.across.iter().zip(&moved.corners)) {
            if across != NONE {
                self.triangles[(across / 3) as usize].across[(across % 3) as usize] = 3 * t + k;
            }
            if begins[v as usize] == last {
                begins[v as usize] = t;
            }
        }
    }

    /// Forgets vertices that no triangle has.
    fn rename(&mut self, is_left: &[bool]) {
        let mut count = 0;
        let name = |&is_left: &bool| {
            count += u32::from(is_left);
            count.wrapping_sub(1)
        };
        let names: Vec<u32> = is_left.iter().map(name).collect();
        for triangle in &mut self.triangles {
            triangle.corners = triangle.corners.map(|v| names[v as usize]);
        }
        let mut is_left = is_left.iter();
        self.points.retain(|_| is_left.next() != Some(&false));
        self.begins.truncate(self.points.len());
    }
}

impl<S: Samples> Greedy<'_, S> {
    /// Removes vertices from so many on that are not needed: nothing would be further away than allowed without them.
    pub(super) fn prune(&mut self, first: usize, allowed: f64) {
        let mut begins = vec![NONE; self.vertices.len()];
        for (t, triangle) in (0..).zip(&self.mesh.triangles) {
            triangle.corners.iter().for_each(|&v| begins[v as usize] = t);
        }
        let mut hole = Hole::default();
        for v in (first as u32..self.vertices.len() as u32).rev() {
            if !self.mesh.open(v, begins[v as usize], &mut hole) {
                continue;
            }
            let samples = |corners: [u32; 3]| corners.map(|v| self.vertices[v as usize]);
            // Most vertices are too far from what would be there themselves.
            let sample = self.vertices[v as usize];
            let is_near = |above| self.samples.error(samples(above), sample) <= allowed;
            if !self.mesh.above(v, &hole).is_some_and(is_near) || !self.mesh.cover(&mut hole) {
                continue;
            }
            let is_good = |corners| {
                self.samples.worst(samples(corners), allowed).is_none_or(|(error, _)| error <= allowed)
            };
            if hole.triangles().all(is_good) {
                self.mesh.close(&hole, &mut begins);
                begins[v as usize] = NONE;
            }
        }
        self.renumber();
        let is_left: Vec<bool> = (0..).zip(&begins).map(|(v, &t)| v < first || t != NONE).collect();
        self.mesh.rename(&is_left);
        let mut is_left = is_left.into_iter();
        self.vertices.retain(|_| is_left.next() != Some(false));
    }
}
