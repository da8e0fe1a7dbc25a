//! Hilbert order by medians: neighbours in the order are neighbours in the plane, whatever the distribution.
//!
//! Source: Hilbert's curve with its squares cut at the median instead of the middle (the "median policy" of
//! Delage & Devillers, "Spatial sorting", CGAL manual), so that clusters and outliers need no finer keys.
//! Cost: O(n log n), recursion at most log4 n deep.

/// Below this size the order inside a cell does not matter.
const SMALL: usize = 4;

/// Sorts indices of points along the curve.
pub(crate) fn sort(points: &[[f64; 2]], indices: &mut [u32]) {
    cell(points, indices, 0, [false, false]);
}

/// Sorts one cell. The curve runs first along `axis`; an axis whose flag is set runs downwards.
fn cell(points: &[[f64; 2]], indices: &mut [u32], axis: usize, down: [bool; 2]) {
    if indices.len() <= SMALL {
        return;
    }
    let other = 1 - axis;
    let flipped = |axes: &[usize]| {
        let mut down = down;
        axes.iter().for_each(|&k| down[k] = !down[k]);
        down
    };
    let (near, far) = halves(points, indices, axis, down[axis]);
    let (first, second) = halves(points, near, other, down[other]);
    let (third, fourth) = halves(points, far, other, !down[other]);
    cell(points, first, other, down);
    cell(points, second, axis, down);
    cell(points, third, axis, down);
    cell(points, fourth, other, flipped(&[0, 1]));
}

/// Splits indices at the median coordinate.
fn halves<'a>(
    points: &[[f64; 2]],
    indices: &'a mut [u32],
    axis: usize,
    down: bool,
) -> (&'a mut [u32], &'a mut [u32]) {
    let middle = indices.len() / 2;
    if middle > 0 {
        let coordinate = |i: u32| points[i as usize][axis];
        indices.select_nth_unstable_by(middle, |&i, &j| {
            let order = coordinate(i).total_cmp(&coordinate(j));
            if down { order.reverse() } else { order }
        });
    }
    indices.split_at_mut(middle)
}

#[cfg(test)]
mod tests {
    use super::sort;

    /// On a grid of 4^k points the curve takes only unit steps between cells of four.
    #[test]
    fn steps_are_short() {
        let points: Vec<_> = (0..4096).map(|i| [f64::from(i % 64), f64::from(i / 64)]).collect();
        let mut indices: Vec<u32> = (0..4096).collect();
        sort(&points, &mut indices);
        let step = |w: &[u32]| {
            let [p, q] = [points[w[0] as usize], points[w[1] as usize]];
            (p[0] - q[0]).abs() + (p[1] - q[1]).abs()
        };
        let total: f64 = indices.windows(2).map(step).sum();
        assert!(total < 2.0 * 4096.0, "{total}");
    }
}
