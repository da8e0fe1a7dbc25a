//! A biased randomized insertion order in the plane, and the Hilbert order by medians along which it goes.
//!
//! Sources: Amenta, Choi & Rote, "Incremental constructions con BRIO", SoCG 2003: points are dealt at random into rounds
//! of geometrically growing size, random enough for the worst case, and each round is visited along a space-filling
//! curve, local enough for the cache. Hilbert's curve with its squares cut at the median instead of the middle (the
//! "median policy" of Delage & Devillers, "Spatial sorting", CGAL manual), so that clusters and outliers need no finer
//! keys.
//!
//! Cost: O(n log n), recursion at most log4 n deep.

use super::random::SplitMix;

/// Each round holds seven times as many points as all before it.
const GROWTH: u64 = 8;
/// The first round is not made smaller than this.
const SMALLEST: usize = 64;

/// An order for the points; the same for the same seed.
pub(crate) fn insertion_order(points: &[[f64; 2]], seed: u64) -> Vec<u32> {
    let mut indices: Vec<u32> = (0..points.len() as u32).collect();
    deal(&mut indices, seed, |round| along_curve(points, round));
    indices
}

/// The indices of points along the curve.
pub(crate) fn curve(points: &[[f64; 2]]) -> Vec<u32> {
    let mut indices: Vec<u32> = (0..points.len() as u32).collect();
    along_curve(points, &mut indices);
    indices
}

/// The order of [`insertion_order`] for so many points that are along the curve already.
pub(crate) fn rounds(count: usize, seed: u64) -> Vec<u32> {
    let mut indices: Vec<u32> = (0..count as u32).collect();
    deal(&mut indices, seed, <[u32]>::sort_unstable);
    indices
}

/// Deals items into rounds, and puts each of them in order.
pub(crate) fn deal<T>(items: &mut [T], seed: u64, put_in_order: impl Fn(&mut [T])) {
    let mut random = SplitMix(seed);
    let mut rest = items;
    while rest.len() > SMALLEST {
        // Those that stay go to the front, one in GROWTH; the others are this round, and later rounds come first.
        let mut earlier = 0;
        for i in 0..rest.len() {
            if random.next().is_multiple_of(GROWTH) {
                rest.swap(i, earlier);
                earlier += 1;
            }
        }
        let (front, round) = rest.split_at_mut(earlier);
        put_in_order(round);
        rest = front;
    }
    put_in_order(rest);
}

/// Points, up to which a cell of the curve is not cut further: their order does not matter.
const UNORDERED_POINTS: usize = 4;

/// Sorts indices of points along the curve.
fn along_curve(points: &[[f64; 2]], indices: &mut [u32]) {
    cell(points, indices, 0, [false, false]);
}

/// Sorts one cell. The curve runs first along `axis`; an axis whose flag is set runs downwards.
fn cell(points: &[[f64; 2]], indices: &mut [u32], axis: usize, down: [bool; 2]) {
    if indices.len() <= UNORDERED_POINTS {
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
    use super::{along_curve, insertion_order};

    #[test]
    fn is_a_permutation_that_the_seed_decides() {
        let points: Vec<_> = (0..5000).map(|i| [f64::from(i * 7919 % 5003), f64::from(i)]).collect();
        let first = insertion_order(&points, 1);
        let mut sorted = first.clone();
        sorted.sort_unstable();
        assert!(sorted.iter().copied().eq(0..5000));
        assert_eq!(first, insertion_order(&points, 1));
        assert_ne!(first, insertion_order(&points, 2));
    }

    /// On a grid of 4^k points the curve takes only unit steps between cells of four.
    #[test]
    fn steps_are_short() {
        let points: Vec<_> = (0..4096).map(|i| [f64::from(i % 64), f64::from(i / 64)]).collect();
        let mut indices: Vec<u32> = (0..4096).collect();
        along_curve(&points, &mut indices);
        let step = |w: &[u32]| {
            let [p, q] = [points[w[0] as usize], points[w[1] as usize]];
            (p[0] - q[0]).abs() + (p[1] - q[1]).abs()
        };
        let total: f64 = indices.windows(2).map(step).sum();
        assert!(total < 2.0 * 4096.0, "{total}");
    }
}
