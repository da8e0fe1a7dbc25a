//! Delaunay triangulations of the plane, and what is made of them.

mod alpha;
mod arc;
mod around;
mod boxes;
mod change;
pub(crate) mod check;
mod constrained;
mod construct;
mod delaunay;
mod disk_edges;
mod furthest;
mod graphs;
#[cfg(feature = "histories")]
mod histories;
mod imprecise;
mod layer;
mod locate;
mod locator;
mod moving;
mod nearest;
mod orders;
mod radial;
mod rectangle;
mod refine;
mod region;
mod regular;
mod triangulation;
pub(crate) mod verify;
mod voronoi;
mod weld;

pub use arc::{Arc2, arcs_over_shared_chords};
pub use constrained::{
    Constrained2, ConstrainedFlaw2, ConstraintReport2, Covering2, Crossings, Domains2, Fill, Gap2,
    Membership2, Overlaps2, Part2, PolygonRegion2, PolygonTriangles2, Polygons2, RegionSeed2, RingFill,
    Seeds2, SegmentEnds, SegmentId,
};
pub use construct::Algorithm2;
pub(crate) use construct::{InOrder, in_order};
pub use delaunay::Delaunay2;
pub use disk_edges::DiskEdges2;
pub use furthest::{EnclosingCircle, Furthest2};
pub use imprecise::Hints2;
pub(crate) use layer::cavity::Cavity;
pub use locate::Location2;
pub use moving::{Moving2, Step2};
pub use orders::{Exchange, OrderCells2, OrderCircle2, OrderK2, OrderRegion2};
pub use radial::NearestSites2;
pub use refine::{
    AllQuads2, Keep, LayerReport2, Layers2, Middle2, Placement, Quads2, Reason, Refined2, Refinement,
    RefinementReport2, Shapes2, Unrefined2,
};
pub use region::Region2;
pub use regular::{Jacobian2, Power2, Prescribed2, Regular2};
pub use voronoi::{Cell2, Cells2, LineCells2, MedialAxis2, Relaxation2, Ring, Voronoi2, VoronoiEdge2};
pub use weld::Weld2;
