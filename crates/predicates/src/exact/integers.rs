//! Exact signs in machine integers: coordinates scaled to a common power of two that fit 61 bits. They are scaled in floating
//! point, which is exact or is seen not to be, and tiny ones bit by bit.
//!
//! Differences then fit 62 bits and a sign, dot and cross products 125, and the in-circle determinant
//! compares two products of 250 bits.

use std::cmp::Ordering;

use super::{TINY, decode, to_integers};
use crate::Sign;

/// The coordinates as integers on a common scale, if they fit 61 bits.
#[inline]
fn align<const N: usize>(coordinates: &[f64; N]) -> Option<[i64; N]> {
    if coordinates.iter().any(|x| x.abs() > TINY) {
        return to_integers(coordinates, 61);
    }
    let mut aligned = [0; N];
    align_into(coordinates, &mut aligned)?;
    Some(aligned)
}

/// Aligns any number of coordinates of any size; zeros stay as they are.
pub(crate) fn align_into(coordinates: &[f64], aligned: &mut [i64]) -> Option<()> {
    let scale = coordinates.iter().map(|&x| decode(x).1).min().unwrap_or(0);
    for (out, &x) in aligned.iter_mut().zip(coordinates) {
        let (mantissa, exponent) = decode(x);
        if mantissa == 0 {
            continue;
        }
        let shift = (exponent - scale).unsigned_abs();
        let room = mantissa.unsigned_abs().leading_zeros(); // at least 11
        if shift + 3 > room {
            return None;
        }
        *out = mantissa << shift;
    }
    Some(())
}

/// Dot and cross product of q - l and q - r.
fn dot_cross(l: [i64; 2], r: [i64; 2], q: [i64; 2]) -> (i128, i128) {
    let [lx, ly] = [i128::from(q[0] - l[0]), i128::from(q[1] - l[1])];
    let [rx, ry] = [i128::from(q[0] - r[0]), i128::from(q[1] - r[1])];
    (lx * rx + ly * ry, lx * ry - ly * rx)
}

pub(super) fn orient2d(coordinates: &[f64; 6]) -> Option<Sign> {
    let [ax, ay, bx, by, cx, cy] = align(coordinates)?;
    let (_, cross) = dot_cross([ax, ay], [bx, by], [cx, cy]);
    Some(Sign::of(&cross, &0))
}

pub(super) fn in_circle(coordinates: &[f64; 8]) -> Option<Sign> {
    let [ax, ay, bx, by, cx, cy, dx, dy] = align(coordinates)?;
    let (dot_c, cross_c) = dot_cross([ax, ay], [bx, by], [cx, cy]);
    let (dot_d, cross_d) = dot_cross([ax, ay], [bx, by], [dx, dy]);
    Some(compare_products(dot_c, cross_d, dot_d, cross_c))
}

/// Points q, a, b: the distance of a from q against that of b.
pub(super) fn compare_distances(coordinates: &[f64; 6]) -> Option<Ordering> {
    let [qx, qy, ax, ay, bx, by] = align(coordinates)?;
    let (to_a, _) = dot_cross([qx, qy], [qx, qy], [ax, ay]);
    let (to_b, _) = dot_cross([qx, qy], [qx, qy], [bx, by]);
    Some(to_a.cmp(&to_b))
}

/// Points q, a, (radius, 0): the distance of a from q against the radius.
pub(super) fn compare_with_radius(coordinates: &[f64; 6]) -> Option<Ordering> {
    let [qx, qy, ax, ay, radius, _] = align(coordinates)?;
    let (to_a, _) = dot_cross([qx, qy], [qx, qy], [ax, ay]);
    Some(to_a.cmp(&(i128::from(radius) * i128::from(radius))))
}

/// Points a, b, o: the scalar product of a - o and b - o.
pub(super) fn angle(coordinates: &[f64; 6]) -> Option<Sign> {
    let [ax, ay, bx, by, ox, oy] = align(coordinates)?;
    let (dot, _) = dot_cross([ax, ay], [bx, by], [ox, oy]);
    Some(Sign::of(&dot, &0))
}

/// Points o, a, b, p: |a - o|^2 (b - o).(p - o) against |b - o|^2 (a - o).(p - o).
pub(super) fn center_side(coordinates: &[f64; 8]) -> Option<Sign> {
    let [ox, oy, ax, ay, bx, by, px, py] = align(coordinates)?;
    let (o, [u, v, w]) = ([ox, oy], [[ax, ay], [bx, by], [px, py]]);
    let dot = |p: [i64; 2], q: [i64; 2]| dot_cross(p, q, o).0;
    Some(compare_products(dot(u, u), dot(v, w), dot(v, v), dot(u, w)))
}

