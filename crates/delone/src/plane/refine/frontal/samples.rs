//! Sizes along a way: sampled where they change, and summed, so that the way can be divided into parts that are equally long for their sizes.
//!
//! Cost: O(1) for each sample, of which there are some twelve for each part.

use crate::sorting;

/// Samples for a way as long as the size there, and for a whole way, at least.
const SAMPLES_EACH: f64 = 12.0;
const LEAST_SAMPLES: f64 = 24.0;
/// From so many samples on, they are no nearer to each other than the least part of the way.
const MOST_SAMPLES: usize = 1 << 20;

/// See the module.
#[derive(Clone, Debug)]
pub(super) struct Samples {
    /// Distances from the beginning.
    at: Vec<f64>,
    sizes: Vec<f64>,
    /// How many sizes long the way is up to each sample.
    sums: Vec<f64>,
}

impl Samples {
    /// Of a way of some length, with sizes that are known at some distances, which may be beyond the way, and lengths that are wanted
    /// anywhere. No size is larger than another one and what may be grown on the way from there. Where the way is known to be more than
    /// `most` sizes long, the rest is not looked at.
    pub(super) fn along(
        length: f64,
        most: f64,
        mut known: Vec<(f64, f64)>,
        wanted: impl Fn(f64) -> f64,
        slope: f64,
    ) -> Self {
        sorting::by(&mut known, |one, other| one.0.total_cmp(&other.0));
        limit(&mut known, slope);
        let mut samples: Vec<(f64, f64)> = Vec::new();
        let (mut from, mut next, mut sum) = (0.0_f64, 0, 0.0);
        loop {
            while known.get(next).is_some_and(|known| known.0 <= from) {
                next += 1;
            }
            let beside = [next.checked_sub(1).and_then(|last| known.get(last)), known.get(next)];
            let allowed = beside.into_iter().flatten().map(|(at, size)| size + slope * (from - at).abs());
            let size = allowed.fold(wanted(from), f64::min);
            samples.push((from, size));
            if from >= length {
                break;
            }
            let least = if samples.len() < MOST_SAMPLES { 0.0 } else { length / MOST_SAMPLES as f64 };
            let step = (size / SAMPLES_EACH).max(least).min(length / LEAST_SAMPLES);
            sum += step / size;
            if sum > most {
                samples.push((length, size));
                break;
            }
            let end = known.get(next).map_or(length, |known| known.0.min(length));
            // Steps that are lost in rounding lead on, too.
            from = if from + step > from { (from + step).min(end) } else { end };
        }
        limit(&mut samples, slope);
        let mut sums = vec![0.0];
        for pair in samples.windows(2) {
            let more = 0.5 * (pair[1].0 - pair[0].0) * (1.0 / pair[0].1 + 1.0 / pair[1].1);
            sums.push(sums[sums.len() - 1] + more);
        }
        let (at, sizes) = samples.into_iter().unzip();
        Self { at, sizes, sums }
    }

    /// The first distance at which something is true of it and the size there.
    pub(super) fn first(&self, is_true: impl Fn(f64, f64) -> bool) -> Option<f64> {
        self.at.iter().zip(&self.sizes).find(|&(&from, &size)| is_true(from, size)).map(|found| *found.0)
    }

    /// How many sizes long the way is between two distances.
    pub(super) fn sizes_between(&self, from: f64, to: f64) -> f64 {
        self.sum_at(to) - self.sum_at(from)
    }

    fn sum_at(&self, from: f64) -> f64 {
        let at = self.at.partition_point(|&at| at <= from).clamp(1, self.at.len() - 1) - 1;
        let within = (from - self.at[at]) / (self.at[at + 1] - self.at[at]);
        self.sums[at] + within.clamp(0.0, 1.0) * (self.sums[at + 1] - self.sums[at])
    }

    /// The distances that divide the way between two others into parts of equally many sizes.
    pub(super) fn divided(&self, from: f64, to: f64, count: usize) -> Vec<f64> {
        let [low, high] = [from, to].map(|from| self.sum_at(from));
        let mut at = 0;
        let distance = |k: usize| {
            let sum = low + (high - low) * k as f64 / count as f64;
            while at + 2 < self.sums.len() && self.sums[at + 1] < sum {
                at += 1;
            }
            let within = (sum - self.sums[at]) / (self.sums[at + 1] - self.sums[at]);
            self.at[at] + within * (self.at[at + 1] - self.at[at])
        };
        (1..count).map(distance).collect()
    }
}

/// Lowers sizes at increasing distances until none is larger than another one and what may be grown on the way from there.
fn limit(sizes: &mut [(f64, f64)], slope: f64) {
    for k in 1..sizes.len() {
        sizes[k].1 = sizes[k].1.min(sizes[k - 1].1 + slope * (sizes[k].0 - sizes[k - 1].0));
    }
    for k in (1..sizes.len()).rev() {
        sizes[k - 1].1 = sizes[k - 1].1.min(sizes[k].1 + slope * (sizes[k].0 - sizes[k - 1].0));
    }
}

#[cfg(test)]
mod tests {
    use super::Samples;

    /// From a size of a millionth on sizes grow by a fifth of the way: the number of sizes is a logarithm.
    #[test]
    fn sums_are_integrals() {
        for least in [1e-12, 1e-6, 0.01] {
            let samples = Samples::along(1.0, 1e9, vec![(0.0, least)], |_| f64::INFINITY, 0.2);
            let exact = ((least + 0.2) / least).ln() / 0.2;
            let sum = samples.sizes_between(0.0, 1.0);
            assert!((sum / exact - 1.0).abs() < 1e-3, "{sum} is not {exact}");
            let parts = samples.divided(0.0, 1.0, 100);
            assert!(parts.len() == 99 && parts.is_sorted() && parts[0] > 0.0 && parts[98] < 1.0);
        }
        let even = Samples::along(2.0, 1e9, vec![(0.0, 0.5), (3.0, 0.5)], |_| 0.5, 0.2);
        assert!((even.sizes_between(0.5, 1.5) - 2.0).abs() < 1e-12);
        assert_eq!(even.divided(0.0, 2.0, 4), [0.5, 1.0, 1.5]);
    }
}
