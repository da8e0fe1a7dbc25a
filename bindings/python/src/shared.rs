//! Content that several threads of Python read at once and one may change: changes wait for readers, and readers for changes.
//!
//! Whoever asks owns a share of the content, and whoever changes owns all of it, so that either may go on in the background after
//! Ctrl-C: the content comes back when a change ends, however its caller fared.
//!
//! Nobody waits with Python's lock or with a share, and Ctrl-C ends the wait. In the child of a fork the threads of the parent are gone, and
//! what they held stays held: there a wait that has no end is an error that says so.

use std::mem::replace;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, TryLockError};
use std::thread;
use std::time::Duration;

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;

use crate::interrupt::interruptible;
use crate::pool::generation;

/// How long to wait before asking again: short beside what people notice (a tenth of a second), long beside a query (microseconds).
const PAUSE: Duration = Duration::from_millis(1);
/// Pauses after which a child gives up: about a second.
const PAUSES_OF_A_CHILD: usize = 1000;

/// Something that is asked by many and changed by one.
pub struct Shared<T>(Arc<Place<T>>);

struct Place<T> {
    content: Mutex<Content<T>>,
    /// Changes that wait. Who comes to ask lets them go first, or many who ask would keep them waiting.
    changes: AtomicUsize,
    /// The process that it was made in.
    generation: usize,
}

enum Content<T> {
    Ready(Arc<T>),
    /// A change has it.
    Away,
    /// A change did not end.
    Lost,
}

impl<T: Send + Sync + 'static> Shared<T> {
    pub fn new(content: T) -> Self {
        let content = Mutex::new(Content::Ready(Arc::new(content)));
        Self(Arc::new(Place { content, changes: AtomicUsize::new(0), generation: generation() }))
    }

    /// A share of it, for what is short: a change waits until it is dropped.
    pub fn read(&self, py: Python<'_>) -> PyResult<Arc<T>> {
        self.read_when(py, |content| Ok(Some(Arc::clone(content))))
    }

    /// Runs work on it, as soon as it can be read.
    pub fn read_when<G>(
        &self,
        py: Python<'_>,
        ready: impl Fn(&Arc<T>) -> PyResult<Option<G>>,
    ) -> PyResult<G> {
        let place = &*self.0;
        place.wait(py, false, |content| match content {
            Content::Ready(content) if !place.is_to_change() => ready(content),
            _ => Ok(None),
        })
    }

    /// The answer to a question that may be long; how long, its size says.
    pub fn ask<A: Send + 'static>(
        &self,
        py: Python<'_>,
        size: impl FnOnce(&T) -> usize,
        question: impl FnOnce(&T) -> A + Send + 'static,
    ) -> PyResult<A> {
        let content = self.read(py)?;
        let size = size(&content);
        interruptible(py, size, move || question(&content))
    }

    /// Changes it alone. Ctrl-C ends the wait for the turn; after that the wait for the change, which goes on to its end.
    pub fn change<A: Send + 'static>(
        &self,
        py: Python<'_>,
        size: impl FnOnce(&T) -> usize,
        change: impl FnOnce(&mut T) -> A + Send + 'static,
    ) -> PyResult<A> {
        let mut content = self.take(py)?;
        let (size, place) = (size(&content), Arc::clone(&self.0));
        interruptible(py, size, move || {
            let answer = catch_unwind(AssertUnwindSafe(|| change(&mut content)));
            place.put(if answer.is_ok() { Content::Ready(Arc::new(content)) } else { Content::Lost });
            answer.unwrap_or_else(|panic| resume_unwind(panic))
        })
    }

    /// Puts other content in its place.
    pub fn replace(&self, py: Python<'_>, content: T) -> PyResult<()> {
        self.change(py, |_| 0, |held| *held = content)
    }

    fn take(&self, py: Python<'_>) -> PyResult<T> {
        self.0.wait(py, true, |content| match replace(content, Content::Away) {
            Content::Ready(shared) => match Arc::try_unwrap(shared) {
                Ok(alone) => Ok(Some(alone)),
                Err(shared) => {
                    *content = Content::Ready(shared);
                    Ok(None)
                }
            },
            other => {
                *content = other;
                Ok(None)
            }
        })
    }
}

impl<T> Place<T> {
    fn is_to_change(&self) -> bool {
        self.changes.load(Ordering::Relaxed) > 0 && self.generation == generation()
    }

    /// Tries until there is something; a change counts as one that waits.
    fn wait<G>(
        &self,
        py: Python<'_>,
        is_change: bool,
        try_it: impl Fn(&mut Content<T>) -> PyResult<Option<G>>,
    ) -> PyResult<G> {
        let (mut pauses, mut turn) = (0, None);
        loop {
            if let Some(mut content) = self.lock_now() {
                if matches!(*content, Content::Lost) {
                    return Err(PyRuntimeError::new_err("a change of this did not end: make it anew"));
                }
                if let Some(found) = try_it(&mut content)? {
                    return Ok(found);
                }
            }
            // A handler of signals may ask, on this thread: it must not wait for a change that waits for the handler.
            drop(turn.take());
            py.check_signals()?;
            if self.generation != generation() && pauses > PAUSES_OF_A_CHILD {
                return Err(PyRuntimeError::new_err(
                    "this process was forked while another thread asked or changed this: make it anew, or start processes by \"spawn\"",
                ));
            }
            turn = is_change.then(|| Turn::new(&self.changes));
            py.detach(|| thread::sleep(PAUSE));
            pauses += 1;
        }
    }

    /// The lock is held for moments, but in the child of a fork for ever if it was held then.
    fn lock_now(&self) -> Option<MutexGuard<'_, Content<T>>> {
        match self.content.try_lock() {
            Ok(content) => Some(content),
            Err(TryLockError::Poisoned(content)) => Some(content.into_inner()),
            Err(TryLockError::WouldBlock) => None,
        }
    }

    fn put(&self, content: Content<T>) {
        *self.content.lock().unwrap_or_else(PoisonError::into_inner) = content;
    }
}

/// A change that waits.
struct Turn<'a>(&'a AtomicUsize);

impl<'a> Turn<'a> {
    fn new(changes: &'a AtomicUsize) -> Self {
        changes.fetch_add(1, Ordering::Relaxed);
        Self(changes)
    }
}

impl Drop for Turn<'_> {
    fn drop(&mut self) {
        self.0.fetch_sub(1, Ordering::Relaxed);
    }
}
