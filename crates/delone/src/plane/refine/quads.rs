//! Triangles in pairs that make convex quadrilaterals, for solvers that want these.
//!
//! Pairs are taken one after the other: first of triangles that have one partner left, then by how near their angles are to right ones, then
//! by the middle of the edge between. The first rule leaves few triangles over (Karp & Sipser, "Maximum matchings in sparse random graphs",
//! FOCS 1981).
//!
//! Cost: O(n log n).

use std::cmp::Reverse;
use std::collections::{BTreeSet, BinaryHeap};

use delone_predicates::orient2d;

use super::Refined2;
use super::all_quads::range_of_angles;
use crate::ids::{EdgeId, TriangleId, VertexId};
use crate::plane::Constrained2;

/// The largest squared cosine of an angle of a quadrilateral: angles are from 30 to 150 degrees. Two equilateral triangles have 60 and 120.
const LARGEST_SQUARED_COSINE: f64 = 0.75;

/// Quadrilaterals and triangles that cover the inside of a mesh. No quadrilateral crosses a constraint.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Quads2 {
    /// The corners of each quadrilateral, counter-clockwise; its diagonal is from the first to the third.
    pub corners: Vec<[VertexId; 4]>,
    /// The two triangles of each.
    pub pairs: Vec<[TriangleId; 2]>,
    /// Triangles that stay, by id.
    pub triangles: Vec<TriangleId>,
}

/// A pair: whether both have other partners, the bits of its squared cosine, the middle of its diagonal in an order of numbers.
type Rank = (bool, u64, [u64; 2]);

impl Quads2 {
    /// Pairs the triangles inside whose quadrilateral is convex, exactly, with angles from 30 to 150 degrees, rounded.
    ///
    /// Cost: O(n log n).
    ///
    /// ```
    /// use delone::{Constrained2, Quads2, Refinement};
    ///
    /// let mut c = Constrained2::from_parts(&[[0, 0], [3, 0], [3, 2], [0, 2]], &[])?;
    /// let refined = Refinement::new().edge(0.25).run(&mut c)?;
    /// let quads = Quads2::of(&c, &refined);
    /// assert_eq!(2 * quads.corners.len() + quads.triangles.len(), refined.report.triangles);
    /// assert!(quads.triangles.len() * 5 < refined.report.triangles);
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn of(c: &Constrained2, refined: &Refined2) -> Self {
        let mut pairing = Pairing::new(c, refined);
        pairing.run();
        pairing.quads()
    }

    /// The smallest and the largest angle of the quadrilaterals in degrees, rounded; nothing if there are none.
    pub fn angles(&self, c: &Constrained2) -> Option<[f64; 2]> {
        range_of_angles(self.corners.iter().map(|corners| corners.map(|v| c.point(v))))
    }
}

/// The state of a pairing.
struct Pairing<'a> {
    c: &'a Constrained2,
    refined: &'a Refined2,
    /// For each triangle, by index, the edges across which it may be paired with their squared cosines.
    partners: Vec<[Option<f64>; 3]>,
    is_paired: Vec<bool>,
    /// The diagonals of the pairs.
    diagonals: Vec<EdgeId>,
    queue: BinaryHeap<Reverse<(Rank, EdgeId)>>,
}

impl<'a> Pairing<'a> {
    fn new(c: &'a Constrained2, refined: &'a Refined2) -> Self {
        let count = c.mesh().slot_count();
        let (partners, is_paired) = (vec![[None; 3]; count], vec![false; count]);
        let mut made =
            Self { c, refined, partners, is_paired, diagonals: Vec::new(), queue: BinaryHeap::new() };
        let edges: Vec<EdgeId> = made.inside().flat_map(|t| [0, 1, 2].map(|k| t.edge(k))).collect();
        for e in edges {
            made.partners[e.triangle().index()][e.corner()] = made.squared_cosine(e);
        }
        made
    }

