//! What several threads of Python ask at once, and one may change: changes wait for those who ask, and those who ask for changes.
//!
//! Nobody waits with Python's lock, and Ctrl-C ends the wait. In the child of a fork the threads of the parent are gone, and what they
//! held stays held: there a wait that has no end is an error that says so.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{RwLock, RwLockReadGuard, RwLockWriteGuard, TryLockError, TryLockResult};
use std::thread;
use std::time::Duration;

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;

use crate::pool::generation;

/// How long to wait before asking again: short beside what people notice (a tenth of a second), long beside a query (microseconds).
const PAUSE: Duration = Duration::from_millis(1);
/// Pauses after which a child gives up: about a second.
const PAUSES_OF_A_CHILD: usize = 1000;

/// Something that is asked by many and changed by one.
pub struct Shared<T> {
    content: RwLock<T>,
    /// Changes that wait. Who comes to ask lets them go first, or many who ask would keep them waiting.
    changes: AtomicUsize,
    /// The process that it was made in.
    generation: usize,
}

impl<T> Shared<T> {
    pub fn new(content: T) -> Self {
        Self { content: RwLock::new(content), changes: AtomicUsize::new(0), generation: generation() }
    }

    /// To ask.
    pub fn read(&self, py: Python<'_>) -> PyResult<RwLockReadGuard<'_, T>> {
        let is_changed = || self.changes.load(Ordering::Relaxed) > 0 && self.generation == generation();
        let lock = || if is_changed() { Err(TryLockError::WouldBlock) } else { self.content.try_read() };
        self.wait(py, lock)
    }

    /// To change.
    pub fn write(&self, py: Python<'_>) -> PyResult<RwLockWriteGuard<'_, T>> {
        self.changes.fetch_add(1, Ordering::Relaxed);
        let guard = self.wait(py, || self.content.try_write());
        self.changes.fetch_sub(1, Ordering::Relaxed);
        guard
    }

    fn wait<G>(&self, py: Python<'_>, lock: impl Fn() -> TryLockResult<G>) -> PyResult<G> {
        let mut pauses = 0;
        loop {
            match lock() {
                Ok(guard) => return Ok(guard),
                Err(TryLockError::Poisoned(_)) => {
                    return Err(PyRuntimeError::new_err("a change of this did not end: make it anew"));
                }
                Err(TryLockError::WouldBlock) => {}
            }
            py.check_signals()?;
            if self.generation != generation() && pauses > PAUSES_OF_A_CHILD {
                return Err(PyRuntimeError::new_err(
                    "this process was forked while another thread asked or changed this: make it anew, or start processes by \"spawn\"",
                ));
            }
            py.detach(|| thread::sleep(PAUSE));
            pauses += 1;
        }
    }
}
