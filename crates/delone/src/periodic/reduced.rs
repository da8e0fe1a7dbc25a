//! A basis of short vectors of a lattice, and what is measured along them.
//!
//! A lattice has many bases. With short vectors, nearly at right angles, few copies of the points are near the cell. Pairs of vectors are
//! shortened by each other until none gets shorter (Lagrange; Semaev 2001 for three). The basis need not be the best one: any is right.

use std::ops::{Add, Mul, Sub};

use crate::error::{Error, LatticeProblem};

/// The lengths of axes, so that products of six of them do not leave the range of `f64`: 1e-100 and its inverse.
const LENGTHS: std::ops::RangeInclusive<f64> = 1e-100..=1e100;

/// The shortest length of a reduced vector, or height of the cell, as part of the longest vector. Below it the axes depend on each other but
/// for rounding.
const FLAT: f64 = 1e-12;

/// Halos reach this much further than the bound that is proved, for rounding.
pub(super) const MORE: f64 = 1.005;

/// A vector of a reduced basis.
#[derive(Clone, Debug)]
pub(super) struct Reduced<const D: usize> {
    pub vector: [f64; D],
    /// The vector in steps of the grid.
    pub steps: [i128; D],
    /// How often each axis is added.
    pub of_axes: [i64; D],
    /// The product of a place with it is the number of periods from the origin.
    dual: [f64; D],
    /// The height of the cell along this vector.
    pub width: f64,
}

impl<const D: usize> Reduced<D> {
    /// How many periods a place is from the origin, rounded.
    #[inline]
    pub(super) fn fraction(&self, place: &[f64; D]) -> f64 {
        dot(&self.dual, place)
    }
}

/// The vectors, before they are on a grid.
pub(super) struct Basis<const D: usize> {
    vectors: Vec<([f64; D], [i64; D])>,
    duals: Vec<[f64; D]>,
    widths: Vec<f64>,
    radius: f64,
}

fn dot<const D: usize>(u: &[f64; D], v: &[f64; D]) -> f64 {
    (0..D).fold(0.0, |sum, k| sum + u[k] * v[k])
}

/// Whether an axis of a box has a length in the range.
///
/// # Errors
/// [`Error::Lattice`] with the axis.
pub(super) fn check_length<const D: usize>(axis: usize, vector: &[f64; D]) -> Result<(), Error> {
    let problem = |problem| Err(Error::Lattice { axis, problem });
    if vector.iter().any(|x| !x.is_finite()) {
        return problem(LatticeProblem::NotFinite);
    }
    let largest = vector.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    if largest == 0.0 {
        return problem(LatticeProblem::Dependent);
    }
    if !LENGTHS.contains(&largest) {
        return problem(LatticeProblem::Range);
    }
    Ok(())
}

impl<const D: usize> Basis<D> {
    /// Short vectors that give the same lattice as those axes along which it repeats.
    pub(super) fn new(axes: [[f64; D]; D], periodic: [bool; D]) -> Result<Self, Error> {
        let mut vectors = Vec::new();
        for axis in (0..D).filter(|&axis| periodic[axis]) {
            check_length(axis, &axes[axis])?;
            vectors.push((axes[axis], std::array::from_fn(|k| i64::from(k == axis))));
        }
        reduce(&mut vectors);
        let (duals, radius) = duals(&vectors.iter().map(|v| v.0).collect::<Vec<_>>());
        let widths: Vec<f64> = duals.iter().map(|dual| 1.0 / dot(dual, dual).sqrt()).collect();
        let longest = vectors.iter().map(|(v, _)| dot(v, v).sqrt()).fold(0.0, f64::max);
        if let Some(i) = widths.iter().position(|&width| width.is_nan() || width <= FLAT * longest) {
            let axis = (0..D).rev().find(|&axis| vectors[i].1[axis] != 0).unwrap_or(0);
            return Err(Error::Lattice { axis, problem: LatticeProblem::Dependent });
        }
        // The reduced basis is far from flat, so that the sign of its volume is not lost. The change of basis is in integers.
        if vectors.len() == D {
            let places: Vec<[f64; D]> = vectors.iter().map(|v| v.0).collect();
            let changes: Vec<[i128; D]> = vectors.iter().map(|v| v.1.map(i128::from)).collect();
            if (determinant(&places) < 0.0) != (determinant(&changes) < 0) {
                return Err(Error::Lattice { axis: D - 1, problem: LatticeProblem::LeftHanded });
            }
        }
        Ok(Self { vectors, duals, widths, radius })
    }

    /// How far the coordinates of points beside the span of the vectors can be from zero: of what is left without its parts along them. Nothing, if
    /// they span all.
    pub(super) fn beside(&self, points: impl Iterator<Item = [f64; D]>) -> [f64; D] {
        /// Rounding errors of a point, in parts of its largest coordinate: far more than there are.
        const ROUNDING: f64 = 1e-14;
        let mut most = [0.0_f64; D];
        if self.vectors.len() == D {
            return most;
        }
        for p in points {
            let largest = p.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
            let mut rest = p;
            for ((vector, _), dual) in self.vectors.iter().zip(&self.duals) {
                let part = dot(dual, &p);
                rest = std::array::from_fn(|k| rest[k] - part * vector[k]);
            }
            most = std::array::from_fn(|k| most[k].max(rest[k].abs() + ROUNDING * largest));
        }
        most
    }

