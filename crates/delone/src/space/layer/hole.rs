//! A hole in a triangulation of space, refilled with the triangulation of its own vertices.
//!
//! Source: Devillers & Teillaud, "Perturbations and vertex removal in a 3D Delaunay triangulation", SODA 2003. Every
//! tetrahedron that the points have in the hole has its corners in the hole or on its border and an empty sphere, so it
//! is one of the triangulation of these vertices alone; with the canonical rule there is only one, and its facets fit.
//! The vertices are triangulated apart, what lies inside of the border is found from one of its facets, and copied.
//!
//! Cost: O(d log d) expected for a hole of d tetrahedra, if the triangulation of its vertices is of size O(d).

use delone_predicates::lexicographic3;

use super::Layer;
use super::kernel::Lift;
use crate::ids::{FacetId, Place, TetrahedronId};
use crate::mesh::tetrahedra::Tetrahedron;
use crate::mesh::tetrahedra::surgery::turned;
use crate::order;
use crate::space::construct;

/// Vertices, up to which a hole is triangulated in any order of insertion.
const UNORDERED_VERTICES: usize = 40;

/// Buffers that are kept between holes.
#[derive(Clone, Debug, Default)]
pub(in crate::space) struct Hole {
    /// The tetrahedra that go.
    pub(in crate::space) cells: Vec<TetrahedronId>,
    /// The vertices of the filling, the ghost not counted, sorted. Places of the filling are numbers of this list.
    pub(in crate::space) vertices: Vec<Place>,
    /// The facets around the hole.
    pub(in crate::space) border: Vec<Border>,
    /// The tetrahedra of the filling inside of the hole, each with the one that it becomes.
    pub(in crate::space) inside: Vec<(TetrahedronId, TetrahedronId)>,
    order: Vec<u32>,
    star: Vec<TetrahedronId>,
}

/// A facet of the border.
#[derive(Clone, Copy, Debug)]
pub(in crate::space) struct Border {
    /// Its corners by number as the hole sees them, from the smallest on.
    corners: [u32; 3],
    /// The facet outside.
    pub(in crate::space) outside: FacetId,
    /// Where the filling meets it.
    pub(in crate::space) inside: FacetId,
}

impl Hole {
    /// Takes the corners of the tetrahedra that go for the vertices, but for one, and some more.
    pub(in crate::space) fn set_vertices<W: Lift>(
        &mut self,
        layer: &Layer<W>,
        without: Option<Place>,
        more: impl IntoIterator<Item = Place>,
    ) {
        self.vertices.clear();
        self.vertices.extend(self.cells.iter().flat_map(|t| layer.mesh.cells[t.index()].corners));
        self.vertices.extend(more);
        self.vertices.sort_unstable();
        self.vertices.dedup();
        self.vertices.retain(|&p| Some(p) != without && !p.is_ghost());
    }

    /// Whether two of the vertices are in one place.
    pub(in crate::space) fn has_equal_points<W: Lift>(&mut self, layer: &Layer<W>) -> bool {
        let at = |&i: &u32| layer.points[self.vertices[i as usize].index()];
        self.order.clear();
        self.order.extend(0..self.vertices.len() as u32);
        self.order.sort_unstable_by(|i, j| lexicographic3(at(i), at(j)));
        self.order.windows(2).any(|pair| at(&pair[0]) == at(&pair[1]))
    }

    /// Triangulates the vertices apart. They must be in different places.
    pub(in crate::space) fn triangulate<W: Lift>(&mut self, layer: &Layer<W>, fill: &mut Layer<W>) {
        fill.restart(self.vertices.iter().map(|&p| layer.site(p)));
        self.order.clear();
        if self.vertices.len() <= UNORDERED_VERTICES {
            self.order.extend(0..self.vertices.len() as u32);
        } else {
            let along = order::space::hilbert(self.vertices.len(), &|i| fill.points[i as usize]);
            let rounds = order::space::rounds(self.vertices.len(), 0);
            self.order.extend(rounds.into_iter().map(|i| along[i as usize]));
        }
        // As few as they are, they have room.
        let built = construct::build(fill, &self.order, &mut Vec::new(), &mut ());
        debug_assert!(built.is_some(), "a filling has room");
    }

