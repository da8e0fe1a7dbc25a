//! Decimal grids: coordinates that are multiples of a step but for rounding, as integers.
//!
//! A file that says 0.3 means three tenths, and no `f64` is that. So points that lie on a lattice, on one line or on one circle by their
//! decimals do so no more once they are read, by a unit in the last place. Multiplied with 10^d and rounded they are integers, which are
//! exact: ties are ties again. Nothing does this unless it is asked to: it moves points, by rounding errors or by half a step.
//!
//! Cost: O(n) for each number of decimals that is tried, 16 at most.

use crate::error::Error;

/// The most decimals that are looked for.
const MOST_DECIMALS: i32 = 15;

/// The largest multiple of a step that is found by looking: so large numbers have no decimals, but by chance.
const MOST_STEPS: f64 = (1_u64 << 40) as f64;

/// How far a coordinate may be from the multiple of a step, in units in the last place of the largest one: several operations have
/// rounded it, as in `0.1 * 3 + 0.2`.
const ROUNDINGS: f64 = 4.0;

/// The largest integer up to which all are `f64`.
pub(crate) const MOST_EXACT: f64 = (1_u64 << 53) as f64;

/// A grid of the multiples of a step.
///
/// ```
/// use delone::{DecimalGrid, Delaunay2};
///
/// // Three tenths as a sum: not the number that is nearest to 0.3.
/// let points = [[0.0, 0.0], [0.1 + 0.2, 0.0], [0.3, 0.3], [0.0, 0.3], [0.6, 0.3], [0.6, 0.0]];
/// let grid = DecimalGrid::find(points.as_flattened()).expect("one decimal is enough");
/// assert_eq!(grid.step(), 0.1);
/// let integers = points.map(|p| p.map(|x| grid.index(x)));
/// assert_eq!(integers[1], [3.0, 0.0]);
/// let d = Delaunay2::from_points(&integers)?;
/// assert_eq!(d.triangles().count(), 4);
/// assert_eq!(grid.coordinate(3.0), 0.3);
/// # Ok::<(), delone::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DecimalGrid {
    /// The step is `times / parts`, and one of the two is 1.
    times: f64,
    parts: f64,
}

impl DecimalGrid {
    /// The coarsest step of 1, 0.1, 0.01, ... 10^-15 that all numbers are multiples of within rounding: within four units in the
    /// last place of the largest. `None` if there is none, or if a number would be more than 2^40 steps, as for measured coordinates.
    pub fn find(numbers: &[f64]) -> Option<Self> {
        let largest = numbers.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        let off = ROUNDINGS * (largest.next_up() - largest);
        (0..=MOST_DECIMALS).map(|d| Self { times: 1.0, parts: 10f64.powi(d) }).find(|grid| {
            largest * grid.parts <= MOST_STEPS && numbers.iter().all(|&x| (grid.nearest(x) - x).abs() <= off)
        })
    }

    /// The multiples of a step, which is taken for the decimal that it is nearest to.
    ///
    /// # Errors
    /// [`Error::Parameter`] if it is not positive and finite.
    pub fn with_step(step: f64) -> Result<Self, Error> {
        let parts = (1.0 / step).round();
        if !(step > 0.0 && step.is_finite() && (step >= 1.0 || parts.is_finite())) {
            return Err(Error::Parameter { name: "the step of the grid", value: step, range: "positive" });
        }
        let is_part = step < 1.0 && 1.0 / parts == step;
        Ok(if is_part { Self { times: 1.0, parts } } else { Self { times: step, parts: 1.0 } })
    }

    /// The step, in coordinate units, rounded.
    pub fn step(self) -> f64 {
        self.times / self.parts
    }

    /// The multiple of the step that is nearest to a coordinate: an integer.
    pub fn index(self, x: f64) -> f64 {
        // Minus zero is zero.
        (x * self.parts / self.times).round_ties_even() + 0.0
    }

    /// A coordinate in steps, an integer only if it is a multiple but for rounding: for what is beside the points of the grid.
    ///
    /// ```
    /// let grid = delone::DecimalGrid::with_step(0.1)?;
    /// assert_eq!((grid.in_steps(0.1 + 0.2), grid.in_steps(0.25)), (3.0, 2.5));
    /// # Ok::<(), delone::Error>(())
    /// ```
    pub fn in_steps(self, x: f64) -> f64 {
        let off = ROUNDINGS * (x.abs().next_up() - x.abs());
        if (self.nearest(x) - x).abs() <= off { self.index(x) } else { x * self.parts / self.times }
    }

    /// An area, or the square of a length, in squares of the step, rounded twice.
    pub fn area(self, area: f64) -> f64 {
        area * (self.parts * self.parts) / (self.times * self.times)
    }

    /// The coordinate of so many steps, an integer or not, rounded once if the step is a decimal.
    pub fn coordinate(self, index: f64) -> f64 {
        index * self.times / self.parts
    }

    /// The multiple of the step that is nearest to a coordinate, as a coordinate.
    pub fn nearest(self, x: f64) -> f64 {
        self.coordinate(self.index(x))
    }
}

#[cfg(test)]
mod tests {
    use super::DecimalGrid;

    #[test]
    fn decimals_are_found_within_rounding() {
        let sums: Vec<f64> = (0..50).scan(0.0, |x, _| Some(std::mem::replace(x, *x + 0.1))).collect();
        let products: Vec<f64> = (0..50).map(|i| f64::from(i) * 3.639).collect();
        assert_eq!(DecimalGrid::find(&products).map(DecimalGrid::step), Some(0.001));
        assert_eq!(DecimalGrid::find(&sums[..20]).map(DecimalGrid::step), Some(0.1));
        assert_eq!(DecimalGrid::find(&[1.0, -7.0, 1e9]).map(DecimalGrid::step), Some(1.0));
        assert_eq!(DecimalGrid::find(&[]).map(DecimalGrid::step), Some(1.0));
        assert_eq!(DecimalGrid::find(&[0.1, 1.0 / 3.0]), None);
        assert_eq!(DecimalGrid::find(&[1e300]), None);
        // A hundredth of a unit in the last place beside a large number says nothing.
        assert_eq!(DecimalGrid::find(&[0.123_456_789_012_345, 1e9]), None);
    }

    #[test]
    fn multiples_come_back() {
        for (step, parts) in [(1e-9, 1e9), (0.005, 200.0), (0.1, 10.0)] {
            let grid = DecimalGrid::with_step(step).expect("a step");
            assert_eq!(grid.parts, parts);
            for i in (-1000..1000).map(f64::from) {
                assert_eq!(grid.index(grid.coordinate(i)), i);
                assert_eq!(grid.coordinate(i), i / parts);
            }
        }
        let coarse = DecimalGrid::with_step(1000.0).expect("a step");
        assert_eq!((coarse.index(1499.0), coarse.coordinate(-2.0)), (1.0, -2000.0));
        for step in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-320] {
            assert!(DecimalGrid::with_step(step).is_err(), "{step}");
        }
        assert!(!DecimalGrid::with_step(0.1).expect("a step").index(-0.01).is_sign_negative());
    }
}
