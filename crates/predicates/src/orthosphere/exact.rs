//! The exact stage: integers of a few words where coordinates fit 60 bits and weights the square of that, big integers for
//! the rest, and for radii.
//!
//! Differences take 61 bits and a sign, lifts 125, minors 123; |n|^2 248, (h v - k u) 188 and n x q 186: degree six takes 375 bits.

use super::Side;
use super::fraction::{length, normal, smallest};
use crate::ball::Number;
use crate::exact::big;
use crate::exact::big_int::BigInt;
use crate::exact::power::{Rows, big_rows, rows};
use crate::exact::wide::Wide;
use crate::{Sign, Site};

impl Number for BigInt {
    fn plus(&self, other: &Self) -> Self {
        self + other
    }

    fn minus(&self, other: &Self) -> Self {
        self - other
    }

    fn times(&self, other: &Self) -> Self {
        self * other
    }
}

fn product(x: i64, y: i64) -> i128 {
    i128::from(x) * i128::from(y)
}

fn inner<const D: usize>(u: &[i64; D], v: &[i64; D]) -> i128 {
    (0..D).map(|axis| product(u[axis], v[axis])).sum()
}

fn big_inner(u: &[BigInt], v: &[BigInt]) -> BigInt {
    u.iter().zip(v).map(|(x, y)| x * y).sum()
}

/// (a - q) . (b - q).
#[cold]
pub(super) fn angle<const D: usize>(a: [f64; D], b: [f64; D], q: [f64; D]) -> Side {
    let sites = [a, b, q].map(|p| (p, 0.0));
    if let Some(([a, b], _)) = rows::<D, 3, 2>(&sites) {
        return Sign::of(&inner(&a, &b), &0);
    }
    let Rows { differences: rows, .. } = big_rows(&sites);
    big_inner(&rows[0], &rows[1]).sign()
}

/// h_q |u|^2 - h (q . u) of a, q, b, seen from b.
#[cold]
pub(super) fn edge<const D: usize>(sites: [Site<D>; 3]) -> Side {
    if let Some(([u, q], [h, hq])) = rows::<D, 3, 2>(&sites) {
        let term = |lift: i128, inner: i128| -> Wide<4> { Wide::from(lift).times(Wide::from(inner)) };
        return term(hq, inner(&u, &u)).minus(term(h, inner(&q, &u))).sign();
    }
    let Rows { differences: rows, lifts, .. } = big_rows(&sites);
    let [u, q] = [&rows[0], &rows[1]];
    (&lifts[1] * length(u) - &lifts[0] * big_inner(q, u)).sign()
}

/// h_q |n|^2 - (h v - k u) . (n x q) of a, b, q, c, seen from c.
#[cold]
pub(super) fn triangle(sites: [Site<3>; 4]) -> Side {
    if let Some(([u, v, q], [h, k, hq])) = rows::<3, 4, 3>(&sites) {
        const NEXT: [[usize; 2]; 3] = [[1, 2], [2, 0], [0, 1]];
        let n = NEXT.map(|[i, j]| product(u[i], v[j]) - product(u[j], v[i])).map(Wide::from);
        let words = |x: i64| Wide::from(x);
        let wide = |lift: i128, x: i64| -> Wide<3> { Wide::from(lift).times(words(x)) };
        let mut sum: Wide<6> = Wide::from(hq).times(Wide::<4>::sum_of_squares(n));
        for axis in 0..3 {
            let [i, j] = NEXT[axis];
            let t = wide(h, v[axis]).minus(wide(k, u[axis]));
            let side = n[i].times::<1, 3>(words(q[j])).minus(n[j].times(words(q[i])));
            sum = sum.minus(t.times(side));
        }
        return sum.sign();
    }
    let Rows { differences: rows, lifts, .. } = big_rows(&sites);
    let [u, v, q] = [&rows[0], &rows[1], &rows[2]];
    let n = normal(u, v);
    let t: Vec<BigInt> = (0..3).map(|axis| &lifts[0] * &v[axis] - &lifts[1] * &u[axis]).collect();
    (&lifts[2] * length(&n) - big_inner(&t, &normal(&n, q))).sign()
}

/// The squared radius, rounded once; infinite for points that are no simplex.
#[cold]
#[inline(never)]
pub(super) fn radius<const D: usize, const N: usize>(sites: &[Site<D>; N]) -> f64 {
    let Rows { differences: rows, lifts, weight, scale } = big_rows(sites);
    let fraction = smallest::<_, D, N>(|i, axis| rows[i][axis].clone(), |i, _| lifts[i].clone());
    let denominator = fraction.denominator << 2;
    if denominator == BigInt::ZERO {
        return f64::INFINITY;
    }
    big::quotient(&(fraction.numerator - weight * &denominator), &denominator, 2 * scale)
}
