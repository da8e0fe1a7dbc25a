//! Memory is asked for before long work starts: the engine, which takes it piece by piece, ends the process where there is none.

use std::hint::black_box;

/// Whether there is room for so many bytes at the moment. A system that promises more memory than it has says yes.
pub fn has_room(bytes: usize) -> bool {
    // Seen by nobody, the question would be optimized away.
    black_box(&mut Vec::<u8>::new()).try_reserve_exact(bytes).is_ok()
}
