//! Cells that no region cuts, read off the triangulation: around each edge of a site the ring of tetrahedra is a face.
//!
//! Cost: O(k) for a cell with k corners, counted face by face.

use super::cells::Faces;
use super::centers::Centers;
use crate::ids::{Place, TetrahedronId};
use crate::mesh::tetrahedra::{Mesh3, first_around};

/// A reader of cells, one after the other.
pub(super) struct Reader<'a> {
    mesh: &'a Mesh3,
    centers: &'a Centers,
    /// For each place one more than that of the last cell that it was beside.
    met: Vec<u32>,
    /// Neighbors whose faces are still to be read, with a tetrahedron at the edge to them.
    next: Vec<(Place, TetrahedronId)>,
}

impl<'a> Reader<'a> {
    pub(super) fn new(mesh: &'a Mesh3, centers: &'a Centers) -> Self {
        Self { mesh, centers, met: vec![0; mesh.incident.len()], next: Vec::new() }
    }

    /// Adds the faces of a cell all of whose corners are inside. Says whether it is one: else nothing is added.
    pub(super) fn push(&mut self, site: Place, faces: &mut Faces) -> bool {
        let first = self.mesh.incident[site.index()];
        if !self.centers.inside.get(first.index()).is_some_and(|&inside| inside) {
            return false;
        }
        let before = faces.len();
        self.next.clear();
        self.met[site.index()] = site.index() as u32 + 1;
        for p in self.mesh.cells[first.index()].corners {
            self.meet(site, p, first);
        }
        while let Some((other, t)) = self.next.pop() {
            if !self.push_ring(site, other, t, faces) {
                faces.truncate(before);
                return false;
            }
            faces.close(self.mesh.name(other).bits());
        }
        true
    }

    #[inline]
    fn meet(&mut self, site: Place, other: Place, t: TetrahedronId) {
        let met = &mut self.met[other.index()];
        if *met != site.index() as u32 + 1 {
            *met = site.index() as u32 + 1;
            self.next.push((other, t));
        }
    }

    /// The corners of a face, if all are inside.
    #[inline]
    fn push_ring(&mut self, site: Place, other: Place, first: TetrahedronId, faces: &mut Faces) -> bool {
        let (mesh, centers) = (self.mesh, self.centers);
        let mut f = first_around(first, [site, other].map(|end| mesh.cells[first.index()].corner(end)));
        loop {
            faces.indices.push(centers.corner(f.tetrahedron()));
            let entered = mesh.twin(f);
            let t = entered.tetrahedron();
            if t == first {
                return true;
            }
            if !centers.inside[t.index()] {
                return false;
            }
            self.meet(site, mesh.cells[t.index()].corners[entered.corner()], t);
            f = mesh.next_around(entered, [site, other]);
        }
    }
}
