//! Memory is asked for before long work starts: the library, which takes it piece by piece, ends the process where there is
//! none, and Python has an exception for that.

use delone_pool::has_room;
use pyo3::exceptions::PyMemoryError;
use pyo3::prelude::*;

/// Memory of work for a point, in bytes, by dimension: measured on a million points, and half as much again.
pub struct Need([usize; 2]);

pub const TRIANGULATION: Need = Need([160, 430]);
pub const HINTS: Need = Need([240, 540]);
pub const ALPHA: Need = Need([900, 3300]);
/// Above the triangulation for a diagram of order k: so much times k a point, and so much times k squared.
pub const ORDER: usize = 1000;
pub const ORDER_SITES: usize = 50;
pub const HULL: Need = Need([50, 100]);
pub const NEIGHBORS: Need = Need([80, 100]);

impl Need {
    /// Refuses work on so many points if there is no memory for it.
    pub fn check(&self, dimension: usize, points: usize) -> PyResult<()> {
        self.check_with(dimension, points, 0)
    }

    /// Checks with `more` bytes in addition.
    pub fn check_with(&self, dimension: usize, points: usize, more: usize) -> PyResult<()> {
        let bytes = points.saturating_mul(self.0[dimension - 2]).saturating_add(more);
        if !has_room(bytes) {
            let megabytes = bytes >> 20;
            return Err(PyMemoryError::new_err(format!("{points} points need about {megabytes} megabytes")));
        }
        Ok(())
    }
}

/// Room for k numbers for each query; the answer may be larger than memory.
pub fn room_for_neighbors<T>(queries: usize, k: usize) -> PyResult<Vec<T>> {
    let mut room = Vec::new();
    let size = queries.checked_mul(k);
    if size.is_none_or(|size| room.try_reserve_exact(size).is_err()) {
        return Err(PyMemoryError::new_err(format!("{queries} times {k} neighbors")));
    }
    Ok(room)
}

/// Refuses results of so many bytes if there is no memory for them.
pub fn room(bytes: usize, what: &str) -> PyResult<()> {
    if !has_room(bytes) {
        return Err(PyMemoryError::new_err(format!("{what} need about {} megabytes", bytes >> 20)));
    }
    Ok(())
}
