//! Long work that Ctrl-C ends.

use std::sync::Mutex;
use std::sync::mpsc::{RecvTimeoutError, sync_channel};
use std::time::{Duration, Instant};

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;

use crate::pool::{FEW, alone, generation, pool};

/// How often to look for signals.
const PAUSE: Duration = Duration::from_millis(50);

/// Queries that are answered before the first look: the slowest, of a thousand neighbours each, take 0.1 ms.
const FIRST: usize = 1 << 10;

/// The answers to items, piece by piece, with a look for signals after each. Pieces grow while they take less than [`PAUSE`], so
/// many quick ones are few pieces.
pub fn in_pieces<I, A>(
    py: Python<'_>,
    items: &[I],
    mut work: impl FnMut(&[I]) -> PyResult<Vec<A>>,
) -> PyResult<Vec<A>> {
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
        if later.is_empty() {
            return Ok(all);
        }
        py.check_signals()?;
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
    if points < FEW {
        return Ok(py.detach(work));
    }
    let Some(pool) = py.detach(pool) else {
        return Ok(py.detach(|| alone(work)));
    };
    let (sender, receiver) = sync_channel(1);
    pool.spawn(move || {
        // Nobody is there any more after an interruption.
        _ = sender.send(work());
    });
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
