//! Sides of faces, gathered: who has the same side is found in the bucket of its first corner.
//!
//! Cost: O(n) and a sort of each bucket, which are short where degrees are; on all threads but for filling.

use std::ops::Range;

use crate::ids::Place;
use crate::parallel;

/// For each vertex what has it as first corner.
pub(super) struct Buckets<E> {
    starts: Vec<usize>,
    entries: Vec<E>,
}

impl<E: Copy + Default + Ord + Send + Sync> Buckets<E> {
    /// Puts M entries for each of `count` faces into the buckets of vertices, whose places are below `places`.
    pub(super) fn new<const M: usize>(
        places: usize,
        count: usize,
        entries_of: impl Fn(usize) -> [(Place, E); M],
    ) -> Self {
        let mut starts = vec![0; places + 1];
        for (first, _) in (0..count).flat_map(&entries_of) {
            starts[first.index() + 1] += 1;
        }
        for i in 0..places {
            starts[i + 1] += starts[i];
        }
        let mut next = starts.clone();
        let mut entries = parallel::filled(E::default(), M * count);
        for (first, entry) in (0..count).flat_map(&entries_of) {
            let place = &mut next[first.index()];
            entries[*place] = entry;
            *place += 1;
        }
        Self { starts, entries }
    }

    /// Gives each bucket, sorted, to `work` with what it makes of a part of them; these are in the order of the vertices.
    pub(super) fn in_parts<R: Default + Send>(
        mut self,
        work: impl Fn(Place, &[E], &mut R) + Send + Sync,
    ) -> Vec<R> {
        let places = self.starts.len() - 1;
        let parts = parallel::parts(self.entries.len());
        let ends = parallel::even_ends(places, parts);
        let entry_ends: Vec<usize> = ends.iter().map(|&end| self.starts[end]).collect();
        let slices = parallel::split_at(&mut self.entries, &entry_ends);
        let starts = &self.starts;
        let ranges = ends.iter().scan(0, |start, &end| Some(std::mem::replace(start, end)..end));
        let tasks: Vec<(Range<usize>, &mut [E])> = ranges.zip(slices).collect();
        parallel::map(tasks, |(range, entries)| {
            let mut made = R::default();
            let from = starts[range.start];
            for v in range {
                let bucket = &mut entries[starts[v] - from..starts[v + 1] - from];
                bucket.sort_unstable();
                work(Place::new(v), bucket, &mut made);
            }
            made
        })
    }
}
