//! Where does a point fall? Strategies of location, free of coordinates.
//!
//! A strategy proposes where to start; the exact [`walk`] alone decides. What location needs to know of a
//! triangulation is the port [`Ground`], which each dimension implements with its predicates.

pub(crate) mod walk;

use crate::ids::EdgeId;
use crate::mesh::Mesh;

/// A triangulation as location sees it.
pub(crate) trait Ground {
    /// A point that is looked for.
    type Query: Copy;

    /// The topology.
    fn mesh(&self) -> &Mesh;

    /// Whether `q` is strictly on the right of a finite edge: beyond it, seen from the edge's triangle.
    fn is_beyond(&self, e: EdgeId, q: Self::Query) -> bool;
}
