//! Arrays derived from the corners of simplices: neighbors, a simplex of each point, maps to barycentric coordinates, planes of lifted
//! simplices. Arrays in, arrays out.

mod barycentric;
mod incident;
mod lifted;

use std::convert::Infallible;

use numpy::{PyArray1, PyArray2, PyArray3, PyArrayMethods, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;

use crate::arrays::{indices, rows};
use crate::interrupt::interruptible;
use crate::pool::{SERIAL_ITEMS, shared};

/// Simplices that one task looks at: so many take about a millisecond.
const TASK: usize = SERIAL_ITEMS / 2;

/// The simplices across from each corner, -1 where there is none; each facet belongs to at most two.
#[pyfunction]
pub fn neighbors_of<'py>(
    py: Python<'py>,
    simplices: PyReadonlyArray2<'py, i32>,
) -> PyResult<Bound<'py, PyArray2<i32>>> {
    fn array<'py, const W: usize>(py: Python<'py>, rows: &[[i32; W]]) -> PyResult<Bound<'py, PyArray2<i32>>> {
        let (count, rows) = (rows.len(), rows.to_vec());
        let found = interruptible(py, count, move || incident::neighbors(&rows))?;
        PyArray1::from_vec(py, found.into_flattened()).reshape([count, W])
    }
    match simplices.shape()[1] {
        2 => array::<2>(py, rows(&simplices)?),
        _ => array::<3>(py, rows(&simplices)?),
    }
}

/// Which of so many points are corners of triangles, increasing.
#[pyfunction]
pub fn corners_of<'py>(
    py: Python<'py>,
    points: usize,
    facets: PyReadonlyArray2<'py, i32>,
) -> PyResult<Bound<'py, PyArray1<i32>>> {
    let mut is_corner = vec![false; points];
    for &corner in indices::<3>(&facets, 0, points)?.as_flattened() {
        is_corner[corner as usize] = true;
    }
    let corners = (0..).zip(is_corner).filter_map(|(point, is_corner)| is_corner.then_some(point));
    Ok(PyArray1::from_vec(py, corners.collect()))
}

/// For each of so many points the last simplex that it, or the one that it equals, is a corner of; -1 for those that are no corner.
/// Twins are points with the one that each equals.
#[pyfunction]
pub fn vertex_to_simplex<'py>(
    py: Python<'py>,
    points: usize,
    simplices: PyReadonlyArray2<'py, i32>,
    twins: PyReadonlyArray2<'py, i32>,
) -> PyResult<Bound<'py, PyArray1<i32>>> {
    let mut found = vec![-1; points];
    let mut fill = |row: usize, corners: &[i32]| corners.iter().for_each(|&p| found[p as usize] = row as i32);
    if simplices.shape()[1] == 3 {
        indices::<3>(&simplices, 0, points)?.iter().enumerate().for_each(|(row, corners)| fill(row, corners));
    } else {
        indices::<4>(&simplices, 0, points)?.iter().enumerate().for_each(|(row, corners)| fill(row, corners));
    }
    for &[twin, first] in indices::<2>(&twins, 0, points)? {
        found[twin as usize] = found[first as usize];
    }
    Ok(PyArray1::from_vec(py, found))
}

/// The neighbors of so many points that edges join: where those of each start, and which they are, increasing.
#[pyfunction]
#[expect(clippy::type_complexity, reason = "two arrays")]
pub fn vertex_neighbors<'py>(
    py: Python<'py>,
    points: usize,
    edges: PyReadonlyArray2<'py, i32>,
) -> PyResult<(Bound<'py, PyArray1<i32>>, Bound<'py, PyArray1<i32>>)> {
    let edges = indices::<2>(&edges, 0, points)?.to_vec();
    let (starts, others) = interruptible(py, points, move || incident::around(points, &edges))?;
    Ok((PyArray1::from_vec(py, starts), PyArray1::from_vec(py, others)))
}

/// For each simplex the map to barycentric coordinates and its last corner, (n, ndim + 1, ndim); NaN where it is not proved to be right.
#[pyfunction]
pub fn transforms<'py>(
    py: Python<'py>,
    points: PyReadonlyArray2<'py, f64>,
    simplices: PyReadonlyArray2<'py, i32>,
) -> PyResult<Bound<'py, PyArray3<f64>>> {
    let count = simplices.shape()[0];
    if points.shape()[1] == 2 {
        let maps = of_corners(py, &points, &simplices, barycentric::in_plane)?;
        PyArray1::from_vec(py, maps.into_flattened().into_flattened()).reshape([count, 3, 2])
    } else {
        let maps = of_corners(py, &points, &simplices, barycentric::in_space)?;
        PyArray1::from_vec(py, maps.into_flattened().into_flattened()).reshape([count, 4, 3])
    }
}

/// Planes of lifted simplices, (n, ndim + 2): normals of length 1 that point down, or up, and offsets.
#[pyfunction]
pub fn lifted_equations<'py>(
    py: Python<'py>,
    points: PyReadonlyArray2<'py, f64>,
    simplices: PyReadonlyArray2<'py, i32>,
    is_up: bool,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let count = simplices.shape()[0];
    if points.shape()[1] == 2 {
        let planes = of_corners(py, &points, &simplices, move |corners| lifted::in_plane(corners, is_up))?;
        PyArray1::from_vec(py, planes.into_flattened()).reshape([count, 4])
    } else {
        let planes = of_corners(py, &points, &simplices, move |corners| lifted::in_space(corners, is_up))?;
        PyArray1::from_vec(py, planes.into_flattened()).reshape([count, 5])
    }
}

/// Computes a value from the coordinates of the corners of each simplex, on all threads if there are many.
pub fn of_corners<const D: usize, const W: usize, A: Send + 'static>(
    py: Python<'_>,
    points: &PyReadonlyArray2<'_, f64>,
    simplices: &PyReadonlyArray2<'_, i32>,
    work: impl Fn([[f64; D]; W]) -> A + Send + Sync + 'static,
) -> PyResult<Vec<A>> {
    let points: &[[f64; D]] = rows(points)?;
    let simplices = indices(simplices, 0, points.len())?.to_vec();
    let (count, points) = (simplices.len(), points.to_vec());
    interruptible(py, count, move || {
        let work = |corners: &[i32; W]| Ok::<_, Infallible>(work(corners.map(|p| points[p as usize])));
        let Ok(found) = shared(&simplices, TASK, work);
        found
    })
}
