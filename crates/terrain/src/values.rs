//! Values, such as heights, of points that were added: where segments crossed, or by refinement.
//!
//! O(1) for each vertex on a segment.

use std::collections::BTreeMap;

use delone::Constrained2;
use delone::surface::{Duplicates, Several};

/// The values of all points, rows of `width` of them: those given for the first points, and for points that were added on
/// segments what these have there, linear between the given points; where segments differ, the mean. How far they differ
/// from the first at most comes too. `free` says what other points have; of what it does not know, 0.
pub fn extended(
    c: &Constrained2,
    width: usize,
    given: &[f64],
    free: impl Fn([f64; 2]) -> Option<Vec<f64>>,
) -> (Vec<f64>, f64) {
    let known = given.len().checked_div(width).unwrap_or_default();
    let mut values = given.to_vec();
    values.resize(c.points().len() * width, 0.0);
    let mut has_value = vec![false; c.points().len() - known];
    let mut means: BTreeMap<usize, Several> = BTreeMap::new();
    let mut widest = 0.0_f64;
    for (s, _) in c.segments() {
        let chain = c.chain(s).unwrap_or_default();
        let old: Vec<usize> = (0..chain.len()).filter(|&k| chain[k].index() < known).collect();
        for piece in old.windows(2).filter(|piece| piece[1] > piece[0] + 1) {
            let [first, last] = [chain[piece[0]], chain[piece[1]]];
            let (p, q) = (c.point(first), c.point(last));
            for v in &chain[piece[0] + 1..piece[1]] {
                let is_other = std::mem::replace(&mut has_value[v.index() - known], true);
                for k in 0..width {
                    let ends = [first, last].map(|v| given[v.index() * width + k]);
                    let (at, value) = (v.index() * width + k, along(c.point(*v), [p, q], ends));
                    if is_other {
                        widest = widest.max((value - values[at]).abs());
                        let several = || Several::new(Duplicates::Mean, values[at]);
                        means.entry(at).or_insert_with(several).add(value);
                    } else {
                        values[at] = value;
                    }
                }
            }
        }
    }
    means.into_iter().for_each(|(at, several)| values[at] = several.height());
    for (i, _) in has_value.iter().enumerate().filter(|(_, has_value)| !**has_value) {
        if let Some(found) = free(c.points()[known + i]) {
            values[(known + i) * width..(known + i + 1) * width].copy_from_slice(&found);
        }
    }
    (values, widest)
}

/// The linear function with these values at the ends of a segment, at a point on it; never beyond them. The same bits whichever end is
/// first.
pub fn along(p: [f64; 2], ends: [[f64; 2]; 2], values: [f64; 2]) -> f64 {
    let first = least(&ends);
    let [(a, of_a), (b, of_b)] = [first, 1 - first].map(|k| (ends[k], values[k]));
    let values = [of_a, of_b];
    let axis = usize::from((b[1] - a[1]).abs() > (b[0] - a[0]).abs());
    let share = (p[axis] - a[axis]) / (b[axis] - a[axis]);
    clamped(values[0] + share * (values[1] - values[0]), &values)
}

/// Where the lexicographically least of some points is.
pub fn least(points: &[[f64; 2]]) -> usize {
    (1..points.len()).fold(0, |least, k| if points[k] < points[least] { k } else { least })
}

/// A mean that rounding does not lead out; where it is none, because numbers are too large or too small, the least value.
pub fn clamped(mean: f64, values: &[f64]) -> f64 {
    if values.iter().any(|value| value.is_nan()) {
        return f64::NAN;
    }
    let low = values.iter().copied().fold(f64::INFINITY, f64::min);
    let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    if mean.is_nan() { low } else { mean.clamp(low, high) }
}
