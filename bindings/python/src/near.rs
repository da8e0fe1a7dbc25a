//! Queries one near the other: interpolators walk from each to the next, so those in any order are taken along a curve of Morton, and
//! the answers are put back. Cost: a sort.

use delone::Coordinates;
use rayon::prelude::*;

/// Queries, up to which they are answered in the order given; more are first sorted along a curve. Results are the same.
const UNSORTED_QUERIES: usize = 64;
/// Bits of the cells along an axis.
const BITS: u32 = 16;

/// Queries in an order in which they are near each other.
pub struct Near<P> {
    pub queries: Vec<P>,
    /// Of each its place among those given; empty if they are as they were given.
    places: Vec<u32>,
}

impl<P: Coordinates + Send + Sync> Near<P> {
    /// Sorts them, by the threads of whoever calls if there are many.
    pub fn new(queries: Vec<P>) -> Self {
        if queries.len() < UNSORTED_QUERIES || u32::try_from(queries.len()).is_err() {
            return Self { queries, places: Vec::new() };
        }
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for q in &queries {
            for (k, &x) in q.as_ref().iter().enumerate() {
                (low[k], high[k]) = (low[k].min(x), high[k].max(x));
            }
        }
        // Halves cannot overflow. What is not in range, or no number, is in some cell.
        let scale = [0, 1, 2].map(|k| f64::from((1_u32 << BITS) - 1) / (high[k] / 2.0 - low[k] / 2.0));
        let key = |(place, q): (usize, &P)| {
            let cells =
                q.as_ref().iter().enumerate().map(|(k, x)| ((x / 2.0 - low[k] / 2.0) * scale[k]) as u64);
            let spread =
                |cell: u64| (0..BITS).map(move |bit| ((cell >> bit) & 1) << (bit as usize * P::COUNT));
            let key: u64 = cells.enumerate().map(|(k, cell)| spread(cell).sum::<u64>() << k).sum();
            (key, place as u32)
        };
        let mut keys: Vec<(u64, u32)> = queries.iter().enumerate().map(key).collect();
        if keys.len() < crate::pool::SERIAL_ITEMS {
            keys.sort_unstable();
        } else {
            keys.par_sort_unstable();
        }
        let places: Vec<u32> = keys.into_iter().map(|(_, place)| place).collect();
        Self { queries: places.iter().map(|&place| queries[place as usize]).collect(), places }
    }

    /// Rows of so many columns, one for each query, in the order given.
    pub fn back(&self, rows: Vec<f64>, columns: usize) -> Vec<f64> {
        if self.places.is_empty() || columns == 0 {
            return rows;
        }
        let mut result = vec![0.0; rows.len()];
        for (row, &place) in rows.chunks_exact(columns).zip(&self.places) {
            result[place as usize * columns..][..columns].copy_from_slice(row);
        }
        result
    }

    /// For each query given its place here.
    pub fn order(&self) -> Vec<usize> {
        let mut order: Vec<usize> = (0..self.queries.len()).collect();
        for (here, &place) in self.places.iter().enumerate() {
            order[place as usize] = here;
        }
        order
    }
}
