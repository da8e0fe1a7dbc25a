//! Points and segments that nearly touch, welded.

use delone::Weld2;
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray2};
use pyo3::prelude::*;

use crate::constrained::{SEGMENT, index, pairs, work};
use crate::errors::python_error;
use crate::interrupt::interruptible;
use crate::memory::TRIANGULATION;
use crate::triangulation::coordinates;

/// For each point the one that it became; pieces of segments, and the segment of each; points that moved, the largest move, vertices that
/// joined a segment, segments that became a point.
type Welded<'py> = (
    Bound<'py, PyArray1<i64>>,
    Bound<'py, PyArray2<i64>>,
    Bound<'py, PyArray1<i64>>,
    (usize, f64, usize, usize),
);

/// Points and segments after welding.
#[pyfunction]
pub fn weld<'py>(
    py: Python<'py>,
    points: PyReadonlyArray2<'py, f64>,
    segments: PyReadonlyArray2<'py, i64>,
    tolerance: f64,
) -> PyResult<Welded<'py>> {
    let points: Vec<[f64; 2]> = coordinates(&points)?;
    let segments: Vec<[usize; 2]> = pairs(&segments)?.iter().map(|ends| ends.map(index)).collect();
    TRIANGULATION.check_with(2, points.len(), segments.len().saturating_mul(SEGMENT))?;
    let size = work(points.len(), segments.len(), false);
    let made =
        interruptible(py, size, move || Weld2::new(&points, &segments, tolerance))?.map_err(python_error)?;
    let of_indices = |given: &[usize]| given.iter().map(|&i| i as i64).collect::<Vec<_>>();
    let pieces = made.segments.len();
    Ok((
        PyArray1::from_vec(py, of_indices(&made.stays)),
        PyArray1::from_vec(py, of_indices(made.segments.as_flattened())).reshape([pieces, 2])?,
        PyArray1::from_vec(py, of_indices(&made.origins)),
        (made.moved, made.largest_move, made.bends, made.collapsed),
    ))
}
