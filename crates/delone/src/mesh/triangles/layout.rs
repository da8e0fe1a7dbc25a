//! The same mesh at other places: neighbours in the plane become neighbours in memory again.
//!
//! A mesh that changes loses its order in memory. Given an order of its vertices, each goes to an even place with
//! a free one after it, and with it go up to four triangles of its star, to the four slots that belong to the two
//! places: a place tells where its triangles are. About half of the slots stay free for what comes.
//!
//! Cost: O(n); old and new mesh exist side by side for a while.

use super::{HalfEdge, Mesh2, Slots};
use crate::ids::{EdgeId, Place, TriangleId};
use crate::memory::room_for;
use crate::parallel::filled;
use crate::prefetch::prefetch;

/// Places for each vertex.
const ROOM: usize = 2;
/// Slots of triangles for each vertex.
const OWN: usize = 2 * ROOM;
/// How many vertices ahead memory is asked.
const AHEAD: usize = 8;
/// Where a triangle goes that is free, or has no new slot yet; what comes to a slot that stays free.
const NONE: u32 = u32::MAX;

/// Slots are made anew where none nearby is free, up to one in eight (see `slots`): memory for these is set aside, and
/// costs nothing until it is used.
pub(crate) const fn with_spare(count: usize) -> usize {
    count + count / 8
}

/// Which triangle goes where.
struct Moves {
    /// For each old triangle its new slot.
    to: Vec<u32>,
    /// For each new slot the old triangle.
    from: Vec<u32>,
}

impl Mesh2 {
    /// Puts the vertex at place `order[i]` to place 2 i, for all vertices. Returns for each old place the new one,
    /// and the free places between.
    pub(crate) fn lay_out(&mut self, order: &[Place]) -> (Vec<Place>, Slots) {
        let mut moved = filled(Place::GHOST, self.incident.len());
        for (i, place) in order.iter().enumerate() {
            moved[place.index()] = Place::new(ROOM * i);
        }
        let moves = Moves::new(self, order);
        let edge = |e: EdgeId| match e {
            EdgeId::NONE => e,
            e => TriangleId::new(moves.to[e.triangle().index()] as usize).edge(e.corner()),
        };
        let mut edges = room_for(with_spare(4 * moves.from.len()));
        for (slot, &t) in moves.from.iter().enumerate() {
            prefetch(
                &self.edges,
                moves.from.get(slot + AHEAD * OWN).map_or(0, |&t| (t as usize).wrapping_mul(4)),
            );
            let mut records = [HalfEdge::UNUSED; 4];
            if t != NONE {
                let old = &self.edges[TriangleId::new(t as usize).edge(0).index()..][..4];
                records[3] = old[3];
                for (record, &HalfEdge { origin, twin }) in records.iter_mut().zip(&old[..3]) {
                    let origin = if origin.is_ghost() { origin } else { moved[origin.index()] };
                    *record = HalfEdge { origin, twin: edge(twin) };
                }
            }
            edges.extend(records);
        }
        self.edges = edges;
        let mut incident = room_for(with_spare(ROOM * order.len()));
        incident.extend(order.iter().flat_map(|p| [edge(self.incident[p.index()]), EdgeId::NONE]));
        self.incident = incident;
        self.ghost_edge = edge(self.ghost_edge);
        self.lone = self.lone.map(|p| moved[p.index()]);
        self.free = Slots::where_free(moves.from.len(), |slot| moves.from[slot] == NONE);
        if let Some(names) = &mut self.names {
            names.rearrange(ROOM * order.len(), &moved);
        }
        (moved, Slots::where_free(ROOM * order.len(), |place| place % ROOM != 0))
    }
}

impl Moves {
    /// Each vertex takes triangles of its star that no vertex before it has taken; the few whose corners have
    /// all taken others (one in 30,000 of random points) get slots that are still free.
    fn new(mesh: &Mesh2, order: &[Place]) -> Self {
        let mut moves = Self { to: filled(NONE, mesh.slot_count()), from: filled(NONE, OWN * order.len()) };
        for (i, &place) in order.iter().enumerate() {
            if let Some(next) = order.get(i + AHEAD) {
                prefetch(&mesh.edges, mesh.incident[next.index()].index());
            }
            let mut slots = OWN * i..OWN * (i + 1);
            for t in mesh.spokes(place).map(EdgeId::triangle) {
                if moves.to[t.index()] == NONE
                    && let Some(slot) = slots.next()
                {
                    moves.put(t, slot);
                }
            }
        }
        let mut slot = 0;
        for t in (0..mesh.slot_count()).map(TriangleId::new) {
            if moves.to[t.index()] == NONE && mesh.is_triangle(t) {
                // There are twice as many slots as triangles.
                while moves.from[slot] != NONE {
                    slot += 1;
                }
                moves.put(t, slot);
            }
        }
        moves
    }

    fn put(&mut self, t: TriangleId, slot: usize) {
        self.to[t.index()] = slot as u32;
        self.from[slot] = t.index() as u32;
    }
}
