//! The plane as location sees it: [`Ground`] by the predicates.

use delone_predicates::orient2d;

use crate::ids::EdgeId;
use crate::locate::Ground;
use crate::mesh::Mesh;

/// A mesh and the coordinates of its vertices.
#[derive(Clone, Copy)]
pub(super) struct Plane<'a> {
    pub(super) mesh: &'a Mesh,
    pub(super) points: &'a [[f64; 2]],
}

impl Ground for Plane<'_> {
    type Query = [f64; 2];

    #[inline]
    fn mesh(&self) -> &Mesh {
        self.mesh
    }

    #[inline]
    fn is_beyond(&self, e: EdgeId, q: [f64; 2]) -> bool {
        let [a, b] = [self.mesh.origin(e), self.mesh.destination(e)].map(|v| self.points[v.index()]);
        orient2d(a, b, q).is_negative()
    }
}
