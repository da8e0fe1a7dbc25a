//! Memory of results: the caller's, or new memory of `malloc`, because clients give it back by `free`.

#![allow(unsafe_code, reason = "results are written into memory of C")]

use std::ffi::c_void;
use std::mem::MaybeUninit;

use rayon::prelude::*;

use crate::fault::Fault;

/// Rows from which on several threads write.
const SHARED_ROWS: usize = 1 << 15;
/// Rows that a thread writes at once.
const TASK_ROWS: usize = 1 << 13;

/// Lists that got new memory. They lose it again, unless they are kept.
#[derive(Debug, Default)]
pub(crate) struct Fresh {
    lists: Vec<*mut *mut c_void>,
}

impl Fresh {
    /// Room for so many rows in a list, which gets new memory if it is NULL.
    ///
    /// # Safety
    /// The list is readable and writable as long as this lives; what it has, if it is not NULL, has room for so many rows, and nothing else
    /// uses it meanwhile. A row is made of what the list is made of.
    pub(crate) unsafe fn room<'a, T, R>(
        &mut self,
        list: *mut *mut T,
        rows: usize,
        name: &str,
    ) -> Result<&'a mut [MaybeUninit<R>], Fault> {
        let bytes = rows.checked_mul(size_of::<R>()).filter(|&bytes| isize::try_from(bytes).is_ok());
        let bytes = bytes.ok_or_else(|| Fault::memory(usize::MAX, name))?;
        // SAFETY: the list may be read and written, as the caller says; what malloc gives is aligned for numbers, and is as long as was
        // asked for.
        unsafe {
            if (*list).is_null() {
                let memory = libc::malloc(bytes.max(1));
                if memory.is_null() {
                    return Err(Fault::memory(bytes, name));
                }
                *list = memory.cast();
                self.lists.push(list.cast());
            }
            Ok(std::slice::from_raw_parts_mut((*list).cast(), rows))
        }
    }

    /// Leaves the memory to the caller.
    pub(crate) fn keep(mut self) {
        self.lists.clear();
    }
}

impl Drop for Fresh {
    fn drop(&mut self) {
        for &list in &self.lists {
            // SAFETY: the list is still there, as `room` asks, and its memory is of malloc.
            unsafe {
                libc::free(*list);
                *list = std::ptr::null_mut();
            }
        }
    }
}

/// Writes a value for each item, in their order.
pub(crate) fn fill<T: Send, S: Sync>(
    to: &mut [MaybeUninit<T>],
    from: &[S],
    value: impl Fn(usize, &S) -> T + Sync,
) {
    let write = |start: usize, to: &mut [MaybeUninit<T>], from: &[S]| {
        for (k, (to, from)) in to.iter_mut().zip(from).enumerate() {
            to.write(value(start + k, from));
        }
    };
    if from.len() < SHARED_ROWS {
        return write(0, to, from);
    }
    let tasks = to.par_chunks_mut(TASK_ROWS).zip(from.par_chunks(TASK_ROWS)).enumerate();
    tasks.for_each(|(task, (to, from))| write(task * TASK_ROWS, to, from));
}

/// Copies values.
pub(crate) fn copy<T: Copy + Send + Sync>(to: &mut [MaybeUninit<T>], from: &[T]) {
    fill(to, from, |_, &value| value);
}
