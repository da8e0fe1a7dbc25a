//! Permutations of points: the orders in which algorithms visit them. Knows coordinates, no mesh.

pub(crate) mod cuts;
mod exponents;
pub(crate) mod morton;
pub(crate) mod plane;
pub(crate) mod quantize;
mod radix;
pub(crate) mod random;
pub(crate) mod space;

/// In which order centers are inserted, and instances after them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum HintOrder {
    /// At random.
    Random {
        /// Decides the order.
        seed: u64,
    },
    /// In biased random rounds, each along a curve: the faster one.
    Spatial {
        /// Decides the rounds.
        seed: u64,
    },
}

impl Default for HintOrder {
    fn default() -> Self {
        Self::Spatial { seed: 0 }
    }
}
