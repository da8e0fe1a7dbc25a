//! Vertices that are not needed in the end: what is chosen early is often made superfluous by what is chosen later.
//!
//! The triangles around a vertex are a hole, and each edge of it gets the corner whose circle is empty of the others, as in the removal
//! from any Delaunay triangulation; if no sample is too far from the triangles that come of it, the vertex goes. The last ones that were
//! chosen are asked first, and each once, so what is left is again a matter of the set of points alone.
//!
//! Cost: for a vertex the samples in its star, and O(k^2) for k neighbors; one with many is left, which bounds that.

use super::Samples;
use super::greedy::Greedy;
use super::mesh::Mesh;
use crate::ids::{EdgeId, Place, TriangleId};
use crate::mesh::triangles::surgery::BorderEdge;

/// A vertex with more neighbors stays.
const NEIGHBOURS: usize = 64;

/// The place of a vertex that may go: its triangles, and what shall be there.
#[derive(Debug, Default)]
pub(super) struct Hole {
    star: Vec<TriangleId>,
    /// The edges around it, counter-clockwise: where each begins, and its twin outside.
    border: Vec<BorderEdge>,
    /// The corners of the triangles that shall be there, counter-clockwise, by number: the second is the apex of the side between the
    /// others. They come in the order in which surgery fills the hole.
    fill: Vec<[usize; 3]>,
    pending: Vec<[usize; 2]>,
}

impl Hole {
    /// The vertices of some corners.
    fn at(&self, corners: [usize; 3]) -> [Place; 3] {
        corners.map(|i| self.border[i].0)
    }
}

impl Mesh {
    /// Looks at the triangles around a vertex. Says whether there is one on all sides, no fixed edge ends there, and they are not too
    /// many.
    fn open(&self, v: Place, hole: &mut Hole) -> bool {
        hole.star.clear();
        hole.border.clear();
        for spoke in self.base.spokes(v) {
            let side = spoke.next();
            hole.star.push(spoke.triangle());
            hole.border.push((self.base.tail(side), self.base.twin(side)));
            let is_at_hull = self.base.head(spoke).is_ghost();
            if is_at_hull || self.base.is_fixed(spoke) || hole.star.len() > NEIGHBOURS {
                return false;
            }
        }
        true
    }

    /// The corner of the triangle on the left of the edge from a corner of the hole back to an earlier one.
    fn apex(&self, hole: &Hole, [i, j]: [usize; 2]) -> Option<usize> {
        let at = |k: usize| self.point(hole.border[k].0);
        let (from, to) = (at(j), at(i));
        let inside = (i + 1..j).filter(|&m| self.filter.orient2d(from, to, at(m)).is_positive());
        inside.reduce(
            |best, m| {
                if self.filter.in_circle(from, to, at(best), at(m)).is_positive() { m } else { best }
            },
        )
    }

    /// The corners of the triangle that will be where the vertex is.
    fn above(&self, v: Place, hole: &Hole) -> Option<[Place; 3]> {
        let q = self.point(v);
        let [mut i, mut j] = [0, hole.border.len() - 1];
        loop {
            let m = self.apex(hole, [i, j])?;
            let is_beyond =
                |a: usize, b: usize| self.side(hole.border[a].0, hole.border[b].0, q).is_negative();
            if is_beyond(i, m) {
                j = m;
            } else if is_beyond(m, j) {
                i = m;
            } else {
                return Some(hole.at([i, m, j]));
            }
        }
    }

    /// Finds all triangles that will be in a hole; whether there are some.
    fn cover(&self, hole: &mut Hole) -> bool {
        hole.fill.clear();
        hole.pending.clear();
        hole.pending.push([0, hole.border.len() - 1]);
        while let Some([i, j]) = hole.pending.pop() {
            let Some(m) = self.apex(hole, [i, j]) else { return false };
            hole.fill.push([i, m, j]);
            hole.pending.extend([[i, m], [m, j]].into_iter().filter(|[i, j]| j - i > 1));
        }
        true
    }

    /// Puts the triangles of a hole in the place of those around its vertex.
    fn close(&mut self, v: Place, hole: &Hole) {
        let mut fill = hole.fill.iter();
        let apex = |_, last, ()| (fill.next().map_or(last - 1, |corners| corners[1]), (), ());
        self.base.fill_hole(&hole.border, &hole.star, &mut Vec::new(), (), apex);
        hole.star[..2].iter().for_each(|&t| self.base.free_triangle(t));
        self.base.incident[v.index()] = EdgeId::NONE;
        self.base.vertex_count -= 1;
    }
}

impl<S: Samples> Greedy<'_, S> {
    /// Removes vertices from so many on that are not needed: nothing would be further away than allowed without them.
    pub(super) fn prune(&mut self, first: usize, allowed: f64) {
        let mut hole = Hole::default();
        for v in (first..self.vertices.len()).rev().map(Place::new) {
            if !self.mesh.open(v, &mut hole) {
                continue;
            }
            let samples = |corners: [Place; 3]| corners.map(|v| self.vertices[v.index()]);
            // Most vertices are too far from what would be there themselves.
            let sample = self.vertices[v.index()];
            let is_near = |above| self.samples.error(samples(above), sample) <= allowed;
            if !self.mesh.above(v, &hole).is_some_and(is_near) || !self.mesh.cover(&mut hole) {
                continue;
            }
            let is_good = |&corners: &[usize; 3]| {
                let corners = samples(hole.at(corners));
                self.samples.worst(corners, allowed).is_none_or(|(error, _)| error <= allowed)
            };
            if hole.fill.iter().all(is_good) {
                self.mesh.close(v, &hole);
            }
        }
        self.forget();
    }
}
