//! Equal vertices are one: they are sorted, and counted.
//!
//! Cost: a sort of the first coordinates as integers, on all threads that there are; others are looked at where these are equal.

use rayon::prelude::*;

use crate::pool::SERIAL_ITEMS;

/// An integer for a number that is none other's, in the order of numbers; both zeros have the same.
fn key(x: f64) -> u64 {
    let bits = (x + 0.0).to_bits();
    if bits >> 63 == 0 { bits | 1 << 63 } else { !bits }
}

/// The distinct rows among those that are kept, sorted, and for each row which of them it is; -1 for those that are not kept.
pub fn distinct<const D: usize>(rows: &[[f64; D]], kept: Option<&[bool]>) -> (Vec<[f64; D]>, Vec<i32>) {
    let is_kept = |row: usize| kept.is_none_or(|kept| kept[row]);
    let first = |(row, at): (usize, &[f64; D])| (key(at[0]), row as u32);
    let mut order: Vec<(u64, u32)> =
        rows.iter().enumerate().filter(|&(row, _)| is_kept(row)).map(first).collect();
    if order.len() < SERIAL_ITEMS {
        order.sort_unstable();
    } else {
        order.par_sort_unstable();
    }
    let others = |row: u32| rows[row as usize].map(key);
    for equal in order.chunk_by_mut(|a, b| a.0 == b.0).filter(|equal| equal.len() > 1) {
        equal.sort_unstable_by_key(|&(_, row)| (others(row), row));
    }
    let mut found: Vec<[f64; D]> = Vec::with_capacity(order.len());
    let mut which = vec![-1; rows.len()];
    for (_, row) in order {
        let at = rows[row as usize];
        if found.last().is_none_or(|last| last.map(key) != at.map(key)) {
            found.push(at);
        }
        which[row as usize] = found.len() as i32 - 1;
    }
    (found, which)
}
