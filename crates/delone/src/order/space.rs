//! Hilbert order in space, and the rounds of a biased randomized insertion order along it.
//!
//! Sources: Hamilton, "Compact Hilbert indices", Dalhousie University CS-2006-07, 2006, for the keys; Amenta, Choi &
//! Rote, "Incremental constructions con BRIO", SoCG 2003, for the rounds. Keys have a few bits more than it takes to
//! tell evenly spread points apart; where many points share a key, they get keys in their own bounding box, recursively.
//!
//! Cost: O(n) passes for points spread evenly, O(n log n) otherwise.

use super::radix;
use super::random::SplitMix;
use crate::parallel;
use crate::points::Bounds;

/// The most bits an axis: three axes fit 32 bits.
const MOST_BITS: u32 = 10;
/// Runs of equal keys up to this length keep the order of the input.
const SHORT_RUN: usize = 32;
/// Each round holds seven times as many points as all before it: of eight, two to this power.
const GROWTH: u32 = 3;
/// The first round is not made smaller than this.
const SMALLEST: usize = 64;

/// The indices of points along the curve; equal points by increasing index. In parallel if they are many.
pub(crate) fn hilbert(count: usize, point: &(impl Fn(u32) -> [f64; 3] + Sync)) -> Vec<u32> {
    let bits = bits_for(count);
    let Some(cells) = Cells::around((0..count as u32).map(point), bits) else {
        return (0..count as u32).collect();
    };
    // A key, and below it the index.
    let mut entries = parallel::collect(count, |i| cells.key(point(i as u32)) << 32 | i as u64);
    radix::sort(&mut entries, 3 * bits);
    let mut pending: Vec<&mut [u64]> = long_runs(&mut entries).collect();
    while let Some(run) = pending.pop() {
        let bits = bits_for(run.len());
        let Some(cells) = Cells::around(run.iter().map(|&entry| point(entry as u32)), bits) else { continue };
        for entry in &mut *run {
            let i = *entry as u32;
            *entry = cells.key(point(i)) << 32 | u64::from(i);
        }
        radix::by_digits(run, 3 * bits);
        pending.extend(long_runs(run));
    }
    entries.into_iter().map(|entry| entry as u32).collect()
}

fn bits_for(count: usize) -> u32 {
    (count.max(1).ilog2() / 3 + 3).min(MOST_BITS)
}

/// The runs of equal keys that are too long.
fn long_runs(entries: &mut [u64]) -> impl Iterator<Item = &mut [u64]> {
    entries.chunk_by_mut(|a, b| a >> 32 == b >> 32).filter(|run| run.len() > SHORT_RUN)
}

/// The cells of a box.
struct Cells {
    low: [f64; 3],
    /// 1/2 where the extent overflows.
    half: f64,
    scale: f64,
    /// Again, because one factor could overflow for a tiny box.
    lift: f64,
    bits: u32,
}

impl Cells {
    /// None around points that are all equal.
    fn around(points: impl Iterator<Item = [f64; 3]>, bits: u32) -> Option<Self> {
        let Bounds { low, high } = Bounds::of(points);
        let side = |half: f64| (0..3).map(|k| high[k] * half - low[k] * half).fold(0.0, f64::max);
        let half = if side(1.0).is_finite() { 1.0 } else { 0.5 };
        let side = side(half);
        if side == 0.0 || !side.is_finite() {
            return None;
        }
        let lift = if side < 1e-290 { 2f64.powi(200) } else { 1.0 };
        let scale = f64::from(1 << bits) / (side * lift);
        Some(Self { low: low.map(|x| x * half), half, scale, lift, bits })
    }

    fn key(&self, p: [f64; 3]) -> u64 {
        let cell = |k: usize| {
            let along = (p[k] * self.half - self.low[k]) * self.lift * self.scale;
            (along as u32).min((1 << self.bits) - 1)
        };
        curve([cell(0), cell(1), cell(2)], self.bits)
    }
}

