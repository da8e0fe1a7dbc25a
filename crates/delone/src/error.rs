//! What can be wrong with what was asked for: what, and where.

use crate::ids::VertexId;

/// Why a triangulation could not be built, changed or asked.
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
    #[error("{count} points are more than the {most} that one triangulation holds")]
    TooManyPoints {
        /// The number of points given.
        count: usize,
        /// The largest number.
        most: usize,
    },
    /// More tetrahedra than 32-bit facet indices can serve, which take 32 gigabytes.
    #[error("there would be more than {most} tetrahedra, ghosts included")]
    TooManyTetrahedra {
        /// The largest number.
        most: usize,
    },
    /// A coordinate of a point given alone is NaN or infinite.
    #[error("the {} coordinate {value} is not finite", ["x", "y", "z"][*.axis])]
    Coordinate {
        /// 0 for x, 1 for y, 2 for z.
        axis: usize,
        /// The coordinate.
        value: f64,
    },
    /// An id that is no vertex: it was removed, is that of a duplicate, or was never given here.
    #[error("{} is no vertex of this triangulation", .vertex.index())]
    NoSuchVertex {
        /// The id.
        vertex: VertexId,
    },
    /// A vertex was to be moved to the place of another one.
    #[error("vertex {} is there already", .vertex.index())]
    Occupied {
        /// The vertex that is there.
        vertex: VertexId,
    },
    /// Location by history forgets nothing, so nothing can be removed or moved.
    #[error("a triangulation that is located by history cannot lose vertices")]
    InsertOnly,
    /// An instance of another number of points than was preprocessed.
    #[error("{found} points for {expected} centres")]
    Length {
        /// The number of centres.
        expected: usize,
        /// The number of points.
        found: usize,
    },
    /// There is no such strategy of location in space: no history, of walks only the visibility walk, and no nearest vertex by
    /// circles.
    #[error(
        "location by history, walks but for the visibility walk and the nearest vertex by circles are for the plane"
    )]
    OnlyInThePlane,
    /// A region has no proper border.
    #[error("ring {ring} of the region, at corner {corner}: {problem}")]
    Region {
        /// The ring, from 0.
        ring: usize,
        /// The corner of the ring, from 0.
        corner: usize,
        /// What is wrong there.
        problem: RegionProblem,
    },
    /// A parameter is out of range.
    #[error("{name} is {value}; it must be {range}")]
    Parameter {
        /// Its name.
        name: &'static str,
        /// Its value.
        value: f64,
        /// What it must be.
        range: &'static str,
    },
}

/// What can be wrong with the border of a region.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum RegionProblem {
    /// A coordinate is NaN or infinite.
    #[error("a coordinate is not finite")]
    NotFinite,
    /// There is no area inside.
    #[error("there is no area inside")]
    Empty,
    /// A ring comes to the same corner twice.
    #[error("the ring comes here a second time")]
    VisitedTwice,
    /// A side crosses, touches or overlaps another one, or rings cross at a corner of both.
    #[error("the side from here crosses or touches another one")]
    Crossing,
}
