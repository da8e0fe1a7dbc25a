//! Layout: a mesh moves to other places, so that neighbors in the plane are neighbors in memory again.
//!
//! A mesh that changes loses its order in memory. Given an order of its vertices, each goes to an even place with
//! a free one after it, and with it go up to four triangles of its star, to the four slots that belong to the two
//! places: a place tells where its triangles are. About half of the slots stay free for what comes; or a third, with a free
//! place after every other vertex.
//!
//! Cost: O(n); old and new mesh exist side by side for a while.

use super::{HalfEdge, Mesh2, Slots};
use crate::ids::{EdgeId, Place, TriangleId};
use crate::memory::room_for;
use crate::parallel::filled;
use crate::prefetch::prefetch;

/// How much stays free.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Room {
    /// A place for each vertex: for what may become twice as many.
    Much,
    /// A place for every other vertex.
    Some,
}

impl Room {
    /// The place of a vertex, by its rank; of the number of vertices the number of places.
    #[inline]
    pub(crate) fn place(self, rank: usize) -> usize {
        match self {
            Self::Much => 2 * rank,
            Self::Some => rank + rank / 2,
        }
    }

    /// Slots of triangles for each vertex: two for each place.
    fn own(self) -> usize {
        match self {
            Self::Much => 4,
            Self::Some => 3,
        }
    }

    /// Whether a place stays free.
    fn is_free(self, place: usize) -> bool {
        match self {
            Self::Much => place % 2 == 1,
            Self::Some => place % 3 == 2,
        }
    }

    /// Spreads values by rank over the places; free places get a copy of their neighbor's value.
    pub(crate) fn spread<T: Copy>(
        self,
        by_rank: impl ExactSizeIterator<Item = T>,
    ) -> impl Iterator<Item = T> {
        let count = move |rank| self.place(rank + 1) - self.place(rank);
        by_rank.enumerate().flat_map(move |(rank, what)| std::iter::repeat_n(what, count(rank)))
    }
}

/// Vertices between the one that is moved and the one that is prefetched.
const PREFETCH_DISTANCE: usize = 8;
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
    /// Puts the vertex at place `order[i]` to place `room.place(i)`, for all vertices. Returns for each old place the new one,
    /// and the free places between.
    pub(crate) fn lay_out(&mut self, order: &[Place], room: Room) -> (Vec<Place>, Slots) {
        let places = room.place(order.len());
        let mut moved = filled(Place::GHOST, self.incident.len());
        for (i, place) in order.iter().enumerate() {
            moved[place.index()] = Place::new(room.place(i));
        }
        let (moves, free) = Moves::new(self, order, room);
        let edge = |e: EdgeId| match e {
            EdgeId::NONE => e,
            e => TriangleId::new(moves.to[e.triangle().index()] as usize).edge(e.corner()),
        };
        let mut edges = room_for(with_spare(4 * moves.from.len()));
        for (slot, &t) in moves.from.iter().enumerate() {
            prefetch(
                &self.edges,
                moves
                    .from
                    .get(slot + PREFETCH_DISTANCE * room.own())
                    .map_or(0, |&t| (t as usize).wrapping_mul(4)),
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
        let mut incident = room_for(with_spare(places));
        incident.resize(places, EdgeId::NONE);
        for (i, p) in order.iter().enumerate() {
            incident[room.place(i)] = edge(self.incident[p.index()]);
        }
        self.incident = incident;
        self.ghost_edge = edge(self.ghost_edge);
        self.lone = self.lone.map(|p| moved[p.index()]);
        self.free = free;
        if let Some(names) = &mut self.names {
            names.rearrange(places, &moved);
        }
        (moved, Slots::where_free(places, |place| room.is_free(place)))
    }
}

impl Moves {
    /// Each vertex takes triangles of its star that no vertex before it has taken; the few whose corners have
    /// all taken others (one in 30,000 of random points with much room) get slots nearby that are still free. Says also which
    /// slots stay free.
    fn new(mesh: &Mesh2, order: &[Place], room: Room) -> (Self, Slots) {
        let own = room.own();
        let mut moves = Self { to: filled(NONE, mesh.slot_count()), from: filled(NONE, own * order.len()) };
        for (i, &place) in order.iter().enumerate() {
            if let Some(next) = order.get(i + PREFETCH_DISTANCE) {
                prefetch(&mesh.edges, mesh.incident[next.index()].index());
            }
            let mut slots = own * i..own * (i + 1);
            for t in mesh.spokes(place).map(EdgeId::triangle) {
                if moves.to[t.index()] == NONE
                    && let Some(slot) = slots.next()
                {
                    moves.put(t, slot);
                }
            }
        }
        let mut free = Slots::where_free(moves.from.len(), |slot| moves.from[slot] == NONE);
        // Where the triangle before was put, which is likely to be near in the plane too.
        let mut near = 0;
        for t in (0..mesh.slot_count()).map(TriangleId::new) {
            if moves.to[t.index()] != NONE {
                near = moves.to[t.index()] as usize;
            } else if mesh.is_triangle(t) {
                // There are two triangles a vertex, and three slots at least.
                let slot = free.take_near(near).expect("a third of all slots is free");
                moves.put(t, slot);
            }
        }
        (moves, free)
    }

    fn put(&mut self, t: TriangleId, slot: usize) {
        self.to[t.index()] = slot as u32;
        self.from[slot] = t.index() as u32;
    }
}
