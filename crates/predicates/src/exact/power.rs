//! Exact signs for points with weights: coordinates on a common scale s that fit 60 bits, weights on its square.
//!
//! Differences then fit 61 bits and a sign, lifts 125, minors of two columns 123 and of three 186: the determinant in the
//! plane takes 250 bits and that in space 313. What does not fit goes to big integers.

use std::cmp::Ordering;

use super::big;
use super::big_int::BigInt;
use super::decode;
use super::wide::Wide;
use crate::{Sign, Site};

/// Bits of coordinates, and of weights.
const BITS: u32 = 60;
const WEIGHT_BITS: u32 = 122;

/// Sites as integers, the weights on the square of the scale of the coordinates, if they fit.
fn align<const D: usize, const N: usize>(sites: &[Site<D>; N]) -> Option<([[i64; D]; N], [i128; N])> {
    let mut scale = i32::MAX;
    for (point, weight) in sites {
        scale = point.iter().fold(scale, |scale, &x| scale.min(decode(x).1));
        scale = scale.min(decode(*weight).1.div_euclid(2));
    }
    let fitted = |x: f64, scale: i32, bits: u32| {
        let (mantissa, exponent) = decode(x);
        if mantissa == 0 {
            return Some(0);
        }
        let shift = (exponent - scale).unsigned_abs();
        let fits = shift + (64 - mantissa.unsigned_abs().leading_zeros()) <= bits;
        fits.then(|| i128::from(mantissa) << shift)
    };
    let (mut points, mut weights) = ([[0; D]; N], [0; N]);
    for (k, (point, weight)) in sites.iter().enumerate() {
        for axis in 0..D {
            points[k][axis] = fitted(point[axis], scale, BITS)? as i64;
        }
        weights[k] = fitted(*weight, scale.saturating_mul(2), WEIGHT_BITS)?;
    }
    Some((points, weights))
}

/// The rows of a determinant: all sites but the last as seen from there, and their lifts.
pub(crate) fn rows<const D: usize, const N: usize, const R: usize>(
    sites: &[Site<D>; N],
) -> Option<([[i64; D]; R], [i128; R])> {
    const { assert!(R + 1 == N) };
    let (points, weights) = align(sites)?;
    let (mut rows, mut lifts) = ([[0; D]; R], [0; R]);
    for k in 0..R {
        rows[k] = std::array::from_fn(|axis| points[k][axis] - points[N - 1][axis]);
        let square: i128 = rows[k].iter().map(|&x| i128::from(x) * i128::from(x)).sum();
        lifts[k] = square - (weights[k] - weights[N - 1]);
    }
    Some((rows, lifts))
}

fn minor<const D: usize>(u: &[i64; D], v: &[i64; D]) -> i128 {
    i128::from(u[0]) * i128::from(v[1]) - i128::from(v[0]) * i128::from(u[1])
}

fn three(u: &[i64; 3], v: &[i64; 3], w: &[i64; 3]) -> Wide<3> {
    let times = |z: i64, minor: i128| -> Wide<3> { Wide::from(z).times(Wide::from(minor)) };
    times(u[2], minor(v, w)).minus(times(v[2], minor(u, w))).plus(times(w[2], minor(u, v)))
}

/// Sites a, b, c, d: positive where d is below.
pub(crate) fn in_power_circle(sites: [Site<2>; 4]) -> Sign {
    let Some(([a, b, c], lifts)) = rows(&sites) else { return big_determinant(&sites) };
    let lifted = |k: usize, minor: i128| -> Wide<4> { Wide::from(lifts[k]).times(Wide::from(minor)) };
    lifted(0, minor(&b, &c)).plus(lifted(1, minor(&c, &a))).plus(lifted(2, minor(&a, &b))).sign()
}

/// Sites a, b, c, d, e: positive where e is below, and d above a, b, c.
pub(crate) fn in_power_sphere(sites: [Site<3>; 5]) -> Sign {
    let Some(([a, b, c, d], lifts)) = rows(&sites) else { return -big_determinant(&sites) };
    let lifted = |k: usize, minor: Wide<3>| -> Wide<5> { Wide::from(lifts[k]).times(minor) };
    let positive = lifted(2, three(&a, &b, &d)).plus(lifted(0, three(&b, &c, &d)));
    positive.minus(lifted(3, three(&a, &b, &c)).plus(lifted(1, three(&a, &c, &d)))).sign()
}

/// Sites a, b, q on a line: positive where q is below.
pub(crate) fn in_power_interval(a: Site<2>, b: Site<2>, q: Site<2>) -> Sign {
    // Along the axis on which they differ.
    let axis = usize::from(a.0[0] == b.0[0]);
    let Some((rows, lifts)) = rows::<2, 3, 2>(&[a, b, q]) else { return big_interval(axis, &[a, b, q]) };
    let [u, v] = rows.map(|row| row[axis]);
    let lifted = |lift: i128, x: i64| -> Wide<3> { Wide::from(lift).times(Wide::from(x)) };
    lifted(lifts[0], v).minus(lifted(lifts[1], u)).sign() * Sign::of(&v, &u)
}

/// |q - p|^2 - w of one site against that of another.
pub(crate) fn compare_powers<const D: usize>(q: [f64; D], a: Site<D>, b: Site<D>) -> Ordering {
    if let Some((_, [a, b])) = rows::<D, 3, 2>(&[a, b, (q, 0.0)]) {
        a.cmp(&b)
    } else {
        let Rows { lifts, .. } = big_rows(&[a, b, (q, 0.0)]);
        lifts[0].cmp(&lifts[1])
    }
}

