//! Morton order with the cuts between neighbors: the tree on which divide and conquer works.
//!
//! Points are sorted by the interleaved bits of their cells (x first). Between two neighbors in that order
//! runs the cut of the first bit in which their keys differ.
//!
//! Keys have three bits more than log2 n, and as many more as radix passes of the same number can take; a few points have
//! none. Skewed data collapse into few cells; there a run of equal keys is sorted again in its own bounding box,
//! recursively. A nested box is at least 2^5 times smaller than the one around it, so 2100 / 5 is a bound on the depth
//! for any doubles; where boxes would nest that deep, at the origin, exponents are the keys (`exponents.rs`). Equal points meet in
//! the end, and all but the first given are set aside as duplicates.
//!
//! Cost: O(n) passes for data spread evenly, O(n log n) for any data of bounded exponent range.

use std::cmp::Ordering;
use std::ops::Range;

use super::cuts::{Cells, Cut, KeyBox, SHORT_RUN};
use super::exponents::{self, Exponents};
use super::quantize::Quantizer;
use super::radix;
use crate::memory::zeroed;
use crate::parallel;
use crate::points::{Bounds, survey};

/// Points, up to which a set is sorted without keys.
const UNKEYED_POINTS: usize = 12;

/// Points, from which on keys are as long as the passes of the sort allow: points along a curve then stay in cells of their own.
const LONG_KEY_POINTS: usize = 1 << 15;

/// Points in Morton order, without duplicates.
pub(crate) struct Sorted {
    /// The distinct points in order.
    pub(crate) points: Vec<[f64; 2]>,
    /// Their input indices.
    pub(crate) indices: Vec<u32>,
    /// For each point the cut before it, relative to the box that holds both neighbors.
    pub(crate) cuts: Vec<Cut>,
    /// The boxes, outermost first, each before those nested in it.
    pub(crate) boxes: Vec<KeyBox>,
    /// Input index and representative of each point that equals an earlier one, in order of discovery.
    pub(crate) duplicates: Vec<(u32, u32)>,
}

/// Sorts points within their bounds, in parallel if they are many. All must be finite, and fewer than 2^32.
pub(crate) fn sort(points: &[[f64; 2]], bounds: &Bounds<2>) -> Sorted {
    let n = points.len();
    let mut sorted = Sorted {
        points: zeroed(n),
        indices: zeroed(n),
        cuts: zeroed(n),
        boxes: Vec::new(),
        duplicates: Vec::new(),
    };
    if n > 0 {
        let mut sorter = Sorter {
            boxes: Vec::with_capacity(1),
            ..Sorter::new(0, &mut sorted.points, &mut sorted.indices, &mut sorted.cuts)
        };
        let key_box = sorter.key_box(points, bounds, None, 0..n);
        sorter.runs(0..n, &key_box);
        let Sorter { boxes, removed, duplicates, .. } = sorter;
        (sorted.boxes, sorted.duplicates) = (boxes, duplicates);
        // Exponents are given boxes at once, with others on both sides of those inside.
        let mut order: Vec<u64> =
            sorted.boxes.iter().enumerate().map(|(k, b)| (b.start as u64) << 32 | k as u64).collect();
        if !order.is_sorted() {
            order.sort_unstable();
            sorted.boxes = order.into_iter().map(|entry| sorted.boxes[entry as u32 as usize]).collect();
        }
        sorted.close_gaps(&removed);
    }
    sorted
}

/// Sorts the points at some positions. Inside, positions are counted from the first.
struct Sorter<'a> {
    start: usize,
    points: &'a mut [[f64; 2]],
    indices: &'a mut [u32],
    cuts: &'a mut [Cut],
    boxes: Vec<KeyBox>,
    duplicates: Vec<(u32, u32)>,
    /// Ascending positions of duplicates, counted from the first of all.
    removed: Vec<usize>,
}

impl<'a> Sorter<'a> {
    fn new(start: usize, points: &'a mut [[f64; 2]], indices: &'a mut [u32], cuts: &'a mut [Cut]) -> Self {
        Self { start, points, indices, cuts, boxes: Vec::new(), duplicates: Vec::new(), removed: Vec::new() }
    }

