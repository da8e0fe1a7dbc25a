//! Delaunay triangulations of space: the rooms of the plane, with the same names.

mod alpha;
mod around;
mod change;
pub(crate) mod check;
mod construct;
mod delaunay;
mod graphs;
mod imprecise;
mod layer;
mod locate;
mod locator;
mod moving;
mod nearest;
mod region;
mod regular;
mod triangulation;
pub(crate) mod verify;
mod voronoi;

pub(crate) use construct::{InOrder3, in_order};
pub use delaunay::{Algorithm3, Delaunay3};
pub use imprecise::Hints3;
pub(crate) use layer::{NearestFace, nearest_face};
pub use locate::Location3;
pub use moving::{Moving3, Step3};
pub use region::Region3;
pub use regular::{Power3, Regular3};
pub use voronoi::{Across3, Cell3, Cells3, Face3, Relaxation3, Voronoi3};
