//! Bulk construction in the plane. Every algorithm gives the same set of triangles.
//!
//! Divide and conquer is the default. `order/morton.rs` sorts points by Morton keys and gives the *cut* between each two neighbors; the
//! cuts form the recursion tree. The points at positions `lo..=hi` own the triangles `2 lo..=2 hi - 2`, and a merge uses the two
//! between its parts. So nothing is allocated, neighbors are near in memory, and threads share nothing. `leaf` writes up to four points
//! from tables. `merge` is the rising bubble of Guibas and Stolfi (1985) on ghost triangles. `number` puts vertices to their places.
//! Boxes out of the range of the filters are scaled by powers of two (`rescaled`). Runs of equal keys get keys in their own box; at the
//! origin, where boxes of doubles nest a thousand deep, exponents serve as keys (`order/exponents.rs`).

mod builder;
mod divide_and_conquer;
pub(super) mod incremental;
mod leaf;
mod merge;
mod number;
mod rescaled;
mod weighted;

pub(crate) use divide_and_conquer::{InOrder, in_order};
pub(super) use weighted::{Weighted, weighted};

use crate::error::Error;
use crate::ids::Duplicate;
use crate::locate::Locate;
use crate::mesh::Mesh2;
use crate::points::{check_finite, survey};
use crate::tally::{Counters, Work};

/// How to build a triangulation. The result is the same set of triangles; only cost and numbering of the
/// triangles differ.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub enum Algorithm2 {
    /// Divide and conquer in Morton order: the fastest, O(n log n) in the worst case for coordinates of few magnitudes, without
    /// randomness. Where points at m magnitudes are nested, sets can be made for which it is O(m n): a thousand fans around one
    /// tiny segment, each half as large as the one before.
    #[default]
    DivideAndConquer,
    /// Insertion one by one in a biased randomized order along a Hilbert curve, each point located by a walk
    /// from the one before it: O(n log n) expected.
    Incremental {
        /// Decides the random order.
        seed: u64,
    },
    /// Insertion one by one in random order, each point located by a strategy: the papers' algorithms. By
    /// [`Locate::History`] points are inserted by splits and flips, by the others with cavities.
    Located {
        /// The strategy, which stays with the triangulation.
        locate: Locate,
        /// Decides the random order.
        seed: u64,
    },
    /// Insertion one by one in random order by splits and flips; each triangle keeps a list of the points in it
    /// that are to come: O(n log n) expected. Without the feature `histories`, as [`Self::Incremental`].
    ConflictLists {
        /// Decides the random order.
        seed: u64,
    },
}

/// The result of a construction, with the points given.
pub(super) struct Built {
    pub(super) points: Vec<[f64; 2]>,
    pub(super) mesh: Mesh2,
    pub(super) duplicates: Vec<Duplicate>,
    pub(super) counters: Counters,
}

/// Looks for points that are not finite by itself, as it looks for the box around all.
pub(super) fn divide_and_conquer(points: Vec<[f64; 2]>) -> Result<Built, Error> {
    let (bounds, are_finite) = survey(&points);
    if !are_finite {
        check_finite(points.iter().copied())?;
    }
    let (mesh, duplicates, counters) = divide_and_conquer::triangulate(&points, &bounds);
    Ok(Built { points, mesh, duplicates, counters: Counters::DivideAndConquer(counters) })
}

pub(super) fn incremental(points: Vec<[f64; 2]>, seed: u64) -> Built {
    let mut work = Work::default();
    let (points, mesh, duplicates) = incremental::triangulate(points, seed, &mut work);
    Built { points, mesh, duplicates, counters: Counters::Incremental(work) }
}

#[cfg(test)]
mod tests {
    use super::Algorithm2;
    use crate::{Delaunay2, Error, Locate};

    #[test]
    fn what_is_not_finite_is_named() {
        let located = Algorithm2::Located { locate: Locate::default(), seed: 1 };
        let incremental = Algorithm2::Incremental { seed: 1 };
        for algorithm in [Algorithm2::default(), incremental, located, Algorithm2::ConflictLists { seed: 1 }]
        {
            for (k, bad) in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY].into_iter().enumerate() {
                let mut points = vec![[0.0, 1.0], [2.0, 3.0], [5.0, 4.0], [7.0, -1.0], [6.0, 6.0]];
                points[3][k % 2] = bad;
                points[4][0] = f64::NAN;
                let found = Delaunay2::with_algorithm(&points, algorithm).err();
                let is_named =
                    matches!(found, Some(Error::NotFinite { index: 3, axis, .. }) if axis == k % 2);
                assert!(is_named, "{algorithm:?} {bad}: {found:?}");
            }
        }
    }
}
