//! Rows of indices that Python gives back, and rows as its lists. It may have written into arrays, so each index is looked at before it is
//! one of something here.

use numpy::{PyReadonlyArray1, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::exceptions::{PyIndexError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyList;

/// Whether all numbers of an array are finite.
#[pyfunction]
pub fn is_finite(array: PyReadonlyArray2<'_, f64>) -> PyResult<bool> {
    // All of them are looked at, which is faster than to stop.
    Ok(array.as_slice()?.iter().fold(true, |are_finite, x| are_finite & x.is_finite()))
}

/// A list for each row of items, from where rows start and where the last one ends.
#[pyfunction]
pub fn lists<'py>(
    py: Python<'py>,
    starts: PyReadonlyArray1<'py, i64>,
    items: PyReadonlyArray1<'py, i64>,
) -> PyResult<Bound<'py, PyList>> {
    let items = items.as_slice()?;
    let row = |ends: &[i64]| {
        let row = items.get(ends[0] as usize..ends[1] as usize);
        PyList::new(py, row.ok_or_else(|| PyIndexError::new_err("rows beyond the end of their items"))?)
    };
    PyList::new(py, starts.as_slice()?.windows(2).map(row).collect::<PyResult<Vec<_>>>()?)
}

/// Rows of so many columns.
pub fn rows<'a, T: numpy::Element, const W: usize>(
    array: &'a PyReadonlyArray2<'_, T>,
) -> PyResult<&'a [[T; W]]> {
    if array.shape()[1] != W {
        let columns = array.shape()[1];
        return Err(PyValueError::new_err(format!("rows of {columns} columns where there must be {W}")));
    }
    Ok(array.as_slice()?.as_chunks().0)
}

/// Reads rows of indices below `count`, from a least one, which may be -1.
pub fn indices<'a, const W: usize>(
    array: &'a PyReadonlyArray2<'_, i32>,
    least: i32,
    count: usize,
) -> PyResult<&'a [[i32; W]]> {
    let rows = rows(array)?;
    let is_known = |i: i32| i >= least && (i < 0 || (i as usize) < count);
    // All of them are looked at, which is faster than to stop.
    if rows.as_flattened().iter().fold(true, |known, &i| known & is_known(i)) {
        return Ok(rows);
    }
    let wrong = rows.as_flattened().iter().copied().find(|&i| !is_known(i)).unwrap_or_default();
    Err(PyIndexError::new_err(format!("index {wrong} is out of bounds for {count}")))
}
