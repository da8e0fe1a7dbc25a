//! What can be given as a point of space.

/// A position in space. Conversions to `f64` are exact.
///
/// Implemented for arrays and triples of `f64`, `f32` and `i32`; for the points of `mint` behind the feature of
/// that name.
pub trait Position3: Sync {
    /// x, y, z.
    fn xyz(&self) -> [f64; 3];
}

macro_rules! numbers {
    ($($number:ty)+) => { $(
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

numbers! { f64 f32 i32 }

#[cfg(feature = "mint")]
impl<T: Copy + Into<f64> + Sync> Position3 for mint::Point3<T> {
    fn xyz(&self) -> [f64; 3] {
        [self.x.into(), self.y.into(), self.z.into()]
    }
}