/// Numbers as integers, and weights on the square of their scale.
pub(crate) struct Scaled {
    pub(crate) numbers: Vec<BigInt>,
    pub(crate) weights: Vec<BigInt>,
    /// The binary exponent of the scale of the numbers.
    pub(crate) scale: i32,
}

/// Puts numbers of any size on one scale.
pub(crate) fn on_one_scale(numbers: &[f64], weights: &[f64]) -> Scaled {
    let ((numbers, scale), (weights, weight_scale)) = (big::integers(numbers), big::integers(weights));
    // Zeros alone have any scale.
    let scale = if scale == i32::MAX { 0 } else { scale };
    if weights.iter().all(|w| *w == BigInt::ZERO) {
        return Scaled { numbers, weights, scale };
    }
    let finer = (scale - weight_scale.div_euclid(2)).max(0);
    let coarser = (weight_scale - 2 * (scale - finer)).unsigned_abs();
    Scaled {
        numbers: numbers.into_iter().map(|x| x << finer.unsigned_abs()).collect(),
        weights: weights.into_iter().map(|w| w << coarser).collect(),
        scale: scale - finer,
    }
}

/// The result of [`rows`], for numbers of any size.
pub(crate) struct Rows {
    pub(crate) differences: Vec<Vec<BigInt>>,
    pub(crate) lifts: Vec<BigInt>,
    /// The weight of the last site.
    pub(crate) weight: BigInt,
    /// The binary exponent of the scale of the rows; lifts and weights are on its square.
    pub(crate) scale: i32,
}

/// [`rows`] for numbers of any size.
pub(crate) fn big_rows<const D: usize>(sites: &[Site<D>]) -> Rows {
    big_rows_and_last(sites).0
}

/// Rows of numbers of any size, and the last point on their scale.
pub(crate) fn big_rows_and_last<const D: usize>(sites: &[Site<D>]) -> (Rows, Vec<BigInt>) {
    let coordinates: Vec<f64> = sites.iter().flat_map(|site| site.0).collect();
    let weights: Vec<f64> = sites.iter().map(|site| site.1).collect();
    let mut scaled = on_one_scale(&coordinates, &weights);
    let rows = rows_of::<D>(&scaled);
    (rows, scaled.numbers.split_off(coordinates.len() - D))
}

fn rows_of<const D: usize>(Scaled { numbers, weights, scale }: &Scaled) -> Rows {
    let last = weights.len() - 1;
    let seen = |k: usize, axis: usize| &numbers[D * k + axis] - &numbers[D * last + axis];
    let rows: Vec<Vec<BigInt>> = (0..last).map(|k| (0..D).map(|axis| seen(k, axis)).collect()).collect();
    let lift = |k: usize| {
        let square: BigInt = rows[k].iter().map(|x| x * x).sum();
        square - (&weights[k] - &weights[last])
    };
    let lifts = (0..last).map(lift).collect();
    Rows { lifts, weight: weights[last].clone(), scale: *scale, differences: rows }
}

/// The point with the same power to three sites, correctly rounded; a coordinate that no `f64` can hold is infinite. None for
/// collinear points.
pub(crate) fn power_center(a: Site<2>, b: Site<2>, c: Site<2>) -> Option<[f64; 2]> {
    let coordinates = [b.0, c.0, a.0].concat();
    let scaled = on_one_scale(&coordinates, &[b.1, c.1, a.1]);
    let Rows { differences: rows, lifts, .. } = rows_of::<2>(&scaled);
    let ([b, c], [bb, cc]) = ([&rows[0], &rows[1]], [&lifts[0], &lifts[1]]);
    let denominator = (&b[0] * &c[1] - &b[1] * &c[0]) << 1;
    if denominator == BigInt::ZERO {
        return None;
    }
    let x = &scaled.numbers[4] * &denominator + (&c[1] * bb - &b[1] * cc);
    let y = &scaled.numbers[5] * &denominator + (&b[0] * cc - &c[0] * bb);
    Some([x, y].map(|numerator| big::quotient(&numerator, &denominator, scaled.scale)))
}

/// The sign of the determinant of the rows and their lifts.
#[cold]
fn big_determinant<const D: usize>(sites: &[Site<D>]) -> Sign {
    let Rows { differences: mut rows, lifts, .. } = big_rows(sites);
    rows.iter_mut().zip(lifts).for_each(|(row, lift)| row.push(lift));
    determinant(&rows.iter().map(Vec::as_slice).collect::<Vec<_>>()).sign()
}

#[cold]
fn big_interval(axis: usize, sites: &[Site<2>]) -> Sign {
    let Rows { differences: rows, lifts, .. } = big_rows(sites);
    let [u, v] = [&rows[0][axis], &rows[1][axis]];
    (&lifts[0] * v - &lifts[1] * u).sign() * Sign::of(v, u)
}

/// By its first column.
fn determinant(rows: &[&[BigInt]]) -> BigInt {
    if let [row] = rows {
        return row[0].clone();
    }
    let mut sum = BigInt::ZERO;
    for k in 0..rows.len() {
        let others: Vec<&[BigInt]> = (0..rows.len()).filter(|&i| i != k).map(|i| &rows[i][1..]).collect();
        let term = &rows[k][0] * determinant(&others);
        sum = if k % 2 == 0 { sum + term } else { sum - term };
    }
    sum
}
