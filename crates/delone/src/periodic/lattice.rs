//! Lattices: up to three vectors by which a set of points repeats, and how coordinates are rounded so that all copies are exact.

use std::ops::{AddAssign, Mul};

use super::reduced::{Basis, Reduced};
use crate::decimal::{DecimalGrid, MOST_EXACT};
use crate::error::{Error, LatticeProblem};

/// How coordinates become numbers to which vectors of the lattice can be added without rounding.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub enum Grid {
    /// Multiples of a power of two, two or three bits coarser than the numbers from half the size of the box up to its size.
    #[default]
    Binary,
    /// Decimals, if points and lattice are multiples of one step within rounding ([`DecimalGrid::find`]); otherwise as `Binary`.
    Auto,
    /// Multiples of this grid: whatever is between them is moved.
    Decimal(DecimalGrid),
}

/// A box, or another parallelepiped, that repeats: along all of its axes or along some.
///
/// ```
/// use delone::Lattice3;
///
/// let cube = Lattice3::with_sides([10.0, 10.0, 10.0])?;
/// let slab = cube.periodic([true, true, false]);
/// let tilted = Lattice3::with_axes([[10.0, 0.0, 0.0], [3.0, 9.0, 0.0], [0.0, 2.0, 8.0]])?;
/// assert_eq!(slab.axes(), [[10.0, 0.0, 0.0], [0.0, 10.0, 0.0], [0.0, 0.0, 10.0]]);
/// assert!(Lattice3::with_sides([10.0, -1.0, 10.0]).is_err());
/// # let _ = tilted;
/// # Ok::<(), delone::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lattice<const D: usize> {
    axes: [[f64; D]; D],
    periodic: [bool; D],
    origin: [f64; D],
    grid: Grid,
}

/// A lattice of the plane.
pub type Lattice2 = Lattice<2>;

/// A lattice of space.
pub type Lattice3 = Lattice<3>;

impl<const D: usize> Lattice<D> {
    /// A box with these sides, which repeats along all axes.
    ///
    /// # Errors
    /// [`Error::Lattice`] for a side that is not positive and finite.
    pub fn with_sides(sides: [f64; D]) -> Result<Self, Error> {
        if let Some(axis) = sides.iter().position(|&side| !(side > 0.0 && side.is_finite())) {
            return Err(Error::Lattice { axis, problem: LatticeProblem::Side });
        }
        let mut axes = [[0.0; D]; D];
        for (axis, side) in sides.into_iter().enumerate() {
            axes[axis][axis] = side;
        }
        Self::with_axes(axes)
    }

    /// A parallelepiped with these axes, one a row, which repeats along all of them. Their lengths must be between 1e-100 and 1e100.
    ///
    /// # Errors
    /// [`Error::Lattice`] for numbers that are not finite or out of this range, for axes of which one is nearly a sum of multiples of the
    /// others, and for left-handed ones.
    pub fn with_axes(axes: [[f64; D]; D]) -> Result<Self, Error> {
        let lattice = Self { axes, periodic: [true; D], origin: [0.0; D], grid: Grid::default() };
        Basis::new(axes, [true; D])?;
        Ok(lattice)
    }

    /// Along which axes it repeats. Triangulations are without bounds along the others, and cells end at the walls of the box.
    #[must_use]
    pub fn periodic(self, periodic: [bool; D]) -> Self {
        Self { periodic, ..self }
    }

    /// Where the box begins, which is the origin otherwise. It matters along axes along which the box does not repeat, for cells: there they
    /// end at its walls.
    #[must_use]
    pub fn origin(self, origin: [f64; D]) -> Self {
        Self { origin, ..self }
    }

    /// How coordinates are rounded.
    #[must_use]
    pub fn grid(self, grid: Grid) -> Self {
        Self { grid, ..self }
    }

    /// The axes, one a row.
    pub fn axes(&self) -> [[f64; D]; D] {
        self.axes
    }

    /// Along which axes it repeats.
    pub fn is_periodic(&self) -> [bool; D] {
        self.periodic
    }

    /// The decimal grid that is asked for, or that the numbers have if they are to be looked at.
    fn decimal(&self, points: &[[f64; D]]) -> Option<DecimalGrid> {
        match self.grid {
            Grid::Binary => None,
            Grid::Decimal(grid) => Some(grid),
            Grid::Auto => {
                let axes = (0..D).filter(|&i| self.periodic[i]).flat_map(|i| self.axes[i]);
                let numbers: Vec<f64> = points.iter().flatten().copied().chain(axes).collect();
                DecimalGrid::find(&numbers)
            }
        }
    }

