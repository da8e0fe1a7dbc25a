//! The plane: an edge has of its dual, in a triangle, half of the cotangent of the angle opposite to it.

use super::super::real::Real;
use super::{Local, Measure};

/// The error of a quotient in units of the last place of what it is made of, of a triangle with these squared sides and one over twice its
/// area: some rounded operations, and what cancels in the area.
fn doubt(squares: f64, over: f64) -> f64 {
    8.0 + 4.0 * squares * over.abs()
}

pub(super) fn sum<R: Real>(local: &mut Local<R>, cavity: &[[u32; 4]], border: &[[u32; 3]], measure: Measure) {
    let one = R::difference(1.0, 0.0, 1.0);
    for &[v, w, _] in border {
        let [a, b] = [v, w].map(|k| local.at[k as usize]);
        let [ax, ay, bx, by] = [a[0], a[1], b[0], b[1]];
        let (dx, dy) = (bx - ax, by - ay);
        let over = one / (ax * by - ay * bx);
        // The cotangents times the area, at each end.
        let (at_a, at_b) = (R::default() - (ax * dx + ay * dy), bx * dx + by * dy);
        let (aa, bb) = (ax * ax + ay * ay, bx * bx + by * by);
        let doubt = doubt((aa + bb).value(), over.value());
        if measure == Measure::Laplace {
            local.add(v, [at_b], over, doubt);
            local.add(w, [at_a], over, doubt);
        } else {
            let between = R::default() - (dx * dx + dy * dy) * (ax * bx + ay * by);
            local.add(v, [between, R::default() - aa * at_b], over, doubt);
            local.add(w, [between, R::default() - bb * at_a], over, doubt);
        }
    }
    if measure == Measure::Laplace {
        return;
    }
    for &[i, j, k, _] in cavity {
        let [a, b, c] = [i, j, k].map(|v| local.at[v as usize]);
        // Each side is opposite to its corner.
        let sides = [[c[0] - b[0], c[1] - b[1]], [a[0] - c[0], a[1] - c[1]], [b[0] - a[0], b[1] - a[1]]];
        let over = one / (sides[0][0] * sides[1][1] - sides[0][1] * sides[1][0]);
        let squares = sides.map(|s| s[0] * s[0] + s[1] * s[1]);
        let doubt = doubt((squares[0] + squares[1]).value(), over.value());
        let dot = |s: [R; 2], t: [R; 2]| s[0] * t[0] + s[1] * t[1];
        let [p, q, r] = [(0, 1, 2), (1, 2, 0), (2, 0, 1)]
            .map(|(own, one, other)| R::default() - squares[own] * dot(sides[one], sides[other]));
        local.add(i, [q, r], over, doubt);
        local.add(j, [r, p], over, doubt);
        local.add(k, [p, q], over, doubt);
    }
}
