//! Work on several threads at once; on one if there is but one, or without the feature `rayon`.
//!
//! Tasks own disjoint parts of arrays, so what they write does not depend on who does it: results are the same bits for any
//! number of threads.

#[cfg(feature = "rayon")]
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

#[cfg(feature = "rayon")]
use crate::memory::extend_in_parts;
use crate::memory::room_for;

/// Work on fewer items is not worth a thread. The Python package relies on it: it gives less than this no pool of its own, and a
/// forked process waits for ever for the threads of another.
static MANY: AtomicUsize = AtomicUsize::new(1 << 15);

/// The fewest items of a part.
const PART: usize = 1 << 11;

/// Says from how many items on (points, say) threads share the work on them, 2,048 at least; before it is said, that is 32,768. It holds
/// for the whole process, and results do not depend on it. Fewer are for a program whose threads wait for nothing but this: what is small
/// is done a millisecond sooner, and each call wakes threads.
pub fn share_work_from(items: usize) {
    MANY.store(items.max(PART), Ordering::Relaxed);
}

/// The threads there are.
pub(crate) fn threads() -> usize {
    #[cfg(feature = "rayon")]
    return rayon::current_num_threads();
    #[cfg(not(feature = "rayon"))]
    1
}

/// Into how many parts to cut work on so many items: more than there are threads, so that none waits long; one if it is not
/// worth it.
pub(crate) fn parts(items: usize) -> usize {
    // To ask for threads takes longer than to triangulate three points.
    let threads = if items < MANY.load(Ordering::Relaxed) { 1 } else { threads() };
    if threads == 1 { 1 } else { (8 * threads).min(items / PART) }
}

/// Does all tasks, and gives the results in their order.
pub(crate) fn map<T: Send, R: Send>(tasks: Vec<T>, work: impl Fn(T) -> R + Send + Sync) -> Vec<R> {
    #[cfg(feature = "rayon")]
    if tasks.len() > 1 {
        let places: Vec<_> = tasks.into_iter().map(|task| Mutex::new((Some(task), None))).collect();
        erased::for_each(places.len(), &|i| {
            let mut place = places[i].lock().expect("a task is done once");
            place.1 = place.0.take().map(&work);
        });
        let done = |place: Mutex<(Option<T>, Option<R>)>| place.into_inner().expect("no task failed").1;
        return places.into_iter().map(|place| done(place).expect("every task is done")).collect();
    }
    tasks.into_iter().map(work).collect()
}

/// Runs tasks that share `count` items: one after the other if there are too few items for threads.
pub(crate) fn share<T: Send, R: Send>(
    items: usize,
    tasks: Vec<T>,
    work: impl Fn(T) -> R + Send + Sync,
) -> Vec<R> {
    if parts(items) > 1 { map(tasks, work) } else { tasks.into_iter().map(work).collect() }
}

/// Does work on so many items on one of the threads, if several are worth it: where it hands out tasks again and again, none of them has to
/// wake another thread and wait for it.
pub(crate) fn inside<R: Send>(items: usize, work: impl FnOnce() -> R + Send) -> R {
    #[cfg(feature = "rayon")]
    if parts(items) > 1 {
        return once(work, erased::inside);
    }
    #[cfg(not(feature = "rayon"))]
    let _ = items;
    work()
}

/// Does two tasks, at once if there is a thread for each.
pub(crate) fn join<A: Send, B: Send>(a: impl FnOnce() -> A + Send, b: impl FnOnce() -> B + Send) -> (A, B) {
    #[cfg(feature = "rayon")]
    return {
        let mut second = None;
        let first = once(a, |a| second = Some(once(b, |b| erased::join(a, b))));
        (first, second.expect("both are done"))
    };
    #[cfg(not(feature = "rayon"))]
    (a(), b())
}

/// Sorts items of which equal ones are the same.
pub(crate) fn sort<T: Ord + Send>(items: &mut [T]) {
    #[cfg(feature = "rayon")]
    if parts(items.len()) > 1 {
        use rayon::prelude::*;
        return items.par_sort_unstable();
    }
    items.sort_unstable();
}

/// As many copies of a value.
pub(crate) fn filled<T: Copy + Send + Sync>(value: T, count: usize) -> Vec<T> {
    collect(count, |_| value)
}

/// Fills an array in small pages, because large pages take long to get: for arrays of hundreds of bytes a point.
pub(crate) fn filled_in_small_pages<T: Copy + Send + Sync>(value: T, count: usize) -> Vec<T> {
    collect_into(Vec::with_capacity(count), count, |_| value)
}

/// The results for 0, 1, 2 and so on.
pub(crate) fn collect<T: Send>(count: usize, item: impl Fn(usize) -> T + Send + Sync) -> Vec<T> {
    collect_into(room_for(count), count, item)
}

fn collect_into<T: Send>(mut items: Vec<T>, count: usize, item: impl Fn(usize) -> T + Send + Sync) -> Vec<T> {
    #[cfg(feature = "rayon")]
    if parts(count) > 1 {
        extend_in_parts(&mut items, count, PART, item, erased::for_each);
        return items;
    }
    items.extend((0..count).map(item));
    items
}

/// The indices of items, in as many ranges as work on them is cut into.
pub(crate) fn ranges(items: usize) -> Vec<std::ops::Range<usize>> {
    even_ranges(items, parts(items))
}

/// Nearly equal ranges of indices.
pub(crate) fn even_ranges(count: usize, parts: usize) -> Vec<std::ops::Range<usize>> {
    let mut from = 0;
    even_ends(count, parts).into_iter().map(|to| std::mem::replace(&mut from, to)..to).collect()
}

/// Cuts a slice into parts that end at given positions, increasing, the last at the end of the slice.
pub(crate) fn split_at<'a, T>(mut items: &'a mut [T], ends: &[usize]) -> Vec<&'a mut [T]> {
    let mut start = 0;
    let part = |&end: &usize| {
        let (part, rest) = std::mem::take(&mut items).split_at_mut(end - start);
        (items, start) = (rest, end);
        part
    };
    ends.iter().map(part).collect()
}

/// Where nearly equal parts end.
pub(crate) fn even_ends(count: usize, parts: usize) -> Vec<usize> {
    (1..=parts).map(|k| count * k / parts).collect()
}

/// Runs a task that gives a result by what runs one that gives none.
#[cfg(feature = "rayon")]
fn once<R: Send>(work: impl FnOnce() -> R + Send, run: impl FnOnce(&mut (dyn FnMut() + Send))) -> R {
    let (mut work, mut result) = (Some(work), None);
    run(&mut || result = work.take().map(|work| work()));
    result.expect("the task was run")
}

/// The few functions of rayon that are used, each compiled once: rayon makes some forty functions for each type of task, which were
/// a fifth of the library's code.
#[cfg(feature = "rayon")]
mod erased {
    use rayon::prelude::*;

    /// Does the tasks 0, 1, 2 and so on, each on whatever thread is free.
    pub(super) fn for_each(tasks: usize, task: &(dyn Fn(usize) + Sync)) {
        (0..tasks).into_par_iter().with_max_len(1).for_each(task);
    }

    pub(super) fn join(a: &mut (dyn FnMut() + Send), b: &mut (dyn FnMut() + Send)) {
        rayon::join(a, b);
    }

    /// Does a task on a thread of the pool.
    pub(super) fn inside(task: &mut (dyn FnMut() + Send)) {
        rayon::scope(|_| task());
    }
}
