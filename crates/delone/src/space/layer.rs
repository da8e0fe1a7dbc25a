//! A triangulation of space that can change: topology, coordinates by place, static filter, and the buffers of its
//! operations. It knows no strategy of location.
//!
//! Points that span less than space have the same mesh: *scaffold* points off their span make up for what is missing,
//! three for a point, two for a line, one for a plane. What is in the span does not depend on them: with coplanar points
//! and one apex, a point of the plane is in the sphere of a triangle and the apex exactly if it is in the circle of the
//! triangle, ties included, because the height of the apex has no part in it.

use delone_predicates::{Filter3, Grid, orient2d, orient3d};

use super::cavity::Cavity;
use crate::ids::{Place, TetrahedronId};
use crate::locate::tally::Tally;
use crate::mesh::Dimension;
use crate::mesh::tetrahedra::{FACETS, Mesh3, Tetrahedron};

/// See the module.
#[derive(Clone, Debug, Default)]
pub(super) struct Layer {
    pub(super) mesh: Mesh3,
    /// For each place its coordinates.
    pub(super) points: Vec<[f64; 3]>,
    /// The box around all points, and a lattice that they are on.
    limits: Limits,
    pub(super) filter: Filter3,
    /// The places of scaffold points.
    pub(super) scaffold: Vec<Place>,
    pub(super) cavity: Cavity,
}

/// The box around points, axis by axis.
#[derive(Clone, Copy, Debug)]
struct Limits {
    low: [f64; 3],
    high: [f64; 3],
}

impl Default for Limits {
    fn default() -> Self {
        Self { low: [f64::INFINITY; 3], high: [f64::NEG_INFINITY; 3] }
    }
}

impl Limits {
    fn include(&mut self, p: [f64; 3]) -> bool {
        let mut grown = false;
        for k in 0..3 {
            if p[k] < self.low[k] {
                (self.low[k], grown) = (p[k], true);
            }
            if p[k] > self.high[k] {
                (self.high[k], grown) = (p[k], true);
            }
        }
        grown
    }

    fn extent(&self) -> [f64; 3] {
        [0, 1, 2].map(|k| (self.high[k] - self.low[k]).max(0.0))
    }
}

/// Whether three points are on one line.
pub(super) fn are_collinear(a: [f64; 3], b: [f64; 3], c: [f64; 3]) -> bool {
    (0..3).all(|k| {
        let [a, b, c] = [a, b, c].map(|p| [p[(k + 1) % 3], p[(k + 2) % 3]]);
        orient2d(a, b, c).is_zero()
    })
}

impl Layer {
    /// Points at their places, none a vertex yet.
    pub(super) fn new(points: Vec<[f64; 3]>) -> Self {
        let mut limits = Limits::default();
        points.iter().for_each(|&p| _ = limits.include(p));
        let grid = Grid::of(points.as_flattened().iter().copied());
        let mesh = Mesh3 { incident: vec![TetrahedronId::NONE; points.len()], ..Mesh3::default() };
        let filter = Filter3::for_box(limits.extent(), grid);
        Self { mesh, points, limits, filter, ..Self::default() }
    }

    /// Keeps a point at a new place. It is no vertex yet.
    pub(super) fn keep(&mut self, q: [f64; 3]) -> Place {
        if self.limits.include(q) {
            self.filter = Filter3::for_box(self.limits.extent(), None);
        }
        self.points.push(q);
        self.mesh.incident.push(TetrahedronId::NONE);
        self.mesh.names.add_place();
        Place::new(self.points.len() - 1)
    }

    /// What the vertices span.
    pub(super) fn dimension(&self) -> Dimension {
        match (self.mesh.vertex_count, self.scaffold.len()) {
            (0, _) => Dimension::Empty,
            (_, 3) => Dimension::Point,
            (_, 2) => Dimension::Line,
            (_, 1) => Dimension::Plane,
            _ => Dimension::Space,
        }
    }

    pub(super) fn is_scaffold(&self, p: Place) -> bool {
        self.scaffold.contains(&p)
    }

