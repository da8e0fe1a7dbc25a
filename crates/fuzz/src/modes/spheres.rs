//! Spheres that keep clear of boxes, by rational numbers: numerators over one common denominator.

use delone_predicates::keeps_clear;
use num_bigint::BigInt;

use super::predicates::Judge;
use crate::oracle::exact::{Vector, cofactors, determinant, dot, integers, minus, sign};

/// Whether a sphere that is said to keep clear of a box does.
pub(crate) fn judge_clear(corners: [[f64; 3]; 4], low: [f64; 3], high: [f64; 3], judge: &mut Judge) {
    if keeps_clear(corners, low, high) && !is_clear(corners, low, high) {
        judge.equal(&format!("keeps_clear of the box from {low:?} to {high:?}"), true, false);
    }
}

fn is_clear([a, b, c, d]: [[f64; 3]; 4], low: [f64; 3], high: [f64; 3]) -> bool {
    let exact = integers(&[a, b, c, d, low, high]);
    let [u, v, w, low, high] = [1, 2, 3, 4, 5].map(|i| minus(&exact[i], &exact[0]));
    // The center x, relative to a, has u.x = |u|^2 / 2 and so on: x = numerators / denominator.
    let denominator: BigInt = determinant(&[u.clone(), v.clone(), w.clone()]) * 2;
    if sign(&denominator) == 0 {
        return false;
    }
    let [vw, wu, uv] = [[&v, &w], [&w, &u], [&u, &v]].map(|rows| cofactors(&rows.map(Vector::clone)));
    let (uu, vv, ww) = (dot(&u, &u), dot(&v, &v), dot(&w, &w));
    let flip = BigInt::from(sign(&denominator));
    let numerator = |k: usize| (&uu * &vw[k] + &vv * &wu[k] + &ww * &uv[k]) * &flip;
    let denominator = denominator * &flip;
    let center: Vector = (0..3).map(numerator).collect();
    let beside = |k: usize| {
        let below = &low[k] * &denominator - &center[k];
        let above = &center[k] - &high[k] * &denominator;
        below.max(above).max(BigInt::ZERO)
    };
    let distance: BigInt = (0..3).map(|k| beside(k).pow(2)).sum();
    distance > dot(&center, &center)
}

#[cfg(test)]
mod tests {
    use super::is_clear;

    #[test]
    fn touching_is_not_clear() {
        // The sphere around (1/2, 1/2, 1/2) through the corners of the unit cube, and boxes beside it.
        let corners = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        assert!(!is_clear(corners, [1.0; 3], [2.0; 3]));
        assert!(is_clear(corners, [1.0_f64.next_up(); 3], [2.0; 3]));
        assert!(!is_clear(corners, [0.4; 3], [0.5; 3]));
        let turned = [corners[0], corners[2], corners[1], corners[3]];
        assert!(is_clear(turned, [-2.0; 3], [-5e-324; 3]));
        assert!(!is_clear(turned, [-2.0; 3], [0.0; 3]));
    }
}
