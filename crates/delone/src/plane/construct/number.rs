//! The last step of divide and conquer: vertices, until then positions in an order, get their places.
//!
//! Cost: O(n); it reads and writes every triangle once, which memory bounds: two threads gain a third.

use std::sync::atomic::AtomicU32;
use std::sync::atomic::Ordering::Relaxed;

use crate::ids::{EdgeId, Place, TriangleId};
use crate::mesh::Slots;
use crate::mesh::triangles::{HalfEdge, Mesh2};
use crate::parallel;

impl Mesh2 {
    /// Puts each vertex from its position in an order to its place, one of so many, and remembers an edge of each: the
    /// last one.
    ///
    /// Where sites are hidden some triangles are unused, and stay so.
    ///
    /// A task has the triangles of some positions, and writes for these alone; what it finds of others is written
    /// afterwards. Edges are noted by position, near each other in memory, and each put to its place once.
    pub(super) fn number_vertices<const HIDES: bool>(
        &mut self,
        places: usize,
        place: impl Fn(Place) -> Place + Sync,
    ) {
        let n = self.vertex_count;
        let mut last = parallel::filled(EdgeId::NONE, n);
        let ends = parallel::even_ends(n, parallel::parts(n));
        let records: Vec<usize> = ends.iter().map(|end| (8 * end).min(self.edges.len())).collect();
        let starts = std::iter::once(0).chain(ends.iter().copied());
        let runs = parallel::split_at(&mut self.edges, &records).into_iter().zip(starts);
        let tasks = runs.zip(parallel::split_at(&mut last, &ends)).collect();
        let found =
            parallel::map(tasks, |((edges, start), last): ((&mut [HalfEdge], usize), &mut [EdgeId])| {
                let mut elsewhere = Vec::new();
                let ghost_edge = number::<HIDES>(edges, 2 * start, &place, |position, e| {
                    match last.get_mut(position.index().wrapping_sub(start)) {
                        Some(last) => *last = e,
                        None => elsewhere.push((position, e)),
                    }
                });
                (ghost_edge, elsewhere)
            });
        for (ghost_edge, elsewhere) in found {
            if ghost_edge != EdgeId::NONE {
                self.ghost_edge = ghost_edge;
            }
            for (position, e) in elsewhere {
                let last = &mut last[position.index()];
                *last = if *last == EdgeId::NONE { e } else { e.max(*last) };
            }
        }
        let incident: Vec<AtomicU32> = parallel::collect(places, |_| AtomicU32::new(EdgeId::NONE.bits()));
        let tasks: Vec<_> = parallel::ranges(n);
        parallel::map(tasks, |positions| {
            for position in positions {
                let v = place(Place::new(position));
                incident[v.index()].store(last[position].bits(), Relaxed);
            }
        });
        self.incident = incident.into_iter().map(|bits| EdgeId::from_bits(bits.into_inner())).collect();
    }
}

impl Mesh2 {
    /// Counts triangles that were left over where sites are hidden as free, and these sites as none.
    pub(super) fn forget_unused(&mut self) {
        let hidden = self.incident.iter().filter(|&&e| e == EdgeId::NONE).count();
        if self.lone.is_none() && hidden > 0 {
            self.vertex_count -= hidden;
            self.free = Slots::where_free(self.slot_count(), |slot| {
                self.edges[TriangleId::new(slot).edge(0).index()].twin == EdgeId::NONE
            });
        }
    }
}

impl Mesh2 {
    /// Moves each vertex to another place, one of so many. Triangles stay as they are, fixed edges too.
    pub(super) fn move_vertices(&mut self, places: usize, place: impl Fn(Place) -> Place + Sync) {
        let ends: Vec<usize> = parallel::even_ends(self.slot_count(), parallel::parts(self.incident.len()))
            .into_iter()
            .map(|end| 4 * end)
            .collect();
        parallel::map(parallel::split_at(&mut self.edges, &ends), |edges| {
            let records = edges.chunks_exact_mut(4).flat_map(|records| &mut records[..3]);
            for record in records.filter(|record| !record.origin.is_ghost()) {
                record.origin = place(record.origin);
            }
        });
        let mut incident = parallel::filled(EdgeId::NONE, places);
        for (position, &e) in self.incident.iter().enumerate() {
            incident[place(Place::new(position)).index()] = e;
        }
        self.incident = incident;
        self.lone = self.lone.map(place);
    }
}

/// Puts the vertices of triangles, the first of which has a number, from their positions to their places, and notes position
/// and edge of each corner. Returns the last edge that starts at the ghost.
fn number<const HIDES: bool>(
    edges: &mut [HalfEdge],
    first: usize,
    place: impl Fn(Place) -> Place,
    mut note: impl FnMut(Place, EdgeId),
) -> EdgeId {
    let mut ghost_edge = EdgeId::NONE;
    for (t, records) in edges.chunks_exact_mut(4).enumerate() {
        records[3] = HalfEdge::UNUSED;
        if HIDES && records[0].twin == EdgeId::NONE {
            continue;
        }
        for (k, record) in records[..3].iter_mut().enumerate() {
            let e = TriangleId::new(first + t).edge(k);
            let position = record.origin;
            if position.is_ghost() {
                ghost_edge = e;
            } else {
                record.origin = place(position);
                note(position, e);
            }
        }
    }
    ghost_edge
}
