//! The threads that work runs on: a pool of this library alone, and a new one in the child of a fork.

use std::sync::Once;

/// Does work in the pool.
pub(crate) fn run<T: Send>(work: impl FnOnce() -> T + Send) -> T {
    static HANDLER: Once = Once::new();
    HANDLER.call_once(watch_forks);
    match delone_pool::pool() {
        Some(pool) => pool.install(work),
        None => delone_pool::alone(work),
    }
}

#[cfg(unix)]
fn watch_forks() {
    extern "C" fn in_child() {
        delone_pool::after_fork();
    }
    // SAFETY: the handler takes no lock that a thread of the parent may hold: it counts, and makes an empty slot. The library is never unloaded.
    // Without room for a handler a child that forks after parallel work has to do without.
    let _ = unsafe { libc::pthread_atfork(None, None, Some(in_child)) };
}

#[cfg(not(unix))]
fn watch_forks() {}
