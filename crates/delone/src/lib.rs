//! Exact, canonical Delaunay triangulation.
//!
//! The triangulation is a function of the set of points alone: ties between cocircular points are broken by a
//! symbolic perturbation, so insertion order, algorithm and machine never show in the result. Every finite
//! `f64` is accepted, and every geometric decision is exact.
//!
//! ```
//! use delone::{Algorithm2, Delaunay2};
//!
//! // A grid: every cell is cocircular. Two algorithms, one answer.
//! let points: Vec<[f64; 2]> = (0..100).map(|i| [f64::from(i % 10), f64::from(i / 10)]).collect();
//! let fast = Delaunay2::from_points(&points)?;
//! let other = Delaunay2::with_algorithm(&points, Algorithm2::Incremental { seed: 1 })?;
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

mod duplicates;
mod error;
mod hull;
mod ids;
mod locate;
mod memory;
pub mod mesh;
mod order;
mod parallel;
pub mod plane;
mod points;
mod prefetch;
pub mod space;
mod tally;
mod triangulation;
mod verdict;
mod vertex_map;

pub use error::{Error, RegionProblem};
pub use hull::{Hull2, Hull3, HullHistory3};
pub use ids::{
    Duplicate, EdgeId, FacetId, Inserted, MAX_POINTS, MAX_POINTS_IN_SPACE, TetrahedronId, TriangleId,
    VertexId,
};
pub use locate::{Footprint, Hierarchy, JumpAndWalk, Locate, Walk};
pub use mesh::{Dimension, Mesh2, Mesh3};
pub use order::HintOrder;
pub use plane::{
    Algorithm2, Cells2, Delaunay2, EnclosingCircle, Furthest2, Hints2, Location2, Moving2, NearestSites2,
    Region2, Relaxation2, Ring, Step2, Voronoi2, VoronoiEdge2,
};
pub use points::{Bounds, Position2, Position3};
pub use space::{Algorithm3, Delaunay3, Hints3, Location3, Moving3, Step3};
pub use tally::{Counters, Merges, Tally, Work};
pub use triangulation::{Ask, Change, Coordinates, Corners, Found, Imprecise, Triangulation};
pub use verdict::Verdict;
pub use vertex_map::VertexMap;
