//! How memory is shared: among workers, into tiles, for joins.
//!
//! Bytes a point are what was measured, rounded up; a test of the program holds the sum to what was asked.

use std::path::Path;

use crate::error::Error;

/// Bytes of a point while its tile is triangulated, read and written, at most.
const OF_TILE: u64 = 150;
/// Bytes of a border's point while borders are joined, at most.
const OF_JOIN: u64 = 300;
/// The program itself, and what files are read and written through.
const ITSELF: u64 = 40 << 20;
/// With less there would be more seams than tiles.
const LEAST: u64 = 64 << 20;
/// Larger tiles gain nothing.
const LARGEST: u64 = 4_000_000;

/// The limits of a run.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Budget {
    memory: u64,
    workers: u64,
    /// Points of a tile at most, where somebody says.
    said: Option<u64>,
}

impl Budget {
    pub(crate) fn new(memory: u64, workers: usize, said: Option<usize>) -> Result<Self, Error> {
        if memory < LEAST {
            return Err(Error::LittleMemory { memory, least: LEAST });
        }
        if said == Some(0) {
            return Err(Error::EmptyTiles);
        }
        Ok(Self { memory, workers: workers.max(1) as u64, said: said.map(|said| said as u64) })
    }

    fn free(&self) -> u64 {
        self.memory - ITSELF
    }

    /// Points of a tile at most.
    pub(crate) fn most(&self) -> u64 {
        let by_memory = (self.free() / self.workers / OF_TILE).min(LARGEST);
        self.said.map_or(by_memory, |said| said.min(self.free() / OF_TILE))
    }

    /// How many tiles to cut so many points into: samples are not exact, so a tile is not meant to be full.
    pub(crate) fn tiles(&self, points: u64) -> usize {
        let most = self.most();
        if points <= most { 1 } else { points.div_ceil((most * 4 / 5).max(1)) as usize }
    }

    /// How many points to draw a sample from, about: at most twice as many are kept.
    pub(crate) fn sample(&self) -> usize {
        (self.memory / 1024).min(1 << 19) as usize
    }

    /// Bytes that a bucket of so many gathers before they are written.
    pub(crate) fn buffer(&self, buckets: usize) -> usize {
        (self.free() / 4 / buckets.max(1) as u64).clamp(1 << 12, 1 << 20) as usize
    }

    /// Workers that can have a tile of so many points each, as the largest bucket has; an error if not even one can.
    pub(crate) fn workers(&self, largest: u64, bucket: &Path) -> Result<usize, Error> {
        let workers = (self.free() / largest.saturating_mul(OF_TILE).max(1)).min(self.workers);
        if workers == 0 {
            return Err(Error::LargeTile {
                path: bucket.to_owned(),
                points: largest,
                needed: largest.saturating_mul(OF_TILE).saturating_add(ITSELF),
                memory: self.memory,
            });
        }
        Ok(workers as usize)
    }

    /// Whether borders of so many points can be joined at once.
    pub(crate) fn can_join(&self, points: u64) -> bool {
        points * OF_JOIN <= self.free()
    }

    /// Why they cannot.
    pub(crate) fn cannot_join(&self, node: u32, points: u64, all: u64) -> Error {
        let share = 100.0 * points as f64 / all.max(1) as f64;
        Error::LargeJoin { node, points, share, needed: points * OF_JOIN + ITSELF, memory: self.memory }
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::Budget;

    #[test]
    fn tiles_fit_into_memory() {
        let budget = Budget::new(1 << 30, 2, None).expect("enough");
        assert!(budget.most() * 2 * 150 <= 1 << 30);
        assert_eq!(budget.tiles(1000), 1);
        assert!(budget.tiles(1_000_000_000) as u64 * budget.most() > 1_000_000_000);
        let workers = |largest: u64| budget.workers(largest, Path::new("bucket")).ok();
        assert_eq!([1000, 5_000_000, 50_000_000].map(workers), [Some(2), Some(1), None]);
        assert!(Budget::new(1 << 20, 1, None).is_err());
        let small = Budget::new(64 << 20, 1, Some(10)).expect("enough");
        assert_eq!((small.most(), small.tiles(10), small.tiles(100)), (10, 1, 13));
    }
}
