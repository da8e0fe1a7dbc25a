//! What can be wrong with an input: what, and where.

use crate::ids::MAX_POINTS;

/// Why a triangulation could not be built.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A coordinate is NaN or infinite.
    #[error("point {index} has the {} coordinate {value}, which is not finite", ["x", "y", "z"][*.axis])]
    NotFinite {
        /// The index of the point in the input.
        index: usize,
        /// 0 for x, 1 for y, 2 for z.
        axis: usize,
        /// The coordinate.
        value: f64,
    },
    /// More points than 32-bit edge indices can serve.
    #[error("{count} points are more than the {MAX_POINTS} that one triangulation holds")]
    TooManyPoints {
        /// The number of points given.
        count: usize,
    },
}
