//! The cavity of a new point: the tetrahedra whose spheres contain it, refilled as a star.
//!
//! Source: Bowyer, and Watson, The Computer Journal 1981. With the canonical in-sphere test the cavity is that of
//! points in general position: a ball without an inner vertex, star-shaped around the new point.
//!
//! The new tetrahedra stand on the facets of the ball's border and are glued along its edges. Each border vertex gets a
//! small number, and a table by pairs of numbers holds the facet above each directed edge; so nothing is searched. The
//! numbers are found without marks: the slot where a vertex keeps its tetrahedron holds the number for the while.
//!
//! Cost: O(k) for k tetrahedra, about twenty on average over random insertions; nothing is allocated once the buffers
//! have grown.

use super::layer::Layer;
use crate::fetch::fetch;
use crate::ids::{FacetId, Place, TetrahedronId};
use crate::locate::tally::Tally;
use crate::mesh::tetrahedra::{FACETS, Tetrahedron};

/// Marks of tetrahedra while a cavity is dug.
const INSIDE: u8 = 1;
const OUTSIDE: u8 = 2;

/// Buffers that are kept between insertions.
#[derive(Clone, Debug, Default)]
pub(super) struct Cavity {
    /// The tetrahedra in conflict; then the new ones.
    pub(super) cells: Vec<TetrahedronId>,
    /// The facets around them, seen from outside.
    border: Vec<FacetId>,
    /// The border's vertices by their number; the ghost has the first.
    vertices: Vec<Place>,
    /// By the numbers of its ends, the facet above each directed edge of the border.
    table: Vec<FacetId>,
    /// The logarithm of the table's side.
    width: u32,
}

impl Cavity {
    /// Makes the point at `v` a vertex: removes the tetrahedra in conflict with it, starting from `seed`, one of them,
    /// and joins it to their border.
    pub(super) fn insert<T: Tally>(
        &mut self,
        layer: &mut Layer,
        v: Place,
        seed: TetrahedronId,
        tally: &mut T,
    ) {
        self.find(layer, layer.points[v.index()], seed, tally);
        tally.destroyed(self.cells.len());
        tally.created(self.border.len());
        self.refill(layer, v);
    }

    /// Collects the tetrahedra in conflict and their border.
    fn find<T: Tally>(&mut self, layer: &mut Layer, q: [f64; 3], seed: TetrahedronId, tally: &mut T) {
        self.cells.clear();
        self.border.clear();
        layer.mesh.marks[seed.index()] = INSIDE;
        self.cells.push(seed);
        let mut done = 0;
        while let Some(&t) = self.cells.get(done) {
            done += 1;
            for g in layer.mesh.cells[t.index()].across {
                let outside = g.tetrahedron();
                let mark = match layer.mesh.marks[outside.index()] {
                    0 => {
                        tally.in_circle();
                        let mark = if layer.conflicts(outside, q) { INSIDE } else { OUTSIDE };
                        layer.mesh.marks[outside.index()] = mark;
                        if mark == INSIDE {
                            for f in layer.mesh.cells[outside.index()].across {
                                fetch(&layer.mesh.cells, f.tetrahedron().index());
                            }
                            self.cells.push(outside);
                        }
                        mark
                    }
                    mark => mark,
                };
                if mark == OUTSIDE {
                    self.border.push(g);
                }
            }
        }
    }

    /// Joins `v` to every facet of the border.
    fn refill(&mut self, layer: &mut Layer, v: Place) {
        let mesh = &mut layer.mesh;
        self.vertices.clear();
        self.vertices.push(Place::GHOST);
        while self.cells.len() < self.border.len() {
            self.cells.push(mesh.new_cell());
        }
        // A ball of many tetrahedra may have few facets.
        for t in self.cells.drain(self.border.len()..) {
            mesh.marks[t.index()] = 0;
            mesh.free_cell(t);
        }
        // A sphere of F triangles has F / 2 + 2 corners; the ghost has a number even if it is none of them.
        self.widen(self.border.len() / 2 + 3);
        for (&g, &t) in self.border.iter().zip(&self.cells) {
            let outside = &mesh.cells[g.tetrahedron().index()];
            let mut base = FACETS[g.corner()].map(|k| outside.corners[k]);
            // The ghost is always the last corner.
            while base[0].is_ghost() || base[1].is_ghost() {
                base.rotate_left(1);
            }
            mesh.marks[t.index()] = 0;
            mesh.marks[g.tetrahedron().index()] = 0;
            mesh.cells[t.index()] = Tetrahedron { corners: [v, base[0], base[1], base[2]], across: [g; 4] };
            mesh.cells[g.tetrahedron().index()].across[g.corner()] = t.facet(0);
            let numbers = base.map(|p| {
                if p.is_ghost() {
                    return 0;
                }
                let slot = &mut mesh.incident[p.index()];
                if self.vertices.get(slot.index()) != Some(&p) {
                    *slot = TetrahedronId::new(self.vertices.len());
                    self.vertices.push(p);
                }
                slot.index()
            });
            for k in 0..3 {
                let (i, j) = (numbers[(k + 1) % 3], numbers[(k + 2) % 3]);
                self.table[i << self.width | j] = t.facet(k + 1);
            }
        }
        for &t in &self.cells {
            let corners = mesh.cells[t.index()].corners;
            let numbers = [1, 2, 3].map(|k| {
                let p: Place = corners[k];
                if p.is_ghost() { 0 } else { mesh.incident[p.index()].index() }
            });
            for k in 0..3 {
                let (i, j) = (numbers[(k + 1) % 3], numbers[(k + 2) % 3]);
                mesh.cells[t.index()].across[k + 1] = self.table[j << self.width | i];
            }
        }
        for &t in &self.cells {
            for p in mesh.cells[t.index()].corners.into_iter().filter(|p| !p.is_ghost()) {
                mesh.incident[p.index()] = t;
            }
        }
    }

    /// Makes room for so many vertices in the table.
    fn widen(&mut self, vertices: usize) {
        let width = vertices.next_power_of_two().trailing_zeros().max(6);
        if width > self.width {
            self.width = width;
            self.table = vec![FacetId::NONE; 1 << (2 * width)];
        }
    }
}
