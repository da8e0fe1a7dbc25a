//! The threads that work is done on: a pool of the library alone, which a forked process makes anew.

#![allow(unsafe_code, reason = "the system is told what to do after a fork")]

use delone_pool::{SERIAL_ITEMS, alone, pool};

use crate::switches::Switches;

/// Registers, once, that the child of a fork goes on to a pool of its own.
#[cfg(unix)]
fn survive_forks() {
    use std::sync::Once;
    static REGISTERED: Once = Once::new();
    extern "C" fn child() {
        delone_pool::after_fork();
    }
    REGISTERED.call_once(|| {
        // SAFETY: the handler lasts as long as the process, as the library is never unloaded.
        // Without memory for it a forked process would wait for ever; there is nothing else to be done.
        let _ = unsafe { libc::pthread_atfork(None, None, Some(child)) };
    });
}

#[cfg(not(unix))]
fn survive_forks() {}

/// Does work in the pool, or on the calling thread: where a caller's test is asked, which may belong to that thread, and where there is too
/// little to be shared.
pub(crate) fn run<T: Send>(s: &Switches, points: usize, work: impl FnOnce() -> T + Send) -> T {
    survive_forks();
    let is_little = points < SERIAL_ITEMS && !s.quality;
    match pool().filter(|_| !s.user && !is_little) {
        Some(pool) => pool.install(work),
        None => alone(work),
    }
}
