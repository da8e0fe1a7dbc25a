//! Exact, canonical Delaunay triangulation, in the plane and in space.
//!
//! The triangulation is a function of the set of points alone: ties between cocircular points are broken by a
//! symbolic perturbation, so insertion order, algorithm, threads and machine never show in the result. Every finite
//! `f64` is accepted, and every geometric decision is exact.
//!
#![doc = concat!("<p align=\"center\">", include_str!("../docs/triangulation.svg"), include_str!("../docs/cells.svg"), include_str!("../docs/tetrahedra.svg"), "</p>")]
//!
//! ```
//! use delone::{Algorithm2, Delaunay2};
//!
//! // A grid: every cell is cocircular. Two algorithms, one answer.
//! let points: Vec<[f64; 2]> = (0..100).map(|i| [f64::from(i % 10), f64::from(i / 10)]).collect();
//! let fast = Delaunay2::from_points(&points)?;
//! let other = Delaunay2::with_algorithm(&points, Algorithm2::Incremental { seed: 1 })?;
//!
//! let edges = |d: &Delaunay2| {
//!     let mut edges: Vec<_> = d.edges().map(|[v, w]| [v.min(w), v.max(w)]).collect();
//!     edges.sort();
//!     edges
//! };
//! assert_eq!(edges(&fast), edges(&other));
//! fast.check()?; // proved, not believed
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Which type
//!
//! | what there is | in the plane | in space | cost |
//! | --- | --- | --- | --- |
//! | points, all at once or coming and going | [`Delaunay2`] | [`Delaunay3`] | O(n log n), in space where the result is linear; a change O(log n) on average |
//! | points and segments that must be edges; what is inside | [`Constrained2`], [`Domains2`] | | as the points, and O(k log k) for k edges that a segment crosses |
//! | meshes: triangles with angles and sizes as wanted | [`Refinement`] | | O(log n) for each new vertex |
//! | polygons with holes to triangles, one or many | [`Polygons2`] | | O(n log n) |
//! | points known nearly beforehand, in many instances | [`Hints2`] | [`Hints3`] | O(n) an instance |
//! | edges of points known by disks, in every and in some instance | [`DiskEdges2`] | | about O(n) where disks overlap little |
//! | points that move | [`Moving2`] | [`Moving3`] | O(n) a step |
//! | only the hull is wanted | [`Hull2`] | [`Hull3`], [`HullHistory3`] to ask it | O(n log n) |
//! | who is near whom: Gabriel graph, relative neighbors, spanning tree, skeletons, k nearest | [`Delaunay2::graph`] | [`Delaunay3::graph`] | see [`Graph`] |
//! | cells of sites | [`Delaunay2::voronoi`], [`Cells2`] in a [`Region2`] | | O(n) |
//! | where which k sites are the nearest | [`Delaunay2::order`], [`OrderCells2`] | | O(k^2 n) on evenly spread sites |
//! | alpha complexes: shapes of points, with weights too, and filtrations | [`Delaunay2::alpha`], [`Regular2::alpha`], [`Alpha2`] | [`Delaunay3::alpha`], [`Regular3::alpha`], [`Alpha3`] | O(k log k) for k faces |
//! | sites evenly spread | [`Relaxation2`] | | O(n log n) a step |
//! | points with weights (squared radii), hidden or not | [`Regular2`] | [`Regular3`] | O(n log n), in space where the result is linear |
//! | cells of points with weights, and how their areas change | [`Power2`], [`Jacobian2`] | | O(n) |
//! | the furthest site, the enclosing circle | [`Furthest2`] | | O(n log n), O(log n) a query |
//! | only the nearest points are wanted | [`Neighbors2`] | [`Neighbors3`] | O(log n) expected a query, on evenly spread points |
//! | nearest sites at the same cost for any sites | [`NearestSites2`] | | O(log^2 n) expected a query |
//! | values between points: linear, natural neighbors, smooth; rasters, contours, thinning | [`surface`], [`surface::Interpolator`] | the same | O(1) expected each from nearby |
//! | more points than memory, on one machine or many | [`tiles`] | | as the points, and little for the seams |
//! | triangles from elsewhere, to be judged | [`verify::verify2`] | [`verify::verify3`] | O(n log n) |
//! | data of your own on vertices | [`VertexMap`] | [`VertexMap`] | O(1) |
//! | code for any kind of triangulation | [`Triangulation`], [`Ask`], [`Change`] | the same | |
//!
//! Points are anything that is a [`Position2`] or a [`Position3`]: arrays and tuples of `f64`, `f32`, `i32`, and the points of
//! other crates by feature. Results are indices: a [`VertexId`] is the index of its point.
//!
//! # Names
//!
//! Names of types of the plane or of space end in 2 or 3. `new` is empty, `from_points` takes points, `from_vec` may keep
//! them, `with_...` has a choice. Triangles are counter-clockwise, tetrahedra in positive order. Errors name what is wrong, by
//! index.
//!
//! # Features
//!
//! | feature | default | what |
//! | --- | --- | --- |
//! | `rayon` | yes | large sets are built on all threads of the current pool, to the same bits |
//! | `histories` | yes | location by history, construction by conflict lists; without it such strategies are the tree, and such a construction is incremental |
//! | `mint` | | points of `mint` as input |
//! | `geo-types` | | points and coordinates of `geo-types` as input |
//! | `serde` | | ids, [`Duplicate`], [`Inserted`], [`Location2`], [`Location3`], [`Dimension`] and [`Bounds`] are written and read; whole triangulations are not: they are functions of their points |
//!
//! # Debug builds
//!
//! A debug build of a program computes exact predicates without the optimizer. To optimize Delone alone, once:
//!
//! ```toml
//! [profile.dev.package]
//! delone = { opt-level = 3 }
//! delone-predicates = { opt-level = 3 }
//! ```
//!
//! Examples that leave a picture: `cargo run --example terrain`, `cells`, `moving`, `section`, `labels`, `exactness`, `ghosts`, `ideas`.

