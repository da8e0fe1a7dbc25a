//! Common types of regular triangulations in the plane and in space: flaws, and the outcome of new weights.

use crate::ids::{Duplicate, VertexId};

/// A flaw of a regular triangulation. `F` is a flaw of any triangulation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum RegularFlaw<F> {
    /// The simplices are not the regular ones of the vertices.
    #[error(transparent)]
    Triangulation(#[from] F),
    /// A site is called hidden and is below the simplices.
    #[error("site {} is no vertex, and none of the others hides it", .0.index())]
    Hidden(VertexId),
    /// A site is called the duplicate of a vertex that it does not equal, or is not called that of the one that it equals.
    #[error("site {} is said to be another one's duplicate and is not, or the other way round", .0.index())]
    Duplicate(VertexId),
}

/// How a triangulation took other weights for all sites.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Reweighed {
    /// By repair.
    Repaired {
        /// Flips, or what does the work of one.
        flips: usize,
        /// Sites that were no vertices, or not all of the time, and fell again.
        settled: usize,
    },
    /// By a construction from nothing.
    Rebuilt,
}

/// The sites that stay when duplicates are forgotten, in the order of their ids: the new id of each old one, points, and weights.
pub(crate) fn compacted<const D: usize>(
    sites: impl Iterator<Item = Option<([f64; D], f64)>>,
    duplicates: impl Iterator<Item = Duplicate>,
) -> (Vec<Option<VertexId>>, Vec<[f64; D]>, Vec<f64>) {
    let mut sites: Vec<_> = sites.collect();
    duplicates.for_each(|duplicate| sites[duplicate.point] = None);
    let (points, weights): (Vec<_>, Vec<_>) = sites.iter().flatten().copied().unzip();
    let mut new = (0..points.len()).map(VertexId::new);
    (sites.iter().map(|site| site.and_then(|_| new.next())).collect(), points, weights)
}