    /// The lattice on the grid of some points.
    pub(super) fn prepare(&self, points: &[[f64; D]]) -> Result<Prepared<D>, Error> {
        let decimal = self.decimal(points);
        let axes = self.axes.map(|axis| axis.map(|x| decimal.map_or(x, |grid| grid.index(x))));
        let basis = Basis::new(axes, self.periodic)?;
        let beside = basis.beside(points.iter().map(|p| p.map(|x| decimal.map_or(x, |grid| grid.index(x)))));
        let mut steps = [None; D];
        for (axis, step) in steps.iter_mut().enumerate() {
            let reach = basis.reach(axis);
            if reach > 0.0 {
                let reach = reach + beside[axis];
                // All multiples up to the reach are numbers: the step is the least power of two for which they are.
                let least = power_of_two_above(reach / MOST_EXACT);
                *step = Some(if decimal.is_some() { least.max(1.0) } else { least });
            }
        }
        let rounded = axes.map(|axis| std::array::from_fn(|k| in_steps(axis[k], steps[k]).unwrap_or(0)));
        let reduced =
            basis.on_grid(&rounded, &steps).map_err(|error| far_away(points, &beside).unwrap_or(error))?;
        // Walls stay where they are, between the multiples too.
        let wall = |x: f64| decimal.map_or(x, |grid| steps_to(grid, x));
        let origin = self.origin.map(wall);
        let walled = std::array::from_fn(|axis| (!self.periodic[axis]).then(|| self.axes[axis].map(wall)));
        Ok(Prepared { decimal, steps, axes: rounded, reduced, origin, walled })
    }
}

/// The point that is furthest away along the axis along which the points are: beside it the lattice vanishes by rounding.
fn far_away<const D: usize>(points: &[[f64; D]], beside: &[f64; D]) -> Option<Error> {
    let axis = (0..D).filter(|&k| beside[k] > 0.0).max_by(|&i, &j| beside[i].total_cmp(&beside[j]))?;
    let (index, point) =
        points.iter().enumerate().max_by(|p, q| p.1[axis].abs().total_cmp(&q.1[axis].abs()))?;
    Some(Error::FarAway { index, axis, value: point[axis] })
}

/// How many steps of a grid a length has: a whole number where it is a multiple but for rounding.
fn steps_to(grid: DecimalGrid, x: f64) -> f64 {
    /// Several roundings.
    const ROUNDING: f64 = 1e-15;
    let is_multiple = (grid.nearest(x) - x).abs() <= ROUNDING * x.abs();
    if is_multiple { grid.index(x) } else { x / grid.step() }
}

/// The least power of two that is not below a positive number.
fn power_of_two_above(x: f64) -> f64 {
    let below = f64::from_bits(x.to_bits() & 0x7ff << 52);
    if below == x { below } else { 2.0 * below }
}

/// A coordinate as a multiple of a step, the nearest one; none without a step, and for one beyond 2^100 steps.
fn in_steps(x: f64, step: Option<f64>) -> Option<i128> {
    let multiple = (x / step?).round_ties_even();
    (multiple.abs() < (1_u128 << 100) as f64).then_some(multiple as i128)
}

/// Adds a multiple of a vector.
#[inline]
pub(super) fn add<T: Copy + AddAssign + Mul<Output = T>, const D: usize>(
    sum: &mut [T; D],
    times: T,
    vector: &[T; D],
) {
    for (sum, &x) in sum.iter_mut().zip(vector) {
        *sum += times * x;
    }
}

/// A lattice whose vectors are multiples of steps.
#[derive(Clone, Debug)]
pub(super) struct Prepared<const D: usize> {
    pub decimal: Option<DecimalGrid>,
    /// The step of each coordinate, a power of two; none for one that no vector of the lattice changes.
    steps: [Option<f64>; D],
    axes: [[i128; D]; D],
    /// A basis of short vectors.
    pub reduced: Vec<Reduced<D>>,
    pub origin: [f64; D],
    /// The axes along which the box does not repeat, in units of places.
    pub walled: [Option<[f64; D]>; D],
}

/// A site moved into the cell of the reduced basis at the origin.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wrapped<const D: usize> {
    pub place: [f64; D],
    /// How often each vector of the reduced basis is to be added for the point itself.
    pub offset: [i64; D],
}

