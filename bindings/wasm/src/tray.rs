//! Arrays on their way in and out.

use std::cell::RefCell;

use crate::fault::{Fault, answer};

/// Arrays that JavaScript has written, and arrays for it to read.
#[derive(Default)]
pub struct Tray {
    pub points: Vec<[f64; 2]>,
    pub numbers: Vec<f64>,
    pub indices: Vec<u32>,
    pub ints: [Vec<u32>; 3],
    pub floats: [Vec<f64>; 3],
}

thread_local! {
    static TRAY: RefCell<Tray> = RefCell::default();
}

/// Works on the tray.
pub fn with<R>(work: impl FnOnce(&mut Tray) -> R) -> R {
    TRAY.with_borrow_mut(work)
}

/// Takes the points that were given.
pub fn points() -> Vec<[f64; 2]> {
    with(|tray| std::mem::take(&mut tray.points))
}

/// Takes the numbers that were given.
#[cfg(any(feature = "surface", feature = "weights"))]
pub fn numbers() -> Vec<f64> {
    with(|tray| std::mem::take(&mut tray.numbers))
}

/// Takes the indices that were given.
#[cfg(any(feature = "constraints", feature = "regions"))]
pub fn indices() -> Vec<u32> {
    with(|tray| std::mem::take(&mut tray.indices))
}

/// Leaves an array of integers.
pub fn leave_ints(k: usize, array: Vec<u32>) {
    with(|tray| tray.ints[k] = array);
}

/// Leaves an array of numbers.
pub fn leave_floats(k: usize, array: Vec<f64>) {
    with(|tray| tray.floats[k] = array);
}

/// Makes room for so many items.
fn make_room<T: Clone + Default>(items: &mut Vec<T>, count: usize) -> i32 {
    items.clear();
    if items.try_reserve_exact(count).is_err() {
        return answer(Err(Fault::memory(count.saturating_mul(size_of::<T>()))));
    }
    items.resize(count, T::default());
    0
}

export! {
    /// Room for so many points, all of it to be written.
    fn room_for_points(count: usize) -> i32 {
        with(|tray| make_room(&mut tray.points, count))
    }

    /// Room for so many numbers.
    fn room_for_numbers(count: usize) -> i32 {
        with(|tray| make_room(&mut tray.numbers, count))
    }

    /// Room for so many indices.
    fn room_for_indices(count: usize) -> i32 {
        with(|tray| make_room(&mut tray.indices, count))
    }

    /// Where points are written.
    fn points_at() -> *mut [f64; 2] {
        with(|tray| tray.points.as_mut_ptr())
    }

    /// Where numbers are written.
    fn numbers_at() -> *mut f64 {
        with(|tray| tray.numbers.as_mut_ptr())
    }

    /// Where indices are written.
    fn indices_at() -> *mut u32 {
        with(|tray| tray.indices.as_mut_ptr())
    }

    /// Where an array of integers is read.
    fn ints_at(k: usize) -> *const u32 {
        with(|tray| tray.ints.get(k).map_or(std::ptr::null(), Vec::as_ptr))
    }

    /// How many there are.
    fn ints_count(k: usize) -> usize {
        with(|tray| tray.ints.get(k).map_or(0, Vec::len))
    }

    /// Where an array of numbers is read.
    fn floats_at(k: usize) -> *const f64 {
        with(|tray| tray.floats.get(k).map_or(std::ptr::null(), Vec::as_ptr))
    }

    /// How many there are.
    fn floats_count(k: usize) -> usize {
        with(|tray| tray.floats.get(k).map_or(0, Vec::len))
    }

    /// Gives the memory of all arrays back.
    fn clear_tray() -> i32 {
        with(|tray| *tray = Tray::default());
        0
    }
}
