//! The cavity of a new point: the tetrahedra whose spheres contain it, refilled as a star.
//!
//! Source: Bowyer, and Watson, The Computer Journal 1981. With the canonical in-sphere test the cavity is that of
//! points in general position: a ball without an inner vertex, star-shaped around the new point. With weights the vertices
//! inside are those that it hides.
//!
//! The new tetrahedra stand on the facets of the ball's border and are glued along its edges. Each border vertex gets a
//! small number, and a table by pairs of numbers holds the facet above each directed edge; so nothing is searched. The
//! numbers are found without marks: the slot where a vertex keeps its tetrahedron holds the number for the while. The
//! edges of large borders (of the center of a sphere's surface) are sorted instead.
//!
//! Cost: O(k) for k tetrahedra, about twenty on average over random insertions; nothing is allocated once the buffers
//! have grown. Sorting: O(k log k).

use super::arena::{Arena, Memory};
use super::kernel::Lift;
use crate::ids::{FacetId, Place, TetrahedronId};
use crate::mesh::tetrahedra::{FACETS, Tetrahedron};
use crate::prefetch::prefetch;
use crate::tally::Tally;

/// Marks of tetrahedra while a cavity is dug.
const INSIDE: u8 = 1;
const OUTSIDE: u8 = 2;
const WAITING: u8 = 3;

/// Facets of a border, above which they are glued by sorting: the table grows with the square of their number.
const TABLED_FACETS: usize = 2000;

/// The least side of the table, in vertices: hardly any border has more.
const LEAST_TABLE: usize = 64;

/// Buffers that are kept between insertions.
#[derive(Clone, Debug, Default)]
pub(in crate::space) struct Cavity {
    /// The tetrahedra in conflict; then the new ones.
    cells: Vec<TetrahedronId>,
    /// All that are or were to be tested, in their order, and how many they are.
    queue: Vec<TetrahedronId>,
    queued: usize,
    /// The facets around them, seen from outside.
    border: Vec<FacetId>,
    /// The border's vertices by their number, each with a new tetrahedron; the ghost has the first.
    vertices: Vec<(Place, TetrahedronId)>,
    /// For each facet of the border where its edges are in the table, as seen from the other side.
    edges: Vec<[u32; 3]>,
    /// By the numbers of its ends, the facet above each directed edge of the border.
    table: Vec<FacetId>,
    /// The vertices inside, which the new one hides, where it may hide some; before that all corners that may be.
    hidden: Vec<Place>,
    /// Tetrahedra of the cavity that its star did not take.
    spare: Vec<TetrahedronId>,
}

impl Cavity {
    /// Makes the point at `v` a vertex: removes the tetrahedra in conflict with it, starting from `seed`, one of them,
    /// and joins it to their border.
    ///
    /// `None`, and nothing has changed, if there is no room.
    pub(in crate::space) fn insert<A: Arena, T: Tally>(
        &mut self,
        arena: &mut A,
        v: Place,
        seed: TetrahedronId,
        tally: &mut T,
    ) -> Option<()> {
        self.find(&mut arena.memory(), v, seed, tally);
        if self.border.len() > self.cells.len() + arena.room() {
            let marks = arena.memory().marks;
            self.cells.iter().chain(&self.queue[..self.queued]).for_each(|t| marks[t.index()] = 0);
            return None;
        }
        tally.destroyed(self.cells.len());
        tally.created(self.border.len());
        if A::Weight::HIDES {
            self.find_perhaps_hidden(&arena.memory());
        }
        while self.cells.len() < self.border.len() {
            self.cells.push(arena.new_cell()?);
        }
        // A ball of many tetrahedra may have few facets.
        self.spare.clear();
        for t in self.cells.drain(self.border.len()..) {
            self.spare.push(t);
            arena.memory().marks[t.index()] = 0;
            arena.free_cell(t);
        }
        self.refill(&mut arena.memory(), v);
        if A::Weight::HIDES {
            self.find_hidden(&mut arena.memory());
        }
        Some(())
    }

    /// The vertices that the last one inserted hides, which are none any more.
    pub(in crate::space) fn hidden(&self) -> &[Place] {
        &self.hidden
    }

