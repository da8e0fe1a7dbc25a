//! Tags of a triangle: a mark while a cavity is dug, which of its edges are fixed, and the domain
//! that it is in. All are in its fourth record, on the cache line that is read anyway.
//!
//! Every operation of [`super::surgery`] and [`super::line`] carries tags along: an edge stays fixed as long as it is there,
//! and new triangles are in the domain of those whose place they take. Fixed edges and domains are for triangulations with
//! constraints; a plain one has none.

use super::{HalfEdge, Mesh2};
use crate::ids::{EdgeId, Place, TriangleId};

/// Bits 0 to 2: edges 0 to 2 are fixed. The others: the domain.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Tags(u32);

const EDGES: u32 = 0b111;

impl Tags {
    /// The tags of a new triangle in the same domain: no edge is fixed.
    #[inline]
    pub(super) fn of_domain(self) -> Self {
        Self(self.0 & !EDGES)
    }

    /// The tags as they are written, without a mark.
    #[inline]
    pub(super) fn record(self) -> HalfEdge {
        HalfEdge { origin: Place::GHOST, twin: EdgeId::from_bits(!self.0) }
    }

    /// With an edge fixed, or not.
    #[inline]
    pub(super) fn with(self, e: EdgeId, fixed: bool) -> Self {
        Self(self.0 & !(1 << e.corner()) | u32::from(fixed) << e.corner())
    }
}

impl Mesh2 {
    /// Whether an edge is fixed, so that no flip may take it away.
    #[inline]
    pub fn is_fixed(&self, e: EdgeId) -> bool {
        self.tags(e.triangle()).0 >> e.corner() & 1 == 1
    }

    /// The fixed edges, each in one of its two directions. Cost: O(n), little for a triangle that has none.
    pub(crate) fn fixed_edges(&self) -> impl Iterator<Item = EdgeId> + '_ {
        let has_some = |&t: &TriangleId| self.tags(t).0 & EDGES != 0 && self.is_triangle(t);
        let triangles = (0..self.slot_count()).map(TriangleId::new).filter(has_some);
        let edges = triangles.flat_map(|t| [0, 1, 2].map(|k| t.edge(k)));
        edges.filter(|&e| self.is_fixed(e) && e < self.twin(e))
    }

    /// The number of the domain that a triangle is in; 0 if there are none.
    pub fn domain(&self, t: TriangleId) -> usize {
        (self.tags(t).0 >> EDGES.count_ones()) as usize
    }

    #[inline]
    pub(super) fn tags(&self, t: TriangleId) -> Tags {
        if !self.is_tagged {
            return Tags::default();
        }
        Tags(!self.edges[4 * t.index() + 3].twin.bits())
    }

    /// Gives a triangle its tags, and takes its mark away.
    #[inline]
    pub(super) fn set_tags(&mut self, t: TriangleId, tags: Tags) {
        self.edges[4 * t.index() + 3] = tags.record();
    }

    /// Fixes an edge and its twin, or lets them go.
    pub(crate) fn set_fixed(&mut self, e: EdgeId, fixed: bool) {
        self.is_tagged |= fixed;
        for e in [e, self.twin(e)] {
            self.set_tags(e.triangle(), self.tags(e.triangle()).with(e, fixed));
        }
    }

    /// Whether a triangle is marked.
    #[inline]
    pub(crate) fn is_marked(&self, t: TriangleId) -> bool {
        self.edges[4 * t.index() + 3].origin != Place::GHOST
    }

    /// Marks a triangle; whatever gives it new corners takes the mark away.
    #[inline]
    pub(crate) fn mark(&mut self, t: TriangleId) {
        self.edges[4 * t.index() + 3].origin = Place::new(0);
    }
}

impl Mesh2 {
    /// Takes the mark of a triangle away that keeps its corners.
    pub(crate) fn unmark(&mut self, t: TriangleId) {
        self.edges[4 * t.index() + 3].origin = Place::GHOST;
    }