    /// Begins with the first of some places whose points span as much as all of them do; returns those that are
    /// vertices now. The mesh must be empty.
    pub(super) fn begin(&mut self, order: &[u32]) -> Vec<Place> {
        let at = |i: u32| self.points[i as usize];
        let Some(&a) = order.first() else { return Vec::new() };
        let (mut corners, p) = (vec![a], at(a));
        if let Some(&b) = order.iter().find(|&&b| at(b) != p) {
            corners.push(b);
            if let Some(&c) = order.iter().find(|&&c| !are_collinear(p, at(b), at(c))) {
                corners.push(c);
                corners.extend(order.iter().find(|&&d| !orient3d(p, at(b), at(c), at(d)).is_zero()));
            }
        }
        let vertices: Vec<Place> = corners.iter().map(|&i| Place::new(i as usize)).collect();
        let scaffold: Vec<[f64; 3]> = self.off_span(&vertices);
        self.scaffold = scaffold.into_iter().map(|p| self.keep(p)).collect();
        let mut four: Vec<Place> = vertices.iter().chain(&self.scaffold).copied().collect();
        let [a, b, c, d] = [0, 1, 2, 3].map(|k| self.points[four[k].index()]);
        if orient3d(a, b, c, d).is_negative() {
            four.swap(0, 1);
        }
        self.mesh.vertex_count = vertices.len();
        self.first_cells([four[0], four[1], four[2], four[3]]);
        vertices
    }

    /// Points that make four with one to three others, which span one dimension less than they are.
    fn off_span(&self, vertices: &[Place]) -> Vec<[f64; 3]> {
        let at = |k: usize| self.points[vertices[k].index()];
        let a = at(0);
        // Away from the first point along one axis, by about the size of the whole.
        let moved = |axis: usize| {
            let (x, size) = (a[axis], self.limits.extent().into_iter().fold(0.0, f64::max));
            let far = [x + size, x - size, 0.0, 1.0].into_iter().find(|y| y.is_finite() && *y != x);
            let mut p = a;
            p[axis] = far.unwrap_or(2.0);
            p
        };
        match vertices.len() {
            1 => [0, 1, 2].map(moved).to_vec(),
            2 => {
                let along = (0..3).find(|&k| at(1)[k] != a[k]).unwrap_or(0);
                [(along + 1) % 3, (along + 2) % 3].map(moved).to_vec()
            }
            3 => {
                let seen = |k: usize| {
                    let [a, b, c] = [a, at(1), at(2)].map(|p| [p[(k + 1) % 3], p[(k + 2) % 3]]);
                    !orient2d(a, b, c).is_zero()
                };
                vec![moved((0..3).find(|&k| seen(k)).unwrap_or(2))]
            }
            _ => Vec::new(),
        }
    }

    /// A tetrahedron of four places in positive order, and the ghosts around it.
    fn first_cells(&mut self, corners: [Place; 4]) {
        let mesh = &mut self.mesh;
        let first = mesh.new_cell();
        mesh.cells[first.index()] = Tetrahedron { corners, ..Tetrahedron::FREE };
        let ghosts = [0, 1, 2, 3].map(|k| {
            let t = mesh.new_cell();
            // Seen from the other side.
            let [a, b, c] = FACETS[k].map(|i| corners[i]);
            mesh.cells[t.index()].corners = [a, c, b, Place::GHOST];
            mesh.link(first.facet(k), t.facet(3));
            mesh.incident[corners[k].index()] = first;
            t
        });
        for (i, &t) in ghosts.iter().enumerate() {
            for (j, &u) in ghosts.iter().enumerate().filter(|&(j, _)| j != i) {
                // They share all but the corners i and j of the first.
                let corner = |t: TetrahedronId, p: Place| {
                    mesh.cells[t.index()].corners.iter().position(|&q| q == p).unwrap_or(3)
                };
                let (f, g) = (t.facet(corner(t, corners[j])), u.facet(corner(u, corners[i])));
                mesh.link(f, g);
            }
        }
    }

