//! The triangles that samples are inserted into one by one: those of a constrained triangulation, decided by the filter of one box.
//!
//! Bowyer & Watson's insertion with the canonical in-circle test. Fixed edges bound cavities, as those of a constrained triangulation do,
//! so what comes out is the one canonical (constrained) triangulation of the vertices so far. Every point is inside of the hull that
//! there is at the beginning. Topology and cavities are those of `Delaunay2`; names, locators and kernels are left out.
//!
//! Cost: the walk, and O(1) for each triangle of the cavity.

use std::ops::Range;

use delone_predicates::{Filter, Sign, strictly_between};

use crate::ids::{EdgeId, Place, TriangleId};
use crate::locate::walk::{exit, walk};
use crate::mesh::Mesh2;
use crate::order::random::SplitMix;
use crate::plane::{Cavity, Constrained2};

/// See the module.
#[derive(Debug)]
pub(super) struct Mesh {
    pub(super) base: Mesh2,
    /// The coordinates of the vertices, by place. A new vertex has a new place.
    points: Vec<[f64; 2]>,
    pub(super) filter: Filter,
    cavity: Cavity,
}

/// The place where a point falls.
enum Spot {
    Inside(TriangleId),
    /// On this edge, not at its ends.
    Edge(EdgeId),
    /// On a vertex, or outside of all triangles.
    Nowhere,
}

impl Mesh {
    pub(super) fn new(triangulation: Constrained2, filter: Filter) -> Self {
        let (base, points) = triangulation.into_parts();
        Self { base, points, filter, cavity: Cavity::default() }
    }

    pub(super) fn point(&self, v: Place) -> [f64; 2] {
        self.points[v.index()]
    }

    pub(super) fn side(&self, from: Place, to: Place, q: [f64; 2]) -> Sign {
        self.filter.orient2d(self.point(from), self.point(to), q)
    }

    /// The finite triangles of some slots.
    pub(super) fn triangles(&self, slots: Range<usize>) -> impl Iterator<Item = TriangleId> {
        slots.map(TriangleId::new).filter(|&t| !self.base.is_ghost(t))
    }

    /// Walks from a triangle to where a point is. Exact.
    fn spot(&self, from: TriangleId, q: [f64; 2]) -> Spot {
        let mesh = &self.base;
        let side = |e: EdgeId| self.side(mesh.tail(e), mesh.head(e), q);
        let is_beyond = |e: EdgeId| side(e).is_negative();
        let edges = |t: TriangleId| [0, 1, 2].map(|k| t.edge(k)).into_iter();
        let from = mesh.finite_side(from.edge(0)).triangle();
        let Some(first) = edges(from).find(|&e| !is_beyond(e)) else { return Spot::Nowhere };
        // Walks among constraints may turn in circles if they are not random.
        let mut random = SplitMix(1);
        let end = walk(first, usize::MAX, |entered| {
            if mesh.tip(entered).is_ghost() {
                return None;
            }
            let is_turned = mesh.is_tagged && random.next() & 1 == 1;
            exit(entered, is_turned, is_beyond).map(|crossed| mesh.twin(crossed))
        });
        let t = end.at.triangle();
        if mesh.places(t).into_iter().any(|v| v.is_ghost() || self.point(v) == q) {
            return Spot::Nowhere;
        }
        edges(t).find(|&e| side(e).is_zero()).map_or(Spot::Inside(t), Spot::Edge)
    }

    /// The triangles that a point is in or on the border of, from another one; none outside of all, and for a vertex.
    pub(super) fn around(&self, from: TriangleId, q: [f64; 2]) -> [Option<TriangleId>; 2] {
        match self.spot(from, q) {
            Spot::Inside(t) => [Some(t), None],
            Spot::Edge(e) => {
                let beyond = self.base.twin(e).triangle();
                [Some(e.triangle()), Some(beyond).filter(|&t| !self.base.is_ghost(t))]
            }
            Spot::Nowhere => [None; 2],
        }
    }

    /// Makes a point a vertex, from a triangle near it. Says whether it is one: a point that is a vertex already is not, nor one that
    /// is outside.
    pub(super) fn insert(&mut self, q: [f64; 2], from: TriangleId) -> bool {
        let (seed, on) = match self.spot(from, q) {
            Spot::Nowhere => return false,
            Spot::Inside(t) => (t, None),
            Spot::Edge(e) => (e.triangle(), Some(e).filter(|&e| self.base.is_fixed(e))),
        };
        let Self { base, points, filter, cavity } = self;
        let v = Place::new(points.len());
        base.incident.push(EdgeId::NONE);
        points.push(q);
        let ends = on.map(|e| [base.tail(e), base.head(e)]);
        on.into_iter().for_each(|e| base.set_fixed(e, false));
        cavity.find(base, points, seed, |corners| {
            let point = |k: usize| points[corners[k % 3].index()];
            match corners.iter().position(|corner| corner.is_ghost()) {
                None => filter.in_circle(point(0), point(1), point(2), q).is_positive(),
                Some(k) => {
                    let (u, v) = (point(k + 1), point(k + 2));
                    let side = filter.orient2d(u, v, q);
                    side.is_positive() || side.is_zero() && strictly_between(u, v, q)
                }
            }
        });
        cavity.fill(base, v);
        for end in ends.into_iter().flatten() {
            base.edge_between(v, end).into_iter().for_each(|e| base.set_fixed(e, true));
        }
        true
    }

    /// The triangles around the last vertex, ghosts included, in the slots of all that are gone, and in others.
    pub(super) fn star(&self) -> &[TriangleId] {
        self.cavity.last().0
    }
}
