//! Errors of requests, with the place of the fault.

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
    /// An area that is prescribed and is none.
    #[error("site {index} is to have the area {value}; it must be positive and finite")]
    Area {
        /// The index of the site in the input.
        index: usize,
        /// The area.
        value: f64,
    },
    /// A site without area where one is prescribed.
    #[error("site {site} has no cell in the region: it is outside, or at the point of another one")]
    NoCell {
        /// The index of the site in the input.
        site: usize,
    },
    /// A height is NaN or infinite.
    #[error("point {index} has the height {value}, which is not finite")]
    Height {
        /// The index of the point in the input.
        index: usize,
        /// The height.
        value: f64,
    },
    /// A weight is NaN or infinite.
    #[error("site {index} has the weight {value}, which is not finite")]
    Weight {
        /// The index of the site in the input.
        index: usize,
        /// The weight.
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
    /// A Voronoi diagram of higher order with more circles than 32-bit edge indices can serve.
    #[error("there would be more than {most} circles with at most {inside} sites inside")]
    TooManyCircles {
        /// The largest number.
        most: usize,
        /// How many sites are inside of the last ones.
        inside: usize,
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
    #[error("{found} points for {expected} centers")]
    Length {
        /// The number of centers.
        expected: usize,
        /// The number of points.
        found: usize,
    },
    /// Another number of values than of vertices, times the values at each.
    #[error("{found} values where there should be {expected}")]
    Values {
        /// How many there should be.
        expected: usize,
        /// How many there are.
        found: usize,
    },
    /// There is no such strategy of location in space: no history, of walks only the visibility walk, and no nearest vertex by
    /// circles.
    #[error(
        "location by history, walks but for the visibility walk and the nearest vertex by circles are for the plane"
    )]
    OnlyInThePlane,
    /// A segment whose end is no point of the input.
    #[error("segment {segment} ends at point {index}, and there are {count} points, counted from 0")]
    NoSuchPoint {
        /// The index of the segment.
        segment: usize,
        /// The index that is none of a point.
        index: usize,
        /// The number of points.
        count: usize,
    },
    /// Two segments cross strictly inside of both.
    #[error("segments {first} and {second} cross near ({}, {}){}", .near[0], .near[1], others(*.count))]
    SegmentsCross {
        /// The index of one of them.
        first: usize,
        /// The index of the other one.
        second: usize,
        /// Where they cross, rounded.
        near: [f64; 2],
        /// The number of pairs of segments that cross.
        count: usize,
    },
    /// A segment between a vertex and itself.
    #[error("a segment from vertex {} to itself has no length", .vertex.index())]
    NoLength {
        /// The vertex.
        vertex: VertexId,
    },
    /// A segment that was removed, has no length, or was never given here.
    #[error("there is no segment {segment} in this triangulation")]
    NoSuchSegment {
        /// Its index.
        segment: usize,
    },
    /// A vertex was to be removed at which segments end, bend or cross.
    #[error("{count} segments end or meet at vertex {}", .vertex.index())]
    ConstraintsEnd {
        /// The vertex.
        vertex: VertexId,
        /// The number of segments.
        count: usize,
    },
    /// A seed of a hole or a region that is in no part of the triangulation, or between two.
    #[error("the seed of {what} {index} at ({}, {}) is {place}", .at[0], .at[1])]
    Seed {
        /// A hole or a region.
        what: &'static str,
        /// Its index.
        index: usize,
        /// The seed.
        at: [f64; 2],
        /// Where it is.
        place: &'static str,
    },
    /// Parts of another triangulation, or of this one before it changed.
    #[error("the parts are of another triangulation, or it has changed since")]
    Parts,
    /// A triangle that is to be kept and cannot be.
    #[error("triangle {triangle} near ({}, {}) {flaw}", .near[0], .near[1])]
    KeptTriangle {
        /// Its index.
        triangle: usize,
        /// The middle of an edge of it, rounded.
        near: [f64; 2],
        /// The fault.
        flaw: &'static str,
    },
    /// A segment cannot be the chord of an arc with the center that it is given.
    #[error("segment {segment} is no chord of an arc around its center: {problem}")]
    Arc {
        /// The index of the segment.
        segment: usize,
        /// The fault.
        problem: ArcProblem,
    },
    /// Location by history or by the Delaunay tree is for Delaunay triangulations.
    #[error("a triangulation with constraints cannot be located by history or by the Delaunay tree")]
    OnlyDelaunay,
    /// A region has no proper border.
    #[error("ring {ring} of the region, at corner {corner}: {problem}")]
    Region {
        /// The ring, from 0.
        ring: usize,
        /// The corner of the ring, from 0.
        corner: usize,
        /// The fault there.
        problem: RegionProblem,
    },
    /// Axes that are none of a lattice.
    #[error("axis {axis} of the lattice, counted from 0, {problem}")]
    Lattice {
        /// The axis, from 0.
        axis: usize,
        /// Its fault.
        problem: LatticeProblem,
    },
    /// A point that is more periods away from the origin than can be counted, or so far beside a lattice of one or two axes that these vanish in its
    /// rounding.
    #[error("point {index} has the {} coordinate {value}, which is too far away for the lattice", ["x", "y", "z"][*.axis])]
    FarAway {
        /// The index of the point in the input.
        index: usize,
        /// 0 for x, 1 for y, 2 for z.
        axis: usize,
        /// The coordinate.
        value: f64,
    },
    /// A region of space that has no inside.
    #[error("the region has no volume inside")]
    NoVolume,
    /// The bound that a mesh is to keep somewhere is NaN, zero or negative.
    #[error("the size wanted at ({}, {}) is {value}; it must be positive", .at[0], .at[1])]
    Size {
        /// The value given.
        value: f64,
        /// Where.
        at: [f64; 2],
    },
    /// A point that is not in the region of its tile.
    #[error("point {index} has the {} coordinate {value}, which is not in the region of its tile", ["x", "y", "z"][*.axis])]
    OutsideRegion {
        /// The index of the point in the input.
        index: usize,
        /// 0 for x, 1 for y, 2 for z: the first that is outside.
        axis: usize,
        /// The coordinate.
        value: f64,
    },
    /// A cut of the plane or of space into tiles that is none, or where none can be.
    #[error("the tiles cannot be cut at node {node}: {problem}")]
    Cut {
        /// The number of the node.
        node: u32,
        /// The fault.
        problem: &'static str,
    },
    /// The border of a tile that is none, or that does not belong to the others.
    #[error("border {index}: {problem}")]
    Border {
        /// Which of the borders, from 0.
        index: usize,
        /// The fault.
        problem: BorderProblem,
    },
    /// Somebody wanted to stop.
    #[error("the work was stopped")]
    Stopped,
    /// A parameter is out of range.
    #[error("{name} is {}; it must be {range}", short(*.value))]
    Parameter {
        /// Its name.
        name: &'static str,
        /// Its value.
        value: f64,
        /// The range allowed.
        range: &'static str,
    },
}