impl<const D: usize> Prepared<D> {
    /// A point, moved into the cell at the origin; and by how much a coordinate was rounded at most, in coordinate units. The place is the same
    /// for all points that differ by a vector of the lattice.
    ///
    /// # Errors
    /// The axis along which it is too far away: more than 2^60 periods, or 2^100 steps.
    pub(super) fn wrap(&self, point: [f64; D]) -> Result<(Wrapped<D>, f64), usize> {
        const MOST_PERIODS: f64 = (1_u64 << 60) as f64;
        let given = point;
        let mut point = point.map(|x| self.decimal.map_or(x, |grid| grid.index(x)));
        let mut steps = [0; D];
        for axis in 0..D {
            if let Some(step) = self.steps[axis] {
                steps[axis] = in_steps(point[axis], self.steps[axis]).ok_or(axis)?;
                point[axis] = (point[axis] / step).round_ties_even() * step;
            }
        }
        let off = |k: usize| (self.length(point[k]) - given[k]).abs();
        let rounding = (0..D).map(off).fold(0.0, f64::max);
        let mut offset = [0; D];
        // The first pass leaves what rounding of large quotients has left.
        for _ in 0..2 {
            let place = self.at(&steps, &point);
            for (i, vector) in self.reduced.iter().enumerate() {
                let periods = vector.fraction(&place).floor();
                if periods.abs() > MOST_PERIODS {
                    return Err((0..D).find(|&k| vector.steps[k] != 0).unwrap_or(0));
                }
                offset[i] += periods as i64;
                add(&mut steps, -(periods as i128), &vector.steps);
            }
        }
        Ok((self.least(steps, &point, offset), rounding))
    }

    /// Of all places in the cell, or beside it by rounding, that differ by a vector of the lattice, the least.
    fn least(&self, steps: [i128; D], point: &[f64; D], offset: [i64; D]) -> Wrapped<D> {
        /// In periods: far more than rounding of a fraction, far less than the halo.
        const NEAR_PERIODS: f64 = 1e-9;
        let is_in = |place: &[f64; D]| {
            self.reduced.iter().all(|v| (-NEAR_PERIODS..=1.0 + NEAR_PERIODS).contains(&v.fraction(place)))
        };
        let mut best = Wrapped { place: self.at(&steps, point), offset };
        let fractions = self.reduced.iter().map(|v| v.fraction(&best.place));
        if fractions.into_iter().all(|f| f > NEAR_PERIODS && f < 1.0 - NEAR_PERIODS) {
            return best;
        }
        let count = self.reduced.len() as u32;
        let mut is_known = is_in(&best.place);
        for code in 0..3_usize.pow(count) {
            let (mut moved, mut other, mut rest) = (steps, offset, code);
            for (i, vector) in self.reduced.iter().enumerate() {
                let times = (rest % 3) as i64 - 1;
                rest /= 3;
                other[i] -= times;
                add(&mut moved, i128::from(times), &vector.steps);
            }
            let place = self.at(&moved, point);
            if is_in(&place) && (!is_known || place < best.place) {
                is_known = true;
                best = Wrapped { place, offset: other };
            }
        }
        best
    }

    /// Coordinates from steps, and from the point where there are none.
    fn at(&self, steps: &[i128; D], point: &[f64; D]) -> [f64; D] {
        std::array::from_fn(|k| self.steps[k].map_or(point[k], |step| steps[k] as f64 * step))
    }

    /// A place in the cell, moved by vectors of the reduced basis: exact within the halo.
    #[inline]
    pub(super) fn moved(&self, place: &[f64; D], times: [i32; D]) -> [f64; D] {
        let mut moved = *place;
        for (vector, times) in self.reduced.iter().zip(times) {
            add(&mut moved, f64::from(times), &vector.vector);
        }
        moved
    }

    /// A place in the cell, moved by axes of the user however often, in the units of the user and rounded once or twice.
    pub(super) fn far(&self, place: &[f64; D], times: [i64; D]) -> [f64; D] {
        std::array::from_fn(|k| {
            let moved = self.steps[k].map_or(place[k], |step| {
                let moves: i128 = (0..D).map(|axis| i128::from(times[axis]) * self.axes[axis][k]).sum();
                ((place[k] / step) as i128 + moves) as f64 * step
            });
            self.length(moved)
        })
    }

    /// A length of the places in coordinate units.
    pub(super) fn length(&self, length: f64) -> f64 {
        self.decimal.map_or(length, |grid| grid.coordinate(length))
    }

    /// Any place, moved by vectors of the reduced basis, in coordinate units; rounded.
    pub(super) fn shifted(&self, place: [f64; D], times: [i64; D]) -> [f64; D] {
        std::array::from_fn(|k| {
            let moves: i128 =
                self.reduced.iter().zip(times).map(|(v, times)| i128::from(times) * v.steps[k]).sum();
            self.length(place[k] + self.steps[k].map_or(0.0, |step| moves as f64 * step))
        })
    }

    /// A weight in the units of the places.
    pub(super) fn weight(&self, weight: f64) -> f64 {
        self.decimal.map_or(weight, |grid| grid.area(weight))
    }

    /// How often each axis of the user is added for so many vectors of the reduced basis.
    pub(super) fn in_axes(&self, offset: [i64; D]) -> [i64; D] {
        let mut times = [0; D];
        for (vector, &count) in self.reduced.iter().zip(&offset) {
            add(&mut times, count, &vector.of_axes);
        }
        times
    }
}
