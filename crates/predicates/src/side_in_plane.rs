//! Sides of a line in the plane of a triangle of space: filter, exact. Degree four, without perturbation: zero is an answer.

use crate::{Point3, Sign, exact};

/// The products of two sums of three products of rounded differences: fourteen roundings, and room for those of the sizes.
const ERROR: f64 = 20.0 * (f64::EPSILON / 2.0);
/// The largest of these sums for which [`FLOOR`] is valid: 2^500.
const CEILING: f64 = f64::from_bits((1023 + 500) << 52);
/// All errors by underflow: each of twenty roundings is off by at most 2^-1075 and multiplied by at most 2^500.
const FLOOR: f64 = f64::from_bits((1023 - 560) << 52);

/// On which side of the line through `a` and `b`, in the plane of `a`, `b` and `c`, is the point of the plane that is nearest to `q`: positive
/// where `c` is. Zero too if the three are collinear.
///
/// Exact for every finite input. O(1).
///
/// ```
/// use delone_predicates::{Sign, side_in_plane};
/// let (a, b, c) = ([0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
/// assert_eq!(side_in_plane(a, b, c, [9.0, 2.0, 5.0]), Sign::Positive);
/// assert_eq!(side_in_plane(a, b, c, [0.5, -1e-9, 5.0]), Sign::Negative);
/// assert_eq!(side_in_plane(a, b, c, [0.5, 0.0, 5.0]), Sign::Zero);
/// ```
pub fn side_in_plane(a: Point3, b: Point3, c: Point3, q: Point3) -> Sign {
    let [u, v, w] = [b, c, q].map(|p| [0, 1, 2].map(|k| p[k] - a[k]));
    let dot = |u: Point3, v: Point3| {
        let products = [0, 1, 2].map(|k| u[k] * v[k]);
        (products.iter().sum::<f64>(), products.iter().map(|x| x.abs()).sum::<f64>())
    };
    let [(uu, size_uu), (vw, size_vw), (uv, size_uv), (uw, size_uw)] =
        [dot(u, u), dot(v, w), dot(u, v), dot(u, w)];
    let value = uu * vw - uv * uw;
    let bound = ERROR * (size_uu * size_vw + size_uv * size_uw) + FLOOR;
    if size_uu + size_vw + size_uv + size_uw < CEILING && value.abs() > bound {
        Sign::of(&value, &0.0)
    } else {
        exact::side_in_plane(a, b, c, q)
    }
}

#[cfg(test)]
mod tests {
    use delone_generators::Random;
    use num_bigint::BigInt;

    use super::side_in_plane;
    use crate::{Point3, Sign};

    /// Coordinates times 2^1074 are integers.
    fn by_definition(points: [Point3; 4]) -> Sign {
        let integer = |x: f64| {
            let bits = x.to_bits();
            let exponent = (bits >> 52 & 0x7ff).max(1);
            let digits = bits & ((1 << 52) - 1) | u64::from(bits >> 52 & 0x7ff != 0) << 52;
            let magnitude = BigInt::from(digits) << (exponent - 1);
            if x < 0.0 { -magnitude } else { magnitude }
        };
        let [a, b, c, q] = points.map(|p| p.map(integer));
        let [u, v, w] = [b, c, q].map(|p| [0, 1, 2].map(|k| &p[k] - &a[k]));
        let cross = |u: &[BigInt; 3], v: &[BigInt; 3]| {
            [0, 1, 2].map(|k| {
                let (i, j) = ((k + 1) % 3, (k + 2) % 3);
                &u[i] * &v[j] - &u[j] * &v[i]
            })
        };
        // The normal of the triangle is turned into its plane, towards c.
        let across = cross(&cross(&u, &v), &u);
        let side: BigInt = (0..3).map(|k| &across[k] * &w[k]).sum();
        Sign::of(&side, &BigInt::ZERO)
    }

    #[test]
    fn all_sizes_by_definition() {
        let mut random = Random::new(3);
        let mut found = [0; 3];
        for round in 0..20_000 {
            let size = [1.0, 1e-200, 1e200, 1e-320, 1e-40][round % 5];
            let mut coordinate = || match round / 5 % 4 {
                0 => random.between(-1.0, 1.0) * size,
                1 => (random.below(5) as f64 - 2.0) * size,
                2 => (1.0 + random.below(3) as f64 * f64::EPSILON) * size,
                _ => random.between(-1.0, 1.0) * 10f64.powi(random.below(600) as i32 - 300),
            };
            let points = [(); 4].map(|()| [(); 3].map(|()| coordinate()));
            let [a, b, c, q] = points;
            let side = side_in_plane(a, b, c, q);
            assert_eq!(side, by_definition(points), "{points:?}");
            found[(side as i8 + 1) as usize] += 1;
        }
        assert!(found.iter().all(|&found| found > 1000), "{found:?}");
    }
}
