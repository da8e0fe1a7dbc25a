//! How many decisions each stage made.
//!
//! Off by default and then free: counting is empty without the feature `counters`. Each thread has numbers of its own.

/// A predicate that is counted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Predicate {
    /// Orientation of three points.
    Orient2d,
    /// In-circle test of four points.
    InCircle,
}

/// The stage that decided, in the order in which they are asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Floating point with an error bound, or floating point that is exact on a small grid.
    Filter,
    /// Signs of differences alone.
    Signs,
    /// 64- to 256-bit integers.
    Integers,
    /// Floating-point expansions (the `robust` crate).
    Expansions,
    /// Floating point once more, each row of the determinant scaled by itself.
    Scaled,
    /// Arbitrary precision.
    Big,
    /// The canonical perturbation; the exact stage before it is counted too.
    Perturb,
}

/// Counts by predicate and stage.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts([[u64; 7]; 2]);

impl Counts {
    /// The number of decisions of `predicate` at `stage`.
    pub fn get(&self, predicate: Predicate, stage: Stage) -> u64 {
        self.0[predicate as usize][stage as usize]
    }
}

#[cfg(any(test, feature = "counters"))]
mod on {
    use super::{Counts, Predicate, Stage};
    use std::cell::Cell;

    thread_local! {
        static COUNTS: Cell<Counts> = const { Cell::new(Counts([[0; 7]; 2])) };
    }

    #[inline]
    pub(crate) fn count(predicate: Predicate, stage: Stage) {
        let mut counts = COUNTS.get();
        counts.0[predicate as usize][stage as usize] += 1;
        COUNTS.set(counts);
    }

    /// Counts of this thread since it started or since the last call, which resets them.
    pub fn take() -> Counts {
        COUNTS.take()
    }
}

#[cfg(not(any(test, feature = "counters")))]
mod on {
    use super::{Predicate, Stage};

    #[inline]
    pub(crate) fn count(_: Predicate, _: Stage) {}
}

pub(crate) use on::count;
#[cfg(any(test, feature = "counters"))]
pub use on::take;
