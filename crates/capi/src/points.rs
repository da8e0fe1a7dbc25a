//! Points of the caller: rows or columns, of doubles or floats, anywhere in memory.

use std::borrow::Cow;
use std::ffi::c_void;
use std::mem::size_of;
use std::ptr::null;

use crate::failure::{Failure, Status};

const DOUBLE: i32 = 0;
const FLOAT: i32 = 1;

/// `delone_points`.
#[repr(C)]
#[derive(Clone, Copy)]
pub(crate) struct CPoints {
    size: u32,
    kind: i32,
    count: usize,
    stride: usize,
    x: *const c_void,
    y: *const c_void,
    z: *const c_void,
}

fn packed(first: *const f64, dimension: usize, count: usize) -> CPoints {
    let at = |axis: usize| if first.is_null() { null() } else { first.wrapping_add(axis).cast() };
    let (size, stride) = (size_of::<CPoints>() as u32, dimension * size_of::<f64>());
    let z = if dimension == 3 { at(2) } else { null() };
    CPoints { size, kind: DOUBLE, count, stride, x: at(0), y: at(1), z }
}

#[unsafe(no_mangle)]
pub(crate) extern "C" fn delone_xy(xy: *const f64, count: usize) -> CPoints {
    packed(xy, 2, count)
}

#[unsafe(no_mangle)]
pub(crate) extern "C" fn delone_xyz(xyz: *const f64, count: usize) -> CPoints {
    packed(xyz, 3, count)
}

/// The points that a pointer of C tells of, of up to so many. They are copied unless they are rows of doubles.
///
/// # Safety
/// The pointer is NULL or that of a `delone_points`, whose points are there until the result is gone.
pub(crate) unsafe fn read<'a, const D: usize>(
    points: *const CPoints,
    most: usize,
) -> Result<Cow<'a, [[f64; D]]>, Failure> {
    // SAFETY: promised by the caller.
    let Some(points) = (unsafe { points.as_ref() }) else {
        return Err(Failure::argument("points: the pointer is NULL"));
    };
    if (points.size as usize) < size_of::<CPoints>() {
        return Err(Failure::argument(format!("points: size is {}, not sizeof(delone_points)", points.size)));
    }
    let bytes = match points.kind {
        DOUBLE => size_of::<f64>(),
        FLOAT => size_of::<f32>(),
        other => return Err(Failure::argument(format!("points: type {other} is none"))),
    };
    if points.count == 0 {
        return Ok(Cow::Borrowed(&[]));
    }
    if points.count > most {
        let words = format!("points: there are {}, and at most {most} are possible", points.count);
        return Err(Failure::new(Status::TooMany, words));
    }
    let axes = &[points.x, points.y, points.z][..D];
    if let Some(axis) = axes.iter().position(|axis| axis.is_null()) {
        return Err(Failure::argument(format!("points: {} is NULL", ["x", "y", "z"][axis])));
    }
    if points.count > 1 && points.stride < bytes || points.stride > isize::MAX as usize / points.count {
        return Err(Failure::argument(format!(
            "points: a stride of {} bytes is too small or too large",
            points.stride
        )));
    }
    let first = points.x.cast::<[f64; D]>();
    let is_packed = points.kind == DOUBLE
        && (points.stride == size_of::<[f64; D]>() || points.count == 1)
        && (0..D).all(|k| axes[k] == points.x.wrapping_byte_add(k * bytes))
        && first.is_aligned();
    if is_packed {
        // SAFETY: the rows follow each other, aligned, and are there, as the caller promises.
        return Ok(Cow::Borrowed(unsafe { std::slice::from_raw_parts(first, points.count) }));
    }
    crate::memory::check(points.count, size_of::<[f64; D]>())?;
    let number = |axis: *const c_void, row: usize| {
        let at = axis.wrapping_byte_add(row * points.stride);
        // SAFETY: the caller promises numbers of this type so many bytes apart; they need not be aligned.
        unsafe {
            if points.kind == DOUBLE {
                at.cast::<f64>().read_unaligned()
            } else {
                f64::from(at.cast::<f32>().read_unaligned())
            }
        }
    };
    Ok((0..points.count).map(|row| std::array::from_fn(|axis| number(axes[axis], row))).collect())
}

/// A list of the caller: NULL if it has nothing.
///
/// # Safety
/// The pointer is NULL or that of so many items, which are there until the result is gone.
pub(crate) unsafe fn list<'a, T>(first: *const T, count: usize, what: &str) -> Result<&'a [T], Failure> {
    if count == 0 {
        return Ok(&[]);
    }
    if first.is_null() || !first.is_aligned() || count > isize::MAX as usize / size_of::<T>() {
        return Err(Failure::argument(format!(
            "{what}: the pointer is NULL or not aligned, with a count of {count}"
        )));
    }
    // SAFETY: it is aligned and not NULL, and the caller promises the items.
    Ok(unsafe { std::slice::from_raw_parts(first, count) })
}

/// Writes results where the caller has room for them, if there is a pointer.
///
/// # Safety
/// The pointer is NULL or that of room for all items, which may be written to.
pub(crate) unsafe fn write<T>(to: *mut T, items: impl Iterator<Item = T>) {
    if to.is_null() {
        return;
    }
    for (k, item) in items.enumerate() {
        // SAFETY: promised by the caller. Nothing is dropped that was there: it may be anything.
        unsafe { to.add(k).write_unaligned(item) };
    }
}

/// The handle behind a pointer.
///
/// # Safety
/// The pointer is NULL or that of a handle that was not freed.
pub(crate) unsafe fn handle<'a, T>(pointer: *const T) -> Result<&'a T, Failure> {
    // SAFETY: promised by the caller.
    unsafe { pointer.as_ref() }.ok_or_else(|| Failure::argument("the handle is NULL"))
}

/// Gives a handle away.
///
/// # Safety
/// The pointer may be written to.
pub(crate) unsafe fn give<T>(out: *mut *mut T, made: Result<T, Failure>) -> Result<(), Failure> {
    let made = made?;
    // SAFETY: promised by the caller.
    unsafe { out.write(Box::into_raw(Box::new(made))) };
    Ok(())
}

/// Sets the place for a handle to NULL.
///
/// # Safety
/// The pointer is NULL, or may be written to.
pub(crate) unsafe fn clear<T>(out: *mut *mut T) -> Result<(), Failure> {
    if out.is_null() {
        return Err(Failure::argument("out: the pointer is NULL"));
    }
    // SAFETY: promised by the caller.
    unsafe { out.write(std::ptr::null_mut()) };
    Ok(())
}