    /// How far from zero a coordinate of a copy can be: in the cell at the origin, one period further, and in the
    /// widest halo; beside the span of the vectors [`Self::beside`] is to be added.
    pub(super) fn reach(&self, axis: usize) -> f64 {
        let halo = 2.0 * MORE * self.radius;
        let along = |i: usize| self.vectors[i].0[axis].abs() * (2.0 + halo / self.widths[i]);
        (0..self.vectors.len()).map(along).sum()
    }

    /// These vectors of a lattice whose axes are in steps of a grid.
    pub(super) fn on_grid(
        self,
        axes: &[[i128; D]; D],
        steps: &[Option<f64>; D],
    ) -> Result<Vec<Reduced<D>>, Error> {
        let on_grid: Vec<[i128; D]> = self
            .vectors
            .iter()
            .map(|(_, of_axes)| {
                std::array::from_fn(|k| (0..D).map(|axis| i128::from(of_axes[axis]) * axes[axis][k]).sum())
            })
            .collect();
        let place = |v: &[i128; D]| std::array::from_fn(|k| v[k] as f64 * steps[k].unwrap_or(0.0));
        let places: Vec<[f64; D]> = on_grid.iter().map(place).collect();
        let (duals, _) = duals(&places);
        let all = self.vectors.into_iter().zip(on_grid).zip(places).zip(duals);
        all.map(|((((_, of_axes), steps), vector), dual)| {
            let width = 1.0 / dot(&dual, &dual).sqrt();
            let axis = (0..D).find(|&axis| of_axes[axis] != 0).unwrap_or(0);
            let dependent = Error::Lattice { axis, problem: LatticeProblem::Dependent };
            // A coarse grid may make an axis vanish.
            (width > 0.0 && width.is_finite())
                .then_some(Reduced { vector, steps, of_axes, dual, width })
                .ok_or(dependent)
        })
        .collect()
    }
}

/// A radius within which every place has a point of the lattice, measured in the span of its vectors: half the diagonal of the box with
/// the sides of the orthogonalized vectors (Babai 1986).
pub(super) fn covering_radius<const D: usize>(reduced: &[Reduced<D>]) -> f64 {
    duals(&reduced.iter().map(|v| v.vector).collect::<Vec<_>>()).1
}

/// Shortens vectors by each other.
fn reduce<const D: usize>(vectors: &mut [([f64; D], [i64; D])]) {
    /// How often an axis may be added.
    const MOST_TIMES: f64 = (1 << 30) as f64;
    let mut changed = true;
    while std::mem::take(&mut changed) {
        for i in 0..vectors.len() {
            for j in (0..vectors.len()).filter(|&j| j != i) {
                let ((v, of_v), (w, of_w)) = (vectors[i], vectors[j]);
                let times = (dot(&v, &w) / dot(&w, &w)).round();
                let shorter: [f64; D] = std::array::from_fn(|k| v[k] - times * w[k]);
                // Much shorter than rounding, or it might go on for ever.
                let is_shorter = dot(&shorter, &shorter) < dot(&v, &v) * (1.0 - 1e-9);
                let sum: [f64; D] = std::array::from_fn(|k| of_v[k] as f64 - times * of_w[k] as f64);
                if is_shorter && sum.iter().all(|x| x.abs() < MOST_TIMES) {
                    vectors[i] = (shorter, sum.map(|x| x as i64));
                    changed = true;
                }
            }
        }
    }
}

/// For each vector the one whose product with it is 1, and 0 with the others, in the span of all; and [`covering_radius`].
fn duals<const D: usize>(vectors: &[[f64; D]]) -> (Vec<[f64; D]>, f64) {
    let orthogonalized = |last: usize| {
        // Orthogonal to all others, by Gram and Schmidt twice.
        let mut basis: Vec<[f64; D]> = Vec::new();
        for i in (0..vectors.len()).filter(|&i| i != last).chain([last]) {
            let mut v = vectors[i];
            for _ in 0..2 {
                for b in &basis {
                    let part = dot(&v, b) / dot(b, b);
                    v = std::array::from_fn(|k| v[k] - part * b[k]);
                }
            }
            basis.push(v);
        }
        basis
    };
    let dual = |i: usize| {
        let basis = orthogonalized(i);
        let rest = basis[basis.len() - 1];
        let square = dot(&rest, &rest);
        (rest.map(|x| x / square), basis.iter().map(|b| dot(b, b)).sum::<f64>().sqrt() / 2.0)
    };
    let (duals, radii): (Vec<_>, Vec<f64>) = (0..vectors.len()).map(dual).unzip();
    let radius = radii.into_iter().reduce(f64::min);
    (duals, radius.unwrap_or(0.0))
}

/// The determinant of two or three rows.
fn determinant<T: Copy + Mul<Output = T> + Add<Output = T> + Sub<Output = T>, const D: usize>(
    rows: &[[T; D]],
) -> T {
    let minor = |u: &[T; D], v: &[T; D], i: usize, j: usize| u[i] * v[j] - u[j] * v[i];
    match rows {
        [u, v, w] => u[0] * minor(v, w, 1, 2) + u[1] * minor(v, w, 2, 0) + u[2] * minor(v, w, 0, 1),
        rows => minor(&rows[0], &rows[1], 0, 1),
    }
}
