//! Operations on the triangles of a mesh: flip an edge, fill a cavity with a star, fill a hole side by side.
//!
//! Nothing else writes corners and twins, but for the line below the plane ([`super::line`]), the layout of memory
//! ([`super::layout`]) and the bulk construction, which has arrays of its own (`plane/construct`). Tags are carried along
//! ([`super::tags`]). Cost: O(1) for each triangle written.

use super::tags::Tags;
use super::{HalfEdge, Mesh2};
use crate::ids::{EdgeId, Place, TriangleId};
use crate::memory::make_room;
use crate::mesh::Slots;

/// An edge of the border of a hole: where it starts, and its twin outside.
pub(crate) type BorderEdge = (Place, EdgeId);

/// A part of a hole still to be filled: the first and the last vertex of a run of its border, the edge that closes it, seen
/// from outside, and what whoever chooses apexes wants to know of it.
pub(crate) type Part<C> = (usize, usize, EdgeId, C);

impl Mesh2 {
    /// A triangle to be filled in, near another one in memory.
    pub(crate) fn new_triangle(&mut self, near: TriangleId) -> TriangleId {
        if let Some(slot) = self.free.take_near(near.index()) {
            return TriangleId::new(slot);
        }
        make_room(&mut self.edges, 4);
        self.edges.extend([HalfEdge::UNUSED; 4]);
        TriangleId::new(self.slot_count() - 1)
    }

    /// A triangle with these corners, glued to nothing yet.
    pub(crate) fn loose_triangle(&mut self, corners: [Place; 3]) -> TriangleId {
        let [a, b, c] = corners.map(|origin| HalfEdge { origin, twin: EdgeId::NONE });
        make_room(&mut self.edges, 4);
        self.edges.extend([a, b, c, HalfEdge::UNUSED]);
        TriangleId::new(self.slot_count() - 1)
    }

    /// Gives a triangle back.
    pub(crate) fn free_triangle(&mut self, t: TriangleId) {
        self.edges[t.edge(0).index()..][..4].fill(HalfEdge::UNUSED);
        self.free.give(t.index());
    }

    /// Gives all triangles back.
    pub(crate) fn clear_triangles(&mut self) {
        self.incident.fill(EdgeId::NONE);
        self.edges.clear();
        self.free = Slots::default();
        self.ghost_edge = EdgeId::NONE;
    }

    /// Writes the corners of a triangle.
    #[inline]
    pub(super) fn set_corners(&mut self, t: TriangleId, corners: [Place; 3]) {
        let records = &mut self.edges[t.edge(0).index()..][..3];
        for (record, corner) in records.iter_mut().zip(corners) {
            record.origin = corner;
        }
    }

    /// Makes two directed edges twins of each other.
    #[inline]
    pub(super) fn link(&mut self, e: EdgeId, f: EdgeId) {
        self.edges[e.index()].twin = f;
        self.edges[f.index()].twin = e;
    }

    /// Remembers the edge as one that leaves its origin.
    #[inline]
    pub(super) fn remember(&mut self, e: EdgeId) {
        match self.tail(e) {
            Place::GHOST => self.ghost_edge = e,
            p => self.incident[p.index()] = e,
        }
    }

    /// Replaces an edge by the one between the two apexes. The sides of the quadrilateral stay with `e` and its twin:
    /// `e.next()`, `e.previous()` and those of the twin.
    pub(crate) fn flip(&mut self, e: EdgeId) {
        let f = self.twin(e);
        self.flip_into(e, [e, f]);
        for side in [e.next(), e.previous(), f.next(), f.previous()] {
            self.remember(side);
        }
    }

