//! The part of the plane that a tile, or a group of them, is responsible for.

use delone_predicates::stays_within;

/// A box, half-open: a point is inside if no coordinate is below that of the low corner, and each is below that of the high one. Sides may
/// be infinite. In the units of the points.
///
/// ```
/// use delone::tiles::Region;
///
/// let right = Region { low: [1.0, f64::NEG_INFINITY], high: [f64::INFINITY; 2] };
/// assert!(right.contains([1.0, 5.0]) && !right.contains([0.9, 5.0]));
/// assert!(Region::ALL.contains([0.9, 5.0]));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Region {
    /// The least corner, inside.
    pub low: [f64; 2],
    /// The greatest corner, outside.
    pub high: [f64; 2],
}

impl Region {
    /// The plane.
    pub const ALL: Self = Self { low: [f64::NEG_INFINITY; 2], high: [f64::INFINITY; 2] };

    /// Whether a point is inside.
    #[inline]
    pub fn contains(&self, p: [f64; 2]) -> bool {
        (0..2).all(|k| self.low[k] <= p[k] && p[k] < self.high[k])
    }

    /// Whether no point outside can be in the circle through the corners of a triangle, or on it.
    #[inline]
    pub(super) fn certifies(&self, corners: [[f64; 2]; 3]) -> bool {
        stays_within(corners, self.low, self.high)
    }
}
