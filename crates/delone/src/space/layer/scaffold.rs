//! Points that span less than space, in the mesh of those that do.
//!
//! *Scaffold* points off their span make up for what is missing: three for a point, two for a line, one for a plane.
//! What is in the span does not depend on them: with coplanar points and one apex, a point of the plane is in the
//! sphere of a triangle and the apex exactly if it is in the circle of the triangle, ties included, because the height of
//! the apex has no part in it, nor has its weight. When the span changes, everything is triangulated anew.

use delone_predicates::{are_collinear3, orient2d, orient3d};

use super::Layer;
use super::arena::Arena;
use super::kernel::Lift;
use crate::ids::{Place, TetrahedronId};
use crate::mesh::Dimension;
use crate::mesh::tetrahedra::FACETS;
use crate::order;
use crate::space::construct;

impl<W: Lift> Layer<W> {
    /// The dimension of the span of the vertices.
    pub(in crate::space) fn dimension(&self) -> Dimension {
        match (self.mesh.vertex_count, self.scaffold.len()) {
            (0, _) => Dimension::Empty,
            (_, 3) => Dimension::Point,
            (_, 2) => Dimension::Line,
            (_, 1) => Dimension::Plane,
            _ => Dimension::Space,
        }
    }

    pub(in crate::space) fn is_scaffold(&self, p: Place) -> bool {
        self.scaffold.contains(&p)
    }

    /// Begins with the first of some places whose points span as much as all of them do; returns those that are
    /// vertices now. The mesh must be empty. `None` if there is no room.
    pub(in crate::space) fn begin(&mut self, order: &[u32]) -> Option<Vec<Place>> {
        let vertices = spanning(&self.points, order);
        if vertices.is_empty() {
            return Some(vertices);
        }
        let scaffold: Vec<[f64; 3]> = self.off_span(&vertices);
        self.scaffold = scaffold.into_iter().map(|p| self.keep((p, W::default()))).collect();
        let four: Vec<Place> = vertices.iter().chain(&self.scaffold).copied().collect();
        self.mesh.vertex_count = vertices.len();
        first_cells(self, [four[0], four[1], four[2], four[3]])?;
        Some(vertices)
    }

    /// Points that make four with one to three others, which span one dimension less than they are.
    fn off_span(&self, vertices: &[Place]) -> Vec<[f64; 3]> {
        let at = |k: usize| self.points[vertices[k].index()];
        let a = at(0);
        // Away from the first point along one axis, by about the size of the whole.
        let moved = |axis: usize| {
            let (x, size) = (a[axis], self.size());
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

    /// Whether a point is in what the vertices span.
    pub(in crate::space) fn is_in_span(&self, q: [f64; 3]) -> bool {
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
            [a, b] => are_collinear3(a, b, q),
            [a, b, c] => orient3d(a, b, c, q).is_zero(),
            _ => false,
        }
    }

    /// Triangulates all vertices, and the point at one more place, anew: they span more or less than before. `None` if there
    /// is no room; then all is as before, but for the order of tetrahedra.
    pub(in crate::space) fn rebuild(&mut self, more: Option<Place>) -> Option<()> {
        let scaffold = std::mem::take(&mut self.scaffold);
        scaffold.into_iter().for_each(|p| self.free_place(p));
        let mut vertices: Vec<Place> = self.mesh.inhabited().collect();
        let before = vertices.len();
        vertices.extend(more);
        self.build_anew(&vertices).or_else(|| {
            let restored = self.build_anew(&vertices[..before]);
            debug_assert!(restored.is_some(), "what was there has room");
            None
        })
    }

    fn build_anew(&mut self, vertices: &[Place]) -> Option<()> {
        std::mem::take(&mut self.scaffold).into_iter().for_each(|p| self.free_place(p));
        vertices.iter().for_each(|p| self.mesh.incident[p.index()] = TetrahedronId::NONE);
        self.clear_mesh();
        let at = |i: u32| self.points[vertices[i as usize].index()];
        let along = order::space::hilbert(vertices.len(), &at);
        let rounds = order::space::rounds(vertices.len(), 0);
        let order: Vec<u32> =
            rounds.into_iter().map(|i| vertices[along[i as usize] as usize].index() as u32).collect();
        construct::build(self, &order, &mut Vec::new(), &mut ())
    }
}

/// The first of some places whose points span as much as all of them do: at most four.
pub(in crate::space) fn spanning(points: &[[f64; 3]], order: &[u32]) -> Vec<Place> {
    let at = |i: u32| points[i as usize];
    let Some(&a) = order.first() else { return Vec::new() };
    let (mut corners, p) = (vec![a], at(a));
    if let Some(&b) = order.iter().find(|&&b| at(b) != p) {
        corners.push(b);
        if let Some(&c) = order.iter().find(|&&c| !are_collinear3(p, at(b), at(c))) {
            corners.push(c);
            corners.extend(order.iter().find(|&&d| !orient3d(p, at(b), at(c), at(d)).is_zero()));
        }
    }
    corners.into_iter().map(|i| Place::new(i as usize)).collect()
}

/// Begins with the tetrahedron of four places, and the ghosts around it. `None` if there is no room.
pub(in crate::space) fn first_cells(arena: &mut impl Arena, mut corners: [Place; 4]) -> Option<()> {
    let points = arena.view().points;
    let [a, b, c, d] = corners.map(|p| points[p.index()]);
    if orient3d(a, b, c, d).is_negative() {
        corners.swap(0, 1);
    }
    let mut five = [(TetrahedronId::NONE, corners); 5];
    for (k, (t, beyond)) in five.iter_mut().enumerate() {
        *t = arena.new_cell()?;
        if let Some(facet) = k.checked_sub(1).map(|k| FACETS[k]) {
            // Seen from the other side.
            let [a, b, c] = facet.map(|i| corners[i]);
            *beyond = [a, c, b, Place::GHOST];
        }
    }
    // The finite one is written last: its corners have it for their own.
    five.rotate_left(1);
    arena.memory().records().flip(&[], &five);
    Some(())
}
