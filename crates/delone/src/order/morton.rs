//! Morton order with the cuts between neighbours: the tree on which divide and conquer works.
//!
//! Points are sorted by the interleaved bits of their cells (x first). Between two neighbours in that order
//! runs the cut of the first bit in which their keys differ: its depth tells the size of the cell that it
//! halves and, by its parity, the axis. The cuts alone are the tree, so no tree is stored.
//!
//! Keys have just enough bits, about three more than log2 n, for two or three radix passes. Skewed data
//! collapse into few cells; there a run of equal keys is sorted again in its own bounding box, recursively. A
//! nested box is at least 2^5 times smaller than the one around it, so 2100 / 5 is a bound on the depth for
//! any doubles. Equal points meet in the end, and all but the first given are set aside as duplicates.
//!
//! Cost: O(n) passes for data spread evenly, O(n log n) for any data of bounded exponent range.

use super::quantize::{Quantizer, bounds};

/// Runs of equal keys up to this length are sorted by comparison; longer ones get keys of their own.
const SHORT_RUN: usize = 32;

/// Points in Morton order, without duplicates.
pub(crate) struct Sorted {
    /// The distinct points in order.
    pub(crate) points: Vec<[f64; 2]>,
    /// Their input indices.
    pub(crate) indices: Vec<u32>,
    /// For each point the cut before it, relative to the box that holds both neighbours.
    pub(crate) cuts: Vec<Cut>,
    /// The boxes, outermost first, each before those nested in it.
    pub(crate) boxes: Vec<KeyBox>,
    /// Input index and representative of each point that equals an earlier one, in order of discovery.
    pub(crate) duplicates: Vec<(u32, u32)>,
}

/// One set of keys: the positions it sorted and the geometry of its cells.
#[derive(Clone, Copy, Debug)]
pub(crate) struct KeyBox {
    /// First position in the order.
    pub(crate) start: usize,
    /// One past the last position.
    pub(crate) end: usize,
    quantizer: Option<Quantizer>,
    /// Twice the bits per axis: the depth at which keys are used up.
    depth: u32,
}

impl KeyBox {
    /// The number of depths at which this box is cut; at the last, keys are equal and the order is
    /// lexicographic.
    pub(crate) fn depths(&self) -> u32 {
        self.depth + 1
    }

    /// Upper bounds on width and height of the cells at a depth, before the cut there.
    pub(crate) fn cell(&self, depth: u32) -> [f64; 2] {
        self.quantizer.map_or([0.0; 2], |quantizer| quantizer.block([depth.div_ceil(2), depth / 2]))
    }

    /// The depth of a cut, an index below [`Self::depths`], and whether it separates by x (else by y).
    pub(crate) fn split(&self, cut: Cut) -> (usize, bool) {
        let depth = u32::from(cut.0 - 1).min(self.depth);
        (depth as usize, depth % 2 == 0)
    }
}

/// The cut between two neighbours: larger is deeper. [`Cut::OUTSIDE`] is shallower than all.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Cut(u8);

impl Cut {
    /// The border of a box.
    pub(crate) const OUTSIDE: Self = Self(0);
}

/// Sorts points. All must be finite, and fewer than 2^32.
pub(crate) fn sort(points: &[[f64; 2]]) -> Sorted {
    let n = points.len();
    let mut sorter = Sorter {
        input: points,
        sorted: Sorted {
            points: Vec::with_capacity(n),
            indices: Vec::with_capacity(n),
            cuts: Vec::with_capacity(n),
            boxes: Vec::new(),
            duplicates: Vec::new(),
        },
        spare: vec![0; n],
    };
    let mut entries: Vec<u64> = (0..n as u64).collect();
    if n > 0 {
        sorter.key_box(&mut entries, Cut::OUTSIDE);
    }
    sorter.sorted
}

struct Sorter<'a> {
    input: &'a [[f64; 2]],
    sorted: Sorted,
    spare: Vec<u64>,
}

/// An entry holds a key above and an input index below.
fn index(entry: u64) -> usize {
    entry as u32 as usize
}

