//! Topology of triangulated space, closed by a ghost vertex; no coordinates.
//!
//! A tetrahedron has four corners and four facets; facet k is across from corner k, and knows the facet that it is
//! glued to. Corners are in positive order: the first three are seen counter-clockwise from the fourth. Every facet of
//! the hull has a *ghost* tetrahedron beyond it, whose fourth corner is the vertex at infinity, so the whole is a
//! three-dimensional sphere without border cases.
//!
//! Inside, a vertex is known by its place, as in the plane. Points that span less than space are triangulated with
//! *scaffold* vertices off their span, which have a place but no name.
//!
//! Memory: 32 bytes a tetrahedron, one byte beside it for marks, 4 bytes a place.

mod check;
mod iterate;
pub(crate) mod surgery;

pub use check::MeshFlaw3;
pub use iterate::AroundEdge;
pub(crate) use iterate::first_around;

use std::collections::BTreeSet;

use super::Names;
use crate::ids::{FacetId, MAX_TETRAHEDRA, Place, TetrahedronId, VertexId};

/// The corners of facet k, so that they are seen counter-clockwise from corner k.
pub(crate) const FACETS: [[usize; 3]; 4] = [[1, 3, 2], [0, 2, 3], [0, 3, 1], [0, 1, 2]];

/// Four corners, and what is across the facets opposite to them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(C, align(32))]
pub(crate) struct Tetrahedron {
    pub(crate) corners: [Place; 4],
    pub(crate) across: [FacetId; 4],
}

impl Tetrahedron {
    /// A slot that is not in use.
    pub(crate) const FREE: Self = Self { corners: [Place::GHOST; 4], across: [FacetId::NONE; 4] };

    /// Which corner a place is, without a branch; 0 if it is none.
    #[inline]
    pub(crate) fn corner(&self, place: Place) -> usize {
        let [_, b, c, d] = self.corners.map(|corner| usize::from(corner == place));
        b + 2 * c + 3 * d
    }
}

/// How many tetrahedra there may be.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Most(pub(crate) usize);

impl Default for Most {
    /// Whose facets have indices.
    fn default() -> Self {
        Self(MAX_TETRAHEDRA)
    }
}

/// A triangulation's topology.
#[derive(Clone, Debug, Default)]
pub struct Mesh3 {
    pub(crate) cells: Vec<Tetrahedron>,
    /// For each place a tetrahedron at its vertex; none where there is no vertex.
    pub(crate) incident: Vec<TetrahedronId>,
    /// Slots that are not in use.
    pub(crate) free: Vec<TetrahedronId>,
    /// For each slot a mark, zero between operations.
    pub(crate) marks: Vec<u8>,
    /// Which vertex is where.
    pub(crate) names: Names,
    /// The number of vertices, scaffold not counted.
    pub(crate) vertex_count: usize,
    pub(crate) most: Most,
}

/// From outside, by vertex.
impl Mesh3 {
    /// The four corners in positive order; the ghost vertex, in a ghost tetrahedron, is the last.
    #[inline]
    pub fn corners(&self, t: TetrahedronId) -> [VertexId; 4] {
        self.cells[t.index()].corners.map(|p| self.name(p))
    }

    /// The corners of a facet, counter-clockwise seen from inside of its tetrahedron.
    pub fn facet_corners(&self, f: FacetId) -> [VertexId; 3] {
        self.facet_places(f).map(|p| self.name(p))
    }

    /// The facet glued to one, seen from the other side.
    #[inline]
    pub fn twin(&self, f: FacetId) -> FacetId {
        self.cells[f.tetrahedron().index()].across[f.corner()]
    }

    /// The tetrahedra across facets 0 to 3.
    #[doc(alias("neighbors", "neighbours"))]
    pub fn adjacent(&self, t: TetrahedronId) -> [TetrahedronId; 4] {
        self.cells[t.index()].across.map(FacetId::tetrahedron)
    }

    /// The finite tetrahedron across facet k.
    pub(crate) fn across(&self, t: TetrahedronId, k: usize) -> Option<TetrahedronId> {
        let next = self.twin(t.facet(k)).tetrahedron();
        Some(next).filter(|&t| !self.is_ghost(t))
    }

