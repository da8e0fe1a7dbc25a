//! Coordinates as integers, determinants, ranks, barycentric coordinates, distances.

use std::cmp::Ordering;
use std::collections::BTreeMap;
use std::ops::{AddAssign, Mul, Neg};

use num_bigint::BigInt;

/// A vector of integers.
pub(crate) type Vector = Vec<BigInt>;

/// A number as digits times a power of two.
fn digits(x: f64) -> (i64, i32) {
    assert!(x.is_finite(), "the oracle was given {x}");
    let bits = x.to_bits();
    let (exponent, fraction) = ((bits >> 52 & 0x7ff) as i32, (bits & ((1 << 52) - 1)) as i64);
    let (digits, exponent) =
        if exponent == 0 { (fraction, -1074) } else { (fraction + (1 << 52), exponent - 1075) };
    if digits == 0 {
        return (0, 0);
    }
    let zeros = digits.trailing_zeros();
    let digits = digits >> zeros;
    (if x < 0.0 { -digits } else { digits }, exponent + zeros as i32)
}

/// The power of two that all numbers are divided by, so that they are integers.
pub(crate) fn scale<'a>(numbers: impl IntoIterator<Item = &'a f64>) -> i32 {
    numbers.into_iter().filter(|x| **x != 0.0).map(|x| digits(*x).1).min().unwrap_or(0)
}

/// A number divided by a power of two that divides it.
pub(crate) fn integer(x: f64, scale: i32) -> BigInt {
    let (digits, exponent) = digits(x);
    if digits == 0 { BigInt::ZERO } else { BigInt::from(digits) << (exponent - scale) }
}

/// Points with integer coordinates, on a common scale.
pub(crate) fn integers<const D: usize>(points: &[[f64; D]]) -> Vec<Vector> {
    let scale = scale(points.iter().flatten());
    points.iter().map(|p| p.iter().map(|&x| integer(x, scale)).collect()).collect()
}

/// -1, 0 or 1.
pub(crate) fn sign(x: &BigInt) -> i8 {
    match x.cmp(&BigInt::ZERO) {
        Ordering::Less => -1,
        Ordering::Equal => 0,
        Ordering::Greater => 1,
    }
}

pub(crate) fn minus(p: &[BigInt], q: &[BigInt]) -> Vector {
    p.iter().zip(q).map(|(x, y)| x - y).collect()
}

pub(crate) fn dot(p: &[BigInt], q: &[BigInt]) -> BigInt {
    p.iter().zip(q).map(|(x, y)| x * y).sum()
}

/// |p - q|^2.
pub(crate) fn squared(p: &[BigInt], q: &[BigInt]) -> BigInt {
    let v = minus(p, q);
    dot(&v, &v)
}

/// The cofactors of a last row that is not there: the determinant with that row is the sum of its products with them.
pub(crate) fn cofactors(rows: &[Vector]) -> Vector {
    let last = rows.len();
    let cofactor = |column: usize| {
        let minor: Vec<Vector> = rows.iter().map(|row| without(row, column)).collect();
        let value = determinant(&minor);
        if (last + column).is_multiple_of(2) { value } else { -value }
    };
    (0..=last).map(cofactor).collect()
}

/// The determinant of a square matrix; one without rows has 1.
pub(crate) fn determinant(rows: &[Vector]) -> BigInt {
    match rows.split_last() {
        None => BigInt::from(1),
        Some((last, others)) => dot(&cofactors(others), last),
    }
}

fn without(row: &[BigInt], column: usize) -> Vector {
    row.iter().enumerate().filter(|(k, _)| *k != column).map(|(_, x)| x.clone()).collect()
}

/// A number plus infinitesimals: that of a larger rank is infinitely larger than all multiples of the others.
#[derive(Clone, Debug)]
pub(crate) struct Form {
    real: BigInt,
    by_rank: BTreeMap<usize, BigInt>,
}

impl Form {
    pub(crate) fn new(real: BigInt) -> Self {
        Self { real, by_rank: BTreeMap::new() }
    }

    /// One infinitesimal.
    pub(crate) fn infinitesimal(rank: usize) -> Self {
        Self { real: BigInt::ZERO, by_rank: BTreeMap::from([(rank, BigInt::from(1))]) }
    }

    pub(crate) fn sign(&self) -> i8 {
        let all = [&self.real].into_iter().chain(self.by_rank.values().rev());
        all.map(sign).find(|sign| *sign != 0).unwrap_or(0)
    }
}

impl AddAssign for Form {
    fn add_assign(&mut self, other: Self) {
        self.real += other.real;
        for (rank, x) in other.by_rank {
            *self.by_rank.entry(rank).or_default() += x;
        }
    }
}

impl Neg for Form {
    type Output = Self;

    fn neg(self) -> Self {
        let by_rank = self.by_rank.into_iter().map(|(rank, x)| (rank, -x)).collect();
        Self { real: -self.real, by_rank }
    }
}

