//! What can be given as a point of the plane.

/// A position in the plane. Conversions to `f64` are exact.
///
/// Implemented for arrays and pairs of `f64`, `f32` and `i32`; for the points of `mint` and `geo-types` behind
/// the features of those names.
pub trait Position2: Sync {
    /// x, then y.
    fn xy(&self) -> [f64; 2];
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
    )+ };
}

numbers! { f64 f32 i32 }

#[cfg(feature = "mint")]
impl<T: Copy + Into<f64> + Sync> Position2 for mint::Point2<T> {
    fn xy(&self) -> [f64; 2] {
        [self.x.into(), self.y.into()]
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
