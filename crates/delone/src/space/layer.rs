//! A triangulation of space that can change: topology, coordinates by place, static filter, and the buffers of its
//! operations. It knows no strategy of location.
//!
//! Points that span less than space have the same mesh: *scaffold* points off their span make up for what is missing,
//! three for a point, two for a line, one for a plane. What is in the span does not depend on them: with coplanar points
//! and one apex, a point of the plane is in the sphere of a triangle and the apex exactly if it is in the circle of the
//! triangle, ties included, because the height of the apex has no part in it.

use std::cmp::Ordering;

use delone_predicates::{Filter3, Grid, compare_distances3, orient2d, orient3d};

use super::build;
use super::cavity::Cavity;
use super::remove::Hole;
use crate::fetch::fetch;
use crate::ids::{Place, TetrahedronId};
use crate::locate::tally::Tally;
use crate::locate::{Ground, Level, Start};
use crate::mesh::Dimension;
use crate::mesh::tetrahedra::{FACETS, Mesh3, Tetrahedron};
use crate::order::curve;

/// See the module.
#[derive(Clone, Debug, Default)]
pub(super) struct Layer {
    pub(super) mesh: Mesh3,
    /// For each place its coordinates.
    pub(super) points: Vec<[f64; 3]>,
    /// Places without a point.
    free: Vec<Place>,
    /// The box around all points, and a lattice that they are on.
    limits: Limits,
    grid: Option<Grid>,
    pub(super) filter: Filter3,
    /// The places of scaffold points.
    pub(super) scaffold: Vec<Place>,
    pub(super) cavity: Cavity,
    pub(super) hole: Hole,
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

    fn contains(&self, p: [f64; 3]) -> bool {
        (0..3).all(|k| self.low[k] <= p[k] && p[k] <= self.high[k])
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
        Self { mesh, points, limits, grid, filter, ..Self::default() }
    }

    /// Starts anew with other points, as [`Self::new`], in the memory that there is.
    pub(super) fn restart(&mut self, points: impl Iterator<Item = [f64; 3]>) {
        self.points.clear();
        self.points.extend(points);
        self.free.clear();
        self.limits = Limits::default();
        self.points.iter().for_each(|&p| _ = self.limits.include(p));
        self.grid = Grid::of(self.points.as_flattened().iter().copied());
        self.filter = Filter3::for_box(self.limits.extent(), self.grid);
        self.mesh.incident.clear();
        self.mesh.incident.resize(self.points.len(), TetrahedronId::NONE);
        self.clear_mesh();
    }

    fn clear_mesh(&mut self) {
        self.scaffold.clear();
        self.mesh.cells.clear();
        self.mesh.marks.clear();
        self.mesh.free.clear();
        self.mesh.vertex_count = 0;
    }

    /// Keeps a point at a place. It is no vertex yet.
    pub(super) fn keep(&mut self, q: [f64; 3]) -> Place {
        let fits = self.grid.is_none_or(|grid| q.iter().all(|&x| grid.holds(x)));
        if !fits || self.points.is_empty() {
            self.grid = Grid::of(q).filter(|_| self.points.is_empty());
        }
        if self.limits.include(q) || !fits {
            self.filter = Filter3::for_box(self.limits.extent(), self.grid);
        }
        if let Some(place) = self.free.pop() {
            self.points[place.index()] = q;
            return place;
        }
        self.points.push(q);
        self.mesh.incident.push(TetrahedronId::NONE);
        self.mesh.names.add_place();
        Place::new(self.points.len() - 1)
    }

    /// Gives a place back.
    pub(super) fn free_place(&mut self, v: Place) {
        self.mesh.incident[v.index()] = TetrahedronId::NONE;
        self.free.push(v);
    }

    /// Triangulates all vertices, and the point at one more place, anew: they span more or less than before.
    pub(super) fn rebuild(&mut self, more: Option<Place>) {
        let scaffold = std::mem::take(&mut self.scaffold);
        scaffold.into_iter().for_each(|p| self.free_place(p));
        let vertices: Vec<Place> = self.mesh.inhabited().chain(more).collect();
        vertices.iter().for_each(|p| self.mesh.incident[p.index()] = TetrahedronId::NONE);
        self.clear_mesh();
        let at = |i: u32| self.points[vertices[i as usize].index()];
        let along = curve::hilbert(vertices.len(), &at);
        let rounds = curve::rounds(vertices.len(), 0);
        let order: Vec<u32> =
            rounds.into_iter().map(|i| vertices[along[i as usize] as usize].index() as u32).collect();
        build::build(self, &order, &mut Vec::new(), &mut ());
    }

    /// Makes a point a vertex, found from a tetrahedron near it, and returns its place; or the place of the vertex
    /// that it equals.
    pub(super) fn add_point<T: Tally>(
        &mut self,
        from: TetrahedronId,
        q: [f64; 3],
        tally: &mut T,
    ) -> Result<Place, Place> {
        if !self.is_in_span(q) {
            let v = self.keep(q);
            self.rebuild(Some(v));
            return Ok(v);
        }
        let t = self.walk(from, q, tally);
        if let Some(w) = self.vertex_at(t, q) {
            return Err(w);
        }
        let v = self.keep(q);
        self.insert(v, t, tally);
        Ok(v)
    }

