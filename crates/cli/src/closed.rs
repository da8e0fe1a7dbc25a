//! Whether standard output was closed when the program was started (`>&-`): then what goes there is lost.
//!
//! Before `main` the standard library opens `/dev/null` in its place, which nobody can tell from one that a user named. So this looks
//! before that.

#[cfg(unix)]
use std::sync::atomic::{AtomicBool, Ordering};

#[cfg(unix)]
static IS_CLOSED: AtomicBool = AtomicBool::new(false);

#[cfg(unix)]
ctor::declarative::ctor! {
    /// One call of the system; nothing of the standard library is there yet.
    #[ctor(unsafe)]
    fn look() {
        IS_CLOSED.store(rustix::io::fcntl_getfd(rustix::stdio::stdout()).is_err(), Ordering::Relaxed);
    }
}

#[cfg(unix)]
fn is_closed() -> bool {
    IS_CLOSED.load(Ordering::Relaxed)
}

#[cfg(not(unix))]
fn is_closed() -> bool {
    false
}

/// An error if what is written to standard output is lost.
pub(crate) fn check() -> std::io::Result<()> {
    if is_closed() { Err(std::io::Error::other("standard output is closed")) } else { Ok(()) }
}
