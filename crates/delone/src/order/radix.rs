//! Radix sort of 64-bit entries by the bits from 32 up, stably.
//!
//! Arrays that fit the cache are sorted least significant digits first. Larger arrays, or several threads, sort most significant digit first:
//! each thread scatters its part of the input into buckets, whose places are known from counts, and then buckets are
//! sorted by the rest of the bits. Where nearly all keys are equal, only the others are sorted.
//!
//! Cost: O(n) passes.

use crate::memory::zeroed;
use crate::parallel;

/// Below this length a comparison sort is faster; indices ascend, so it is stable too.
const SHORT: usize = 512;
/// More entries are not in a fast cache, and are put into buckets first.
const CACHED: usize = 1 << 18;
/// Bits of the digit that buckets are made by.
const BUCKET_BITS: u32 = 8;
/// The most bits of a digit: as many places must stay in a fast cache.
pub(super) const DIGIT_BITS: u32 = 11;

/// The passes that keys take.
pub(super) fn passes(key_bits: u32) -> u32 {
    key_bits.div_ceil(DIGIT_BITS)
}

/// Sorts entries by `key_bits` bits from bit 32 up. Their lower halves must ascend.
pub(super) fn sort(entries: &mut Vec<u64>, key_bits: u32) {
    match crowded_key(entries) {
        Some(key) => around(entries, key, key_bits),
        None => by_any_digits(entries, key_bits),
    }
}

/// The key that most entries seem to have, if there is one: outliers leave one cell to all others.
fn crowded_key(entries: &[u64]) -> Option<u64> {
    const SAMPLE: usize = 32;
    if entries.len() < SHORT {
        return None;
    }
    let mut keys: [u64; SAMPLE] = std::array::from_fn(|k| entries[entries.len() / SAMPLE * k] >> 32);
    keys.sort_unstable();
    // What most have, the middle one has.
    let middle = keys[SAMPLE / 2];
    (keys.iter().filter(|&&key| key == middle).count() >= SAMPLE * 3 / 4).then_some(middle)
}

/// Leaves entries of one key in their order, sorts all others, and puts them around.
fn around(entries: &mut Vec<u64>, key: u64, key_bits: u32) {
    let n = entries.len();
    let mut others = Vec::new();
    entries.retain(|&entry| {
        let crowded = entry >> 32 == key;
        if !crowded {
            others.push(entry);
        }
        crowded
    });
    by_any_digits(&mut others, key_bits);
    let (before, after) = others.split_at(others.partition_point(|entry| entry >> 32 < key));
    let crowd = entries.len();
    entries.resize(n, 0);
    entries.copy_within(..crowd, before.len());
    entries[..before.len()].copy_from_slice(before);
    entries[before.len() + crowd..].copy_from_slice(after);
}

/// Sorts by the digits that suit the number of entries and of threads.
fn by_any_digits(entries: &mut Vec<u64>, key_bits: u32) {
    let parts = parts(entries.len());
    if key_bits > BUCKET_BITS && (parts > 1 || entries.len() > CACHED) {
        let mut sorted = zeroed(entries.len());
        by_buckets(entries, &mut sorted, key_bits, parts);
        *entries = sorted;
    } else {
        by_digits(entries, key_bits);
    }
}

/// Into how many parts threads cut entries to scatter them.
fn parts(entries: usize) -> usize {
    match parallel::parts(entries) {
        1 => 1,
        parts => parts.min(2 * parallel::threads()),
    }
}

/// Least significant digits first.
pub(super) fn by_digits(entries: &mut [u64], key_bits: u32) {
    if entries.len() < SHORT {
        entries.sort_unstable();
        return;
    }
    let passes = passes(key_bits);
    let digit_bits = key_bits.div_ceil(passes);
    let mut spare = vec![0; entries.len()];
    let (mut from, mut to) = (&mut *entries, &mut *spare);
    for pass in 0..passes {
        let shift = 32 + pass * digit_bits;
        let mask = (1u64 << digit_bits) - 1;
        let digit = |entry: u64| (entry >> shift & mask) as usize;
        let mut places = vec![0u32; 1 << digit_bits];
        for &entry in &*from {
            places[digit(entry)] += 1;
        }
        let mut total = 0;
        for place in &mut places {
            total += std::mem::replace(place, total);
        }
        for &entry in &*from {
            let place = &mut places[digit(entry)];
            to[*place as usize] = entry;
            *place += 1;
        }
        std::mem::swap(&mut from, &mut to);
    }
    if passes % 2 == 1 {
        to.copy_from_slice(from);
    }
}

