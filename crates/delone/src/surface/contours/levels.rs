//! The heights that contours are drawn at.

use crate::error::Error;

/// The largest number of contour levels. More are refused, as a mistyped interval.
const MAX_LEVELS: f64 = 1e6;

/// Heights in increasing order, each once.
///
/// ```
/// use delone::surface::Levels;
///
/// assert_eq!(Levels::given(&[3.0, 1.0, 3.0])?.values(), [1.0, 3.0]);
/// assert_eq!(Levels::every(5.0, 0.0, [12.0, 20.0])?.values(), [10.0, 15.0, 20.0, 25.0]);
/// # Ok::<(), delone::Error>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Levels(Vec<f64>);

impl Levels {
    /// These levels, in any order.
    ///
    /// # Errors
    /// [`Error::Parameter`] for one that is not finite.
    pub fn given(levels: &[f64]) -> Result<Self, Error> {
        if let Some(&value) = levels.iter().find(|x| !x.is_finite()) {
            return Err(Error::Parameter { name: "a level of contours", value, range: "finite" });
        }
        let mut levels = levels.to_vec();
        levels.sort_unstable_by(f64::total_cmp);
        levels.dedup();
        Ok(Self(levels))
    }

    /// A base and all that is multiples of an interval away from it: those in a range of heights, the last one not above it, and the
    /// first one beyond it, so that bands between them are bounded.
    ///
    /// # Errors
    /// [`Error::Parameter`] for an interval that is not positive and finite, a base or a range that is not finite, and where there
    /// would be more than a million levels.
    pub fn every(interval: f64, base: f64, [low, high]: [f64; 2]) -> Result<Self, Error> {
        let refuse = |name, value, range| Err(Error::Parameter { name, value, range });
        if !(interval > 0.0 && interval.is_finite()) {
            return refuse("the interval of contours", interval, "positive and finite");
        }
        if let Some(value) = [base, low, high].into_iter().find(|x| !x.is_finite()) {
            return refuse("the base or range of contours", value, "finite");
        }
        let [first, last] = [((low - base) / interval).floor(), ((high - base) / interval).floor() + 1.0];
        let count = last - first + 1.0;
        // Beyond 2^53 multiples cannot be told from their neighbors.
        if count.is_nan() || count > MAX_LEVELS || first.abs().max(last.abs()) > 9e15 {
            return refuse("the number of levels of contours", count, "at most 1,000,000");
        }
        let level = |k: usize| base + (first + k as f64) * interval;
        let levels: Vec<f64> = (0..count as usize).map(level).collect();
        Self::given(&levels)
    }

    /// The levels, increasing.
    pub fn values(&self) -> &[f64] {
        &self.0
    }
}

#[cfg(test)]
mod tests {
    use super::Levels;

    #[test]
    fn levels_are_multiples_and_not_too_many() {
        let levels = Levels::every(0.1, 0.05, [0.3, 0.5]).expect("levels");
        assert_eq!(levels.values().len(), 4);
        assert!(levels.values()[0] <= 0.3 && *levels.values().last().expect("one") > 0.5);
        for (interval, base, range) in [
            (0.0, 0.0, [0.0, 1.0]),
            (-1.0, 0.0, [0.0, 1.0]),
            (f64::NAN, 0.0, [0.0, 1.0]),
            (1e-9, 0.0, [0.0, 1.0]),
            (1.0, f64::INFINITY, [0.0, 1.0]),
            (1e-300, 0.0, [1e300, 1e300]),
            (1.0, 0.0, [1e300, 1e300]),
        ] {
            assert!(Levels::every(interval, base, range).is_err(), "{interval} {base} {range:?}");
        }
        assert!(Levels::given(&[1.0, f64::NAN]).is_err());
        assert_eq!(Levels::given(&[]).expect("none").values(), [] as [f64; 0]);
    }
}
