//! Removal of a vertex: its star becomes a hole, refilled with the triangulation of the hole's own vertices.
//!
//! Source: Devillers & Teillaud, "Perturbations and vertex removal in a 3D Delaunay triangulation", SODA 2003. Every
//! tetrahedron that the remaining points have in the hole has its corners on the hole's border and an empty sphere, so it
//! is one of the triangulation of the border's vertices alone; with the canonical rule there is only one, and its facets
//! fit. The border's vertices are triangulated apart, what lies inside is found from one facet of the border, and
//! copied.
//!
//! Cost: O(d log d) expected for a star of d tetrahedra, 27 on average, if their triangulation is of size O(d).

use super::build;
use super::layer::Layer;
use crate::ids::{FacetId, Place, TetrahedronId};
use crate::locate::tally::Tally;
use crate::mesh::Dimension;
use crate::mesh::tetrahedra::Tetrahedron;
use crate::order::curve;

/// Up to so many vertices any order of insertion will do.
const FEW: usize = 40;

/// Buffers that are kept between removals.
#[derive(Clone, Debug, Default)]
pub(super) struct Hole {
    star: Vec<TetrahedronId>,
    /// The vertices around the hole, the ghost not counted.
    vertices: Vec<Place>,
    /// The facets around the hole, by their corners as their insides see them, numbered as below.
    border: Vec<([u32; 3], FacetId)>,
    /// The triangulation of the border's vertices.
    fill: Option<Box<Layer>>,
    /// Its tetrahedra inside of the hole, each with the one that it becomes.
    inside: Vec<(TetrahedronId, TetrahedronId)>,
    order: Vec<u32>,
}

/// From the smallest on, in the same sense.
fn turned([a, b, c]: [u32; 3]) -> [u32; 3] {
    if a < b && a < c {
        [a, b, c]
    } else if b < c {
        [b, c, a]
    } else {
        [c, a, b]
    }
}

impl Layer {
    /// Removes the vertex at a place, which is free then.
    pub(super) fn remove<T: Tally>(&mut self, v: Place, tally: &mut T) {
        if self.mesh.vertex_count == 1 {
            self.free_place(v);
            self.rebuild(None);
            return;
        }
        let mut hole = std::mem::take(&mut self.hole);
        let filled = hole.refill(self, v, tally);
        self.hole = hole;
        self.free_place(v);
        if filled {
            self.mesh.vertex_count -= 1;
        } else {
            self.rebuild(None);
        }
    }
}

impl Hole {
    /// Removes the star of a vertex and fills the hole. False, and nothing has changed, if the other vertices span
    /// less.
    fn refill<T: Tally>(&mut self, layer: &mut Layer, v: Place, tally: &mut T) -> bool {
        let mut fill = self.fill.take().unwrap_or_default();
        let there = self.triangulate_border(layer, v, &mut fill);
        if there {
            self.find_inside(&mut fill);
            tally.destroyed(self.star.len());
            tally.created(self.inside.len());
            self.copy(layer, &fill);
        }
        self.fill = Some(fill);
        there
    }

    /// The number of a vertex of the border; the ghost has the largest.
    fn number(&self, p: Place) -> u32 {
        if p.is_ghost() {
            return u32::MAX;
        }
        self.vertices.iter().position(|&w| w == p).map_or(u32::MAX - 1, |k| k as u32)
    }

    /// Triangulates the vertices around the star of `v`. False if all vertices but `v` are in one plane.
    fn triangulate_border(&mut self, layer: &Layer, v: Place, fill: &mut Layer) -> bool {
        let mesh = &layer.mesh;
        mesh.star(v, &mut self.star);
        self.vertices.clear();
        self.vertices.extend(self.star.iter().flat_map(|t| mesh.cells[t.index()].corners));
        self.vertices.sort_unstable();
        self.vertices.dedup();
        self.vertices.retain(|&p| p != v && !p.is_ghost());
        self.triangulate(layer, fill);
        if fill.dimension() < Dimension::Space {
            // All in one plane, and what is beyond it has no part in the hole; but one vertex from there turns
            // the plane's triangles into tetrahedra.
            let beyond = |t: &TetrahedronId| {
                let cell = &mesh.cells[t.index()];
                let k = cell.corners.iter().position(|&p| p == v)?;
                let outside = &mesh.cells[cell.across[k].tetrahedron().index()];
                let apex = outside.corners[cell.across[k].corner()];
                (!apex.is_ghost() && !mesh.is_ghost(*t)).then_some(apex)
            };
            let Some(apex) = self.star.iter().find_map(beyond) else { return false };
            self.vertices.push(apex);
            self.triangulate(layer, fill);
        }
        self.border.clear();
        for &t in &self.star {
            let cell = &mesh.cells[t.index()];
            let k = cell.corners.iter().position(|&p| p == v).unwrap_or_default();
            let corners = mesh.facet_places(t.facet(k)).map(|p| self.number(p));
            self.border.push((turned(corners), cell.across[k]));
        }
        self.border.sort_unstable();
        true
    }