    /// Sorters of the runs of some positions, given by their ends.
    fn split(&mut self, within: Range<usize>, ends: &[usize]) -> Vec<Sorter<'_>> {
        let starts = std::iter::once(within.start).chain(ends.iter().copied()).map(|at| self.start + at);
        let ends: Vec<usize> = ends.iter().map(|end| end - within.start).collect();
        let points = parallel::split_at(&mut self.points[within.clone()], &ends);
        let indices = parallel::split_at(&mut self.indices[within.clone()], &ends);
        let cuts = parallel::split_at(&mut self.cuts[within], &ends);
        let parts = starts.zip(points).zip(indices.into_iter().zip(cuts));
        parts.map(|((start, points), (indices, cuts))| Sorter::new(start, points, indices, cuts)).collect()
    }

    /// Sorts points, which are in input order and have indices of their own if they are not all, into some positions, by keys
    /// in the box around them. The cut before the first is left as it is.
    fn key_box(
        &mut self,
        points: &[[f64; 2]],
        bounds: &Bounds<2>,
        indices: Option<&[u32]>,
        to: Range<usize>,
    ) -> KeyBox {
        let bits = key_bits(points.len());
        let exponents = if bits > 0 { Exponents::around(points, bounds, bits) } else { None };
        let (cells, depth) = match (exponents, Quantizer::new(bounds.low, bounds.high, bits)) {
            (Some(exponents), _) => (Cells::Exponents(exponents), exponents::DEPTHS),
            (None, Some(quantizer)) => (Cells::Square(quantizer), 2 * bits),
            (None, None) => (Cells::One, 2 * bits),
        };
        let key_box = KeyBox { start: self.start + to.start, end: self.start + to.end, cells, depth };
        self.boxes.push(key_box);
        if bits == 0 {
            let mut run = [([0.0; 2], 0); UNKEYED_POINTS];
            for (k, (item, &p)) in run.iter_mut().zip(points).enumerate() {
                *item = (p, indices.map_or(k as u32, |indices| indices[k]));
            }
            self.short_run(to.start, &mut run[..points.len()], depth);
            return key_box;
        }
        // An entry holds a key above and a place in `points` below.
        let entry = |key: u32, i: usize| u64::from(key) << 32 | i as u64;
        let mut entries = match cells {
            Cells::One => (0..points.len()).map(|i| entry(0, i)).collect(),
            Cells::Square(quantizer) => parallel::collect(points.len(), |i| {
                let [column, row] = quantizer.cell(points[i]);
                entry(spread(column) << 1 | spread(row), i)
            }),
            Cells::Exponents(exponents) => {
                parallel::collect(points.len(), |i| entry(exponents.key(points[i]), i))
            }
        };
        let key_bits = if let Cells::Exponents(_) = cells { Exponents::KEY_BITS } else { depth };
        radix::sort(&mut entries, key_bits);
        self.put_all_in_order(&key_box, &entries, points, indices, to);
        if let Cells::Exponents(exponents) = cells {
            self.inner_boxes(key_box, exponents, &entries);
        }
        key_box
    }

    /// The boxes nested in a box of exponents, by its sorted entries.
    fn inner_boxes(&mut self, outer: KeyBox, exponents: Exponents, entries: &[u64]) {
        for (inner, [first, last]) in (1..).map_while(|k| exponents.nth_box(k)) {
            let start = outer.start + entries.partition_point(|entry| entry >> 32 < u64::from(first));
            let end = outer.start + entries.partition_point(|entry| entry >> 32 <= u64::from(last));
            let inner_box = KeyBox { start, end, cells: Cells::Exponents(inner), ..outer };
            match self.boxes.last_mut() {
                // Nothing is between the two.
                Some(around) if around.start == start && around.end == end => *around = inner_box,
                _ => self.boxes.push(inner_box),
            }
        }
    }

    /// Writes points, indices and cuts of sorted entries to some positions.
    fn put_all_in_order(
        &mut self,
        key_box: &KeyBox,
        entries: &[u64],
        points: &[[f64; 2]],
        indices: Option<&[u32]>,
        to: Range<usize>,
    ) {
        let parts = parallel::parts(entries.len());
        if parts == 1 {
            return self.put_in_order(key_box, to, entries, 0, points, indices);
        }
        let ends = parallel::even_ends(entries.len(), parts).into_iter();
        let ends: Vec<usize> = ends.map(|end| to.start + end).collect();
        let first = self.start + to.start;
        parallel::map(self.split(to, &ends), |mut task| {
            let from = task.start - first;
            task.put_in_order(key_box, 0..task.points.len(), entries, from, points, indices);
        });
    }

    /// Orders from one of the entries on, by three plain loops, because the points come from everywhere in memory and nothing
    /// should stand in the way of fetching many at once.
    fn put_in_order(
        &mut self,
        key_box: &KeyBox,
        to: Range<usize>,
        entries: &[u64],
        from: usize,
        points: &[[f64; 2]],
        indices: Option<&[u32]>,
    ) {
        for (point, &entry) in self.points[to.clone()].iter_mut().zip(&entries[from..]) {
            *point = points[entry as u32 as usize];
        }
        for (index, &entry) in self.indices[to.clone()].iter_mut().zip(&entries[from..]) {
            *index = indices.map_or(entry as u32, |indices| indices[entry as u32 as usize]);
        }
        // The first of all has none before it.
        let skipped = usize::from(from == 0);
        let pairs = entries[from + skipped - 1..].windows(2);
        let keys = pairs.map(|pair| [pair[0], pair[1]].map(|entry| (entry >> 32) as u32));
        let cuts = self.cuts[to].iter_mut().skip(skipped).zip(keys);
        if let Cells::Exponents(exponents) = key_box.cells {
            cuts.for_each(|(cut, [left, right])| {
                let depth = exponents.cut(left, right) % exponents::DEPTHS;
                *cut = if left == right { Cut::SAME_CELL } else { Cut::at(depth) };
            });
        } else {
            cuts.for_each(|(cut, [left, right])| *cut = Cut::between(left, right, key_box.depth));
        }
    }

    /// Sorts what shares a cell, among the points of a box.
    fn runs(&mut self, within: Range<usize>, key_box: &KeyBox) {
        let parts = parallel::parts(within.len());
        if parts == 1 {
            return self.runs_of_part(within, key_box);
        }
        // Parts end where cells do.
        let mut ends: Vec<usize> = Vec::new();
        for end in parallel::even_ends(within.len(), parts) {
            let from = within.start + end;
            let same = self.cuts[from.min(within.end)..within.end].iter();
            let end = from + same.take_while(|&&cut| cut == Cut::SAME_CELL).count();
            if ends.last().is_none_or(|&last| last < end) {
                ends.push(end);
            }
        }
        let sorted = parallel::map(self.split(within, &ends), |mut task| {
            task.runs_of_part(0..task.points.len(), key_box);
            (task.boxes, task.duplicates, task.removed)
        });
        for (boxes, duplicates, removed) in sorted {
            self.boxes.extend(boxes);
            self.duplicates.extend(duplicates);
            self.removed.extend(removed);
        }
    }

    /// Finds the runs of a part, one after the other.
    fn runs_of_part(&mut self, within: Range<usize>, key_box: &KeyBox) {
        let depth = key_box.depth;
        let all_have_boxes = matches!(key_box.cells, Cells::Exponents(_));
        let mut at = within.start + 1;
        while let Some(found) =
            self.cuts[at.min(within.end)..within.end].iter().position(|&cut| cut == Cut::SAME_CELL)
        {
            let first = at + found - 1;
            let same = self.cuts[first + 1..within.end].iter().take_while(|&&cut| cut == Cut::SAME_CELL);
            let run = first..first + 1 + same.count();
            at = run.end + 1;
            // Most are very short.
            match run.len() {
                _ if all_have_boxes => self.nested_box(run),
                ..=4 => self.run_of_at_most::<4>(run, depth),
                5..=SHORT_RUN => self.run_of_at_most::<SHORT_RUN>(run, depth),
                _ => self.nested_box(run),
            }
        }
    }

    /// Sorts a short run of one cell.
    fn run_of_at_most<const N: usize>(&mut self, run: Range<usize>, depth: u32) {
        let mut items = [([0.0; 2], 0); N];
        for (item, at) in items.iter_mut().zip(run.clone()) {
            *item = (self.points[at], self.indices[at]);
        }
        self.short_run(run.start, &mut items[..run.len()], depth);
    }

    /// Sorts a long run of one cell by keys of its own.
    fn nested_box(&mut self, run: Range<usize>) {
        // The copies are gone before anything is nested deeper.
        let points = parallel::collect(run.len(), |i| self.points[run.start + i]);
        let indices = parallel::collect(run.len(), |i| self.indices[run.start + i]);
        if points.iter().all(|p| *p == points[0]) {
            drop((points, indices));
            run.clone().skip(1).for_each(|at| self.remove(at, run.start));
            return;
        }
        let key_box = self.key_box(&points, &survey(&points).0, Some(&indices), run.clone());
        drop((points, indices));
        self.runs(run, &key_box);
    }

    /// Sorts the points of one cell, with their indices, lexicographically to where they belong, with the cuts of a
    /// balanced tree.
    fn short_run(&mut self, start: usize, run: &mut [([f64; 2], u32)], depth: u32) {
        run.sort_unstable_by(|&(p, i), &(q, j)| {
            // Mostly x tells.
            if p[0] != q[0] {
                return if p[0] < q[0] { Ordering::Less } else { Ordering::Greater };
            }
            (p[1], i).partial_cmp(&(q[1], j)).expect("finite")
        });
        let (mut distinct, mut last) = (0, start);
        for (i, &(point, index)) in run.iter().enumerate() {
            let at = start + i;
            self.points[at] = point;
            self.indices[at] = index;
            if i > 0 && run[i - 1].0 == point {
                self.remove(at, last);
                continue;
            }
            if distinct > 0 {
                self.cuts[at] = Cut::within_cell(distinct, depth);
            }
            (distinct, last) = (distinct + 1, at);
        }
    }

    /// Marks the point at a position as a duplicate of another.
    fn remove(&mut self, at: usize, representative: usize) {
        self.cuts[at] = Cut::DUPLICATE;
        self.removed.push(self.start + at);
        self.duplicates.push((self.indices[at], self.indices[representative]));
    }
}

