//! Bulk construction in the plane. Every algorithm gives the same set of triangles.

mod divide_and_conquer;
mod incremental;
mod leaf;
mod merge;

pub use divide_and_conquer::Counters as DivideAndConquerCounters;

use super::Duplicate;
use crate::mesh::Mesh;

/// How to build a triangulation. The result is the same set of triangles; only cost and numbering of the
/// triangles differ.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Algorithm {
    /// Divide and conquer in Morton order: the fastest, O(n log n) in the worst case, without randomness.
    #[default]
    DivideAndConquer,
    /// Insertion one by one in a biased randomized order along a Hilbert curve: O(n log n) expected.
    Incremental {
        /// Decides the random order.
        seed: u64,
    },
}

/// What an algorithm did, for those who measure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Counters {
    /// Of [`Algorithm::DivideAndConquer`].
    DivideAndConquer(DivideAndConquerCounters),
    /// Of [`Algorithm::Incremental`].
    Incremental {
        /// Conflict tests of triangles against new points.
        conflict_tests: u64,
    },
}

/// Builds the mesh of points that are finite and not too many.
pub(super) fn build(points: &[[f64; 2]], algorithm: Algorithm) -> (Mesh, Vec<Duplicate>, Counters) {
    match algorithm {
        Algorithm::DivideAndConquer => {
            let (mesh, duplicates, counters) = divide_and_conquer::triangulate(points);
            (mesh, duplicates, Counters::DivideAndConquer(counters))
        }
        Algorithm::Incremental { seed } => {
            let (mesh, duplicates, conflict_tests) = incremental::triangulate(points, seed);
            (mesh, duplicates, Counters::Incremental { conflict_tests })
        }
    }
}