    fn triangulate(&mut self, layer: &Layer, fill: &mut Layer) {
        fill.restart(self.vertices.iter().map(|p| layer.points[p.index()]));
        self.order.clear();
        if self.vertices.len() <= FEW {
            self.order.extend(0..self.vertices.len() as u32);
        } else {
            let along = curve::hilbert(self.vertices.len(), &|i| fill.points[i as usize]);
            let rounds = curve::rounds(self.vertices.len(), 0);
            self.order.extend(rounds.into_iter().map(|i| along[i as usize]));
        }
        build::build(fill, &self.order, &mut Vec::new(), &mut ());
    }

    /// The facet outside of the hole that a facet of the filling meets.
    fn outside(&self, fill: &Layer, f: FacetId) -> Option<FacetId> {
        let number = |p: Place| if p.is_ghost() { u32::MAX } else { p.index() as u32 };
        let key = turned(fill.mesh.facet_places(f).map(number));
        self.border.binary_search_by_key(&key, |facet| facet.0).ok().map(|i| self.border[i].1)
    }

    /// Finds the tetrahedra of the filling that are inside of the hole: from one at a facet of the border, across
    /// facets that are none of the border.
    fn find_inside(&mut self, fill: &mut Layer) {
        self.inside.clear();
        let mut star = Vec::new();
        // One of the first facet's corners is no ghost.
        let corner = self.border[0].0[0];
        fill.mesh.star(Place::new(corner as usize), &mut star);
        let at_border = |t: &TetrahedronId| (0..4).any(|k| self.outside(fill, t.facet(k)).is_some());
        let Some(&first) = star.iter().find(|t| at_border(t)) else {
            debug_assert!(false, "the filling has the border's facets");
            return;
        };
        fill.mesh.marks[first.index()] = 1;
        self.inside.push((first, TetrahedronId::NONE));
        let mut k = 0;
        while let Some(&(t, _)) = self.inside.get(k) {
            k += 1;
            for i in 0..4 {
                let next = fill.mesh.twin(t.facet(i)).tetrahedron();
                if fill.mesh.marks[next.index()] == 0 && self.outside(fill, t.facet(i)).is_none() {
                    fill.mesh.marks[next.index()] = 1;
                    self.inside.push((next, TetrahedronId::NONE));
                }
            }
        }
    }

    /// Puts the inside in the place of the star.
    fn copy(&mut self, layer: &mut Layer, fill: &Layer) {
        let mesh = &mut layer.mesh;
        for &t in &self.star {
            mesh.free_cell(t);
        }
        for (_, to) in &mut self.inside {
            *to = mesh.new_cell();
        }
        self.inside.sort_unstable();
        let place = |p: Place| if p.is_ghost() { p } else { self.vertices[p.index()] };
        for &(from, to) in &self.inside {
            let source = &fill.mesh.cells[from.index()];
            let across = [0, 1, 2, 3].map(|k| {
                self.outside(fill, from.facet(k)).unwrap_or_else(|| {
                    let g = source.across[k];
                    let i = self.inside.binary_search_by_key(&g.tetrahedron(), |pair| pair.0);
                    i.map_or(FacetId::NONE, |i| self.inside[i].1.facet(g.corner()))
                })
            });
            mesh.cells[to.index()] = Tetrahedron { corners: source.corners.map(place), across };
            for (k, g) in across.into_iter().enumerate() {
                mesh.cells[g.tetrahedron().index()].across[g.corner()] = to.facet(k);
            }
            for p in source.corners.into_iter().filter(|p| !p.is_ghost()) {
                mesh.incident[place(p).index()] = to;
            }
        }
    }
}