impl Sorted {
    /// Moves points together where duplicates were.
    fn close_gaps(&mut self, removed: &[usize]) {
        if removed.is_empty() {
            return;
        }
        let Self { points, indices, cuts, boxes, .. } = self;
        let mut to = 0;
        for from in 0..points.len() {
            if cuts[from] != Cut::DUPLICATE {
                (points[to], indices[to], cuts[to]) = (points[from], indices[from], cuts[from]);
                to += 1;
            }
        }
        points.truncate(to);
        indices.truncate(to);
        cuts.truncate(to);
        let moved = |at: usize| at - removed.partition_point(|&removed| removed < at);
        for key_box in boxes {
            (key_box.start, key_box.end) = (moved(key_box.start), moved(key_box.end));
        }
    }
}

/// The bits an axis of the keys of so many points, at most sixteen.
fn key_bits(n: usize) -> u32 {
    if n <= UNKEYED_POINTS {
        return 0; // one cell, sorted by comparison
    }
    let enough = (n.next_power_of_two().ilog2() + 3).div_ceil(2).min(16);
    if n < LONG_KEY_POINTS { enough } else { (radix::passes(2 * enough) * radix::DIGIT_BITS / 2).min(16) }
}

/// Moves bit i to bit 2i.
fn spread(x: u32) -> u32 {
    let x = (x | x << 8) & 0x00ff_00ff;
    let x = (x | x << 4) & 0x0f0f_0f0f;
    let x = (x | x << 2) & 0x3333_3333;
    (x | x << 1) & 0x5555_5555
}