    /// Puts a triangle into a domain; 0 is none.
    pub(crate) fn set_domain(&mut self, t: TriangleId, domain: usize) {
        self.is_tagged |= domain > 0;
        let tags = self.tags(t);
        self.set_tags(t, Tags(tags.0 & EDGES | (domain as u32) << EDGES.count_ones()));
    }
}

#[cfg(test)]
mod tests {
    use delone_generators::{Kind, Random};

    use super::{EDGES, Tags};
    use crate::ids::{EdgeId, VertexId};
    use crate::mesh::Mesh2;
    use crate::plane::Delaunay2;

    fn fix(mesh: &mut Mesh2, e: EdgeId) {
        mesh.set_fixed(e, true);
    }

    /// The fixed edges that there are, by their ends, and whether both sides say so.
    fn fixed(d: &Delaunay2) -> Vec<[VertexId; 2]> {
        let mesh = d.mesh();
        let mut found = Vec::new();
        for e in mesh.undirected_edges() {
            assert_eq!(mesh.is_fixed(e), mesh.is_fixed(mesh.twin(e)), "{e:?}");
            if mesh.is_fixed(e) {
                let mut ends = [mesh.origin(e), mesh.destination(e)];
                ends.sort_unstable();
                found.push(ends);
            }
        }
        found.sort_unstable();
        found
    }

    #[test]
    fn what_is_fixed_stays_so_as_long_as_it_is_there() {
        // Constrained triangulations do more where a new point is on a fixed edge, or one ends at a vertex that goes.
        for kind in [Kind::Uniform, Kind::Circle] {
            let points = kind.points(60, 1);
            let mut d = Delaunay2::from_points(&points).expect("finite");
            let mut random = Random::new(3);
            let edges: Vec<EdgeId> = d.mesh().undirected_edges().collect();
            let mesh = d.mesh_mut();
            edges.iter().filter(|_| random.below(3) == 0).for_each(|&e| fix(mesh, e));
            let expected = fixed(&d);
            assert!(!expected.is_empty());
            for _ in 0..200 {
                let alive: Vec<VertexId> = d.vertices().collect();
                let goes = alive[random.below(alive.len())];
                let is_free = !d.mesh().star(goes).any(|e| d.mesh().is_fixed(e));
                if random.below(2) == 0 && is_free {
                    d.remove(goes).expect("a vertex");
                } else {
                    let like = points[random.below(points.len())];
                    let along = random.between(0.0, 1.0);
                    let other = points[random.below(points.len())];
                    d.insert([0, 1].map(|k| like[k] + along * (other[k] - like[k]))).expect("finite");
                }
                if random.below(20) == 0 {
                    d.lay_out();
                }
                let after: Vec<[VertexId; 2]> = d.edges().map(sorted).collect();
                assert!(d.check().is_ok(), "{kind:?}");
                assert!(expected.iter().all(|ends| after.contains(ends)), "{kind:?}");
                assert_eq!(fixed(&d), expected, "{kind:?}");
            }
        }
    }

    fn sorted(mut ends: [VertexId; 2]) -> [VertexId; 2] {
        ends.sort_unstable();
        ends
    }

    #[test]
    fn triangles_stay_in_their_domain() {
        let mut d = Delaunay2::from_points(&Kind::Uniform.points(100, 1)).expect("finite");
        let all: Vec<_> = (0..d.mesh().slot_count()).map(crate::ids::TriangleId::new).collect();
        let mesh = d.mesh_mut();
        mesh.is_tagged = true;
        all.iter().for_each(|&t| mesh.set_tags(t, Tags(7 << EDGES.count_ones())));
        for p in Kind::Uniform.points(100, 2) {
            d.insert(p).expect("finite");
        }
        for v in d.vertices().take(150).collect::<Vec<_>>() {
            d.remove(v).expect("a vertex");
        }
        d.lay_out();
        assert!(d.mesh().triangles().all(|t| d.mesh().domain(t) == 7));
    }
}