    /// Whether a corner of the tetrahedron is the vertex at infinity.
    #[inline]
    pub fn is_ghost(&self, t: TetrahedronId) -> bool {
        self.cells[t.index()].corners[3].is_ghost()
    }

    /// Whether this is a vertex.
    pub fn contains(&self, v: VertexId) -> bool {
        self.place(v).is_some()
    }

    /// The number of vertices, the ghost not counted.
    pub fn vertex_count(&self) -> usize {
        self.vertex_count
    }

    /// The vertices, by increasing index.
    pub fn vertices(&self) -> impl Iterator<Item = VertexId> + Clone + '_ {
        self.names.vertices()
    }

    /// One more than the largest index of a tetrahedron. Indices of removed ones are used again.
    pub fn slot_count(&self) -> usize {
        self.cells.len()
    }
}

/// From inside, by place.
impl Mesh3 {
    /// Memory of tetrahedra, stars and names, in bytes.
    pub(crate) fn bytes(&self) -> usize {
        let Self { cells, incident, marks, names, .. } = self;
        size_of_val(&**cells) + size_of_val(&**incident) + size_of_val(&**marks) + names.bytes()
    }

    /// The vertex at a place; the ghost for a scaffold.
    #[inline]
    pub(crate) fn name(&self, place: Place) -> VertexId {
        if place.is_ghost() { VertexId::GHOST } else { self.names.of(place) }
    }

    /// Where a vertex is, if it is one.
    #[inline]
    pub(crate) fn place(&self, v: VertexId) -> Option<Place> {
        self.names.place(v)
    }

    /// The corners of a facet, counter-clockwise seen from inside of its tetrahedron.
    #[inline]
    pub(crate) fn facet_places(&self, f: FacetId) -> [Place; 3] {
        let corners = &self.cells[f.tetrahedron().index()].corners;
        FACETS[f.corner()].map(|k| corners[k])
    }

    /// Whether there is a tetrahedron with this index, and it is in use.
    pub(crate) fn is_cell(&self, t: TetrahedronId) -> bool {
        self.cells.get(t.index()).is_some_and(|cell| !cell.corners[0].is_ghost())
    }

    /// The tetrahedra in use, ghosts included.
    pub(crate) fn cells(&self) -> impl Iterator<Item = TetrahedronId> + Clone + '_ {
        (0..self.cells.len()).map(TetrahedronId::new).filter(|&t| self.is_cell(t))
    }

    /// The places in use, scaffold included.
    pub(crate) fn inhabited(&self) -> impl Iterator<Item = Place> + Clone + '_ {
        let used = |&p: &Place| self.incident[p.index()] != TetrahedronId::NONE;
        (0..self.incident.len()).map(Place::new).filter(used)
    }

    /// How many more tetrahedra there may be.
    pub(crate) fn room(&self) -> usize {
        self.free.len() + self.most.0.saturating_sub(self.cells.len())
    }

    /// The tetrahedra at a place, ghosts included, into a buffer. O(d log d) for d of them.
    pub(crate) fn star(&self, place: Place, star: &mut Vec<TetrahedronId>) {
        /// Tetrahedra, up to which membership in the star is decided by scanning it; a larger star is sorted.
        const SCANNED_STAR: usize = 48;
        star.clear();
        let first = self.incident[place.index()];
        if first == TetrahedronId::NONE {
            return;
        }
        star.push(first);
        let mut met = BTreeSet::new();
        let mut k = 0;
        while let Some(&t) = star.get(k) {
            k += 1;
            let cell = &self.cells[t.index()];
            for (corner, across) in cell.corners.into_iter().zip(cell.across) {
                let next = across.tetrahedron();
                if corner == place {
                    continue;
                }
                if star.len() < SCANNED_STAR {
                    if !star.contains(&next) {
                        star.push(next);
                    }
                    continue;
                }
                if met.is_empty() {
                    met.extend(star.iter().copied());
                }
                if met.insert(next) {
                    star.push(next);
                }
            }
        }
    }
}
