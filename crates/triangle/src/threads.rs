//! The threads that work is done on: a pool of the library alone, which a forked process makes anew.

use delone_pool::alone;

use crate::switches::Switches;

/// Does work in the pool, or on the calling thread: where a caller's test is asked, which may belong to that thread, and where there is too
/// little to be shared.
pub(crate) fn run<T: Send>(s: &Switches, points: usize, work: impl FnOnce() -> T + Send) -> T {
    delone_pool::survive_forks();
    // Meshes may have more points than they were made of.
    let items = if s.quality { usize::MAX } else { points };
    if s.user { alone(work) } else { delone_pool::run(items, work) }
}
