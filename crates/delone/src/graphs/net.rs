//! Who is joined with whom, for searches that ask each vertex several times: coordinates and neighbors of all vertices, in
//! the order in which a curve comes to them, so that what is near is near in memory.

use std::collections::BTreeSet;
use std::ops::Range;

use super::Sites;
use crate::ids::Place;
use crate::parallel;
use crate::prefetch::prefetch;

/// The vertices with their neighbors; each is known by its rank in the order.
pub(crate) struct Net<const D: usize> {
    /// For each rank a place, and its coordinates.
    places: Vec<Place>,
    pub(super) points: Vec<[f64; D]>,
    /// For each place a rank.
    ranks: Vec<u32>,
    /// For each rank where its neighbors begin; those of the next one follow.
    starts: Vec<usize>,
    joined: Vec<u32>,
}

impl<const D: usize> Net<D> {
    pub(crate) fn of(sites: &(impl Sites<D> + ?Sized)) -> Self {
        let places = sites.along_curve();
        let mut ranks = vec![u32::MAX; sites.place_count()];
        places.iter().enumerate().for_each(|(rank, v)| ranks[v.index()] = rank as u32);
        let from = sites.points();
        let points = parallel::collect(places.len(), |rank| {
            if let Some(next) = places.get(rank + 32) {
                prefetch(from, next.index());
            }
            from[places[rank].index()]
        });
        let part = |range: Range<usize>| {
            let (mut joined, mut degrees) = (Vec::new(), Vec::with_capacity(range.len()));
            for &v in &places[range] {
                let before = joined.len();
                sites.beside(v, |w| joined.push(ranks[w.index()]));
                degrees.push(joined.len() - before);
            }
            (joined, degrees)
        };
        let parts = parallel::map(parallel::ranges(places.len()), part);
        let mut starts = Vec::with_capacity(places.len() + 1);
        let mut sum = 0;
        starts.push(sum);
        for degree in parts.iter().flat_map(|(_, degrees)| degrees) {
            sum += degree;
            starts.push(sum);
        }
        let mut joined = Vec::with_capacity(sum);
        parts.into_iter().for_each(|(part, _)| joined.extend(part));
        Self { places, points, ranks, starts, joined }
    }

    #[inline]
    pub(super) fn neighbors(&self, rank: u32) -> &[u32] {
        &self.joined[self.starts[rank as usize]..self.starts[rank as usize + 1]]
    }

    #[inline]
    pub(super) fn point(&self, rank: u32) -> &[f64; D] {
        &self.points[rank as usize]
    }

    #[inline]
    pub(super) fn ranks(&self, edge: [Place; 2]) -> [u32; 2] {
        edge.map(|v| self.ranks[v.index()])
    }

    /// Works on consecutive ranks on all threads, and gathers edges in the order of ranks.
    pub(super) fn gather(&self, work: impl Fn(Range<u32>) -> Vec<[u32; 2]> + Send + Sync) -> Vec<[Place; 2]> {
        let places = |edge: [u32; 2]| edge.map(|rank| self.places[rank as usize]);
        let part = |range: Range<usize>| -> Vec<[Place; 2]> {
            work(range.start as u32..range.end as u32).into_iter().map(places).collect()
        };
        parallel::map(parallel::ranges(self.places.len()), part).concat()
    }
}

/// Vertices met in a search of few, by the last digits of their ranks.
pub(super) struct Met {
    /// Of each slot the search that used it last, and for whom.
    slots: Vec<(u32, u32)>,
    search: u32,
    count: usize,
    many: BTreeSet<u32>,
}

impl Met {
    /// The number of slots, of which half are used before what is met is kept in a tree.
    const SLOTS: usize = 256;

    pub(super) fn new() -> Self {
        Self { slots: vec![(0, 0); Self::SLOTS], search: 0, count: 0, many: BTreeSet::new() }
    }

    /// Starts a search.
    pub(super) fn clear(&mut self) {
        if self.search == u32::MAX {
            self.slots.fill((0, 0));
            self.search = 0;
        }
        self.search += 1;
        self.count = 0;
        self.many.clear();
    }

    /// Whether this is the first time.
    #[inline]
    pub(super) fn insert(&mut self, rank: u32) -> bool {
        let mut k = rank as usize % Self::SLOTS;
        while self.slots[k].0 == self.search {
            if self.slots[k].1 == rank {
                return false;
            }
            k = (k + 1) % Self::SLOTS;
        }
        if self.count < Self::SLOTS / 2 {
            self.count += 1;
            self.slots[k] = (self.search, rank);
            return true;
        }
        self.many.insert(rank)
    }
}
