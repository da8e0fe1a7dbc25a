//! Sizes: the length that edges are to have at each vertex.
//!
//! A size is the least of the length that was asked for, of the gap to what is across the mesh, and of the size of another vertex and what
//! may be grown on the way from there.
//!
//! Source: the limit of growth is that of Persson, "Mesh size functions for implicit geometries and PDE-based gradient limiting", Eng. with
//! Comput. 2006, along edges by Dijkstra's algorithm.
//!
//! Cost: O(n log n).

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::super::mesher::Mesher;
use super::{Frontal, distance};
use crate::ids::{EdgeId, Place};

/// An edge across a gap is to be this many times as long as a size, or less: so a gap as wide as a size is one triangle wide.
const ACROSS_GAP: f64 = 1.1;
/// A height across a gap is to be an equilateral triangle's of the size, or more: two over the square root of three.
const ACROSS_HEIGHT: f64 = 1.155;

/// Gaps that ask for less than this part of the length that is wanted are left to refinement: it knows which it can fill, and when to end.
/// At vertices of the input, which do not become more, the part is a millionth: sizes grow from there at once.
const NARROWEST_GAP: [f64; 2] = [1.0 / 64.0, 1e-6];

/// See the module.
#[derive(Clone, Debug)]
pub(super) struct Sizes {
    /// By place.
    of: Vec<f64>,
    /// How much a size may grow on a way of length one.
    pub(super) slope: f64,
}

impl Sizes {
    /// Of no vertex yet.
    pub(super) fn new(slope: f64) -> Self {
        Self { of: Vec::new(), slope }
    }

    /// The size at a vertex.
    pub(super) fn at(&self, p: Place) -> f64 {
        self.of[p.index()]
    }

    /// The size that a vertex allows at a distance.
    pub(super) fn from(&self, p: Place, distance: f64) -> f64 {
        self.of[p.index()] + self.slope * distance
    }

    /// Sets the size at a new vertex.
    pub(super) fn set(&mut self, p: Place, size: f64) {
        if self.of.len() <= p.index() {
            self.of.resize(p.index() + 1, f64::INFINITY);
        }
        self.of[p.index()] = size;
    }

    /// Gives vertices that refinement added, some at places of others that went, the mean length of their edges.
    pub(super) fn resize(&mut self, mesher: &Mesher, added: &[Place]) {
        let mesh = &mesher.layer.mesh;
        for &p in added.iter().filter(|p| mesh.is_vertex(**p)) {
            let mut star: Vec<EdgeId> = mesh.spokes(p).filter(|&e| !mesh.head(e).is_ghost()).collect();
            mesher.turn_to_least(&mut star);
            let lengths = star.iter().map(|&e| distance(mesher.point(p), mesher.point(mesh.head(e))));
            self.set(p, lengths.sum::<f64>() / star.len() as f64);
        }
    }
}

impl Frontal<'_, '_> {
    /// Finds the sizes at all vertices there are, which are on constraints but for those of the input. Pairs of constraints are no gap to each
    /// other where `is_joined` says so of vertices on them.
    pub(super) fn find_sizes(&mut self, is_joined: impl Fn(&Self, Place, Place) -> bool) {
        let mesh = &self.mesher.layer.mesh;
        let mut of = vec![f64::INFINITY; self.mesher.layer.points.len()];
        for p in mesh.inhabited() {
            of[p.index()] = self.mesher.rules.length_at(self.point(p));
        }
        let wanted = of.clone();
        let narrowest = |p: Place| {
            let is_input = self.mesher.known[p.index()].is_input();
            NARROWEST_GAP[usize::from(is_input)] * wanted[p.index()].min(self.extent)
        };
        for t in mesh.triangles().filter(|&t| self.mesher.is_inside(t)) {
            let own = self.mesher.rules.length_in(mesh.domain(t));
            for e in [0, 1, 2].map(|k| t.edge(k)) {
                let [u, v, w] = [mesh.tail(e), mesh.head(e), mesh.tip(e)];
                lower(&mut of, u, own);
                if mesh.is_fixed(e) {
                    if !is_joined(self, w, u) && !is_joined(self, w, v) {
                        let height = to_segment(self.point(w), [u, v].map(|p| self.point(p)));
                        lower(&mut of, w, (ACROSS_HEIGHT * height).max(narrowest(w)));
                    }
                } else if !is_joined(self, u, v) {
                    let length = ACROSS_GAP * self.distance(u, v);
                    [u, v].into_iter().for_each(|p| lower(&mut of, p, length.max(narrowest(p))));
                }
            }
        }
        self.sizes.of = of;
    }

    /// Lowers sizes until none is larger than another one and what may be grown on the way from there.
    pub(super) fn limit_growth(&mut self) {
        let mesh = &self.mesher.layer.mesh;
        let task = |p: Place, size: f64| (Reverse(size.to_bits()), p);
        let finite = mesh.inhabited().filter(|p| self.sizes.at(*p).is_finite());
        let mut heap: BinaryHeap<_> = finite.map(|p| task(p, self.sizes.at(p))).collect();
        while let Some((Reverse(bits), p)) = heap.pop() {
            if self.sizes.at(p).to_bits() != bits {
                continue;
            }
            for e in mesh.spokes(p) {
                let q = mesh.head(e);
                let is_inside = [e, mesh.twin(e)].iter().any(|e| self.mesher.is_inside(e.triangle()));
                if q.is_ghost() || !is_inside {
                    continue;
                }
                let size = self.sizes.from(p, self.distance(p, q));
                if size < self.sizes.at(q) {
                    self.sizes.of[q.index()] = size;
                    heap.push(task(q, size));
                }
            }
        }
    }
}

/// Lowers a size.
fn lower(of: &mut [f64], p: Place, size: f64) {
    of[p.index()] = of[p.index()].min(size);
}

/// The distance from a point to a segment, rounded.
fn to_segment(q: [f64; 2], [a, b]: [[f64; 2]; 2]) -> f64 {
    let (u, w) = ([b[0] - a[0], b[1] - a[1]], [q[0] - a[0], q[1] - a[1]]);
    let part = ((u[0] * w[0] + u[1] * w[1]) / (u[0] * u[0] + u[1] * u[1])).clamp(0.0, 1.0);
    distance(q, [a[0] + part * u[0], a[1] + part * u[1]])
}
