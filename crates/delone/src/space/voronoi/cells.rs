//! Clipped cells of space: polyhedra whose corners neighboring cells share.
//!
//! Cost: O(1) for what was measured when a cell was made, O(k) for a face with k corners.

use crate::ids::VertexId;
use crate::memory::room_for;
use crate::space::region::measure::{self, Measures};

/// Set in the code of a wall.
const WALL: u32 = 1 << 31;

/// Clipped cells, by site: convex polyhedra. Neighboring cells share the vertices between them: the face between two cells has the same ones
/// from both sides.
///
/// Vertices are correctly rounded, and all measures are those of the rounded polyhedra. Volumes are right wherever they are numbers:
/// those of cells larger than some 1e102 are infinite, and those of cells smaller than 1e-108 are zero.
#[derive(Clone, Debug, Default)]
pub struct Cells3 {
    /// For each site the first of its faces, and how many there are.
    pub(super) sites: Vec<[u32; 2]>,
    /// By site.
    pub(super) measures: Vec<Measures>,
    pub(super) faces: Faces,
    /// First the centers by tetrahedron, then what clipping has made.
    pub(super) vertices: Vec<[f64; 3]>,
}

/// Faces as they are kept, cell by cell.
#[derive(Clone, Debug)]
pub(super) struct Faces {
    /// The codes of what is beyond each.
    pub(super) across: Vec<u32>,
    /// Where the corners of each start; and the end of the last.
    pub(super) starts: Vec<usize>,
    /// Indices of vertices, counter-clockwise seen from outside.
    pub(super) indices: Vec<u32>,
}

/// The other side of a face of a cell: another cell or a wall of the region. There is no third, so a match may name both.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Across3 {
    /// The cell of this site.
    Site(VertexId),
    /// The wall of the region with this number.
    Wall(usize),
}

/// A clipped cell: no face if nothing of it is left.
#[derive(Clone, Copy, Debug)]
pub struct Cell3<'a> {
    across: &'a [u32],
    /// Where faces start among the corners, and the end of the last.
    ends: &'a [usize],
    corners: &'a [u32],
    vertices: Vertices<'a>,
    measures: Measures,
}

/// A face of a clipped cell: a convex polygon.
#[derive(Clone, Copy, Debug)]
pub struct Face3<'a> {
    across: u32,
    corners: &'a [u32],
    vertices: Vertices<'a>,
}

/// Vertices in two parts.
#[derive(Clone, Copy, Debug)]
struct Vertices<'a>(&'a [[f64; 3]], &'a [[f64; 3]]);

impl Vertices<'_> {
    #[inline]
    fn at(self, i: u32) -> [f64; 3] {
        let i = i as usize;
        if i < self.0.len() { self.0[i] } else { self.1[i - self.0.len()] }
    }
}

impl Default for Faces {
    fn default() -> Self {
        Self { across: Vec::new(), starts: vec![0], indices: Vec::new() }
    }
}

impl Faces {
    pub(super) fn with_room(faces: usize, corners: usize) -> Self {
        let mut starts = room_for(faces + 1);
        starts.push(0);
        Self { across: room_for(faces), starts, indices: room_for(corners) }
    }

    pub(super) fn clear(&mut self) {
        self.across.clear();
        self.starts.truncate(1);
        self.indices.clear();
    }

    pub(super) fn len(&self) -> usize {
        self.across.len()
    }

    /// Forgets all faces from one on.
    #[inline]
    pub(super) fn truncate(&mut self, len: usize) {
        self.across.truncate(len);
        self.starts.truncate(len + 1);
        self.indices.truncate(self.starts[len]);
    }

    /// Ends a face whose corners were pushed. Equal ones that follow one another are one, and so are those on both sides of a corner to which
    /// only rounding goes and comes back. Nothing is left of less than three.
    #[inline]
    pub(super) fn close(&mut self, across: u32) {
        let start = self.starts[self.len()];
        let ring = &mut self.indices;
        let mut end = start;
        for i in start..ring.len() {
            let corner = ring[i];
            if end > start + 1 && ring[end - 2] == corner {
                end -= 1;
            } else if end == start || ring[end - 1] != corner {
                ring[end] = corner;
                end += 1;
            }
        }
        let mut first = start;
        while end > first + 2 {
            if ring[end - 1] == ring[first] || ring[end - 2] == ring[first] {
                end -= 1;
            } else if ring[end - 1] == ring[first + 1] {
                first += 1;
            } else {
                break;
            }
        }
        if end < first + 3 {
            ring.truncate(start);
            return;
        }
        ring.copy_within(first..end, start);
        ring.truncate(end - (first - start));
        self.across.push(across);
        self.starts.push(ring.len());
    }

