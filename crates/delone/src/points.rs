//! Accepted types of points, tests that they are finite, and the box around many.

use std::borrow::Cow;

use crate::error::Error;
use crate::ids::MAX_POINTS_IN_SPACE;
use crate::parallel;

/// A position in the plane. Conversions to `f64` are exact.
///
/// Implemented for arrays and pairs of `f64`, `f32` and `i32`; for the points of `mint` and `geo-types` behind
/// the features of those names.
pub trait Position2: Sync {
    /// x, then y.
    fn xy(&self) -> [f64; 2];

    /// The coordinates of many, copied unless they are that already.
    fn all(points: &[Self]) -> Cow<'_, [[f64; 2]]>
    where
        Self: Sized,
    {
        points.iter().map(Self::xy).collect()
    }
}

/// A position in space. Conversions to `f64` are exact.
///
/// Implemented for arrays and triples of `f64`, `f32` and `i32`; for the points of `mint` behind the feature of
/// that name.
pub trait Position3: Sync {
    /// x, y, z.
    fn xyz(&self) -> [f64; 3];

    /// The coordinates of many, copied unless they are that already.
    fn all(points: &[Self]) -> Cow<'_, [[f64; 3]]>
    where
        Self: Sized,
    {
        points.iter().map(Self::xyz).collect()
    }
}

macro_rules! numbers {
    ($($number:ty)+) => { $(
        impl Position2 for [$number; 2] {
            #[inline]
            fn xy(&self) -> [f64; 2] {
                self.map(f64::from)
            }
        }

        impl Position2 for ($number, $number) {
            #[inline]
            fn xy(&self) -> [f64; 2] {
                [f64::from(self.0), f64::from(self.1)]
            }
        }

        impl Position3 for [$number; 3] {
            #[inline]
            fn xyz(&self) -> [f64; 3] {
                self.map(f64::from)
            }
        }

        impl Position3 for ($number, $number, $number) {
            #[inline]
            fn xyz(&self) -> [f64; 3] {
                [f64::from(self.0), f64::from(self.1), f64::from(self.2)]
            }
        }
    )+ };
}

numbers! { f32 i32 }

impl Position2 for [f64; 2] {
    #[inline]
    fn xy(&self) -> [f64; 2] {
        *self
    }

    fn all(points: &[Self]) -> Cow<'_, [[f64; 2]]> {
        Cow::Borrowed(points)
    }
}

impl Position2 for (f64, f64) {
    #[inline]
    fn xy(&self) -> [f64; 2] {
        (*self).into()
    }
}

impl Position3 for [f64; 3] {
    #[inline]
    fn xyz(&self) -> [f64; 3] {
        *self
    }

    fn all(points: &[Self]) -> Cow<'_, [[f64; 3]]> {
        Cow::Borrowed(points)
    }
}

impl Position3 for (f64, f64, f64) {
    #[inline]
    fn xyz(&self) -> [f64; 3] {
        (*self).into()
    }
}

#[cfg(feature = "mint")]
impl<T: Copy + Into<f64> + Sync> Position2 for mint::Point2<T> {
    fn xy(&self) -> [f64; 2] {
        [self.x.into(), self.y.into()]
    }
}

#[cfg(feature = "mint")]
impl<T: Copy + Into<f64> + Sync> Position3 for mint::Point3<T> {
    fn xyz(&self) -> [f64; 3] {
        [self.x.into(), self.y.into(), self.z.into()]
    }
}

#[cfg(feature = "geo-types")]
impl<T: geo_types::CoordNum + Into<f64> + Sync> Position2 for geo_types::Coord<T> {
    fn xy(&self) -> [f64; 2] {
        [self.x.into(), self.y.into()]
    }
}

#[cfg(feature = "geo-types")]
impl<T: geo_types::CoordNum + Into<f64> + Sync> Position2 for geo_types::Point<T> {
    fn xy(&self) -> [f64; 2] {
        self.0.xy()
    }
}

/// The coordinates of a point, if they are finite.
#[inline]
pub(crate) fn finite<const D: usize>(q: [f64; D]) -> Result<[f64; D], Error> {
    match q.iter().position(|x| !x.is_finite()) {
        Some(axis) => Err(Error::Coordinate { axis, value: q[axis] }),
        None => Ok(q),
    }
}

/// Whether all points are finite, or the first coordinate that is not.
pub(crate) fn check_finite<const D: usize>(points: impl IntoIterator<Item = [f64; D]>) -> Result<(), Error> {
    for (index, p) in points.into_iter().enumerate() {
        if let Some(axis) = p.iter().position(|x| !x.is_finite()) {
            return Err(Error::NotFinite { index, axis, value: p[axis] });
        }
    }
    Ok(())
}

/// Whether all weights are finite, or the first that is not.
pub(crate) fn check_weights(weights: &[f64]) -> Result<(), Error> {
    match weights.iter().position(|w| !w.is_finite()) {
        Some(index) => Err(Error::Weight { index, value: weights[index] }),
        None => Ok(()),
    }
}