    /// Takes the facets around the hole, as its tetrahedra see them. All their corners must be vertices.
    pub(in crate::space) fn set_border<W: Lift>(&mut self, layer: &Layer<W>, facets: &[FacetId]) {
        self.border.clear();
        for &f in facets {
            let corners = turned(layer.mesh.facet_places(f).map(|p| self.number(p)));
            self.border.push(Border { corners, outside: layer.mesh.twin(f), inside: FacetId::NONE });
        }
        self.border.sort_unstable_by_key(|facet| facet.corners);
    }

    /// The number of a vertex; the ghost has the largest.
    fn number(&self, p: Place) -> u32 {
        if p.is_ghost() {
            return u32::MAX;
        }
        self.vertices.binary_search(&p).map_or(u32::MAX - 1, |k| k as u32)
    }

    /// The place on the border's list of a facet of the filling.
    fn on_border<W: Lift>(&self, fill: &Layer<W>, f: FacetId) -> Option<usize> {
        let number = |p: Place| if p.is_ghost() { u32::MAX } else { p.index() as u32 };
        let key = turned(fill.mesh.facet_places(f).map(number));
        self.border.binary_search_by_key(&key, |facet| facet.corners).ok()
    }

    /// Finds the tetrahedra of the filling that are inside of the hole: from one at a facet of the border, across
    /// facets that are none of the border. False if they do not meet all of the border, each facet from inside alone; those
    /// that they do not meet so have no inside then.
    pub(in crate::space) fn find_inside<W: Lift>(&mut self, fill: &mut Layer<W>) -> bool {
        self.inside.clear();
        let mut star = std::mem::take(&mut self.star);
        let first = (0..self.border.len()).find_map(|k| {
            // One of a facet's corners is no ghost.
            fill.mesh.star(Place::new(self.border[k].corners[0] as usize), &mut star);
            let is_at = |t: &TetrahedronId| (0..4).any(|i| self.on_border(fill, t.facet(i)).is_some());
            star.iter().copied().find(is_at)
        });
        self.star = star;
        let Some(first) = first else { return false };
        fill.mesh.marks[first.index()] = 1;
        self.inside.push((first, TetrahedronId::NONE));
        let (mut k, mut met) = (0, 0);
        while let Some(&(t, _)) = self.inside.get(k) {
            k += 1;
            for f in [0, 1, 2, 3].map(|i| t.facet(i)) {
                if let Some(i) = self.on_border(fill, f) {
                    self.border[i].inside = f;
                    met += 1;
                    continue;
                }
                let next = fill.mesh.twin(f).tetrahedron();
                if fill.mesh.marks[next.index()] == 0 {
                    fill.mesh.marks[next.index()] = 1;
                    self.inside.push((next, TetrahedronId::NONE));
                }
            }
        }
        // The border of a mesh that has folded over itself need not part the filling in two: what was found came around to
        // the other side.
        let mut fits = met == self.border.len();
        for k in 0..self.border.len() {
            let inside = self.border[k].inside;
            if inside == FacetId::NONE {
                continue;
            }
            let beyond = fill.mesh.twin(inside);
            if fill.mesh.marks[beyond.tetrahedron().index()] != 0 && self.on_border(fill, beyond).is_none() {
                self.border[k].inside = FacetId::NONE;
                fits = false;
            }
        }
        fits
    }

    /// Puts what was found inside in the place of what goes. `None`, and nothing has changed, if there is no room.
    pub(in crate::space) fn copy<W: Lift>(&mut self, layer: &mut Layer<W>, fill: &Layer<W>) -> Option<()> {
        let mesh = &mut layer.mesh;
        if self.inside.len() > self.cells.len() + mesh.room() {
            return None;
        }
        for &t in &self.cells {
            mesh.free_cell(t);
        }
        for (_, to) in &mut self.inside {
            *to = mesh.new_cell()?;
        }
        self.inside.sort_unstable();
        let place = |p: Place| if p.is_ghost() { p } else { self.vertices[p.index()] };
        for &(from, to) in &self.inside {
            let source = &fill.mesh.cells[from.index()];
            let across = [0, 1, 2, 3].map(|k| {
                if let Some(i) = self.on_border(fill, from.facet(k)) {
                    return self.border[i].outside;
                }
                let g = source.across[k];
                let i = self.inside.binary_search_by_key(&g.tetrahedron(), |pair| pair.0);
                i.map_or(FacetId::NONE, |i| self.inside[i].1.facet(g.corner()))
            });
            mesh.records().put(to, Tetrahedron { corners: source.corners.map(place), across });
        }
        Some(())
    }
}
