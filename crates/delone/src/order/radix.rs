//! Radix sort of 64-bit entries by the bits from 32 up, stably.
//!
//! On one thread least significant digits first. On several, most significant digit first: each thread scatters its part
//! of the input into buckets, whose places are known from counts, and then buckets are sorted by the rest of the bits.
//!
//! Cost: O(n) passes.

use crate::parallel;

/// Below this length a comparison sort is faster; indices ascend, so it is stable too.
const SHORT: usize = 512;
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
    let parts = parallel::parts(entries.len()).min(2 * parallel::threads());
    if parts == 1 || key_bits <= BUCKET_BITS {
        by_digits(entries, key_bits);
    } else {
        by_buckets(entries, key_bits, parts);
    }
}

/// Least significant digits first, on one thread.
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

/// Most significant digit first, in parallel.
fn by_buckets(entries: &mut Vec<u64>, key_bits: u32, parts: usize) {
    let digit = |entry: u64| (entry >> (32 + key_bits - BUCKET_BITS)) as usize;
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
    let mut sorted = parallel::filled(0, entries.len());
    let mut places: Vec<Vec<&mut [u64]>> = chunks.iter().map(|_| Vec::new()).collect();
    for (k, place) in parallel::split_at(&mut sorted, &ends).into_iter().enumerate() {
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
    parallel::map(parallel::split_at(&mut sorted, &buckets), |bucket| {
        by_digits(bucket, key_bits - BUCKET_BITS);
    });
    *entries = sorted;
}

#[cfg(test)]
mod tests {
    use super::{by_buckets, by_digits};

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
            let mut sorted = entries.clone();
            by_buckets(&mut sorted, 20, parts);
            assert!(sorted == expected, "{parts} parts");
        }
        let mut sorted = entries;
        by_digits(&mut sorted, 20);
        assert!(sorted == expected);
    }
}
