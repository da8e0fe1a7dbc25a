//! Long work that Ctrl-C ends: every call that may be long goes through [`while_wanted`].
//!
//! Work owns all that it needs, so that it can go on when its caller is gone. The caller holds nothing meanwhile: a handler of signals,
//! which runs on the caller's thread, may ask and change whatever the work is about, and waits for the work at most.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, sync_channel};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;

use crate::pool::{SERIAL_ITEMS, alone, generation, pool, shared};

/// How often to look for signals.
const PAUSE: Duration = Duration::from_millis(50);

/// The size of work that is long whatever it is about.
pub const LONG: usize = usize::MAX;

/// Queries of the first piece, and as many as are answered without a thread: the slowest, of a thousand neighbors each, take 0.1 ms.
const FIRST: usize = 1 << 10;

/// Whether somebody still waits for work.
pub struct Wanted(Option<Arc<AtomicBool>>);

impl Wanted {
    pub fn is(&self) -> bool {
        self.0.as_ref().is_none_or(|wanted| wanted.load(Ordering::Relaxed))
    }
}

/// How large work on queries is, if each has so many answers at most.
pub fn size_of_queries(count: usize, each: usize) -> usize {
    if count > FIRST { LONG } else { count.saturating_mul(each) }
}

/// How large work is that puts points where there are some: in space each may have simplices with all others.
pub fn size_of_points(dimension: usize, there: usize, more: usize) -> usize {
    let all = there.saturating_add(more);
    if dimension == 2 { all } else { all.max(all.saturating_mul(more) / 12) }
}

/// The answers to items in their order, piece by piece, each on all threads if it is two tasks at least; the first error of any. Pieces grow
/// while they take less than [`PAUSE`]. Work that nobody wants any more ends after a piece.
pub fn in_pieces<I: Sync, A: Send, E: Send>(
    wanted: &Wanted,
    items: &[I],
    task: usize,
    answer: impl Fn(&I) -> Result<A, E> + Sync + Send,
) -> Result<Vec<A>, E> {
    joined(wanted, items, |piece| shared(piece, task, &answer))
}

/// Runs work that answers pieces, and joins the answers.
pub fn joined<I, A, E>(
    wanted: &Wanted,
    items: &[I],
    mut work: impl FnMut(&[I]) -> Result<Vec<A>, E>,
) -> Result<Vec<A>, E> {
    let (mut all, mut rest, mut size) = (Vec::new(), items, FIRST);
    loop {
        let (piece, later) = rest.split_at(size.min(rest.len()));
        let began = Instant::now();
        let answers = work(piece)?;
        if all.is_empty() {
            all = answers;
            // As many for each of the others.
            all.reserve_exact((all.len() / piece.len().max(1)).saturating_mul(later.len()));
        } else {
            all.extend(answers);
        }
        if later.is_empty() || !wanted.is() {
            return Ok(all);
        }
        if began.elapsed() < PAUSE {
            size *= 2;
        }
        rest = later;
    }
}

/// Does work on so many points without Python's lock. On Ctrl-C the exception is raised within moments; the work goes on
/// in the background until its result is dropped. Where the system gives no thread, it is done here, and ends before that.
pub fn interruptible<T: Send + 'static>(
    py: Python<'_>,
    points: usize,
    work: impl FnOnce() -> T + Send + 'static,
) -> PyResult<T> {
    while_wanted(py, points, |_| work())
}

/// Runs work that can end early when nobody wants its result.
pub fn while_wanted<T: Send + 'static>(
    py: Python<'_>,
    points: usize,
    work: impl FnOnce(&Wanted) -> T + Send + 'static,
) -> PyResult<T> {
    if points < SERIAL_ITEMS {
        return Ok(py.detach(|| work(&Wanted(None))));
    }
    let Some(pool) = py.detach(pool) else {
        return Ok(py.detach(|| alone(|| work(&Wanted(None)))));
    };
    let wanted = Arc::new(AtomicBool::new(true));
    let seen = Wanted(Some(Arc::clone(&wanted)));
    let (sender, receiver) = sync_channel(1);
    pool.spawn(move || {
        // Nobody is there any more after an interruption.
        _ = sender.send(work(&seen));
    });
    let result = result_of(py, receiver);
    wanted.store(result.is_ok(), Ordering::Relaxed);
    result
}

/// Waits for a result, and looks for signals meanwhile.
fn result_of<T: Send>(py: Python<'_>, receiver: Receiver<T>) -> PyResult<T> {
    let here = generation();
    // A receiver is for one thread; the lock lends it to whichever this is.
    let receiver = Mutex::new(receiver);
    loop {
        let answer = py.detach(|| receiver.lock().ok().map(|receiver| receiver.recv_timeout(PAUSE)));
        match answer {
            Some(Ok(result)) => return Ok(result),
            // A handler of signals may fork, and its child comes by here too.
            Some(Err(RecvTimeoutError::Timeout)) if here == generation() => py.check_signals()?,
            _ => return Err(PyRuntimeError::new_err("the work ended without a result")),
        }
    }
}
