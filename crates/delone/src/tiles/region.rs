//! The part of the plane, or of space, that a tile, or a group of them, is responsible for.

use crate::error::Error;

/// A box, half-open: a point is inside if no coordinate is below that of the low corner, and each is below that of the high one. Sides may
/// be infinite. In the units of the points. It has two dimensions unless it is said to have three. Two corners
/// are all there is to a box: no field will be added.
///
/// ```
/// use delone::tiles::Region;
///
/// let right = Region { low: [1.0, f64::NEG_INFINITY], high: [f64::INFINITY; 2] };
/// assert!(right.contains([1.0, 5.0]) && !right.contains([0.9, 5.0]));
/// assert!(Region::ALL.contains([0.9, 5.0]));
/// assert!(Region::<3>::ALL.contains([0.9, 5.0, -1.0]));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Region<const D: usize = 2> {
    /// The least corner, inside.
    pub low: [f64; D],
    /// The greatest corner, outside.
    pub high: [f64; D],
}

impl<const D: usize> Region<D> {
    /// The plane, or space.
    pub const ALL: Self = Self { low: [f64::NEG_INFINITY; D], high: [f64::INFINITY; D] };

    /// Whether a point is inside.
    #[inline]
    pub fn contains(&self, p: [f64; D]) -> bool {
        (0..D).all(|k| self.has(k, p[k]))
    }

    fn has(&self, axis: usize, x: f64) -> bool {
        self.low[axis] <= x && x < self.high[axis]
    }

    /// Whether all points are inside, or the first coordinate that is not.
    pub(super) fn check(&self, points: &[[f64; D]]) -> Result<(), Error> {
        for (index, p) in points.iter().enumerate() {
            if let Some(axis) = (0..D).find(|&k| !self.has(k, p[k])) {
                return Err(Error::OutsideRegion { index, axis, value: p[axis] });
            }
        }
        Ok(())
    }
}
