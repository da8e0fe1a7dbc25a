//! Topology of triangulations, of the plane and of space, closed by a ghost vertex; no coordinates.

mod names;
mod slots;
pub(crate) mod tetrahedra;
pub(crate) mod triangles;

pub(crate) use names::Names;
pub(crate) use slots::Slots;
pub use tetrahedra::{AroundEdge, Mesh3, MeshFlaw3};
pub use triangles::{Hull, Mesh2, MeshFlaw2, Star};

/// The dimension of a set of points. There are five in the plane and in space, so a match may name them all.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Dimension {
    /// No point.
    Empty,
    /// One point.
    Point,
    /// All points on one line.
    Line,
    /// The plane: there is a triangle.
    Plane,
    /// Space: there is a tetrahedron.
    Space,
}
