//! The best fit of a linear function to differences, each with its weight, whatever the weights and directions are.
//!
//! Source: Peters and Wilkinson, "The least squares problem and pseudo-inverses", 1970; Bjorck and Duff, "A direct method for the
//! solution of sparse linear least squares problems", 1980, for weights of very different sizes. Gaussian elimination with complete
//! pivoting writes the rows as L U. The columns of L are well-conditioned even where rows are not, so normal equations are solved for
//! L alone. Each row is in error by a part of itself, so large weights do not drown small ones. All is done in twice the precision.
//!
//! Cost: O(k) for k rows, some thousand operations each.

use super::super::real::{Double, Real, dot};

/// One neighbor.
#[derive(Clone, Copy, Debug)]
pub(super) struct Row {
    /// From the vertex to the neighbor, the longest coordinate between one and two.
    pub(super) away: [Double; 3],
    /// The difference of values, in the unit of `away`.
    pub(super) rise: Double,
    /// The weight of the direction, not negative.
    pub(super) weight: Double,
}

/// The largest power of two that is not above a positive number.
pub(super) fn power(x: f64) -> f64 {
    const EXPONENT: u64 = 0x7ff0_0000_0000_0000;
    f64::from_bits(x.max(f64::MIN_POSITIVE).to_bits() & EXPONENT)
}

/// The best fit.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fit {
    /// The gradient.
    pub(super) slope: [f64; 3],
    /// How far it may be off along all axes together, if each rise is off by one in the unit of its row.
    pub(super) noise: f64,
}

/// The gradient that fits best along so many axes; `None` where the rows do not span them, as far as numbers tell.
pub(super) fn fit(rows: &[Row], axes: usize) -> Option<Fit> {
    let largest = rows.iter().map(|row| row.weight.value()).fold(0.0, f64::max);
    if !(largest > 0.0 && largest.is_finite()) {
        return None;
    }
    let unit = power(largest);
    // Rows times powers of two, about the roots of their weights; what the weights have besides is left for later.
    let mut lower = Vec::with_capacity(rows.len());
    let mut scaled = Vec::with_capacity(rows.len());
    let mut rest = Vec::with_capacity(rows.len());
    for row in rows.iter().filter(|row| row.weight.value() > 0.0) {
        let weight = row.weight * double(1.0 / unit);
        let root = power(weight.value().sqrt());
        lower.push(row.away.map(|x| x * double(root)));
        scaled.push((root, row.rise * double(root)));
        rest.push(weight * double(1.0 / root) * double(1.0 / root) / dot(row.away, row.away));
    }
    let upper = eliminate(&mut lower, axes)?;
    // The matrix of the normal equations of L.
    let mut normal = [[Double::default(); 3]; 3];
    for (l, &weight) in lower.iter().zip(&rest) {
        for i in 0..axes {
            let part = l[i] * weight;
            (0..axes).for_each(|j| normal[i][j] += part * l[j]);
        }
    }
    let solve = |right: [Double; 3]| {
        let inner = solve_normal(normal, right, axes);
        let mut solution = [Double::default(); 3];
        for step in (0..axes).rev() {
            let (row, own) = upper[step];
            let known = upper[step + 1..axes]
                .iter()
                .fold(inner[step], |sum, &(_, axis)| sum - row[axis] * solution[axis]);
            solution[own] = known / row[own];
        }
        solution.map(Real::value)
    };
    let mut right = [Double::default(); 3];
    let mut columns = [[0.0; 3]; 3];
    for i in 0..axes {
        let mut unit = [Double::default(); 3];
        unit[i] = Double::one();
        columns[i] = solve(unit);
        for ((l, (_, rise)), &weight) in lower.iter().zip(&scaled).zip(&rest) {
            right[i] += l[i] * weight * *rise;
        }
    }
    let of_row = |((l, (root, _)), weight): ((&[Double; 3], &(f64, Double)), &Double)| {
        let share = |axis: usize| (0..axes).map(|i| columns[i][axis] * l[i].value()).sum::<f64>();
        (0..axes).map(|axis| (share(axis) * weight.value() * root).abs()).sum::<f64>()
    };
    let noise = lower.iter().zip(&scaled).zip(&rest).map(of_row).sum();
    let slope = solve(right);
    slope.iter().all(|x| x.is_finite()).then_some(Fit { slope, noise })
}

