//! How memory is shared: among workers, into tiles, for joins.
//!
//! Bytes a point are what was measured, rounded up; a test of the program holds the sum to what was asked.

use std::path::Path;

use crate::message::Failure;

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
pub(super) struct Budget {
    memory: u64,
    workers: u64,
    /// Points of a tile at most, where somebody says.
    said: Option<u64>,
}

impl Budget {
    pub(super) fn new(memory: u64, workers: usize, said: Option<usize>) -> Result<Self, Failure> {
        if memory < LEAST {
            let what =
                format!("--memory {} is not enough: {} are the least", in_words(memory), in_words(LEAST));
            return Err(Failure::usage(what, "allow more memory, as in --memory 1G"));
        }
        if said == Some(0) {
            return Err(Failure::usage("--tile 0: a tile has at least one point", "give a larger number"));
        }
        Ok(Self { memory, workers: workers.max(1) as u64, said: said.map(|said| said as u64) })
    }

    fn free(&self) -> u64 {
        self.memory - ITSELF
    }

    /// Points of a tile at most.
    pub(super) fn most(&self) -> u64 {
        let by_memory = (self.free() / self.workers / OF_TILE).min(LARGEST);
        self.said.map_or(by_memory, |said| said.min(self.free() / OF_TILE))
    }

    /// How many tiles to cut so many points into: samples are not exact, so a tile is not meant to be full.
    pub(super) fn tiles(&self, points: u64) -> usize {
        let most = self.most();
        if points <= most { 1 } else { points.div_ceil((most * 4 / 5).max(1)) as usize }
    }

    /// How many points to draw a sample from, about: at most twice as many are kept.
    pub(super) fn sample(&self) -> usize {
        (self.memory / 1024).min(1 << 19) as usize
    }

    /// Bytes that a bucket of so many gathers before they are written.
    pub(super) fn buffer(&self, buckets: usize) -> usize {
        (self.free() / 4 / buckets.max(1) as u64).clamp(1 << 12, 1 << 20) as usize
    }

    /// Workers that can have a tile of so many points each, as the largest bucket has; an error if not even one can.
    pub(super) fn workers(&self, largest: u64, bucket: &Path) -> Result<usize, Failure> {
        let workers = (self.free() / largest.saturating_mul(OF_TILE).max(1)).min(self.workers);
        if workers == 0 {
            let needed = largest.saturating_mul(OF_TILE).saturating_add(ITSELF);
            let what = format!(
                "{} has {largest} points, which take {}, and --memory allows {}",
                bucket.display(),
                in_words(needed),
                in_words(self.memory)
            );
            let help = format!("go on with --resume --memory {}, or start again", in_words(needed));
            return Err(Failure::new(what, help));
        }
        Ok(workers as usize)
    }

    /// Whether borders of so many points can be joined at once.
    pub(super) fn can_join(&self, points: u64) -> bool {
        points * OF_JOIN <= self.free()
    }

    /// Why they cannot, and what to do.
    pub(super) fn cannot_join(&self, node: u32, points: u64, all: u64) -> Failure {
        let needed = points * OF_JOIN + ITSELF;
        let share = 100.0 * points as f64 / all.max(1) as f64;
        let what = format!(
            "the borders that meet at node {node} have {points} points, {share:.1}% of all: to join them takes {}, and \
             --memory allows {}",
            in_words(needed),
            in_words(self.memory)
        );
        let help = format!(
            "go on with --resume --memory {}; borders are small unless points lie on few circles or lines",
            in_words(needed)
        );
        Failure::new(what, help)
    }
}

/// Bytes as `--memory` takes them, rounded up.
pub(super) fn in_words(bytes: u64) -> String {
    if bytes < 1 << 20 {
        return format!("{}K", bytes.div_ceil(1 << 10));
    }
    let megabytes = bytes.div_ceil(1 << 20);
    if megabytes < 10_000 { format!("{megabytes}M") } else { format!("{}G", megabytes.div_ceil(1 << 10)) }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::{Budget, in_words};

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
        assert_eq!(
            (in_words(1), in_words(64 << 20), in_words(20 << 30)),
            ("1K".into(), "64M".into(), "20G".into())
        );
    }
}
