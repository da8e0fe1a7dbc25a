//! Exact, canonical Delaunay triangulation.
//!
//! The triangulation is a function of the set of points alone: ties between cocircular points are broken by a
//! symbolic perturbation, so insertion order, algorithm and machine never show in the result. Every finite
//! `f64` is accepted, and every geometric decision is exact.
//!
//! ```
//! use delone::{Algorithm, Delaunay2};
//!
//! // A grid: every cell is cocircular. Two algorithms, one answer.
//! let points: Vec<[f64; 2]> = (0..100).map(|i| [f64::from(i % 10), f64::from(i / 10)]).collect();
//! let fast = Delaunay2::from_points(&points)?;
//! let other = Delaunay2::with_algorithm(&points, Algorithm::Incremental { seed: 1 })?;
//!
//! let sorted = |d: &Delaunay2| {
//!     let smallest_first = |[a, b, c]: [delone::VertexId; 3]| match a.min(b).min(c) {
//!         m if m == a => [a, b, c],
//!         m if m == b => [b, c, a],
//!         _ => [c, a, b],
//!     };
//!     let mut triangles: Vec<_> = d.triangles().map(smallest_first).collect();
//!     triangles.sort();
//!     triangles
//! };
//! assert_eq!(sorted(&fast), sorted(&other));
//! fast.check()?; // proved, not believed
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct Readme;

mod error;
mod fetch;
pub mod hull;
mod ids;
mod locate;
mod memory;
pub mod mesh;
mod order;
mod parallel;
pub mod plane;
pub mod space;

pub use error::{Error, RegionProblem};
pub use ids::{
    Duplicate, EdgeId, FacetId, Inserted, MAX_POINTS, MAX_POINTS_IN_SPACE, TetrahedronId, TriangleId,
    VertexId,
};
pub use locate::tally::{Tally, Work};
pub use locate::{Hierarchy, JumpAndWalk, Locate, Walk};
pub use mesh::tetrahedra::Mesh3;
pub use mesh::{Dimension, Mesh};
pub use order::HintOrder;
pub use plane::{
    Algorithm, Cells, Counters, Delaunay2, EnclosingCircle, Footprint, Furthest2, Hints2, Location, Moving2,
    NearestSites, Position2, Region, Relaxation, Ring, Step, Voronoi2, VoronoiEdge, convex_hull,
};
pub use space::{Algorithm3, Delaunay3, Hints3, Location3, Moving3, Position3, Step3};