    fn inside(&self) -> impl Iterator<Item = TriangleId> + use<'a> {
        let (c, refined) = (self.c, self.refined);
        c.triangle_ids().filter(move |&t| refined.domains.is_inside(t))
    }

    /// The corners of the quadrilateral around an edge, from its origin on.
    fn corners(&self, e: EdgeId) -> [VertexId; 4] {
        let mesh = self.c.mesh();
        [mesh.origin(e), mesh.apex(mesh.twin(e)), mesh.destination(e), mesh.apex(e)]
    }

    /// The largest squared cosine of an angle of the quadrilateral around an edge, if it can be one.
    fn squared_cosine(&self, e: EdgeId) -> Option<f64> {
        let other = self.c.mesh().twin(e).triangle();
        let is_part = self.refined.domains.is_inside(other)
            && (!self.c.is_constraint(e) || self.refined.only_keeps(self.c, e));
        if !is_part {
            return None;
        }
        let p = self.corners(e).map(|v| self.c.point(v));
        let mut worst = 0.0_f64;
        for k in 0..4 {
            let [before, at, after] = [p[(k + 3) % 4], p[k], p[(k + 1) % 4]];
            if !orient2d(before, at, after).is_positive() {
                return None;
            }
            let (u, v) = (direction(at, after), direction(at, before));
            let (dot, of_u) = (u[0] * v[0] + u[1] * v[1], u[0] * u[0] + u[1] * u[1]);
            let square = dot * dot / (of_u * (v[0] * v[0] + v[1] * v[1]));
            worst = if square <= LARGEST_SQUARED_COSINE { worst.max(square) } else { return None };
        }
        Some(worst)
    }

    /// The edges across which a triangle may be paired still.
    fn open(&self, t: TriangleId) -> impl Iterator<Item = EdgeId> {
        let edges = [0, 1, 2].map(|k| t.edge(k));
        edges.into_iter().filter(move |&e| self.is_open(e))
    }

    fn is_open(&self, e: EdgeId) -> bool {
        let sides = [e, self.c.mesh().twin(e)].map(|e| e.triangle());
        let is_free = sides.iter().all(|t| !self.is_paired[t.index()]);
        is_free && self.partners[e.triangle().index()][e.corner()].is_some()
    }

    fn rank(&self, e: EdgeId) -> Rank {
        let mesh = self.c.mesh();
        let has_others = [e, mesh.twin(e)].iter().all(|e| self.open(e.triangle()).count() > 1);
        let [p, q] = [mesh.origin(e), mesh.destination(e)].map(|v| self.c.point(v));
        let weight = self.partners[e.triangle().index()][e.corner()].unwrap_or(f64::INFINITY);
        (has_others, weight.to_bits(), [0, 1].map(|k| ordered(0.5 * p[k] + 0.5 * q[k])))
    }

    fn push(&mut self, e: EdgeId) {
        let e = e.min(self.c.mesh().twin(e));
        let rank = self.rank(e);
        self.queue.push(Reverse((rank, e)));
    }

    fn run(&mut self) {
        let all: Vec<EdgeId> = self.inside().flat_map(|t| [0, 1, 2].map(|k| t.edge(k))).collect();
        let mesh = self.c.mesh();
        for e in all.into_iter().filter(|&e| e < mesh.twin(e)) {
            if self.is_open(e) {
                self.push(e);
            }
        }
        while let Some(Reverse((rank, e))) = self.queue.pop() {
            if !self.is_open(e) {
                continue;
            }
            if self.rank(e) != rank {
                self.push(e);
                continue;
            }
            let sides = [e, mesh.twin(e)].map(|e| e.triangle());
            sides.iter().for_each(|t| self.is_paired[t.index()] = true);
            self.diagonals.push(e);
            // Neighbors have a partner less.
            let around = sides.iter().flat_map(|t| [0, 1, 2].map(|k| mesh.twin(t.edge(k)).triangle()));
            let fewer: BTreeSet<EdgeId> = around.flat_map(|t| self.open(t).collect::<Vec<_>>()).collect();
            fewer.into_iter().for_each(|e| self.push(e));
        }
    }

    fn quads(self) -> Quads2 {
        let mesh = self.c.mesh();
        let mut diagonals = self.diagonals.clone();
        diagonals.sort_unstable();
        Quads2 {
            corners: diagonals.iter().map(|&e| self.corners(e)).collect(),
            pairs: diagonals.iter().map(|&e| [e, mesh.twin(e)].map(|e| e.triangle())).collect(),
            triangles: self.inside().filter(|t| !self.is_paired[t.index()]).collect(),
        }
    }
}

/// From one point towards another one, with a largest coordinate of one: so that squares stay in the range of numbers.
pub(super) fn direction(from: [f64; 2], to: [f64; 2]) -> [f64; 2] {
    // Halves, because a difference may be too large.
    let d = [0, 1].map(|k| 0.5 * to[k] - 0.5 * from[k]);
    let largest = d[0].abs().max(d[1].abs());
    d.map(|x| x / largest)
}

/// A number whose order is that of the given one.
fn ordered(x: f64) -> u64 {
    let bits = (x + 0.0).to_bits();
    if bits >> 63 == 1 { !bits } else { bits | 1 << 63 }
}