/// A number without hundreds of zeros.
fn short(value: f64) -> String {
    if value == 0.0 || !value.is_finite() || (1e-6..1e16).contains(&value.abs()) {
        value.to_string()
    } else {
        format!("{value:e}")
    }
}

/// The words for further pairs.
fn others(count: usize) -> String {
    match count {
        0 | 1 => String::new(),
        2 => ", and so does another pair".to_owned(),
        _ => format!(", and so do {} other pairs", count - 1),
    }
}

/// A fault of an arc.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ArcProblem {
    /// A coordinate is NaN or infinite.
    #[error("a coordinate is not finite")]
    NotFinite,
    /// The center is on the line through both ends.
    #[error("the center is in line with its ends; an arc turns by less than half a turn")]
    HalfTurn,
    /// The ends are not at equal distances from the center, by this factor.
    #[error("one end is {0} times as far from the center as the other")]
    Radii(f64),
    /// Another arc has the same chord.
    #[error("another arc has the same chord")]
    Repeated,
    /// A straight segment has the same chord.
    #[error("a straight segment has the same chord")]
    Straight,
    /// There is no such segment.
    #[error("there is no such segment")]
    NoSegment,
}

/// A fault of the border of a tile.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum BorderProblem {
    /// Bytes that do not begin as a border does.
    #[error("these bytes are no border of a tile, or one of another version")]
    Unknown,
    /// Bytes of a border of the plane where one of space should be, or the other way round.
    #[error("a border of points with {found} coordinates, where they should have {expected}")]
    Dimension {
        /// How many coordinates points should have.
        expected: usize,
        /// How many they have.
        found: usize,
    },
    /// Bytes that end too early or too late.
    #[error("{found} bytes where there should be {expected}")]
    Length {
        /// How many there should be.
        expected: u64,
        /// How many there are.
        found: u64,
    },
    /// Bytes that were changed since they were written.
    #[error("the bytes are damaged: their sum is not the one that was written")]
    Damaged,
    /// Not as many names as points.
    #[error("{ids} ids for {points} points")]
    Ids {
        /// The number of points.
        points: usize,
        /// The number of ids.
        ids: usize,
    },
    /// A coordinate is NaN or infinite.
    #[error("point {point} is not finite")]
    NotFinite {
        /// The index of the point in the border.
        point: usize,
    },
    /// An open triangle, or tetrahedron, without a corner.
    #[error("simplex {simplex} has a corner that is none of the {points} points")]
    Corner {
        /// The index of the triangle or tetrahedron.
        simplex: usize,
        /// The number of points.
        points: usize,
    },
    /// A point that is not in the region.
    #[error("point {point} is not in the region")]
    Outside {
        /// The index of the point in the border.
        point: usize,
    },
    /// A point that is given twice, by this border or by an earlier one.
    #[error("point {point} is in an earlier border too, or a second time in this one")]
    Twice {
        /// The index of the point in the border.
        point: usize,
    },
}

/// A fault of the border of a region.
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

/// A fault of an axis of a lattice.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum LatticeProblem {
    /// A side of a box that is zero, negative or not finite.
    #[error("has no positive, finite length")]
    Side,
    /// A coordinate is NaN or infinite.
    #[error("is not finite")]
    NotFinite,
    /// Squares of the lengths would leave the range of numbers.
    #[error("is shorter than 1e-100 or longer than 1e100")]
    Range,
    /// The axes span less than they should.
    #[error("is zero or, but for rounding, a sum of multiples of the others")]
    Dependent,
    /// The axes are a left hand's.
    #[error("is on the wrong side: the axes are left-handed; exchange two of them")]
    LeftHanded,
}