/// Solves equations whose matrix is symmetric and well-conditioned.
fn solve_normal(mut matrix: [[Double; 3]; 3], mut right: [Double; 3], axes: usize) -> [Double; 3] {
    for step in 0..axes {
        for i in step + 1..axes {
            let factor = matrix[i][step] / matrix[step][step];
            let taken = matrix[step].map(|x| factor * x);
            (step..axes).for_each(|j| matrix[i][j] = matrix[i][j] - taken[j]);
            right[i] = right[i] - factor * right[step];
        }
    }
    for step in (0..axes).rev() {
        let known = (step + 1..axes).fold(right[step], |sum, j| sum - matrix[step][j] * right[j]);
        right[step] = known / matrix[step][step];
    }
    right
}

/// Gaussian elimination with complete pivoting: makes rows those of L, and gives those of U, each with the axis of its pivot; `None`
/// where a pivot is zero or no number. Equal pivots are taken in the order of rows and axes.
fn eliminate(rows: &mut [[Double; 3]], axes: usize) -> Option<[([Double; 3], usize); 3]> {
    let mut upper = [([Double::default(); 3], 0); 3];
    let mut lower = vec![[Double::default(); 3]; rows.len()];
    let mut is_left = [true; 3];
    for step in 0..axes {
        let (mut best, mut pivot) = (0.0, None);
        for (i, row) in rows.iter().enumerate() {
            for axis in (0..axes).filter(|&axis| is_left[axis]) {
                let size = row[axis].value().abs();
                if size > best {
                    (best, pivot) = (size, Some((i, axis)));
                }
            }
        }
        let (i, axis) = pivot.filter(|_| best.is_finite())?;
        upper[step] = (rows[i], axis);
        is_left[axis] = false;
        let chosen = rows[i];
        for (row, factors) in rows.iter_mut().zip(&mut lower) {
            let factor = row[axis] / chosen[axis];
            factors[step] = factor;
            for other in 0..axes {
                row[other] =
                    if is_left[other] { row[other] - factor * chosen[other] } else { Double::default() };
            }
        }
        // Nothing is left of the pivot's own row.
        lower[i][step] = Double::one();
        rows[i] = [Double::default(); 3];
    }
    rows.copy_from_slice(&lower);
    Some(upper)
}

/// A number in twice the precision.
pub(super) fn double(x: f64) -> Double {
    Double::difference(x, 0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::{Row, double, fit};

    fn rows(points: &[([f64; 3], f64)]) -> Vec<Row> {
        let gradient = [3.0, -2.0, 5.0];
        let row = |&(away, weight): &([f64; 3], f64)| Row {
            away: away.map(double),
            rise: double((0..3).map(|k| gradient[k] * away[k]).sum()),
            weight: double(weight),
        };
        points.iter().map(row).collect()
    }

    /// Directions and weights that are each other's worst: whole numbers, so that rises are exact.
    #[test]
    fn weights_of_any_size_leave_linear_functions_alone() {
        let points = [
            ([1.0, 1.0, 1.0], 1e40),
            ([-1.0, -1.0, -1.0], 1e-9),
            ([1.0, 1.0, 0.0], 1e25),
            ([1.0, 0.0, 1.0], 1e-60),
            ([1.0, 1.0, 1.25], 0.0),
        ];
        let found = fit(&rows(&points), 3).expect("they span").slope;
        assert!(found.iter().zip([3.0, -2.0, 5.0]).all(|(a, b)| (a - b).abs() < 1e-14), "{found:?}");
        assert!(fit(&rows(&points[..2]), 3).is_none() && fit(&rows(&points[4..]), 3).is_none());
        // Across a right angle an error stays what it is; across a small one it grows.
        let noise = |x: f64| {
            let away = [[1.0, 0.0, 0.0], [1.0, x, 0.0]];
            fit(&rows(&away.map(|away| (away, 1.0))), 2).expect("they span").noise
        };
        assert!((1.9..4.1).contains(&noise(1.0)) && (1e6..4e6).contains(&noise(1e-6)));
    }
}
