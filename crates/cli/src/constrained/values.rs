//! Values, such as heights, of points that were added: where segments crossed, or by refinement.
//!
//! O(1) for each vertex on a segment.

use delone::Constrained2;

/// The values of all points, rows of `width` of them: those given for the first points, and for points that were added on
/// segments what these have there, linear between the given points; where segments differ, the mean. How far they differ
/// at most comes too. `free` says what other points have; of what it does not know, 0.
pub(crate) fn extended(
    c: &Constrained2,
    width: usize,
    given: &[f64],
    free: impl Fn([f64; 2]) -> Option<Vec<f64>>,
) -> (Vec<f64>, f64) {
    let known = given.len().checked_div(width).unwrap_or_default();
    let mut values = given.to_vec();
    values.resize(c.points().len() * width, 0.0);
    let mut counts = vec![0_u32; c.points().len() - known];
    let mut widest = 0.0_f64;
    for (s, _) in c.segments() {
        let chain = c.chain(s).unwrap_or_default();
        let old: Vec<usize> = (0..chain.len()).filter(|&k| chain[k].index() < known).collect();
        for piece in old.windows(2).filter(|piece| piece[1] > piece[0] + 1) {
            let [first, last] = [chain[piece[0]], chain[piece[1]]];
            let (p, q) = (c.point(first), c.point(last));
            let axis = usize::from((q[1] - p[1]).abs() > (q[0] - p[0]).abs());
            for v in &chain[piece[0] + 1..piece[1]] {
                let share = (c.point(*v)[axis] - p[axis]) / (q[axis] - p[axis]);
                let count = &mut counts[v.index() - known];
                for k in 0..width {
                    let [from, to] = [first, last].map(|v| given[v.index() * width + k]);
                    let value = from + share * (to - from);
                    let sum = &mut values[v.index() * width + k];
                    if *count > 0 {
                        widest = widest.max((value - *sum / f64::from(*count)).abs());
                    }
                    *sum += value;
                }
                *count += 1;
            }
        }
    }
    for (i, &count) in counts.iter().enumerate() {
        let row = &mut values[(known + i) * width..(known + i + 1) * width];
        if count > 0 {
            row.iter_mut().for_each(|sum| *sum /= f64::from(count));
        } else if let Some(found) = free(c.points()[known + i]) {
            row.copy_from_slice(&found);
        }
    }
    (values, widest)
}