#[cfg(test)]
mod tests {
    use super::{Cut, KeyBox, Sorted, survey};
    use delone_generators::Kind;

    fn sort(points: &[[f64; 2]]) -> Sorted {
        super::sort(points, &survey(points).0)
    }

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

    #[cfg(feature = "rayon")]
    #[test]
    fn threads_never_show() {
        let pool = |threads| rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        let (one, many) = (pool(1), pool(5));
        for &kind in Kind::ALL {
            let points = kind.points(100_000, 3);
            let (a, b) = (one.install(|| sort(&points)), many.install(|| sort(&points)));
            assert!(a.points == b.points && a.indices == b.indices, "{}", kind.name());
            assert!(a.cuts == b.cuts && a.duplicates == b.duplicates, "{}", kind.name());
            let boxes = |s: &super::Sorted| s.boxes.iter().map(|b| format!("{b:?}")).collect::<Vec<_>>();
            assert!(boxes(&a) == boxes(&b), "{}", kind.name());
        }
    }

    /// Every cut separates its two sides: strictly by its axis, or lexicographically in a single cell.
    #[test]
    fn cuts_separate() {
        for &kind in Kind::ALL {
            let sorted = sort(&kind.points(2000, 6));
            for key_box in &sorted.boxes {
                let inside = |b: &KeyBox, at: usize| b.start < at && at < b.end;
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