    /// Some tetrahedron; there must be a vertex.
    pub(super) fn any_cell(&self) -> TetrahedronId {
        self.mesh.cells().next().unwrap_or(TetrahedronId::NONE)
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
        // Every finite tetrahedron has all of the scaffold, and as many vertices as it takes for the span.
        let mut t = self.mesh.incident[self.scaffold[0].index()];
        if self.mesh.is_ghost(t) {
            t = self.mesh.twin(t.facet(3)).tetrahedron();
        }
        let corners = self.mesh.cells[t.index()].corners.into_iter().filter(|p| !self.is_scaffold(*p));
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

    /// The filter for the vertices and one more point.
    #[inline]
    fn filter_with(&self, q: [f64; 3]) -> Filter3 {
        if self.limits.contains(q) && self.grid.is_none_or(|grid| q.iter().all(|&x| grid.holds(x))) {
            return self.filter;
        }
        let mut limits = self.limits;
        limits.include(q);
        Filter3::for_box(limits.extent(), None)
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
        let filter = self.filter_with(q);
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
                if filter.orient3d(points[i], points[j], points[l], q).is_negative() {
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

impl Layer {
    /// The tetrahedron where a walk starts.
    #[inline]
    pub(super) fn start_cell(&self, start: Start<TetrahedronId>) -> TetrahedronId {
        match start {
            Start::At(t, _) | Start::Hint(t, _) => t,
            Start::Vertex(v) => self.mesh.incident[v.index()],
            Start::Anywhere => self.any_cell(),
        }
    }

    /// The vertices joined to one, scaffold not counted, into a buffer. `star` is another.
    pub(super) fn neighbors(&self, v: Place, star: &mut Vec<TetrahedronId>, joined: &mut Vec<Place>) {
        self.mesh.star(v, star);
        let corners = star.iter().flat_map(|t| self.mesh.cells[t.index()].corners);
        joined.clear();
        joined.extend(corners.filter(|&p| p != v && !p.is_ghost() && !self.is_scaffold(p)));
        joined.sort_unstable();
        joined.dedup();
    }
}

impl Ground for Layer {
    type Point = [f64; 3];
    type Hint = TetrahedronId;
    const DIMENSIONS: usize = 3;
    const NOWHERE: TetrahedronId = TetrahedronId::NONE;

    fn is_spanned(&self) -> bool {
        self.dimension() == Dimension::Space
    }

    fn vertex_count(&self) -> usize {
        self.mesh.vertex_count
    }

    fn place_count(&self) -> usize {
        self.mesh.incident.len()
    }

    fn inhabited(&self) -> impl Iterator<Item = Place> {
        self.mesh.inhabited().filter(|p| !self.is_scaffold(*p))
    }

    #[inline]
    fn hint(&self, v: Place) -> TetrahedronId {
        self.mesh.incident[v.index()]
    }

    #[inline]
    fn is_alive(&self, hint: TetrahedronId) -> bool {
        self.mesh.is_cell(hint)
    }

    fn any_vertex(&self) -> Option<Place> {
        self.inhabited().next()
    }

    fn neighbor(&self, v: Place) -> Option<Place> {
        let corners = self.mesh.cells.get(self.mesh.incident[v.index()].index())?.corners;
        corners.into_iter().find(|&p| p != v && !p.is_ghost() && !self.is_scaffold(p))
    }

    #[inline]
    fn point(&self, v: Place) -> [f64; 3] {
        self.points[v.index()]
    }

    #[inline]
    fn coordinate(q: [f64; 3], axis: usize) -> f64 {
        q[axis]
    }

    #[inline]
    fn fetch_around(&self, hint: TetrahedronId) {
        fetch(&self.mesh.cells, hint.index());
    }

    #[inline]
    fn compare_distances(&self, q: [f64; 3], a: Place, b: Place) -> Ordering {
        compare_distances3(q, self.points[a.index()], self.points[b.index()])
    }

    fn near<T: Tally>(
        &self,
        start: Start<TetrahedronId>,
        q: [f64; 3],
        exactly: bool,
        tally: &mut T,
    ) -> Place {
        let t = self.walk(self.start_cell(start), q, tally);
        let nearer = |a: Place, b: Place| if self.compare_distances(q, b, a).is_lt() { b } else { a };
        let corners = self.mesh.cells[t.index()].corners.into_iter().filter(|p| !p.is_ghost());
        let mut best = corners.reduce(nearer).expect("a tetrahedron has a finite corner");
        (0..4).for_each(|_| tally.compared());
        // Of the neighbours of a vertex that is not nearest one is nearer.
        let (mut star, mut joined) = (Vec::new(), Vec::new());
        while exactly {
            self.neighbors(best, &mut star, &mut joined);
            joined.iter().for_each(|_| tally.compared());
            match joined.iter().copied().reduce(nearer) {
                Some(next) if self.compare_distances(q, next, best).is_lt() => best = next,
                _ => break,
            }
        }
        best
    }
}

impl Level for Layer {
    fn add(&mut self, q: [f64; 3], start: Start<TetrahedronId>) -> Place {
        let from = self.start_cell(start);
        match self.add_point(from, q, &mut ()) {
            Ok(place) | Err(place) => place,
        }
    }

    fn take(&mut self, v: Place) {
        self.remove(v, &mut ());
    }
}