    /// Whether a point is in what the vertices span.
    pub(super) fn is_in_span(&self, q: [f64; 3]) -> bool {
        if self.scaffold.is_empty() {
            return self.mesh.vertex_count > 0;
        }
        let cell = self.mesh.cells().find(|&t| !self.mesh.is_ghost(t)).map(|t| self.mesh.cells[t.index()]);
        let corners = cell.into_iter().flat_map(|cell| cell.corners).filter(|p| !self.is_scaffold(*p));
        match corners.map(|p| self.points[p.index()]).collect::<Vec<_>>()[..] {
            [a] => a == q,
            [a, b] => are_collinear(a, b, q),
            [a, b, c] => orient3d(a, b, c, q).is_zero(),
            _ => false,
        }
    }

    /// Whether the sphere of a tetrahedron contains `q`. That of a ghost is the half-space beyond its hull facet, with
    /// the inside of the facet's circle.
    #[inline]
    pub(super) fn conflicts(&self, t: TetrahedronId, q: [f64; 3]) -> bool {
        let [a, b, c, d] = self.mesh.cells[t.index()].corners;
        if d.is_ghost() {
            return self.is_beyond_hull(t, q);
        }
        let at = |p: Place| self.points[p.index()];
        self.filter.in_sphere(at(a), at(b), at(c), at(d), q).is_positive()
    }

    /// The same for a ghost.
    fn is_beyond_hull(&self, t: TetrahedronId, q: [f64; 3]) -> bool {
        let cell = &self.mesh.cells[t.index()];
        let [a, b, c] = [0, 1, 2].map(|k| self.points[cell.corners[k].index()]);
        let side = self.filter.orient3d(a, b, c, q);
        if !side.is_zero() {
            return side.is_positive();
        }
        // In the plane of the facet the sphere of the tetrahedron inside cuts out its circle.
        let inner = &self.mesh.cells[cell.across[3].tetrahedron().index()];
        let [a, b, c, d] = inner.corners.map(|p| self.points[p.index()]);
        self.filter.in_sphere(a, b, c, d, q).is_positive()
    }

    /// Walks to `q` from a tetrahedron: to a finite one that contains it in its inside or on its border, or else to the
    /// ghost of a hull facet that it is strictly beyond. Visibility walk, which ends in every Delaunay triangulation.
    #[inline]
    pub(super) fn walk<T: Tally>(&self, from: TetrahedronId, q: [f64; 3], tally: &mut T) -> TetrahedronId {
        let mut t = from;
        if self.mesh.is_ghost(t) {
            t = self.mesh.twin(t.facet(3)).tetrahedron();
        }
        let mut entered = 4;
        'walk: loop {
            tally.visited();
            let cell = &self.mesh.cells[t.index()];
            if cell.corners[3].is_ghost() {
                return t;
            }
            let [a, b, c, d] = cell.corners;
            let at = |p: Place| self.points[p.index()];
            let points = [at(a), at(b), at(c), at(d)];
            for k in 0..4 {
                if k == entered {
                    continue;
                }
                tally.orientation();
                let [i, j, l] = FACETS[k];
                if self.filter.orient3d(points[i], points[j], points[l], q).is_negative() {
                    let across = cell.across[k];
                    (t, entered) = (across.tetrahedron(), across.corner());
                    continue 'walk;
                }
            }
            return t;
        }
    }

    /// The vertex of a tetrahedron that a point equals.
    #[inline]
    pub(super) fn vertex_at(&self, t: TetrahedronId, q: [f64; 3]) -> Option<Place> {
        let corners = self.mesh.cells[t.index()].corners;
        corners.into_iter().find(|p| !p.is_ghost() && self.points[p.index()] == q && !self.is_scaffold(*p))
    }

    /// Makes the point at a place a vertex, from a tetrahedron in conflict with it.
    #[inline]
    pub(super) fn insert<T: Tally>(&mut self, v: Place, seed: TetrahedronId, tally: &mut T) {
        let mut cavity = std::mem::take(&mut self.cavity);
        cavity.insert(self, v, seed, tally);
        self.cavity = cavity;
        self.mesh.vertex_count += 1;
    }
}
