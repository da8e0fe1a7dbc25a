//! The cavity of a new point: the tetrahedra whose spheres contain it, refilled as a star.
//!
//! Source: Bowyer, and Watson, The Computer Journal 1981. With the canonical in-sphere test the cavity is that of
//! points in general position: a ball without an inner vertex, star-shaped around the new point. With weights the vertices
//! inside are those that it hides. The new tetrahedra stand on the facets of the ball's border ([`StarFill`]).
//!
//! Cost: O(k) for k tetrahedra, about twenty on average over random insertions; nothing is allocated once the buffers
//! have grown.

use super::arena::{Arena, Memory};
use super::kernel::Lift;
use crate::ids::{FacetId, Place, TetrahedronId};
use crate::mesh::tetrahedra::surgery::StarFill;
use crate::prefetch::prefetch;
use crate::tally::Tally;

/// Marks of tetrahedra while a cavity is dug.
const INSIDE: u8 = 1;
const OUTSIDE: u8 = 2;
const WAITING: u8 = 3;

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
    star: StarFill,
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
        self.star.fill(&mut arena.memory().records(), v, &self.border, &self.cells);
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
        self.star.joined()
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
}
