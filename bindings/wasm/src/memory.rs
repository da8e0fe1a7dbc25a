//! Memory is asked for before long work starts: the library, which takes it piece by piece, would end in a trap.

use std::hint::black_box;

use crate::fault::Fault;

/// Bytes for a point: triangulating it, and the arrays that are handed out. Measured by `test/memory.test.mjs`, and some more.
pub const TRIANGULATION: usize = 200;
/// Bytes for a cell of a point.
pub const CELLS: usize = 200;
/// For a point with a weight, and its cell.
#[cfg(feature = "weights")]
pub const WEIGHTED: usize = 600;
/// For a point among constraints.
#[cfg(feature = "constraints")]
pub const CONSTRAINED: usize = 400;

/// Refuses work on so many items of so many bytes if there is no memory for it.
pub fn check(items: usize, bytes: usize) -> Result<(), Fault> {
    let bytes = items.saturating_mul(bytes);
    let mut room = Vec::<u8>::new();
    black_box(&mut room).try_reserve_exact(bytes).map_err(|_| Fault::memory(bytes))
}