    /// Some faces as a cell, with vertices in two parts.
    pub(super) fn cell<'a>(
        &'a self,
        [first, count]: [u32; 2],
        [centers, others]: [&'a [[f64; 3]]; 2],
        measures: Measures,
    ) -> Cell3<'a> {
        let (first, count) = (first as usize, count as usize);
        Cell3 {
            across: &self.across[first..first + count],
            ends: &self.starts[first..=first + count],
            corners: &self.indices,
            vertices: Vertices(centers, others),
            measures,
        }
    }
}

impl Across3 {
    pub(super) fn code(self) -> u32 {
        match self {
            Self::Site(v) => v.bits(),
            Self::Wall(k) => WALL | k as u32,
        }
    }

    #[inline]
    fn of(code: u32) -> Self {
        if code & WALL == 0 {
            Self::Site(VertexId::new(code as usize))
        } else {
            Self::Wall((code & !WALL) as usize)
        }
    }
}

impl Cells3 {
    /// The cell of a site: without faces for an id that is no vertex, and for a cell outside of the region.
    pub fn cell(&self, site: VertexId) -> Cell3<'_> {
        let faces = self.sites.get(site.index()).copied().unwrap_or_default();
        let measures = self.measures.get(site.index()).copied().unwrap_or_default();
        self.faces.cell(faces, [&self.vertices, &[]], measures)
    }

    /// The vertices of all cells. Those that no face uses may be infinite.
    pub fn vertices(&self) -> &[[f64; 3]] {
        &self.vertices
    }

    /// See [`Cell3::volume`].
    pub fn volume(&self, site: VertexId) -> f64 {
        self.cell(site).volume()
    }

    /// See [`Cell3::area`].
    pub fn area(&self, site: VertexId) -> f64 {
        self.cell(site).area()
    }

    /// See [`Cell3::centroid`].
    pub fn centroid(&self, site: VertexId) -> Option<[f64; 3]> {
        self.cell(site).centroid()
    }

    /// See [`Cell3::faces`].
    pub fn faces(&self, site: VertexId) -> impl ExactSizeIterator<Item = Face3<'_>> + Clone {
        self.cell(site).faces()
    }
}

impl<'a> Cell3<'a> {
    /// Its faces: none if nothing of it is left.
    pub fn faces(self) -> impl ExactSizeIterator<Item = Face3<'a>> + Clone {
        let Self { across, ends, corners, vertices, .. } = self;
        across.iter().zip(ends.windows(2)).map(move |(&across, ends)| Face3 {
            across,
            corners: &corners[ends[0]..ends[1]],
            vertices,
        })
    }

    /// The volume, in coordinate units cubed. Never negative: less than nothing is rounding. Infinite if it is beyond the range of `f64`.
    pub fn volume(self) -> f64 {
        self.measures.volume
    }

    /// The area of the surface, in coordinate units squared.
    pub fn area(self) -> f64 {
        self.measures.area
    }

    /// The center of mass. `None` if the cell is empty, or so small that its rounded corners have no volume.
    pub fn centroid(self) -> Option<[f64; 3]> {
        self.measures.centroid
    }

    /// Finds volume, area and center of mass. O(k) for k corners.
    pub(super) fn measured(self) -> Measures {
        measure::of(self.faces().map(Face3::points))
    }
}

impl<'a> Face3<'a> {
    /// The cell or the wall beyond it.
    pub fn across(self) -> Across3 {
        Across3::of(self.across)
    }

    /// The site beyond it, if there is one.
    pub fn neighbor(self) -> Option<VertexId> {
        match self.across() {
            Across3::Site(v) => Some(v),
            Across3::Wall(_) => None,
        }
    }

    /// Its corners, counter-clockwise seen from outside of the cell.
    pub fn points(self) -> impl ExactSizeIterator<Item = [f64; 3]> + Clone + 'a {
        self.corners.iter().map(move |&i| self.vertices.at(i))
    }

    /// Its corners as indices into [`Cells3::vertices`].
    pub fn indices(self) -> &'a [u32] {
        self.corners
    }

    /// The area, in coordinate units squared.
    pub fn area(self) -> f64 {
        measure::area(self.points())
    }

    /// The outward normal, of length one. `None` if the rounded corners have no area. For a face smaller than its rounding the direction from
    /// site to site is better.
    pub fn normal(self) -> Option<[f64; 3]> {
        measure::direction(measure::area_vector(self.points()).0)
    }
}
