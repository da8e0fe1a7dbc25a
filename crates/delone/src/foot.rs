//! The nearest point of an edge or a triangle, rounded.
//!
//! Source: Ericson, "Real-time collision detection", 2005, section 5.1. Cost: O(1).

pub(crate) fn minus(p: [f64; 3], q: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|k| p[k] - q[k])
}

pub(crate) fn dot(p: [f64; 3], q: [f64; 3]) -> f64 {
    p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
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

/// The weights of the nearest point of an edge, seen from the point that it is nearest to.
pub(crate) fn on_edge(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    let along = minus(b, a);
    let part = (-dot(a, along) / dot(along, along)).clamp(0.0, 1.0);
    if part.is_nan() { [1.0, 0.0, 0.0] } else { [1.0 - part, part, 0.0] }
}

/// The weights of the nearest point of a triangle, seen from the point that it is nearest to.
pub(crate) fn on_triangle(a: [f64; 3], b: [f64; 3], c: [f64; 3]) -> [f64; 3] {
    let (u, v) = (minus(b, a), minus(c, a));
    let [uu, uv, vv] = [dot(u, u), dot(u, v), dot(v, v)];
    let [of_u, of_v] = [-dot(a, u), -dot(a, v)];
    let whole = uu * vv - uv * uv;
    let (s, t) = ((of_u * vv - of_v * uv) / whole, (of_v * uu - of_u * uv) / whole);
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
