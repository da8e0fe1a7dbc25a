//! The plane: an edge has of its dual, in a triangle, half of the cotangent of the angle opposite to it.

use super::super::real::Real;
use super::{Local, Measure};

/// The error of a piece in units of the last place, of a triangle with these squared sides and twice this area: some rounded operations,
/// and what cancels in the area.
fn doubt(squares: f64, area: f64) -> f64 {
    8.0 + 4.0 * squares / area.abs()
}

pub(super) fn sum<R: Real>(local: &mut Local<R>, cavity: &[[u32; 4]], border: &[[u32; 3]], measure: Measure) {
    for &[v, w, _] in border {
        let [a, b] = [v, w].map(|k| local.at[k as usize]);
        let [ax, ay, bx, by] = [a[0], a[1], b[0], b[1]];
        let (dx, dy) = (bx - ax, by - ay);
        let area = ax * by - ay * bx;
        // Twice the cotangents times the area, at each end.
        let (at_a, at_b) = (R::default() - (ax * dx + ay * dy), bx * dx + by * dy);
        let (aa, bb, ab) = (ax * ax + ay * ay, bx * bx + by * by, ax * bx + ay * by);
        let doubt = doubt((aa + bb).value(), area.value());
        if measure == Measure::Laplace {
            local.add(v, at_b / area, doubt);
            local.add(w, at_a / area, doubt);
        } else {
            let between = (dx * dx + dy * dy) * ab;
            local.take(
                v,
                (between + aa * at_b) / area,
                doubt_of(between + aa * at_b, &[between, aa * at_b], doubt),
            );
            local.take(
                w,
                (between + bb * at_a) / area,
                doubt_of(between + bb * at_a, &[between, bb * at_a], doubt),
            );
        }
    }
    if measure == Measure::Laplace {
        return;
    }
    for &[i, j, k, _] in cavity {
        let corners = [i, j, k].map(|v| local.at[v as usize]);
        // sides[k] is opposite to corner k.
        let sides = [0, 1, 2].map(|k| {
            let (a, b) = (corners[(k + 1) % 3], corners[(k + 2) % 3]);
            [b[0] - a[0], b[1] - a[1]]
        });
        let area = sides[0][0] * sides[1][1] - sides[0][1] * sides[1][0];
        let squares = sides.map(|s| s[0] * s[0] + s[1] * s[1]);
        let doubt = doubt((squares[0] + squares[1]).value(), area.value());
        let pieces = [0, 1, 2].map(|k| {
            let (s, t) = (sides[(k + 1) % 3], sides[(k + 2) % 3]);
            R::default() - squares[k] * (s[0] * t[0] + s[1] * t[1])
        });
        for (corner, (one, other)) in [(i, (1, 2)), (j, (2, 0)), (k, (0, 1))] {
            let piece = pieces[one] + pieces[other];
            local.add(corner, piece / area, doubt_of(piece, &[pieces[one], pieces[other]], doubt));
        }
    }
}

/// The error of a sum in units of the last place of what is left of it.
fn doubt_of<R: Real>(sum: R, parts: &[R; 2], doubt: f64) -> f64 {
    let size = parts[0].value().abs() + parts[1].value().abs();
    let left = sum.value().abs();
    if size == 0.0 { doubt } else { doubt * size / left.max(size * f64::EPSILON) }
}
