//! The point with the same power to four sites by floating point, and one correction by what it misses.
//!
//! Seen from one corner, with sides u_i, the center x is where u_i x = (|u_i|^2 - w_i) / 2 with w_i the difference of weights. A solution q in
//! floating point misses these by r_i = u_i (u_i / 2 - q) - w_i / 2, which sums and products without error give to some hundred bits: off by at
//! most 256 u^2 of the size of its terms. The correction is the sum of r_i n_i / d, where n_i is the vector product of the other sides and d
//! the volume. It is so small that floating point is enough: n_i has four roundings, the sum four more, and d has eight.
//!
//! *Underflow.* Parts of sides are zero or from 2^-100 to 2^100. So products that are not zero are 2^-348 at least in a volume that passes, and
//! 2^-600 in a correction: nothing is lost there. Only the lower parts of sides and of weights may be, by less than 2^-1070 in r_i, which n_i / d
//! makes less than 2^-520 in the center. One floor covers it, so centers that near to zero are left to others.

use crate::ball::{Ball, U, two_product, two_sum};
use crate::{Point3, Site};

/// 2^-100 and 2^100: from the one to the other are the parts of sides, other than zeros, for which no product overflows or underflows.
const SIDES: [f64; 2] = [f64::from_bits((1023 - 100) << 52), f64::from_bits((1023 + 100) << 52)];
/// 2^-400: more than underflow can take from a coordinate of the center.
const FLOOR: f64 = f64::from_bits((1023 - 400) << 52);

#[inline]
fn dot(u: Point3, v: Point3) -> f64 {
    u[0] * v[0] + u[1] * v[1] + u[2] * v[2]
}

#[inline]
fn normal(u: Point3, v: Point3) -> (Point3, Point3) {
    let part = |i: usize, j: usize| {
        let (left, right) = (u[i] * v[j], u[j] * v[i]);
        (left - right, left.abs() + right.abs())
    };
    let [x, y, z] = [part(1, 2), part(2, 0), part(0, 1)];
    ([x.0, y.0, z.0], [x.1, y.1, z.1])
}

/// The part of a side and its rest that a solution misses, and by how much that may be off.
#[inline]
fn missed(u: Point3, low: Point3, q: Point3, weight: [f64; 2]) -> (f64, f64) {
    let (mut sum, mut rest, mut size) = (-0.5 * weight[0], -0.5 * weight[1], weight[0].abs());
    for k in 0..3 {
        let (beyond, of_beyond) = two_sum(0.5 * u[k], -q[k]);
        let (product, of_product) = two_product(u[k], beyond);
        let (more, of_more) = two_sum(sum, product);
        sum = more;
        rest += of_more + (of_product + (u[k] * of_beyond + low[k] * (u[k] - q[k])));
        size += u[k].abs() * (beyond.abs() + u[k].abs());
    }
    (sum + rest, 256.0 * U * U * size)
}

/// The coordinates of the center that this is enough to tell; `None` if the sites are too flat or too far from the range.
#[inline]
pub(super) fn center(sites: &[Site<3>; 4]) -> Option<[Option<f64>; 3]> {
    let (from, last) = sites[0];
    let seen = [1, 2, 3].map(|i| [0, 1, 2].map(|k| two_sum(sites[i].0[k], -from[k])));
    let (sides, rests) = (seen.map(|side| side.map(|x| x.0)), seen.map(|side| side.map(|x| x.1)));
    let weights = [1, 2, 3].map(|i| two_sum(sites[i].1, -last)).map(|(high, low)| [high, low]);
    let is_in_range = |x: &f64| *x == 0.0 || (SIDES[0]..=SIDES[1]).contains(&x.abs());
    if !sides.as_flattened().iter().all(is_in_range) {
        return None;
    }
    let [u, v, w] = sides;
    let normals = [normal(v, w), normal(w, u), normal(u, v)];
    let volume = dot(u, normals[0].0);
    let off = 16.0 * U * dot(u.map(f64::abs), normals[0].1);
    // Half of the volume is left after all errors, which is what the factor of two below is for.
    if volume.abs() <= 2.0 * off {
        return None;
    }
    let inverse = 1.0 / volume;
    let solved =
        |lifts: Point3| [0, 1, 2].map(|k| inverse * (0..3).map(|i| lifts[i] * normals[i].0[k]).sum::<f64>());
    let lifts = [0, 1, 2].map(|i| 0.5 * (dot(sides[i], sides[i]) - weights[i][0]));
    let q = solved(lifts);
    let misses = [0, 1, 2].map(|i| missed(sides[i], rests[i], q, weights[i]));
    let correction = solved(misses.map(|miss| miss.0));
    Some([0, 1, 2].map(|k| {
        let of_misses: f64 =
            (0..3).map(|i| normals[i].1[k] * (misses[i].1 + 16.0 * U * misses[i].0.abs())).sum();
        let radius = 2.0 * inverse.abs() * (of_misses + correction[k].abs() * off);
        let (high, low) = two_sum(from[k], q[k]);
        let rounded = 8.0 * U * (low.abs() + correction[k].abs()) + FLOOR;
        Ball { high, low: low + correction[k], radius: radius + rounded }.nearest()
    }))
}
