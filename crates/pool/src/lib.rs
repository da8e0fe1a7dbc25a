//! The threads that everything long of a binding runs on: a pool of its own, because rayon's global one cannot be made anew.
//!
//! A forked process has none of the threads of its parent, only the memory that says they are there; whoever gives them
//! work waits for ever. So each generation of processes has a slot of its own for a pool, and the child of a fork goes on
//! to the next one: a binding calls [`after_fork`] there. The pool of the parent is never looked at again: to drop it would be to wait for
//! threads that do not exist, and it may be locked by one of them.

mod fork;
mod memory;

use std::cell::OnceCell;
use std::num::NonZero;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

pub use fork::survive_forks;
pub use memory::has_room;

/// Items, up to which the calling thread does the work: the library would cut it into one part anyway.
pub const SERIAL_ITEMS: usize = 20_000;

/// The pools of a generation, and the slot of the next one.
struct Slot {
    /// By the number of threads that were asked for.
    pools: OnceLock<Box<[OnceLock<ThreadPool>]>>,
    next: OnceLock<Box<Slot>>,
}

impl Slot {
    const fn new() -> Self {
        Self { pools: OnceLock::new(), next: OnceLock::new() }
    }
}

static FIRST: Slot = Slot::new();
/// How many forks this process is away from the one that has the first slot.
static GENERATION: AtomicUsize = AtomicUsize::new(0);

/// Which process this is, counted by forks: what threads were given work for another one will never answer.
pub fn generation() -> usize {
    GENERATION.load(Ordering::Acquire)
}

/// The slot of this process.
fn slot() -> &'static Slot {
    (0..generation()).fold(&FIRST, |slot, _| slot.next.get_or_init(|| Box::new(Slot::new())))
}

/// The pool of this process, made at the first need; none where the system gives no thread.
pub fn pool() -> Option<&'static ThreadPool> {
    let asked = threads();
    let pool =
        slot().pools.get_or_init(|| (0..=most_threads()).map(|_| OnceLock::new()).collect()).get(asked)?;
    if let Some(pool) = pool.get() {
        return Some(pool);
    }
    let made = made_of(asked, |count| {
        let named = ThreadPoolBuilder::new().num_threads(count).thread_name(|k| format!("delone-{k}"));
        // Work that panics has no result, which its waiter reports; the process goes on.
        named.panic_handler(drop).build().ok()
    })?;
    // Of two that are made at once one goes again.
    Some(pool.get_or_init(|| made))
}

/// How many threads a program asked for; 0 is none.
static ASKED: AtomicUsize = AtomicUsize::new(0);

/// Sets how many threads there are from now on; 0 is as many as without a call. Work that runs goes on with those it has. Threads that were
/// made for another number sleep until it is asked for again.
pub fn set_threads(count: usize) {
    ASKED.store(count, Ordering::Release);
}

fn cores() -> usize {
    std::thread::available_parallelism().map_or(1, NonZero::get)
}

/// Many more than there are cores would only wait for each other.
fn most_threads() -> usize {
    (4 * cores()).max(16)
}

/// As many threads as were asked for, as `RAYON_NUM_THREADS` says, or there are cores.
fn threads() -> usize {
    let of_program = Some(ASKED.load(Ordering::Acquire)).filter(|&asked| asked > 0);
    let of_user = || std::env::var("RAYON_NUM_THREADS").ok().and_then(|text| text.parse().ok());
    of_program.or_else(of_user).filter(|&asked| asked > 0).unwrap_or_else(cores).min(most_threads())
}

/// A pool of so many threads, or of half as many, and so on: of what the system gives.
fn made_of<P>(most: usize, make: impl FnMut(usize) -> Option<P>) -> Option<P> {
    std::iter::successors(Some(most), |&count| (count > 1).then_some(count / 2)).find_map(make)
}

thread_local! {
    /// The pool of a thread that is all of it.
    static ALONE: OnceCell<Option<ThreadPool>> = const { OnceCell::new() };
}

/// Does work on the thread that asks for it, also what the library shares among threads.
pub fn alone<T: Send>(work: impl FnOnce() -> T + Send) -> T {
    // A thread of another pool stays there.
    let make = || ThreadPoolBuilder::new().num_threads(1).use_current_thread().build().ok();
    ALONE.with(|alone| match alone.get_or_init(make) {
        Some(pool) => pool.install(work),
        None => work(),
    })
}

/// Does work on so many items: in the pool, or on the calling thread where there are too few to be shared.
pub fn run<T: Send>(items: usize, work: impl FnOnce() -> T + Send) -> T {
    match pool().filter(|_| items >= SERIAL_ITEMS) {
        Some(pool) => pool.install(work),
        None => alone(work),
    }
}

/// To be called in the child of a fork, which has one thread.
pub fn after_fork() {
    GENERATION.fetch_add(1, Ordering::Release);
    // Made here, where nobody else can be: a fork while another thread makes it would leave it half made for ever.
    slot();
}

/// Whether so many items are worth the threads, if a task takes as many.
fn is_many<I>(items: &[I], task: usize) -> bool {
    items.len() >= 2 * task
}

/// Runs work on all items in their order, in tasks of several if there are enough, or gives the first error of any. For work on a
/// thread of the pool.
pub fn shared<I: Sync, A: Send, E: Send>(
    items: &[I],
    task: usize,
    work: impl Fn(&I) -> Result<A, E> + Sync + Send,
) -> Result<Vec<A>, E> {
    if is_many(items, task) {
        items.par_iter().with_min_len(task).map(work).collect()
    } else {
        items.iter().map(work).collect()
    }
}