/// The position of a cell along the curve.
fn curve([x, y, z]: [u32; 3], bits: u32) -> u64 {
    let spread = |x: u32| {
        let x = u64::from(x);
        let x = (x | x << 32) & 0x001f_0000_0000_ffff;
        let x = (x | x << 16) & 0x001f_0000_ff00_00ff;
        let x = (x | x << 8) & 0x100f_00f0_0f00_f00f;
        let x = (x | x << 4) & 0x10c3_0c30_c30c_30c3;
        (x | x << 2) & 0x1249_2492_4924_9249
    };
    let octants = spread(x) << 2 | spread(y) << 1 | spread(z);
    let (mut turn, mut key) = (0, 0);
    for bit in (0..bits).rev() {
        let octant = (octants >> (3 * bit)) as u8 & 7;
        let step = STEPS[usize::from(turn | octant)];
        key = key << 3 | u64::from(step & 7);
        turn = step & !7;
    }
    key
}

/// For each of the 24 turns of the curve, and each octant of a cell that it goes through, when it comes there, and in the upper bits
/// how it is turned inside: where it begins (three bits), and the axis that it ends along.
const STEPS: [u8; 256] = steps();

const fn steps() -> [u8; 256] {
    const fn rotated(octant: u32, by: u32) -> u32 {
        (octant << by | octant >> (3 - by)) & 7
    }
    let mut steps = [0; 256];
    let mut i = 0;
    while i < 24 * 8 {
        let (axis, begin, octant) = (i >> 6, i >> 3 & 7, i & 7);
        let by = (axis + 1) % 3;
        // Octants come in the order of the Gray code, rotated.
        let gray = rotated(octant ^ begin, (3 - by) % 3);
        let when = gray ^ gray >> 1 ^ gray >> 2;
        let (first, along) = if when == 0 {
            (0, 0)
        } else {
            let even = (when - 1) & !1;
            (even ^ even >> 1, (when - (when + 1) % 2).trailing_ones() % 3)
        };
        let turn = [(axis + along + 1) % 3, begin ^ rotated(first, by)];
        steps[i as usize] = (turn[0] << 6 | turn[1] << 3 | when) as u8;
        i += 1;
    }
    steps
}

/// The numbers below `count`, dealt into rounds at random: increasing in each, the smallest round first.
pub(crate) fn rounds(count: usize, seed: u64) -> Vec<u32> {
    // Each number is in the last round but for a chance of one in eight, and so on.
    let most = (count / SMALLEST).max(1).ilog2() / GROWTH;
    let mut random = SplitMix(seed);
    let steps: Vec<u8> =
        (0..count).map(|_| (random.next().trailing_zeros() / GROWTH).min(most) as u8).collect();
    let mut order = Vec::with_capacity(count);
    for step in (0..=most).rev() {
        order.extend((0..count as u32).filter(|&i| u32::from(steps[i as usize]) == step));
    }
    order
}

#[cfg(test)]
mod tests {
    use super::{curve, hilbert, rounds};

    #[test]
    fn the_curve_steps_from_cell_to_cell() {
        let side = 8_u32;
        let mut cells: Vec<[u32; 3]> =
            (0..side.pow(3)).map(|i| [i % side, i / side % side, i / side / side]).collect();
        cells.sort_by_key(|&c| curve(c, 3));
        for w in cells.windows(2) {
            let step: u32 = (0..3).map(|k| w[0][k].abs_diff(w[1][k])).sum();
            assert_eq!(step, 1, "{w:?}");
        }
    }

    #[test]
    fn orders_are_permutations() {
        let skewed =
            |i: u32| if i.is_multiple_of(7) { [1e300, 0.0, 0.0] } else { [f64::from(i) * 1e-200, 1.0, 0.0] };
        let mut order = hilbert(5000, &skewed);
        // All but one in seven share their first key, and are on a line: the way along it is short all the same.
        let near: Vec<u32> = order.iter().copied().filter(|i| !i.is_multiple_of(7)).collect();
        let way: u32 = near.windows(2).map(|w| w[0].abs_diff(w[1])).sum();
        assert!(way < 6 * 5000, "{way}");
        order.sort_unstable();
        assert!(order.into_iter().eq(0..5000));
        let mut order = rounds(5000, 3);
        assert_ne!(order, rounds(5000, 4));
        assert!(order[2000..].is_sorted());
        order.sort_unstable();
        assert!(order.into_iter().eq(0..5000));
        assert!(rounds(0, 1).is_empty());
    }
}
