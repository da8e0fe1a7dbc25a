//! The threads that work: as many as were asked for, or as many of these as the system gives. Where it gives none, this one does all.

use std::io;
use std::num::NonZero;
use std::sync::mpsc::{self, Sender};
use std::thread;

use rayon::{ThreadBuilder, ThreadPoolBuilder};

use crate::message::note;

/// From how many points on threads share the work: this program has no other use for them.
const SHARED_FROM: usize = 1 << 13;

/// Says how many threads there are to be, where no option does; rayon's own variable.
const VARIABLE: &str = "RAYON_NUM_THREADS";

/// Starts them. Many more than there are cores would only wait for each other.
pub(crate) fn start(asked: Option<u16>, quiet: bool) {
    delone::share_work_from(SHARED_FROM);
    let cores = thread::available_parallelism().map_or(1, NonZero::get);
    let most = (4 * cores).max(16);
    let by_variable = || std::env::var(VARIABLE).ok()?.parse().ok();
    let asked = asked.map(usize::from).or_else(by_variable).filter(|&asked| asked > 0);
    let threads = asked.unwrap_or(cores);
    if threads > most {
        note(quiet, format_args!("{most} threads are used, not {threads}: there are {cores} cores"));
    }
    let mut seats = seats(threads.min(most), spawn).into_iter();
    let pool = ThreadPoolBuilder::new().num_threads(seats.len().max(1));
    // The global pool can be asked for once, so that its threads must be there before.
    _ = if seats.len() == 0 {
        pool.use_current_thread().build_global()
    } else {
        let gone = || io::Error::other("the thread has ended");
        let sit = |worker| seats.next().and_then(|seat| seat.send(worker).ok()).ok_or_else(gone);
        pool.spawn_handler(sit).build_global()
    };
}

fn spawn(work: Box<dyn FnOnce() + Send>) -> io::Result<()> {
    thread::Builder::new().spawn(work).map(drop)
}

/// Threads that wait for the worker of a pool that they are to be, at most so many.
fn seats(
    count: usize,
    mut spawn: impl FnMut(Box<dyn FnOnce() + Send>) -> io::Result<()>,
) -> Vec<Sender<ThreadBuilder>> {
    let seat = |_| {
        let (seat, worker) = mpsc::channel::<ThreadBuilder>();
        let sit = move || worker.into_iter().take(1).for_each(ThreadBuilder::run);
        spawn(Box::new(sit)).ok().map(|()| seat)
    };
    (0..count).map_while(seat).collect()
}

#[cfg(test)]
mod tests {
    use super::{seats, spawn};
    use std::io;

    #[test]
    fn there_are_as_many_as_the_system_gives() {
        for given in [0_usize, 1, 3, 5] {
            let mut left = given;
            let found = seats(4, |work| {
                left = left.checked_sub(1).ok_or(io::ErrorKind::WouldBlock)?;
                spawn(work)
            });
            assert_eq!(found.len(), given.min(4));
            let mut found = found.into_iter();
            if found.len() > 0 {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(found.len());
                let sit = |worker| {
                    let seat = found.next().ok_or(io::ErrorKind::NotFound)?;
                    seat.send(worker).map_err(|_| io::ErrorKind::BrokenPipe.into())
                };
                let pool = pool.spawn_handler(sit).build().expect("all threads are there");
                assert_eq!(pool.install(rayon::current_num_threads), given.min(4));
            }
        }
    }
}
