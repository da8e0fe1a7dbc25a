//! An allocator that counts, and says in one line that memory is at its end: at a limit, or where the system gives no more. The
//! standard library aborts there, and offers no other way to answer.
//!
//! Threads count for themselves, and add up what is more than [`BATCH`]; so a thread that allocates often waits for no other.
#![allow(unsafe_code)]

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::io::Write;
use std::sync::atomic::{AtomicBool, AtomicIsize, Ordering};

/// Bytes that a thread counts for itself. More is noticed later, less costs a write to shared memory more often.
const BATCH: isize = 1 << 16;

/// Bytes that are allocated, but for the batches of threads.
static USED: AtomicIsize = AtomicIsize::new(0);
/// Bytes that may be.
static LIMIT: AtomicIsize = AtomicIsize::new(isize::MAX);
/// Whether the user has set the limit.
static IS_ASKED: AtomicBool = AtomicBool::new(false);

thread_local! {
    /// Without a destructor, and without memory to ask for.
    static BATCHED: Cell<isize> = const { Cell::new(0) };
}

/// Limits what may be allocated, in bytes. `is_asked` tells whose limit it is.
pub(crate) fn limit(bytes: u64, is_asked: bool) {
    IS_ASKED.store(is_asked, Ordering::Relaxed);
    LIMIT.store(isize::try_from(bytes).unwrap_or(isize::MAX), Ordering::Relaxed);
}

/// The system's allocator; where that gives nothing, or more is asked for than the limit, the program ends with an error.
struct Watched;

#[global_allocator]
static ALLOCATOR: Watched = Watched;

// SAFETY: every call is passed on to the system's allocator as it is, and what that gives is given back; where it gives
// nothing, or the limit is reached before, the call does not return. Counting asks for no memory.
unsafe impl GlobalAlloc for Watched {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count(layout.size() as isize);
        // SAFETY: as the caller promises.
        there(unsafe { System.alloc(layout) })
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        count(layout.size() as isize);
        // SAFETY: as the caller promises.
        there(unsafe { System.alloc_zeroed(layout) })
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        count(size as isize - layout.size() as isize);
        // SAFETY: as the caller promises.
        there(unsafe { System.realloc(pointer, layout, size) })
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        count(-(layout.size() as isize));
        // SAFETY: as the caller promises.
        unsafe { System.dealloc(pointer, layout) }
    }
}

/// Counts bytes that are about to be asked for, or given back.
#[inline]
fn count(bytes: isize) {
    let batched = BATCHED.get() + bytes;
    if batched.abs() < BATCH {
        BATCHED.set(batched);
    } else {
        BATCHED.set(0);
        add(batched);
    }
}

#[cold]
fn add(bytes: isize) {
    let used = USED.fetch_add(bytes, Ordering::Relaxed) + bytes;
    let limit = LIMIT.load(Ordering::Relaxed);
    if bytes > 0 && used > limit {
        end(Some(limit));
    }
}

fn there(pointer: *mut u8) -> *mut u8 {
    if pointer.is_null() {
        end(None);
    }
    pointer
}

/// Ends the program without asking for memory.
#[cold]
fn end(limit: Option<isize>) -> ! {
    // What ends the program may ask for some.
    LIMIT.store(isize::MAX, Ordering::Relaxed);
    let mut out = std::io::stderr();
    _ = match limit {
        Some(bytes) if IS_ASKED.load(Ordering::Relaxed) => writeln!(
            out,
            "error: this takes more memory than --max-memory allows ({} MiB)\nhelp: allow more, or give fewer points",
            bytes >> 20
        ),
        Some(bytes) => writeln!(
            out,
            "error: this takes more memory than there is ({} MiB)\nhelp: give fewer points; --max-memory SIZE sets another limit",
            bytes >> 20
        ),
        None => writeln!(
            out,
            "error: there is not enough memory\nhelp: give fewer points, or raise the limit of memory (ulimit -v)"
        ),
    };
    delone_io::remove_unfinished();
    std::process::exit(1)
}
