//! Large arrays on large pages.
//!
//! The first touch of a page costs a fault, on virtual machines up to two microseconds for four kilobytes: a sixth of a
//! construction in the plane. Where the system gives pages of two megabytes on request, as Linux does, there are five
//! hundred times fewer. Measured on 10^6 points: 210 ns a point without, 184 with. Fresh pages are zero, so arrays that begin
//! as zeros need no pass over them: another 2 %, 5 % on a grid.

#[cfg(feature = "rayon")]
use std::mem::MaybeUninit;
#[cfg(feature = "rayon")]
use std::sync::Mutex;
#[cfg(feature = "rayon")]
use std::sync::atomic::{AtomicUsize, Ordering};

use bytemuck::Zeroable;

/// Bytes, from which on an array gets fresh pages from the system; smaller arrays come from the allocator.
const FRESH_BYTES: usize = 4 << 20;

/// An empty vector with room for so many items, on large pages if there are any.
pub(crate) fn room_for<T>(count: usize) -> Vec<T> {
    let mut items = Vec::with_capacity(count);
    advise(items.spare_capacity_mut());
    items
}

/// As many values whose bytes are zero. Fresh pages are, so nothing is written, and those who fill the array are the first to
/// touch it.
pub(crate) fn zeroed<T: Zeroable + Clone>(count: usize) -> Vec<T> {
    if count < FRESH_BYTES / size_of::<T>() {
        // To ask for zeros takes longer than to write a few.
        let mut items = Vec::with_capacity(count);
        items.resize(count, T::zeroed());
        return items;
    }
    let mut items = bytemuck::zeroed_vec(count);
    advise(&mut items);
    items
}

/// Room for so many more items. A vector that grows by itself is moved page by page, and large pages fall apart.
#[inline]
pub(crate) fn make_room<T: Copy>(items: &mut Vec<T>, more: usize) {
    if items.capacity() - items.len() < more {
        grow(items, more);
    }
}

#[cold]
fn grow<T: Copy>(items: &mut Vec<T>, more: usize) {
    let mut larger = room_for((items.len() + more).max(2 * items.len()).max(8));
    larger.extend_from_slice(items);
    *items = larger;
}

/// Appends the items 0 to `count`, in parts that `for_each` hands out by their numbers, to several threads if it likes. No thread touches
/// memory before its parts are written, so page faults are shared as well.
///
/// Rayon's `collect_into_vec` does the same, and is compiled anew for each closure.
#[cfg(feature = "rayon")]
pub(crate) fn extend_in_parts<T: Send>(
    items: &mut Vec<T>,
    count: usize,
    part: usize,
    item: impl Fn(usize) -> T + Sync,
    for_each: impl FnOnce(usize, &(dyn Fn(usize) + Sync)),
) {
    items.reserve(count);
    let parts: Vec<Mutex<&mut [MaybeUninit<T>]>> =
        items.spare_capacity_mut()[..count].chunks_mut(part).map(Mutex::new).collect();
    let written = AtomicUsize::new(0);
    for_each(parts.len(), &|k| {
        // A part that is handed out twice is empty the second time.
        let places = std::mem::take(&mut *parts[k].lock().expect("a part is written once"));
        for (i, place) in places.iter_mut().enumerate() {
            place.write(item(k * part + i));
        }
        written.fetch_add(places.len(), Ordering::AcqRel);
    });
    assert_eq!(written.into_inner(), count, "every part is handed out");
    #[expect(
        unsafe_code,
        reason = "the standard library has no safe way to fill a vector from several threads"
    )]
    // SAFETY: `reserve` made room for `count` items. A part is counted after all of it was written, and only once, since its slice
    // is taken; so `count` says that each of the first `count` places of the room was.
    unsafe {
        items.set_len(items.len() + count);
    }
}

/// Asks for large pages where nothing has been written yet.
fn advise<T>(items: &mut [T]) {
    let bytes = size_of_val(items);
    if bytes < FRESH_BYTES {
        return;
    }
    #[cfg(all(target_os = "linux", not(miri)))]
    {
        const PAGE: usize = 4096;
        let start = items.as_mut_ptr().cast::<u8>();
        // Whole pages inside of the array.
        let skipped = start.align_offset(PAGE);
        let length = bytes.saturating_sub(skipped) / PAGE * PAGE;
        #[expect(unsafe_code, reason = "a call of the operating system")]
        // SAFETY: the range is inside of one allocation that is ours alone, and the advice changes neither what is in
        // it nor how it may be used. Where it fails, pages are small.
        unsafe {
            libc::madvise(start.wrapping_add(skipped).cast(), length, libc::MADV_HUGEPAGE);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{FRESH_BYTES, make_room, room_for, zeroed};

    #[cfg(feature = "rayon")]
    #[test]
    fn parts_are_fetched_from_whoever_has_them() {
        let boxed = |i: usize| Box::new(i);
        for (count, part) in [(0, 3), (1, 3), (3, 3), (10, 3), (12, 3)] {
            let mut items = vec![Box::new(7)];
            // Out of order, from two threads, and some of them twice.
            super::extend_in_parts(&mut items, count, part, boxed, |parts, write| {
                std::thread::scope(|scope| {
                    scope.spawn(|| (0..parts).rev().step_by(2).for_each(write));
                    (0..parts).for_each(write);
                });
            });
            assert!(items.into_iter().map(|item| *item).eq([7].into_iter().chain(0..count)));
        }
    }

    #[cfg(feature = "rayon")]
    #[test]
    #[should_panic(expected = "every part is handed out")]
    fn a_part_that_is_not_fetched_is_no_item() {
        let mut items = Vec::new();
        super::extend_in_parts(&mut items, 10, 3, |i| i, |parts, write| (1..parts).for_each(write));
    }

    #[test]
    fn zeros_are_zero() {
        for count in [0, 1, 1000, FRESH_BYTES / 8 - 1, FRESH_BYTES / 8, FRESH_BYTES / 8 + 513] {
            let items: Vec<u64> = zeroed(count);
            assert!(items.len() == count && items.iter().all(|&item| item == 0));
        }
    }

    #[test]
    fn advice_changes_nothing() {
        for count in [0, 1, 1000, FRESH_BYTES / 8 - 1, FRESH_BYTES / 8, FRESH_BYTES / 8 + 513] {
            let mut items: Vec<u64> = room_for(count);
            let at = items.as_ptr();
            assert!(items.is_empty() && items.capacity() >= count);
            items.extend(0..count as u64);
            assert_eq!(items.as_ptr(), at);
            make_room(&mut items, 3);
            assert!(items.capacity() >= count + 3);
            assert!(items.iter().copied().eq(0..count as u64));
        }
    }
}