    /// The tetrahedra that the last insertion made, in slots of the cavity and new ones, and those that it freed.
    pub(in crate::space) fn last(&self) -> impl Iterator<Item = TetrahedronId> + '_ {
        self.cells.iter().chain(&self.spare).copied()
    }

    /// The corners of the cavity that have one of its tetrahedra for their own, as all inside do.
    fn find_perhaps_hidden<W>(&mut self, memory: &Memory<'_, W>) {
        let mut count = 0;
        self.hidden.resize(4 * self.cells.len(), Place::GHOST);
        for &t in &self.cells {
            for p in memory.cells[t.index()].corners {
                self.hidden[count] = p;
                count += usize::from(memory.incident.get(p.index()) == Some(&t));
            }
        }
        self.hidden.truncate(count);
    }

    /// Finds the vertices of the cavity that are on no new tetrahedron: the new site hides them.
    fn find_hidden<W>(&mut self, memory: &mut Memory<'_, W>) {
        let Memory { cells, incident, .. } = memory;
        self.hidden.retain(|&p| !cells[incident[p.index()].index()].corners.contains(&p));
        self.hidden.iter().for_each(|p| incident[p.index()] = TetrahedronId::NONE);
    }

    /// The vertices that the last one inserted is joined to, the ghost not among them.
    pub(in crate::space) fn joined(&self) -> impl Iterator<Item = Place> {
        self.vertices[1..].iter().map(|vertex| vertex.0)
    }

    /// Collects the tetrahedra in conflict and their border. Two are tested at a time; what waits to be tested is decided
    /// without branches, which would go the wrong way half of the time.
    fn find<W: Lift, T: Tally>(
        &mut self,
        memory: &mut Memory<'_, W>,
        v: Place,
        seed: TetrahedronId,
        tally: &mut T,
    ) {
        let (point, weight) = (memory.points[v.index()], W::at(memory.weights, v));
        let q = (&point, weight);
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
    fn judge<W>(&mut self, memory: &mut Memory<'_, W>, t: TetrahedronId, inside: bool) {
        if inside {
            self.enter(memory, t);
        } else {
            memory.marks[t.index()] = OUTSIDE;
        }
    }

    /// Takes a tetrahedron into the cavity, and asks for its neighbors.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "calls are a fortieth of all instructions of a construction")]
    fn enter<W>(&mut self, memory: &mut Memory<'_, W>, t: TetrahedronId) {
        memory.marks[t.index()] = INSIDE;
        self.cells.push(t);
        if self.queue.len() < self.queued + 4 {
            self.lengthen();
        }
        let across = memory.cells[t.index()].across;
        let room = &mut self.queue[self.queued..self.queued + 4];
        let mut entered = 0;
        for facet in across {
            let next = facet.tetrahedron();
            let mark = &mut memory.marks[next.index()];
            let fresh = *mark == 0;
            *mark = if fresh { WAITING } else { *mark };
            prefetch(memory.cells, next.index());
            room[entered & 3] = next;
            entered += usize::from(fresh);
        }
        self.queued += entered;
    }

    #[cold]
    #[inline(never)]
    fn lengthen(&mut self) {
        self.queue.resize(2 * self.queued + 64, TetrahedronId::NONE);
    }

    /// Joins `v` to every facet of the border.
    fn refill<W>(&mut self, memory: &mut Memory<'_, W>, v: Place) {
        for (&g, &t) in self.border.iter().zip(&self.cells) {
            let outside = &mut memory.cells[g.tetrahedron().index()];
            outside.across[g.corner()] = t.facet(0);
            let [a, b, c] = ghost_last(FACETS[g.corner()].map(|k| outside.corners[k]));
            memory.marks[g.tetrahedron().index()] = 0;
            memory.marks[t.index()] = 0;
            memory.cells[t.index()] = Tetrahedron { corners: [v, a, b, c], across: [g; 4] };
        }
        if self.border.len() > TABLED_FACETS {
            self.glue_by_sorting(memory);
        } else {
            self.glue_by_table(memory);
        }
        self.vertices[1..].iter().for_each(|&(p, t)| memory.incident[p.index()] = t);
        memory.incident[v.index()] = self.cells[0];
    }

    /// Glues the new tetrahedra to each other, and lists the vertices of the border.
    fn glue_by_table<W>(&mut self, memory: &mut Memory<'_, W>) {
        // A sphere of F triangles has F / 2 + 2 corners; the ghost has a number even if it is none of them.
        let side = (self.border.len() / 2 + 3).next_power_of_two();
        let width = side.trailing_zeros();
        if self.table.len() < side * side {
            let most = side.max(LEAST_TABLE);
            self.table.resize(most * most, FacetId::NONE);
            self.vertices.reserve(most);
        }
        let table = &mut self.table[..side * side];
        self.edges.clear();
        self.vertices.clear();
        self.vertices.push((Place::GHOST, TetrahedronId::NONE));
        for &t in &self.cells {
            let [_, a, b, c] = memory.cells[t.index()].corners;
            let i = number(&mut self.vertices, memory.incident, a, t);
            let j = number(&mut self.vertices, memory.incident, b, t);
            let k = if c.is_ghost() { 0 } else { number(&mut self.vertices, memory.incident, c, t) };
            table[j << width | k] = t.facet(1);
            table[k << width | i] = t.facet(2);
            table[i << width | j] = t.facet(3);
            self.edges.push([k << width | j, i << width | k, j << width | i].map(|at| at as u32));
        }
        for (&t, edges) in self.cells.iter().zip(&self.edges) {
            let across = &mut memory.cells[t.index()].across;
            across[1] = table[edges[0] as usize];
            across[2] = table[edges[1] as usize];
            across[3] = table[edges[2] as usize];
        }
    }

    /// Glues a border of any size.
    #[cold]
    fn glue_by_sorting<W>(&mut self, memory: &mut Memory<'_, W>) {
        let mut edges = Vec::with_capacity(3 * self.cells.len());
        self.vertices.clear();
        for &t in &self.cells {
            let [_, a, b, c] = memory.cells[t.index()].corners;
            edges.extend([(1, b, c), (2, c, a), (3, a, b)].map(|(k, p, q)| (p.min(q), p.max(q), t.facet(k))));
            self.vertices.extend([(a, t), (b, t), (c, t)]);
        }
        edges.sort_unstable();
        for pair in edges.chunks_exact(2) {
            let [f, g] = [pair[0].2, pair[1].2];
            memory.cells[f.tetrahedron().index()].across[f.corner()] = g;
            memory.cells[g.tetrahedron().index()].across[g.corner()] = f;
        }
        self.vertices.retain(|vertex| !vertex.0.is_ghost());
        self.vertices.sort_unstable();
        self.vertices.dedup_by_key(|vertex| vertex.0);
        self.vertices.insert(0, (Place::GHOST, TetrahedronId::NONE));
    }
}

/// The corners of a facet, turned so that the ghost is the last.
#[inline]
fn ghost_last([a, b, c]: [Place; 3]) -> [Place; 3] {
    if a.is_ghost() {
        [b, c, a]
    } else if b.is_ghost() {
        [c, a, b]
    } else {
        [a, b, c]
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