/// Whether points are not too many.
pub(crate) fn check_count(count: usize, most: usize) -> Result<(), Error> {
    if count > most { Err(Error::TooManyPoints { count, most }) } else { Ok(()) }
}

/// Whether points of space are finite, and not too many for a triangulation.
pub(crate) fn check_in_space<P: Position3>(points: &[P]) -> Result<(), Error> {
    check_count(points.len(), MAX_POINTS_IN_SPACE)?;
    check_finite(points.iter().map(Position3::xyz))
}

/// The smallest box around points, axis by axis. Two corners are all there is to a box: no field will be added.
///
/// ```
/// let bounds = delone::Bounds::of([[0.0, 3.0], [2.0, 1.0]]);
/// assert_eq!((bounds.low, bounds.high, bounds.extent()), ([0.0, 1.0], [2.0, 3.0], [2.0, 2.0]));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(bound(
        serialize = "[f64; D]: serde::Serialize",
        deserialize = "[f64; D]: serde::Deserialize<'de>"
    ))
)]
pub struct Bounds<const D: usize> {
    /// The least corner; infinite around no point.
    pub low: [f64; D],
    /// The greatest corner; infinite, and below the least, around no point.
    pub high: [f64; D],
}

impl<const D: usize> Default for Bounds<D> {
    /// Around no point.
    fn default() -> Self {
        Self { low: [f64::INFINITY; D], high: [f64::NEG_INFINITY; D] }
    }
}

impl<const D: usize> Bounds<D> {
    /// Around points. Coordinates that are NaN are passed over.
    #[inline]
    pub fn of(points: impl IntoIterator<Item = [f64; D]>) -> Self {
        let mut bounds = Self::default();
        points.into_iter().for_each(|p| bounds.include(p));
        bounds
    }

    /// Grows to hold a point.
    #[inline]
    pub fn include(&mut self, p: [f64; D]) {
        for (k, x) in p.into_iter().enumerate() {
            self.low[k] = if x < self.low[k] { x } else { self.low[k] };
            self.high[k] = if x > self.high[k] { x } else { self.high[k] };
        }
    }

    /// Whether a point is inside or on the border.
    #[inline]
    pub fn contains(&self, p: [f64; D]) -> bool {
        (0..D).all(|k| self.low[k] <= p[k] && p[k] <= self.high[k])
    }

    /// The lengths of the sides, rounded; zero around no point, infinite beyond the range of `f64`.
    pub fn extent(&self) -> [f64; D] {
        std::array::from_fn(|k| (self.high[k] - self.low[k]).max(0.0))
    }
}

/// The box around points, and whether all are finite, in one pass; in parallel if they are many.
pub(crate) fn survey<const D: usize>(points: &[[f64; D]]) -> (Bounds<D>, bool) {
    let of_part = |part: &[[f64; D]]| {
        let (mut bounds, mut are_finite) = (Bounds::default(), true);
        for &p in part {
            bounds.include(p);
            are_finite &= p.iter().fold(true, |finite, x| finite & x.is_finite());
        }
        (bounds, are_finite)
    };
    let parts = parallel::parts(points.len());
    if parts == 1 {
        return of_part(points);
    }
    let chunks = points.chunks(points.len().div_ceil(parts)).collect();
    let found = parallel::map(chunks, of_part);
    let corners = found.iter().flat_map(|(part, _)| [part.low, part.high]);
    (Bounds::of(corners), found.iter().all(|part| part.1))
}

#[cfg(test)]
mod tests {
    use super::{Bounds, survey};

    #[test]
    fn a_box_holds_its_points_and_no_others() {
        let nothing = Bounds::<3>::default();
        assert_eq!(nothing.extent(), [0.0; 3]);
        assert!(!nothing.contains([0.0; 3]));
        let bounds = Bounds::of([[1.0, -2.0], [-1.0, f64::NAN], [0.0, 5.0]]);
        assert_eq!((bounds.low, bounds.high), ([-1.0, -2.0], [1.0, 5.0]));
        assert!(
            bounds.contains([1.0, 5.0]) && !bounds.contains([1.0, 5.5]) && !bounds.contains([f64::NAN, 0.0])
        );
        assert_eq!(Bounds::of([[f64::MIN], [f64::MAX]]).extent(), [f64::INFINITY]);
    }

    #[test]
    fn many_points_are_surveyed_like_few() {
        let mut points: Vec<[f64; 2]> = (0..300_000).map(|i| [f64::from(i), -f64::from(i % 1000)]).collect();
        assert_eq!(survey(&points), (Bounds { low: [0.0, -999.0], high: [299_999.0, 0.0] }, true));
        points[200_000][1] = f64::NAN;
        assert!(!survey(&points).1);
    }
}