/// Points o, a, b: the same for the directions of the axes.
pub(super) fn center_direction(coordinates: &[f64; 6]) -> Option<[Sign; 2]> {
    let [ox, oy, ax, ay, bx, by] = align(coordinates)?;
    let (uu, _) = dot_cross([ax, ay], [ax, ay], [ox, oy]);
    let (vv, _) = dot_cross([bx, by], [bx, by], [ox, oy]);
    let along = |u: i64, v: i64| compare_products(uu, i128::from(v), vv, i128::from(u));
    Some([along(ay - oy, by - oy), along(ox - ax, ox - bx)])
}

/// The sign of a b - c d.
pub(super) fn compare_products(a: i128, b: i128, c: i128, d: i128) -> Sign {
    let sign = |x: i128, y: i128| Sign::of(&x, &0) * Sign::of(&y, &0);
    let (left, right) = (sign(a, b), sign(c, d));
    if left != right {
        return Sign::of(&left, &right);
    }
    let left_magnitude = wide_product(a.unsigned_abs(), b.unsigned_abs());
    let right_magnitude = wide_product(c.unsigned_abs(), d.unsigned_abs());
    left * Sign::of(&left_magnitude, &right_magnitude)
}

/// The 256-bit product, high half first, so that tuples compare as numbers.
fn wide_product(x: u128, y: u128) -> (u128, u128) {
    const LOW: u128 = u64::MAX as u128;
    let (x1, x0, y1, y0) = (x >> 64, x & LOW, y >> 64, y & LOW);
    let low = x0 * y0;
    let middle = x1 * y0 + (low >> 64); // at most (2^64 - 1)^2 + 2^64 - 1: fits
    let (carry, middle) = (middle >> 64, (middle & LOW) + x0 * y1);
    (x1 * y1 + carry + (middle >> 64), middle << 64 | low & LOW)
}

#[cfg(test)]
mod tests {
    use super::{align, align_into, wide_product};

    #[test]
    fn products_of_the_largest_factors() {
        assert_eq!(wide_product(u128::MAX, u128::MAX), (u128::MAX - 1, 1));
        assert_eq!(wide_product(1 << 127, 6), (3, 0));
        assert_eq!(wide_product(u128::from(u64::MAX), u128::from(u64::MAX)).0, 0);
    }

    #[test]
    fn products_of_all_factors_where_carries_are() {
        use num_bigint::BigUint;
        let edges = (0..128).flat_map(|k| [1_u128 << k, (1 << k) - 1, !0 << k, (!0 << k) ^ 1 << 63]);
        let factors: Vec<u128> = edges.chain([u128::MAX / 3, u128::MAX / 5]).collect();
        for &x in &factors {
            for &y in &factors {
                let (high, low) = wide_product(x, y);
                assert_eq!((BigUint::from(high) << 128) + low, BigUint::from(x) * y, "{x} {y}");
            }
        }
    }

    #[test]
    fn aligning_refuses_more_than_61_bits() {
        assert_eq!(align(&[1.0, 2f64.powi(60)]), Some([1, 1 << 60]));
        assert_eq!(align(&[1.0, 2f64.powi(61)]), None);
        assert_eq!(align(&[0.0, 1e300]).map(|x| x[0]), Some(0));
        assert_eq!(align(&[0.5, -0.75]), Some([2, -3].map(|x| x << 59)));
        assert_eq!(align(&[1e-300, 1e300]), None);
        assert_eq!(align(&[0.0; 2]), Some([0; 2]));
    }

    #[test]
    fn both_ways_of_aligning_agree() {
        let mut random = delone_generators::Random::new(5);
        let mut fit = [0; 2];
        for _ in 0..20_000 {
            let numbers: [f64; 4] = std::array::from_fn(|_| {
                let size = 2f64.powi(random.below(12) as i32 - if random.below(9) == 0 { 1074 } else { 1 });
                [-0.0, size, random.between(-2.0, 2.0) * size][random.below(30).min(2)]
            });
            let mut aligned = [0; 4];
            let general = align_into(&numbers, &mut aligned).map(|()| aligned);
            // On scales that differ by a power of two.
            let odd = |x: [i64; 4]| {
                let shift = x.iter().map(|x| x.trailing_zeros()).min().unwrap_or(0);
                x.map(|x| x.checked_shr(shift).unwrap_or(0))
            };
            assert_eq!(align(&numbers).map(odd), general.map(odd), "{numbers:?}");
            fit[usize::from(general.is_some())] += 1;
        }
        assert!(fit.iter().all(|&fit| fit > 1000), "{fit:?}");
    }
}
