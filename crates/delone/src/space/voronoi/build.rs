//! Cells as they are made, in parts, and what joins the parts.
//!
//! A corner that is the center of a tetrahedron has the index of that. Others get indices behind those, new ones in each cell; at the end
//! those at the same place are one, over all cells.
//!
//! Cost: O(k log k) for k corners of cells that were cut, O(k) for others.

use super::cells::{Cell3, Cells3, Faces};
use super::centers::{Centers, bits};
use crate::ids::{TetrahedronId, VertexId};
use crate::parallel;
use crate::space::region::measure::Measures;
use crate::space::region::solid::Solid;

/// Faces of a cell that room is made for: cells of evenly spread sites have 15.54.
const FACES_OF_CELL: usize = 16;
/// Corners of faces that room is made for: those 15.54 faces have 81.2, each counted in three faces.
const CORNERS_OF_CELL: usize = 84;

/// Cells of some sites.
pub(super) struct Part {
    /// The number of centers.
    centers: usize,
    sites: Vec<(VertexId, u32)>,
    /// Of the cells that have ended.
    measures: Vec<Measures>,
    pub(super) faces: Faces,
    /// Corners that are no centers.
    fresh: Vec<[f64; 3]>,
    /// All corners of cells that were cut: the place, and the index.
    cut: Vec<([u64; 3], u32)>,
}

impl Part {
    /// With room for some cells.
    pub(super) fn new(centers: usize, cells: usize) -> Self {
        Self {
            centers,
            sites: Vec::with_capacity(cells),
            measures: Vec::with_capacity(cells),
            faces: Faces::with_room(cells * FACES_OF_CELL, cells * CORNERS_OF_CELL),
            fresh: Vec::new(),
            cut: Vec::new(),
        }
    }

    /// Begins the cell of a site.
    #[inline]
    pub(super) fn begin(&mut self, site: VertexId) {
        self.sites.push((site, self.faces.len() as u32));
    }

    /// Ends the last cell: measures it while its corners are at hand.
    #[inline]
    pub(super) fn end(&mut self, centers: &[[f64; 3]]) {
        let measures = self.last(centers).measured();
        self.measures.push(measures);
    }

    /// The last cell.
    pub(super) fn last<'a>(&'a self, centers: &'a [[f64; 3]]) -> Cell3<'a> {
        let first = self.sites.last().map_or(0, |site| site.1);
        let measures = self.measures.last().copied().unwrap_or_default();
        self.faces.cell([first, self.faces.len() as u32 - first], [centers, &self.fresh], measures)
    }

    /// Forgets all cells.
    pub(super) fn forget(&mut self) {
        self.sites.clear();
        self.measures.clear();
        self.faces.clear();
        self.fresh.clear();
        self.cut.clear();
    }

    /// Adds the faces of a cell that was cut out. Corners that are centers are known by what is beyond their planes.
    pub(super) fn push_cut(
        &mut self,
        solid: &mut Solid,
        centers: &Centers,
        tetrahedron: impl Fn([Option<u32>; 3]) -> Option<TetrahedronId>,
    ) {
        // The place, the index of a center if it is one, and the number in the cell.
        let corner = |(k, (beyond, corner)): (usize, ([Option<u32>; 3], _))| match tetrahedron(beyond) {
            Some(t) => (centers.points[t.index()], centers.corner(t), k),
            None => (solid.place(corner), u32::MAX, k),
        };
        let mut places: Vec<([f64; 3], u32, usize)> = solid.corners().enumerate().map(corner).collect();
        places.sort_unstable_by_key(|&(place, center, k)| (bits(place), center, k));
        let mut indices = vec![0; places.len()];
        for equal in places.chunk_by(|p, q| p.0 == q.0) {
            let (place, mut index, _) = equal[0];
            if index == u32::MAX {
                index = (self.centers + self.fresh.len()) as u32;
                self.fresh.push(place);
            }
            self.cut.push((bits(place), index));
            equal.iter().for_each(|&(_, _, k)| indices[k] = index);
        }
        let faces = &mut self.faces;
        solid.faces(|across, ring| {
            faces.indices.extend(ring.iter().map(|&k| indices[k as usize]));
            faces.close(across);
        });
    }
}

/// All cells; `ids` were given.
pub(super) fn joined(centers: Centers, ids: usize, parts: Vec<Part>) -> Cells3 {
    let count = centers.points.len();
    let mut cells = Cells3 {
        sites: vec![[0, 0]; ids],
        measures: vec![Measures::default(); ids],
        vertices: centers.points,
        ..Cells3::default()
    };
    let part_count = parts.len();
    if part_count > 1 {
        let sum = |of: fn(&Faces) -> usize| parts.iter().map(|part| of(&part.faces)).sum();
        cells.faces = Faces::with_room(sum(Faces::len), sum(|faces| faces.indices.len()));
    }
    let mut cut = Vec::new();
    let mut fresh = Vec::new();
    for part in parts {
        let (first, offset) = (cells.faces.len(), fresh.len() as u32);
        let moved = |i: u32| if i as usize >= count { i + offset } else { i };
        let ends = part.sites.iter().skip(1).map(|site| site.1).chain([part.faces.len() as u32]);
        for ((&(site, from), end), measures) in part.sites.iter().zip(ends).zip(part.measures) {
            cells.sites[site.index()] = [first as u32 + from, end - from];
            cells.measures[site.index()] = measures;
        }
        cut.extend(part.cut.into_iter().map(|(place, i)| (place, moved(i))));
        fresh.extend(part.fresh);
        if part_count == 1 {
            cells.faces = part.faces;
            continue;
        }
        let Faces { across, starts, indices } = &mut cells.faces;
        let end = indices.len();
        across.extend(part.faces.across);
        starts.extend(part.faces.starts.into_iter().skip(1).map(|start| end + start));
        indices.extend(part.faces.indices.into_iter().map(moved));
    }
    // One vertex for all at a place: a center if there is one.
    parallel::sort(&mut cut);
    let mut index = vec![0; fresh.len()];
    for equal in cut.chunk_by(|p, q| p.0 == q.0) {
        let mut least = equal[0].1;
        if least as usize >= count {
            let place = fresh[least as usize - count];
            least = cells.vertices.len() as u32;
            cells.vertices.push(place);
        }
        for &(_, i) in equal.iter().filter(|(_, i)| *i as usize >= count) {
            index[i as usize - count] = least;
        }
    }
    for corner in cells.faces.indices.iter_mut().filter(|corner| **corner as usize >= count) {
        *corner = index[*corner as usize - count];
    }
    cells
}
