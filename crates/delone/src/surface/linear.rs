//! Linear weights: barycentric coordinates in the smallest face that holds a point.
//!
//! Each is the area of what the point spans with the other corners, of the sum of all, so weights are not negative and their sum is one even
//! in a face whose area is rounded to nothing. Cost: O(1).

use super::real::{Double, Real, cross, dot, minus};
use crate::ids::VertexId;
use crate::triangulation::Coordinates;

/// Errors up to this part of the sum are taken for none: 2^-40.
const GOOD: f64 = 9.094_947_017_729_282e-13;

/// The weights of the corners of a face, given with their points.
pub(super) fn weigh<P: Coordinates>(q: P, corners: &[(VertexId, P)], weights: &mut Vec<(VertexId, f64)>) {
    weights.clear();
    let (q, count) = (super::natural::three(q), corners.len());
    let mut points = [[0.0; 3]; 4];
    for (point, corner) in points.iter_mut().zip(corners) {
        *point = super::natural::three(corner.1);
    }
    let size =
        |k: usize| points[..count].iter().fold(0.0, |most, p| super::natural::apart(p[k], q[k]).max(most));
    let sizes = [size(0), size(1), size(2)];
    // Of a whole triangle or tetrahedron each axis may have a scale of its own; on what is less, lengths along axes are compared.
    let is_whole = count == P::COUNT + 1;
    let common = sizes.into_iter().fold(0.0, f64::max);
    let scale = sizes.map(|size| super::natural::scale(if is_whole { size } else { common }));
    let (shares, doubt) = shares::<f64>(P::COUNT, q, &points[..count], scale);
    let total: f64 = shares[..count].iter().sum();
    let is_good = total > 0.0 && doubt * f64::EPSILON <= GOOD * total;
    let shares = if is_good { shares } else { shares_in_double(P::COUNT, q, &points[..count], scale) };
    weights.extend(corners.iter().zip(shares).map(|(corner, share)| (corner.0, share)));
    if !super::natural::normalize(weights) {
        // All corners are the same but for what numbers can tell.
        weights.iter_mut().for_each(|weight| weight.1 = 1.0 / count as f64);
    }
}

#[cold]
fn shares_in_double(dimension: usize, q: [f64; 3], points: &[[f64; 3]], scale: [[f64; 2]; 3]) -> [f64; 4] {
    shares::<Double>(dimension, q, points, scale).0.map(Real::value)
}

/// The weight of each corner, and a bound of the error of their sum in units of the last place.
fn shares<R: Real>(
    dimension: usize,
    q: [f64; 3],
    points: &[[f64; 3]],
    scale: [[f64; 2]; 3],
) -> ([R; 4], f64) {
    let zero = R::default();
    let mut at = [[zero; 3]; 4];
    for (local, p) in at.iter_mut().zip(points) {
        *local = [0, 1, 2].map(|k| {
            let [before, after] = scale[k];
            R::difference(p[k] * before, q[k] * before, after)
        });
    }
    // Corners come in any orientation.
    let sign = |whole: f64| R::difference(if whole < 0.0 { -1.0 } else { 1.0 }, 0.0, 1.0);
    let squares: f64 = at[..points.len()].iter().map(|&a| dot(a, a).value()).sum();
    let [a, b, c, d] = at;
    match points.len() {
        2 => {
            let along = minus(b, a);
            ([dot(b, along), zero - dot(a, along), zero, zero], 8.0 * squares)
        }
        3 if dimension == 2 => {
            let area = |u: [R; 3], v: [R; 3]| u[0] * v[1] - u[1] * v[0];
            let sign = sign(area(minus(b, a), minus(c, a)).value());
            ([area(b, c) * sign, area(c, a) * sign, area(a, b) * sign, zero], 8.0 * squares)
        }
        3 => {
            let normal = cross(minus(b, a), minus(c, a));
            let share = |u, v| dot(cross(u, v), normal);
            let size = dot(normal, normal).value().sqrt();
            ([share(b, c), share(c, a), share(a, b), zero], 16.0 * squares * size)
        }
        4 => {
            let volume = |u, v, w| dot(u, cross(v, w));
            let sign = sign(volume(minus(a, d), minus(b, d), minus(c, d)).value());
            let shares = [zero - volume(b, c, d), volume(a, c, d), zero - volume(a, b, d), volume(a, b, c)];
            (shares.map(|share| share * sign), 16.0 * squares * squares.sqrt())
        }
        _ => ([R::difference(1.0, 0.0, 1.0), zero, zero, zero], 0.0),
    }
}