// The code of the README and of the book is compiled and run with that of this documentation.
#[cfg(doctest)]
mod book {
    macro_rules! pages {
        ($($page:ident: $path:literal,)*) => {
            $(#[doc = include_str!(concat!("../../../", $path))] struct $page;)*
        };
    }

    pages! {
        Readme: "README.md",
        Library: "docs/start/library.md",
        Exactness: "docs/learn/exactness.md",
        Canonicity: "docs/learn/canonicity.md",
        Perturbation: "docs/learn/perturbation.md",
        Ghosts: "docs/learn/ghosts.md",
        Walks: "docs/learn/walks.md",
        Meshing: "docs/howto/meshing.md",
        Moving: "docs/howto/moving.md",
        Periodic: "docs/howto/periodic.md",
        Constraints: "docs/howto/constraints.md",
        ComingFromRust: "docs/howto/coming-from-rust.md",
        ComingFromCpp: "docs/howto/coming-from-cpp.md",
    }
}

mod alpha;
mod around;
mod closest;
mod decimal;
mod duplicates;
mod error;
mod graphs;
mod hidden;
mod hull;
mod ids;
mod joining;
mod locate;
mod memory;
mod mesh;
mod neighbors;
mod order;
mod parallel;
mod periodic;
mod plane;
mod points;
mod powers;
mod prefetch;
mod regular;
mod sets;
mod sorting;
mod space;
pub mod surface;
mod tally;
pub mod tiles;
mod triangulation;
mod verdict;
mod vertex_map;
mod weight;

pub use alpha::{Alpha, Alpha2, Alpha3, Complex, Face, Manifold3, OutlinePart};
pub use around::{Around, Surround};
pub use decimal::DecimalGrid;
pub use error::{ArcProblem, BorderProblem, Error, LatticeProblem, RegionProblem};
pub use graphs::Graph;
pub use hull::{Hull2, Hull3, HullHistory3};
pub use ids::{
    Duplicate, EdgeId, FacetId, Inserted, MAX_POINTS, MAX_POINTS_IN_SPACE, TetrahedronId, TriangleId,
    VertexId,
};
pub use joining::{MERGE_AUTO, merged_vertices};
pub use locate::{Footprint, Hierarchy, JumpAndWalk, Locate, Nearest, Walk};
pub use mesh::{Dimension, Mesh2, Mesh3, MeshFlaw2, MeshFlaw3};
pub use neighbors::{Neighbors, Neighbors2, Neighbors3};
pub use order::HintOrder;
pub use parallel::share_work_from;
pub use periodic::{
    AcrossPeriodic, AcrossPeriodic2, AcrossPeriodic3, CellularKind, Grid, Image, Lattice, Lattice2, Lattice3,
    Periodic, Periodic2, Periodic3, PeriodicCell, PeriodicCell2, PeriodicCell3, PeriodicCells,
    PeriodicCells2, PeriodicCells3, PeriodicFace, PeriodicFace3, PeriodicKind, PeriodicRegular2,
    PeriodicRegular3, PeriodicSide2,
};
pub use plane::check::Flaw2;
pub use plane::{
    Algorithm2, AllQuads2, Arc2, Cell2, Cells2, Constrained2, ConstrainedFlaw2, ConstraintReport2, Covering2,
    Crossings, Delaunay2, DiskEdges2, Domains2, EnclosingCircle, Exchange, Fill, Furthest2, Gap2, Hints2,
    Jacobian2, Keep, LayerReport2, Layers2, LineCells2, Location2, MedialAxis2, Membership2, Middle2,
    Moving2, NearestSites2, OrderCells2, OrderCircle2, OrderK2, OrderRegion2, Overlaps2, Part2, Placement,
    PolygonRegion2, PolygonTriangles2, Polygons2, Power2, Prescribed2, Quads2, Reason, Refined2, Refinement,
    RefinementReport2, Region2, RegionSeed2, Regular2, Relaxation2, Ring, RingFill, Seeds2, SegmentEnds,
    SegmentId, Shapes2, Step2, Unrefined2, Voronoi2, VoronoiEdge2, Weld2, arcs_over_shared_chords,
};
pub use points::{Bounds, Position2, Position3};
pub use regular::{RegularFlaw, Reweighed};
pub use space::check::Flaw3;
pub use space::{
    Across3, Algorithm3, Cell3, Cells3, Delaunay3, Face3, Hints3, Location3, Moving3, Power3, Region3,
    Regular3, Relaxation3, Step3, Voronoi3,
};
pub use tally::{Counters, Merges, Phase, Tally, Work};
pub use triangulation::{Ask, Change, Coordinates, Corners, Found, Imprecise, Regular, Triangulation};
pub use verdict::Verdict;
pub use vertex_map::VertexMap;

/// Iterators over the parts of a mesh.
pub mod iter {
    pub use crate::mesh::{AroundEdge, Hull, Star};
}

/// Triangles and tetrahedra from any program, judged exactly: whether they are the Delaunay triangulation of the points, and whether its ties
/// are decided as this library decides them.
pub mod verify {
    pub use crate::plane::verify::{Objection2, verify_constrained2, verify_weighted2, verify2};
    pub use crate::space::verify::{Objection3, verify_weighted3, verify3};
}
