//! The child of a fork goes on to a pool of its own.

#![allow(unsafe_code, reason = "the system is told what to do after a fork")]

/// Sees to it that [`after_fork`](crate::after_fork) is called in each child of a fork from now on, where the system has forks. A library that calls this
/// must stay loaded as long as the process lives. Calls after the first do nothing.
#[cfg(unix)]
pub fn survive_forks() {
    use std::sync::Once;
    static REGISTERED: Once = Once::new();
    extern "C" fn in_child() {
        crate::after_fork();
    }
    REGISTERED.call_once(|| {
        // SAFETY: the handler takes no lock that a thread of the parent may hold: it counts, and makes an empty slot. It is there as long as the
        // process, as the library stays loaded. Without memory for it a child waits for threads that it has not; nothing else is to be done.
        let _ = unsafe { libc::pthread_atfork(None, None, Some(in_child)) };
    });
}

/// Does nothing: there are no forks.
#[cfg(not(unix))]
pub fn survive_forks() {}