    /// Replaces the edge e = a -> b by d -> c, in the triangles of two other edges, or of itself and its twin: those of e
    /// are left as they are then. No vertex gets another edge to remember.
    ///
    /// ```text
    ///        c                    c
    ///      /   \                / | \
    ///     a --> b     =>       a  |  b      into[0] is d -> c, of the triangle on its left
    ///      \   /                \ | /
    ///        d                    d
    /// ```
    pub(crate) fn flip_into(&mut self, e: EdgeId, into: [EdgeId; 2]) {
        debug_assert!(!self.is_fixed(e), "{e:?} is fixed");
        let f = self.twin(e);
        let (a, b, c, d) = (self.tail(e), self.tail(f), self.tip(e), self.tip(f));
        let domain = self.tags(e.triangle()).of_domain();
        let [b_c, c_a, a_d, d_b] =
            [e.next(), e.previous(), f.next(), f.previous()].map(|side| self.twin(side));
        self.write(into[0], [d, c, a], [(into[0].next(), c_a), (into[0].previous(), a_d)], domain);
        self.write(into[1], [c, d, b], [(into[1].next(), d_b), (into[1].previous(), b_c)], domain);
        self.link(into[0], into[1]);
    }

    /// Writes all of a triangle. The twins do not know of it yet.
    #[inline]
    fn write_triangle(&mut self, t: TriangleId, corners: [Place; 3], twins: [EdgeId; 3], tags: Tags) {
        let records = &mut self.edges[t.edge(0).index()..][..4];
        for k in 0..3 {
            records[k] = HalfEdge { origin: corners[k], twin: twins[k] };
        }
        records[3] = tags.record();
    }

    /// Writes the triangle of an edge, its corners from the origin of the edge on, two of its sides glued to what is outside.
    #[inline]
    fn write(&mut self, e: EdgeId, corners: [Place; 3], sides: [(EdgeId, EdgeId); 2], domain: Tags) {
        for (side, corner) in [e, e.next(), e.previous()].into_iter().zip(corners) {
            self.edges[side.index()].origin = corner;
        }
        let mut tags = domain;
        for (side, outside) in sides {
            tags = tags.with(side, self.is_fixed(outside));
            self.link(side, outside);
        }
        self.set_tags(e.triangle(), tags);
    }

    /// Joins `v` to every edge of a border, given counter-clockwise, in as many triangles: edge 0 of each is the border's, and
    /// `v` its last corner.
    #[inline]
    pub(crate) fn fill_star(&mut self, v: Place, border: &[BorderEdge], triangles: &[TriangleId]) {
        debug_assert_eq!(triangles.len(), border.len(), "a triangle for each edge");
        // Of the first triangle before any is written: all that go are in one domain.
        let domain = self.tags(triangles[0]).of_domain();
        let mut previous = triangles[triangles.len() - 1];
        for (i, (&t, &(a, outside))) in triangles.iter().zip(border).enumerate() {
            let (b, following) = match (border.get(i + 1), triangles.get(i + 1)) {
                (Some(&(b, _)), Some(&following)) => (b, following),
                _ => (border[0].0, triangles[0]),
            };
            let tags = domain.with(t.edge(0), self.is_fixed(outside));
            let twins = [outside, following.edge(2), previous.edge(1)];
            self.write_triangle(t, [a, b, v], twins, tags);
            self.edges[outside.index()].twin = t.edge(0);
            self.remember(t.edge(0));
            previous = t;
        }
        self.incident[v.index()] = triangles[0].edge(2);
    }

    /// Fills a hole of n edges, its border given counter-clockwise, with the last n - 2 of some triangles, side by side. `apex`
    /// says which vertex of the border is joined to the side from `last` to `first`, one between them, and what is to be known
    /// of the two sides that this makes, the one from `first` on first. `pending` is a buffer.
    #[inline]
    pub(crate) fn fill_hole<C>(
        &mut self,
        border: &[BorderEdge],
        triangles: &[TriangleId],
        pending: &mut Vec<Part<C>>,
        known: C,
        mut apex: impl FnMut(usize, usize, C) -> (usize, C, C),
    ) {
        let (end, closing) = (border.len() - 1, border[border.len() - 1].1);
        let mut unused = triangles.len();
        let domain = self.tags(triangles[unused - 1]).of_domain();
        pending.push((0, end, closing, known));
        while let Some((first, last, outside, known)) = pending.pop() {
            if last == first + 1 {
                let side = border[first].1;
                self.link(outside, side);
                self.remember(outside);
                if self.is_fixed(side) {
                    self.set_fixed(side, true);
                }
                continue;
            }
            let (k, towards, back) = apex(first, last, known);
            unused -= 1;
            let t = triangles[unused];
            let corners = [border[last].0, border[first].0, border[k].0];
            // Two of its sides are closed when their turn comes.
            self.write_triangle(t, corners, [outside, EdgeId::NONE, EdgeId::NONE], domain);
            self.edges[outside.index()].twin = t.edge(0);
            pending.push((first, k, t.edge(1), towards));
            pending.push((k, last, t.edge(2), back));
        }
        let inside = self.twin(closing);
        self.remember(inside);
        if self.is_fixed(closing) {
            self.set_fixed(closing, true);
        }
    }

