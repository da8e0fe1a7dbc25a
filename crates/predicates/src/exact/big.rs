//! Exact signs in arbitrary precision: the last resort, for tuples that span hundreds of binary orders.

use std::cmp::Ordering;

use num_bigint::{BigInt, Sign as BigSign};

use super::decode;
use crate::Sign;

type Vector = [BigInt; 2];

/// The points as big integers on their common scale.
fn align<const N: usize>(coordinates: &[f64; N]) -> Vec<Vector> {
    let parts = coordinates.map(decode);
    let scale = parts.iter().map(|part| part.1).min().unwrap_or(0);
    let integer = |(mantissa, exponent): (i64, i32)| match mantissa {
        0 => BigInt::ZERO,
        _ => BigInt::from(mantissa) << (exponent - scale).unsigned_abs(),
    };
    parts.chunks_exact(2).map(|xy| [integer(xy[0]), integer(xy[1])]).collect()
}

fn difference(q: &Vector, p: &Vector) -> Vector {
    [&q[0] - &p[0], &q[1] - &p[1]]
}

fn dot(u: &Vector, v: &Vector) -> BigInt {
    &u[0] * &v[0] + &u[1] * &v[1]
}

fn cross(u: &Vector, v: &Vector) -> BigInt {
    &u[0] * &v[1] - &u[1] * &v[0]
}

fn sign(value: &BigInt) -> Sign {
    match value.sign() {
        BigSign::Minus => Sign::Negative,
        BigSign::NoSign => Sign::Zero,
        BigSign::Plus => Sign::Positive,
    }
}

pub(super) fn orient2d(coordinates: &[f64; 6]) -> Sign {
    let p = align(coordinates);
    sign(&cross(&difference(&p[2], &p[0]), &difference(&p[2], &p[1])))
}

pub(super) fn in_circle(coordinates: &[f64; 8]) -> Sign {
    let p = align(coordinates);
    let (ca, cb) = (difference(&p[2], &p[0]), difference(&p[2], &p[1]));
    let (da, db) = (difference(&p[3], &p[0]), difference(&p[3], &p[1]));
    sign(&(dot(&ca, &cb) * cross(&da, &db) - dot(&da, &db) * cross(&ca, &cb)))
}

fn squared(q: &Vector, p: &Vector) -> BigInt {
    let d = difference(q, p);
    dot(&d, &d)
}

pub(super) fn compare_distances(coordinates: &[f64; 6]) -> Ordering {
    let p = align(coordinates);
    squared(&p[0], &p[1]).cmp(&squared(&p[0], &p[2]))
}

pub(super) fn compare_with_radius(coordinates: &[f64; 6]) -> Ordering {
    let p = align(coordinates);
    squared(&p[0], &p[1]).cmp(&dot(&p[2], &p[2]))
}

pub(super) fn angle(coordinates: &[f64; 6]) -> Sign {
    let p = align(coordinates);
    sign(&dot(&difference(&p[2], &p[0]), &difference(&p[2], &p[1])))
}
