//! The nearest point of an edge or a triangle, rounded.
//!
//! Source: Ericson, "Real-time collision detection", 2005, section 5.1. Cost: O(1).

pub(crate) fn minus(p: [f64; 3], q: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|k| p[k] - q[k])
}

pub(crate) fn dot(p: [f64; 3], q: [f64; 3]) -> f64 {
    p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
}

pub(crate) fn cross(p: [f64; 3], q: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|k| p[(k + 1) % 3] * q[(k + 2) % 3] - p[(k + 2) % 3] * q[(k + 1) % 3])
}

/// The distance of a point from an edge or a triangle: that of a point on it, which is the nearest but for rounding. Coordinates whose squares
/// are in the range of numbers. Cost: O(1).
pub(crate) fn distance<const N: usize>(q: [f64; 3], corners: [[f64; 3]; N]) -> f64 {
    let local = corners.map(|p| minus(p, q));
    let weights = match local[..] {
        [a, b] => on_edge(a, b),
        [a, b, c] => on_triangle(a, b, c),
        _ => [1.0, 0.0, 0.0],
    };
    let miss = [0, 1, 2].map(|k| local.iter().zip(weights).map(|(p, weight)| weight * p[k]).sum::<f64>());
    dot(miss, miss).sqrt()
}

/// The error of [`distance`], relative to the largest difference of coordinates: differences, weights and their sums are rounded, each by half
/// a last place, at most eleven in all.
const ROUNDING: f64 = 6.0 * f64::EPSILON;

/// Its error where squares underflow.
const UNDERFLOW: f64 = 1e-150;

/// A bound of the distance of a point from an edge or a triangle: not below it, and above it by rounding alone.
pub(crate) fn distance_bound<const N: usize>(q: [f64; 3], corners: [[f64; 3]; N]) -> f64 {
    let size = corners.iter().flat_map(|&p| minus(p, q)).fold(0.0, |most: f64, x| most.max(x.abs()));
    distance(q, corners) * (1.0 + ROUNDING) + ROUNDING * size + UNDERFLOW
}

/// The weights of the nearest point of an edge, seen from the point that it is nearest to.
pub(crate) fn on_edge(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    let along = minus(b, a);
    let part = (-dot(a, along) / dot(along, along)).clamp(0.0, 1.0);
    if part.is_nan() { [1.0, 0.0, 0.0] } else { [1.0 - part, part, 0.0] }
}

/// A triangle is a needle if the square of its height over a side is below this part of the square of the other one.
const NEEDLE: f64 = 1.0 / 64.0;

/// The weights of the nearest point of a triangle, seen from the point that it is nearest to.
pub(crate) fn on_triangle(a: [f64; 3], b: [f64; 3], c: [f64; 3]) -> [f64; 3] {
    let (u, v) = (minus(b, a), minus(c, a));
    let [uu, uv, vv] = [dot(u, u), dot(u, v), dot(v, v)];
    let whole = uu * vv - uv * uv;
    let inside = if whole > NEEDLE * (uu * vv) {
        let [of_u, of_v] = [-dot(a, u), -dot(a, v)];
        [(of_u * vv - of_v * uv) / whole, (of_v * uu - of_u * uv) / whole]
    } else {
        // From the end of the longest side, which comes first.
        let w = minus(c, b);
        let ww = dot(w, w);
        if uu >= vv && uu >= ww {
            on_needle(a, u, v)
        } else if vv >= ww {
            let [s, t] = on_needle(c, minus(a, c), minus(b, c));
            [t, 1.0 - s - t]
        } else {
            let [s, t] = on_needle(b, w, minus(a, b));
            [1.0 - s - t, s]
        }
    };
    let [s, t] = inside;
    if s >= 0.0 && t >= 0.0 && s + t <= 1.0 {
        return [1.0 - s - t, s, t];
    }
    // On a side then, or the triangle is flat to rounding.
    let sides = [(0, on_edge(a, b)), (1, on_edge(b, c)), (2, on_edge(c, a))].map(|(k, [x, y, _])| match k {
        0 => [x, y, 0.0],
        1 => [0.0, x, y],
        _ => [y, 0.0, x],
    });
    let distance = |weights: &[f64; 3]| {
        let miss = [0, 1, 2].map(|k| weights[0] * a[k] + weights[1] * b[k] + weights[2] * c[k]);
        dot(miss, miss)
    };
    sides.into_iter().min_by(|x, y| distance(x).total_cmp(&distance(y))).unwrap_or(sides[0])
}

/// The weights of two sides that lead to the point of their plane that is nearest to the origin, from a corner; the first is the longest one.
///
/// The normal equations lose twice the bits that the angle has lost, so that the point moves along a needle. Here the second side is made
/// upright to the first, and the weights are found one by one, twice: the point is off by last places of the longest side.
fn on_needle(a: [f64; 3], u: [f64; 3], v: [f64; 3]) -> [f64; 2] {
    let uu = dot(u, u);
    let upright = |p: [f64; 3]| {
        let part = dot(p, u) / uu;
        [0, 1, 2].map(|k| p[k] - part * u[k])
    };
    let up = upright(upright(v));
    let (mut s, mut t) = (0.0, 0.0);
    for _ in 0..2 {
        let at = [0, 1, 2].map(|k| a[k] + s * u[k] + t * v[k]);
        t -= dot(upright(at), up) / dot(up, up);
        let at = [0, 1, 2].map(|k| a[k] + s * u[k] + t * v[k]);
        s -= dot(at, u) / uu;
    }
    [s, t]
}

#[cfg(test)]
mod tests {
    use super::{distance, distance_bound};

    /// Needles in many directions, with a point above a place inside of each: the distance is the height.
    #[test]
    fn heights_over_needles_are_found_to_last_places() {
        let mut most = 0.0_f64;
        for turn in 0..40 {
            let (s, c) = (0.37 * f64::from(turn)).sin_cos();
            let (x, y) = ([0.6 * c, 0.8 * c, s], [-0.8, 0.6, 0.0]);
            let z = super::cross(x, y);
            let at = |p: f64, q: f64, r: f64| [0, 1, 2].map(|k| p * x[k] + q * y[k] + r * z[k]);
            for (width, height) in
                (0..14).flat_map(|w| (1..15).map(move |h| (10f64.powi(-w), 10f64.powi(-h))))
            {
                for apex in [-1.0, -0.3, 0.999, 1.0] {
                    let corners = [at(-1.0, 0.0, 0.0), at(1.0, 0.0, 0.0), at(apex, width, 0.0)];
                    // Inside, as a blend of the corners.
                    let q = at(-0.2 + 0.3 * apex, 0.3 * width, height);
                    for first in 0..3 {
                        let mut corners = corners;
                        corners.rotate_left(first);
                        let found = distance(q, corners);
                        most = most.max((found - height).abs());
                        assert!(height <= distance_bound(q, corners) + 1e-15, "{width} {height}");
                    }
                }
            }
        }
        assert!(most < 4e-15, "{most}");
    }
}