    /// Lets `new` stand where `old` stood: the same vertex at another place.
    pub(crate) fn rename(&mut self, old: Place, new: Place) {
        let star: Vec<EdgeId> = self.spokes(old).collect();
        star.into_iter().for_each(|e| self.edges[e.index()].origin = new);
        self.incident.swap(old.index(), new.index());
        if self.lone == Some(old) {
            self.lone = Some(new);
        }
    }

    /// A copy of those triangles of another mesh that are present and have only corners with a place here, closed with ghosts;
    /// together they are convex. None if there are no such triangles.
    #[cfg(feature = "histories")]
    pub(crate) fn closed(
        places: usize,
        other: &Self,
        is_present: impl Fn(TriangleId) -> bool,
        place: impl Fn(Place) -> Place,
    ) -> Option<Self> {
        let mut mesh = Self::empty(places);
        let slots = (0..other.slot_count()).map(TriangleId::new);
        let used = slots.filter(|&t| other.is_triangle(t) && is_present(t));
        let corners = |t: TriangleId| other.places(t).map(&place);
        let kept: Vec<TriangleId> = used.filter(|&t| !corners(t).contains(&Place::GHOST)).collect();
        let mut image = vec![None; other.slot_count()];
        for &t in &kept {
            let new = mesh.new_triangle(TriangleId::new(0));
            mesh.set_corners(new, corners(t));
            image[t.index()] = Some(new);
        }
        // For each vertex of the hull the ghost of the hull edge that leaves it.
        let mut leaving = vec![None; places];
        for t in kept {
            for k in 0..3 {
                let twin = other.twin(t.edge(k));
                let e = image[t.index()].expect("kept").edge(k);
                if let Some(across) = image[twin.triangle().index()] {
                    mesh.link(e, across.edge(twin.corner()));
                } else {
                    let (u, v) = (mesh.tail(e), mesh.head(e));
                    let ghost = mesh.new_triangle(TriangleId::new(0));
                    mesh.set_corners(ghost, [v, u, Place::GHOST]);
                    mesh.link(ghost.edge(0), e);
                    leaving[u.index()] = Some(ghost);
                }
                mesh.remember(e);
            }
        }
        for ghost in leaving.iter().flatten() {
            let v = mesh.tail(ghost.edge(0));
            let next: TriangleId = leaving[v.index()].expect("the hull is closed");
            mesh.link(ghost.edge(2), next.edge(1));
            mesh.remember(ghost.edge(2));
        }
        (mesh.slot_count() > 0).then_some(mesh)
    }

    /// Two triangles back to back: a sphere of three vertices, at places 0 to 2.
    #[cfg(feature = "histories")]
    pub(crate) fn pillow() -> Self {
        let mut mesh = Self::empty(3);
        let [front, back] = [[0, 1, 2], [0, 2, 1]].map(|corners| {
            let t = mesh.new_triangle(TriangleId::new(0));
            mesh.set_corners(t, corners.map(Place::new));
            t
        });
        for k in 0..3 {
            mesh.link(front.edge(k), back.edge(2 - k));
            mesh.remember(front.edge(k));
        }
        mesh.vertex_count = 3;
        mesh
    }
}