/// Most significant digit first, into memory of the same length.
fn by_buckets(entries: &[u64], sorted: &mut [u64], key_bits: u32, parts: usize) {
    let digit = |entry: u64| (entry >> (32 + key_bits - BUCKET_BITS)) as usize % (1 << BUCKET_BITS);
    let chunks: Vec<&[u64]> = entries.chunks(entries.len().div_ceil(parts)).collect();
    let counts = parallel::map(chunks.clone(), |chunk| {
        let mut counts = [0_usize; 1 << BUCKET_BITS];
        chunk.iter().for_each(|&entry| counts[digit(entry)] += 1);
        counts
    });
    // The places of each bucket, and in it of each chunk.
    let mut ends = Vec::with_capacity(chunks.len() << BUCKET_BITS);
    let mut buckets = Vec::with_capacity(1 << BUCKET_BITS);
    let mut total = 0;
    for bucket in 0..1 << BUCKET_BITS {
        for counts in &counts {
            total += counts[bucket];
            ends.push(total);
        }
        buckets.push(total);
    }
    let mut places: Vec<Vec<&mut [u64]>> = chunks.iter().map(|_| Vec::new()).collect();
    for (k, place) in parallel::split_at(sorted, &ends).into_iter().enumerate() {
        places[k % chunks.len()].push(place);
    }
    let tasks = chunks.into_iter().zip(places).collect();
    parallel::map(tasks, |(chunk, mut places): (&[u64], Vec<&mut [u64]>)| {
        let mut filled = [0; 1 << BUCKET_BITS];
        for &entry in chunk {
            let bucket = digit(entry);
            places[bucket][filled[bucket]] = entry;
            filled[bucket] += 1;
        }
    });
    parallel::map(parallel::split_at(sorted, &buckets), |bucket| {
        let rest = key_bits - BUCKET_BITS;
        // Where data are dense, a bucket may have most of them.
        if rest > BUCKET_BITS && bucket.len() > CACHED {
            let unsorted = bucket.to_vec();
            by_buckets(&unsorted, bucket, rest, parts);
        } else {
            by_digits(bucket, rest);
        }
    });
}

#[cfg(test)]
mod tests {
    use super::{around, by_buckets, by_digits, crowded_key, sort};

    #[test]
    fn both_ways_sort_stably() {
        let mut state = 7_u64;
        let keys = (0..100_000_u64).map(|i| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            // Many equal keys, and a crowded bucket.
            let key = if i % 3 == 0 { 77 } else { state >> 44 & 0xfffff };
            key << 32 | i
        });
        let entries: Vec<u64> = keys.collect();
        let mut expected = entries.clone();
        expected.sort_unstable();
        for parts in [1, 2, 5] {
            let mut sorted = vec![0; entries.len()];
            by_buckets(&entries, &mut sorted, 20, parts);
            assert!(sorted == expected, "{parts} parts");
        }
        let mut sorted = entries;
        by_digits(&mut sorted, 20);
        assert!(sorted == expected);
    }

    #[test]
    fn a_crowd_is_left_where_it_is() {
        for crowd in [0_u64, 5, 1023] {
            let key = |i: u64| if i % 10 == 3 { i * 37 % 1024 } else { crowd };
            let entries: Vec<u64> = (0..5000).map(|i| key(i) << 32 | i).collect();
            assert_eq!(crowded_key(&entries), Some(crowd));
            let mut expected = entries.clone();
            expected.sort_unstable();
            let mut sorted = entries.clone();
            sort(&mut sorted, 10);
            assert!(sorted == expected, "{crowd}");
            // Of any key, had by many, few or none.
            for key in [0, 1, 5, 700, 1024] {
                let mut sorted = entries.clone();
                around(&mut sorted, key, 10);
                assert!(sorted == expected, "{crowd} {key}");
            }
        }
    }
}