impl Sorter<'_> {
    /// Sorts the points of `entries`, which are in input order, and appends them to the result.
    fn key_box(&mut self, entries: &mut [u64], before: Cut) {
        let n = entries.len();
        let (low, high) = bounds(entries.iter().map(|&e| self.input[index(e)]));
        let bits = ((n as f64).log2() / 2.0 + 1.5).ceil() as u32;
        let quantizer = Quantizer::new(low, high, bits);
        let start = self.sorted.points.len();
        let place = self.sorted.boxes.len();
        self.sorted.boxes.push(KeyBox { start, end: start, quantizer, depth: 2 * bits });
        if let Some(quantizer) = quantizer {
            for entry in entries.iter_mut() {
                let [column, row] = quantizer.cell(self.input[index(*entry)]);
                *entry = u64::from(spread(column) << 1 | spread(row)) << 32 | (*entry & 0xffff_ffff);
            }
            radix_sort(entries, &mut self.spare[..n], 2 * bits);
            self.runs(entries, 2 * bits, before);
        } else {
            self.push(entries[0], before);
            for &entry in &entries[1..] {
                self.push_duplicate(entry);
            }
        }
        self.sorted.boxes[place].end = self.sorted.points.len();
    }

    /// Appends sorted entries, run by run of equal keys.
    fn runs(&mut self, entries: &mut [u64], depth: u32, before: Cut) {
        let mut cut = before;
        let mut start = 0;
        while start < entries.len() {
            let key = entries[start] >> 32;
            let mut end = start + 1;
            while end < entries.len() && entries[end] >> 32 == key {
                end += 1;
            }
            match end - start {
                1 => self.push(entries[start], cut),
                2..=SHORT_RUN => self.short_run(&mut entries[start..end], depth, cut),
                _ => self.key_box(&mut entries[start..end], cut),
            }
            if let Some(following) = entries.get(end) {
                // Keys that first differ at depth d differ in bit depth - 1 - d. (The entries of a long run have
                // the keys of their own box by now.)
                let differing = (following >> 32 ^ key).ilog2();
                cut = Cut((depth - differing) as u8);
            }
            start = end;
        }
    }

    /// Appends points of one cell in lexicographic order, with the cuts of a balanced tree.
    fn short_run(&mut self, run: &mut [u64], depth: u32, before: Cut) {
        let input = self.input;
        let point = |entry: u64| input[index(entry)];
        run.sort_unstable_by(|&a, &b| {
            point(a).partial_cmp(&point(b)).expect("finite").then(index(a).cmp(&index(b)))
        });
        let mut distinct = 0_u32;
        for (i, &entry) in run.iter().enumerate() {
            if i > 0 && point(run[i - 1]) == point(entry) {
                self.push_duplicate(entry);
                continue;
            }
            // Between two equal numbers of trailing zeros lies a larger one: a tree, cut highest at 16.
            let balanced = || Cut((depth + 1 + 5 - distinct.trailing_zeros()) as u8);
            self.push(entry, if distinct == 0 { before } else { balanced() });
            distinct += 1;
        }
    }

    fn push(&mut self, entry: u64, cut: Cut) {
        self.sorted.points.push(self.input[index(entry)]);
        self.sorted.indices.push(entry as u32);
        self.sorted.cuts.push(cut);
    }

    fn push_duplicate(&mut self, entry: u64) {
        let representative = *self.sorted.indices.last().expect("a duplicate follows its point");
        self.sorted.duplicates.push((entry as u32, representative));
    }
}

/// Moves bit i to bit 2i.
fn spread(x: u32) -> u32 {
    let x = (x | x << 8) & 0x00ff_00ff;
    let x = (x | x << 4) & 0x0f0f_0f0f;
    let x = (x | x << 2) & 0x3333_3333;
    (x | x << 1) & 0x5555_5555
}

/// Sorts entries by `key_bits` bits from bit 32 up, stably: least significant digits first.
fn radix_sort(entries: &mut [u64], spare: &mut [u64], key_bits: u32) {
    // Below this length a comparison sort is faster; indices ascend, so it is stable too.
    if entries.len() < 512 {
        entries.sort_unstable();
        return;
    }
    let passes = key_bits.div_ceil(11);
    let digit_bits = key_bits.div_ceil(passes);
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

#[cfg(test)]
mod tests {
    use super::{Cut, sort};
    use delone_oracle::generate::Kind;

    #[test]
    fn sorts_every_point_once_and_keeps_the_first_of_equals() {
        for &kind in Kind::ALL {
            for n in [1, 2, 40, 3000] {
                let points = kind.points(n, 5);
                let sorted = sort(&points);
                assert_eq!(sorted.points.len() + sorted.duplicates.len(), n, "{}", kind.name());
                let mut seen: Vec<_> =
                    sorted.indices.iter().chain(sorted.duplicates.iter().map(|d| &d.0)).collect();
                seen.sort_unstable();
                seen.dedup();
                assert_eq!(seen.len(), n, "{}", kind.name());
                for (p, &i) in sorted.points.iter().zip(&sorted.indices) {
                    assert_eq!(*p, points[i as usize]);
                    assert_eq!(points.iter().position(|q| q == p), Some(i as usize), "{}", kind.name());
                }
                for &(duplicate, representative) in &sorted.duplicates {
                    assert_eq!(points[duplicate as usize], points[representative as usize]);
                }
            }
        }
    }

    /// Every cut separates its two sides: strictly by its axis, or lexicographically in a single cell.
    #[test]
    fn cuts_separate() {
        for &kind in Kind::ALL {
            let sorted = sort(&kind.points(2000, 6));
            for key_box in &sorted.boxes {
                let inside = |b: &super::KeyBox, at: usize| b.start < at && at < b.end;
                let nested: Vec<_> = sorted
                    .boxes
                    .iter()
                    .filter(|b| key_box.start <= b.start && b.end <= key_box.end)
                    .filter(|b| b.end - b.start < key_box.end - key_box.start)
                    .collect();
                for at in key_box.start + 1..key_box.end {
                    if nested.iter().any(|b| inside(b, at)) {
                        continue;
                    }
                    let cut = sorted.cuts[at];
                    let (depth, by_x) = key_box.split(cut);
                    let same_side = |i: &usize| nested.iter().any(|b| inside(b, *i)) || sorted.cuts[*i] > cut;
                    let left = (key_box.start + 1..at).rev().take_while(same_side).last().unwrap_or(at) - 1;
                    let right = (at + 1..key_box.end).take_while(same_side).last().unwrap_or(at);
                    assert_ne!(cut, Cut::OUTSIDE);
                    for p in &sorted.points[left..at] {
                        for q in &sorted.points[at..=right] {
                            let strictly = if by_x { p[0] < q[0] } else { p[1] < q[1] };
                            let in_a_cell = depth as u32 + 1 == key_box.depths() && p < q;
                            assert!(strictly || in_a_cell, "{}: {p:?} {q:?}", kind.name());
                        }
                    }
                }
            }
        }
    }
}
