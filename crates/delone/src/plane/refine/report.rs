//! The report of a refinement.

use crate::ids::TriangleId;

/// Why a triangle is left that is not as it was to be.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum Reason {
    /// Two constraints of the input meet at a small angle.
    InputAngle,
    /// The coordinates are too coarse for a vertex where it would have to be, or what is to be measured leaves the range of
    /// numbers.
    Precision,
    /// Vertices would come nearer and nearer to each other, far below the size of anything in the input.
    Cascade,
    /// No more vertices were allowed.
    Budget,
    /// A constraint would have to be split that is to be kept.
    Kept,
    /// A new vertex would be nearer to another one than edges may be long.
    Short,
}

impl Reason {
    /// All of them.
    pub const ALL: [Self; 6] =
        [Self::InputAngle, Self::Precision, Self::Cascade, Self::Budget, Self::Kept, Self::Short];

    /// In a few words.
    pub fn text(self) -> &'static str {
        match self {
            Self::InputAngle => "small angle of the input",
            Self::Precision => "out of precision",
            Self::Cascade => "would never end",
            Self::Budget => "no more vertices allowed",
            Self::Kept => "beside a constraint or a layer that is kept",
            Self::Short => "no shorter edges allowed",
        }
    }
}

/// A triangle that is not as it was to be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Unrefined2 {
    /// The triangle, as long as nothing changes.
    pub triangle: TriangleId,
    /// Why.
    pub reason: Reason,
}

/// Degrees of a class of the histogram of angles.
pub(super) const BIN: usize = 10;

/// The boundary layers of a mesh ([`crate::Layers2`]).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct LayerReport2 {
    /// Their triangles.
    pub triangles: usize,
    /// Their vertices that are not on the chosen segments.
    pub vertices: usize,
    /// The largest number of rows anywhere.
    pub rows: usize,
    /// Vertices on the chosen segments, one for each side with layers.
    pub places: usize,
    /// The number of these vertices that have fewer rows than were asked for, because there is no room for more.
    pub shortened: usize,
}

/// The work of a refinement, and what it could not do. Angles are in degrees.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct RefinementReport2 {
    /// New vertices that are on no constraint.
    pub inside: usize,
    /// New vertices on constraints.
    pub on_constraints: usize,
    /// The triangles inside, those of boundary layers included.
    pub triangles: usize,
    /// The boundary layers; angles below are those of the other triangles.
    pub layers: LayerReport2,
    /// The smallest angle of a triangle inside, rounded; 0 if there is none.
    pub smallest_angle: f64,
    /// The largest angle of a triangle inside, rounded; 0 if there is none.
    pub largest_angle: f64,
    /// How many triangles have a smallest angle from 0 to 10 degrees, from 10 to 20, and so on to 60.
    pub smallest_angles: [usize; 60 / BIN],
    /// How many angles of triangles are from 0 to 10 degrees, from 10 to 20, and so on to 180.
    pub angles: [usize; 180 / BIN],
    /// The triangles that are not as they were to be, by id. All others have proven angles of at least the bound.
    pub left: Vec<Unrefined2>,
}

impl RefinementReport2 {
    /// How many triangles are left for a reason.
    pub fn left_for(&self, reason: Reason) -> usize {
        self.left.iter().filter(|left| left.reason == reason).count()
    }
}
