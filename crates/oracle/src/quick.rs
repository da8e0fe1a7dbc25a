//! The definitions of [`crate::exact`] for millions of decisions: floating point where it is so far from wrong that no
//! careful bound is needed, big integers for the rest.

use crate::exact::{self, Point2};

/// Rounding errs by less than sixteen units of 2^-53 in either determinant; this is ninety.
const RELATIVE: f64 = 1e-14;

/// Whether products of four such numbers neither overflow nor lose digits.
fn is_moderate(numbers: &[f64]) -> bool {
    numbers.iter().all(|x| *x == 0.0 || (1e-70..1e70).contains(&x.abs()))
}

fn decided(value: f64, magnitude: f64, numbers: &[f64]) -> Option<i8> {
    (value.abs() > RELATIVE * magnitude && is_moderate(numbers)).then_some(if value > 0.0 { 1 } else { -1 })
}

/// As [`exact::orient2d`].
pub(crate) fn orient2d(a: Point2, b: Point2, c: Point2) -> i8 {
    let [u, v] = [a, b].map(|p| [p[0] - c[0], p[1] - c[1]]);
    let (left, right) = (u[0] * v[1], u[1] * v[0]);
    decided(left - right, left.abs() + right.abs(), &[u[0], u[1], v[0], v[1]])
        .unwrap_or_else(|| exact::orient2d(a, b, c))
}

/// As [`exact::in_circle`].
pub(crate) fn in_circle(a: Point2, b: Point2, c: Point2, d: Point2) -> i8 {
    let [u, v, w] = [a, b, c].map(|p| [p[0] - d[0], p[1] - d[1]]);
    let square = |p: [f64; 2]| p[0] * p[0] + p[1] * p[1];
    let terms = [(u, v, w), (v, w, u), (w, u, v)].map(|(p, q, r)| (square(p), q[0] * r[1], q[1] * r[0]));
    let value = terms.iter().map(|(lift, left, right)| lift * (left - right)).sum::<f64>();
    let magnitude = terms.iter().map(|(lift, left, right)| lift * (left.abs() + right.abs())).sum::<f64>();
    decided(value, magnitude, &[u[0], u[1], v[0], v[1], w[0], w[1]])
        .unwrap_or_else(|| exact::in_circle(a, b, c, d))
}

#[cfg(test)]
mod tests {
    use super::{in_circle, orient2d};
    use crate::exact;
    use crate::samples::Numbers;

    #[test]
    fn quick_is_exact() {
        let mut numbers = Numbers(3);
        for round in 0..40_000 {
            let mut coordinate = || match round % 4 {
                0 => numbers.below(5) as f64,
                1 => 0.1 * numbers.below(5) as f64,
                2 => f64::from_bits(1.0_f64.to_bits() + numbers.below(9) as u64) * 2_f64.powi(300),
                _ => numbers.below(9) as f64 * [1e-300, 1e-100, 1.0, 1e100, 1e150][numbers.below(5)],
            };
            let [a, b, c, d] = [(); 4].map(|()| [coordinate(), coordinate()]);
            assert_eq!(orient2d(a, b, c), exact::orient2d(a, b, c));
            assert_eq!(in_circle(a, b, c, d), exact::in_circle(a, b, c, d), "{:?}", [a, b, c, d]);
        }
    }
}
