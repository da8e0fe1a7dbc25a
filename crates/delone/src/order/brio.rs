//! Biased randomized insertion order: random enough for the worst case, local enough for the cache.
//!
//! Source: Amenta, Choi & Rote, "Incremental constructions con BRIO", SoCG 2003: points are dealt at random
//! into rounds of geometrically growing size, and each round is visited along a space-filling curve.
//! Cost: O(n log n).

use super::hilbert;
use super::random::SplitMix;

/// Each round holds seven times as many points as all before it.
const GROWTH: u64 = 8;
/// The first round is not made smaller than this.
const SMALLEST: usize = 64;

/// An order for the points; the same for the same seed.
pub(crate) fn order(points: &[[f64; 2]], seed: u64) -> Vec<u32> {
    let mut indices: Vec<u32> = (0..points.len() as u32).collect();
    let mut random = SplitMix(seed);
    let mut rest = indices.as_mut_slice();
    let mut rounds = Vec::new();
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
        rounds.push(round);
        rest = front;
    }
    rounds.push(rest);
    for round in rounds {
        hilbert::sort(points, round);
    }
    indices
}

#[cfg(test)]
mod tests {
    use super::order;

    #[test]
    fn is_a_permutation_that_the_seed_decides() {
        let points: Vec<_> = (0..5000).map(|i| [f64::from(i * 7919 % 5003), f64::from(i)]).collect();
        let first = order(&points, 1);
        let mut sorted = first.clone();
        sorted.sort_unstable();
        assert!(sorted.iter().copied().eq(0..5000));
        assert_eq!(first, order(&points, 1));
        assert_ne!(first, order(&points, 2));
    }
}