impl Mul<&BigInt> for Form {
    type Output = Self;

    fn mul(self, factor: &BigInt) -> Self {
        let by_rank = self.by_rank.into_iter().map(|(rank, x)| (rank, x * factor)).collect();
        Self { real: self.real * factor, by_rank }
    }
}

/// The columns of a largest set of independent columns: as many as the rank.
pub(crate) fn independent_columns(rows: &[Vector]) -> Vec<usize> {
    let mut rows = rows.to_vec();
    let width = rows.first().map_or(0, Vec::len);
    let (mut pivots, mut done) = (Vec::new(), 0);
    for column in 0..width {
        let Some(pivot) = (done..rows.len()).find(|&i| sign(&rows[i][column]) != 0) else { continue };
        rows.swap(done, pivot);
        let (above, below) = rows.split_at_mut(done + 1);
        let top = &above[done];
        for row in below {
            let factor = row[column].clone();
            for (x, y) in row.iter_mut().zip(top) {
                *x = &*x * &top[column] - y * &factor;
            }
        }
        pivots.push(column);
        done += 1;
    }
    pivots
}

/// The columns that tell points apart that span as much: projected onto these axes, they span all.
pub(crate) fn axes(points: &[Vector]) -> Vec<usize> {
    let rows: Vec<Vector> = points.iter().skip(1).map(|p| minus(p, &points[0])).collect();
    independent_columns(&rows)
}

/// The coordinates along some axes.
pub(crate) fn along(p: &[BigInt], axes: &[usize]) -> Vector {
    axes.iter().map(|&k| p[k].clone()).collect()
}

/// The orientation of d + 1 points with d coordinates: the sign of the determinant of the differences from the first.
pub(crate) fn orientation(points: &[&Vector]) -> i8 {
    let rows: Vec<Vector> = points[1..].iter().map(|p| minus(p, points[0])).collect();
    sign(&determinant(&rows))
}

/// Whether a point is in the relative inside of a simplex, on no face of it.
pub(crate) fn is_inside(simplex: &[Vector], q: &Vector) -> bool {
    let axes_of_all = axes(simplex);
    if axes_of_all.len() + 1 != simplex.len() {
        return false;
    }
    let with_q: Vec<Vector> = simplex.iter().chain([q]).cloned().collect();
    if axes(&with_q).len() != axes_of_all.len() {
        return false;
    }
    let flat: Vec<Vector> = simplex.iter().map(|p| along(p, &axes_of_all)).collect();
    let q = along(q, &axes_of_all);
    let whole = orientation(&flat.iter().collect::<Vec<_>>());
    (0..flat.len()).all(|i| {
        let corners: Vec<&Vector> = (0..flat.len()).map(|j| if i == j { &q } else { &flat[j] }).collect();
        orientation(&corners) == whole
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn vector(numbers: &[i64]) -> Vector {
        numbers.iter().map(|&x| BigInt::from(x)).collect()
    }

    #[test]
    fn numbers_are_integers_on_a_common_scale() {
        assert_eq!(integers(&[[0.5, -3.0], [0.0, 0.75]]), [vector(&[2, -12]), vector(&[0, 3])]);
        assert_eq!(integers(&[[5e-324, 1.5e-323]]), [vector(&[1, 3])]);
        assert_eq!(integers(&[[f64::MAX]]), [vector(&[1])].map(|_| vector(&[(1 << 53) - 1])));
    }

    #[test]
    fn determinants_and_ranks() {
        let rows = [vector(&[2, 0, 1]), vector(&[1, 3, 2]), vector(&[1, 1, 2])];
        assert_eq!(determinant(&rows), BigInt::from(6));
        assert_eq!(independent_columns(&[vector(&[0, 2, 4]), vector(&[0, 1, 2])]), [1]);
        assert_eq!(axes(&[vector(&[1, 1]), vector(&[2, 2]), vector(&[3, 4])]), [0, 1]);
    }

    #[test]
    fn larger_ranks_outweigh_all_smaller_ones() {
        let mut form = Form::infinitesimal(1) * &BigInt::from(1_000_000);
        form += -Form::infinitesimal(2);
        assert_eq!(form.sign(), -1);
        form += Form::new(BigInt::from(1));
        assert_eq!(form.sign(), 1);
    }

    #[test]
    fn insides_of_simplices() {
        let triangle = [vector(&[0, 0, 0]), vector(&[4, 0, 4]), vector(&[0, 4, 0])];
        assert!(is_inside(&triangle, &vector(&[1, 1, 1])));
        assert!(!is_inside(&triangle, &vector(&[1, 1, 0])));
        assert!(!is_inside(&triangle, &vector(&[2, 2, 2])));
        assert!(is_inside(&triangle[1..], &vector(&[2, 2, 2])));
        assert!(is_inside(&triangle[..1], &vector(&[0, 0, 0])));
        assert!(!is_inside(&triangle[..1], &vector(&[0, 0, 1])));
    }
}
