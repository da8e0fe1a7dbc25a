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

use super::arena::{Arena, Memory};
use crate::fetch::fetch;
use crate::ids::{FacetId, Place, TetrahedronId};
use crate::locate::tally::Tally;
use crate::mesh::tetrahedra::{FACETS, Tetrahedron};

/// Marks of tetrahedra while a cavity is dug.
const INSIDE: u8 = 1;
const OUTSIDE: u8 = 2;
const WAITING: u8 = 3;

/// Buffers that are kept between insertions.
#[derive(Clone, Debug, Default)]
pub(super) struct Cavity {
    /// The tetrahedra in conflict; then the new ones.
    cells: Vec<TetrahedronId>,
    /// All that are or were to be tested, in their order, and how many they are.
    queue: Vec<TetrahedronId>,
    queued: usize,
    /// The facets around them, seen from outside.
    border: Vec<FacetId>,
    /// The border's vertices by their number, each with a new tetrahedron; the ghost has the first.
    vertices: Vec<(Place, TetrahedronId)>,
    /// For each facet of the border the numbers of its corners.
    numbers: Vec<(u32, u32, u32)>,
    /// By the numbers of its ends, the facet above each directed edge of the border.
    table: Vec<FacetId>,
    /// The logarithm of the table's side.
    width: u32,
}

impl Cavity {
    /// Makes the point at `v` a vertex: removes the tetrahedra in conflict with it, starting from `seed`, one of them,
    /// and joins it to their border.
    ///
    /// `None` if there is no room; then the memory is good for nothing more.
    pub(super) fn insert<A: Arena, T: Tally>(
        &mut self,
        arena: &mut A,
        v: Place,
        seed: TetrahedronId,
        tally: &mut T,
    ) -> Option<()> {
        self.find(&mut arena.memory(), v, seed, tally);
        tally.destroyed(self.cells.len());
        tally.created(self.border.len());
        while self.cells.len() < self.border.len() {
            self.cells.push(arena.new_cell()?);
        }
        // A ball of many tetrahedra may have few facets.
        for t in self.cells.drain(self.border.len()..) {
            arena.memory().marks[t.index()] = 0;
            arena.free_cell(t);
        }
        self.refill(&mut arena.memory(), v);
        Some(())
    }

    /// The vertices that the last one inserted is joined to, the ghost not among them.
    pub(super) fn joined(&self) -> impl Iterator<Item = Place> {
        self.vertices[1..].iter().map(|vertex| vertex.0)
    }

    /// Collects the tetrahedra in conflict and their border. Two are tested at a time; what goes on the lists is decided
    /// without branches, which would go the wrong way half of the time.
    fn find<T: Tally>(&mut self, memory: &mut Memory<'_>, v: Place, seed: TetrahedronId, tally: &mut T) {
        let q = memory.points[v.index()];
        self.cells.clear();
        self.queued = 0;
        self.enter(memory, seed);
        let mut done = 0;
        while done < self.queued {
            let t = self.queue[done];
            tally.in_circle();
            if done + 1 == self.queued {
                done += 1;
                let inside = memory.view().conflicts(t, q);
                self.judge(memory, t, inside);
                continue;
            }
            let u = self.queue[done + 1];
            tally.in_circle();
            done += 2;
            let [first, second] = memory.view().both_conflict(t, u, q);
            self.judge(memory, t, first);
            self.judge(memory, u, second);
        }
        let mut count = 0;
        self.border.resize(4 * self.cells.len(), FacetId::NONE);
        for &t in &self.cells {
            let across = memory.cells[t.index()].across;
            for facet in across {
                self.border[count] = facet;
                count += usize::from(memory.marks[facet.tetrahedron().index()] == OUTSIDE);
            }
        }
        self.border.truncate(count);
    }

    /// Notes whether a tetrahedron is in conflict.
    #[inline]
    fn judge(&mut self, memory: &mut Memory<'_>, t: TetrahedronId, inside: bool) {
        if inside {
            self.enter(memory, t);
        } else {
            memory.marks[t.index()] = OUTSIDE;
        }
    }

    /// Takes a tetrahedron into the cavity, and asks for its neighbours.
    #[inline]
    fn enter(&mut self, memory: &mut Memory<'_>, t: TetrahedronId) {
        memory.marks[t.index()] = INSIDE;
        self.cells.push(t);
        if self.queue.len() < self.queued + 4 {
            self.queue.resize(2 * self.queued + 64, TetrahedronId::NONE);
        }
        let across = memory.cells[t.index()].across;
        for facet in across {
            let next = facet.tetrahedron();
            let mark = &mut memory.marks[next.index()];
            let fresh = *mark == 0;
            *mark = if fresh { WAITING } else { *mark };
            fetch(memory.cells, next.index());
            self.queue[self.queued] = next;
            self.queued += usize::from(fresh);
        }
    }

    /// Joins `v` to every facet of the border.
    fn refill(&mut self, memory: &mut Memory<'_>, v: Place) {
        let count = self.border.len();
        // A sphere of F triangles has F / 2 + 2 corners; the ghost has a number even if it is none of them.
        self.widen(count / 2 + 3);
        self.vertices.clear();
        self.vertices.push((Place::GHOST, TetrahedronId::NONE));
        self.numbers.clear();
        for (&g, &t) in self.border.iter().zip(&self.cells) {
            let outside = &mut memory.cells[g.tetrahedron().index()];
            outside.across[g.corner()] = t.facet(0);
            let [i, j, k] = FACETS[g.corner()];
            let (mut a, mut b, mut c) = (outside.corners[i], outside.corners[j], outside.corners[k]);
            // The ghost is always the last corner.
            if a.is_ghost() {
                (a, b, c) = (b, c, a);
            } else if b.is_ghost() {
                (a, b, c) = (c, a, b);
            }
            memory.marks[g.tetrahedron().index()] = 0;
            memory.marks[t.index()] = 0;
            memory.cells[t.index()] = Tetrahedron { corners: [v, a, b, c], across: [g; 4] };
            let i = number(&mut self.vertices, memory.incident, a, t);
            let j = number(&mut self.vertices, memory.incident, b, t);
            let k = if c.is_ghost() { 0 } else { number(&mut self.vertices, memory.incident, c, t) };
            self.table[j << self.width | k] = t.facet(1);
            self.table[k << self.width | i] = t.facet(2);
            self.table[i << self.width | j] = t.facet(3);
            self.numbers.push((i as u32, j as u32, k as u32));
        }
        for (&t, &(i, j, k)) in self.cells.iter().zip(&self.numbers) {
            let (i, j, k) = (i as usize, j as usize, k as usize);
            let across = &mut memory.cells[t.index()].across;
            across[1] = self.table[k << self.width | j];
            across[2] = self.table[i << self.width | k];
            across[3] = self.table[j << self.width | i];
        }
        for &(p, t) in &self.vertices[1..] {
            memory.incident[p.index()] = t;
        }
        memory.incident[v.index()] = self.cells[0];
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

/// The number of a vertex of the border, of which `t` is a new tetrahedron.
#[inline]
fn number(
    vertices: &mut Vec<(Place, TetrahedronId)>,
    incident: &mut [TetrahedronId],
    p: Place,
    t: TetrahedronId,
) -> usize {
    let slot = &mut incident[p.index()];
    if vertices.get(slot.index()).is_none_or(|vertex| vertex.0 != p) {
        *slot = TetrahedronId::new(vertices.len());
        vertices.push((p, t));
    }
    slot.index()
}
