//! Convex hulls.

use delone::Hull3;
use delone_predicates::{Sign, orient2d, orient3d};
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::errors::python_error;
use crate::interrupt::interruptible;
use crate::memory::HULL;
use crate::triangulation::coordinates;

/// The facets of the hull as rows of indices, and what the points span.
#[pyfunction]
pub fn convex_hull<'py>(
    py: Python<'py>,
    points: PyReadonlyArray2<'py, f64>,
) -> PyResult<Bound<'py, PyArray2<i32>>> {
    match points.shape()[1] {
        2 => {
            let points: Vec<[f64; 2]> = coordinates(&points)?;
            HULL.check(2, points.len())?;
            let hull = interruptible(py, points.len(), move || delone::Hull2::from_points(&points))?;
            let hull = hull.map_err(python_error)?;
            let edges: Vec<i32> = hull.facets().flatten().map(|v| v as i32).collect();
            let count = edges.len() / 2;
            PyArray1::from_vec(py, edges).reshape([count, 2])
        }
        3 => {
            let points: Vec<[f64; 3]> = coordinates(&points)?;
            HULL.check(3, points.len())?;
            let hull = interruptible(py, points.len(), move || Hull3::from_points(&points))?
                .map_err(python_error)?;
            let is_body = hull.dimension() == delone::Dimension::Space;
            let facets = hull.facets().filter(|_| is_body).flatten().map(|v| v as i32);
            let facets: Vec<i32> = facets.collect();
            let count = facets.len() / 3;
            PyArray1::from_vec(py, facets).reshape([count, 3])
        }
        columns => Err(PyValueError::new_err(format!("points of {columns} coordinates"))),
    }
}

/// On which side of facets points are, a row for each point: 1 outside, 0 in its line or plane, -1 inside. Facets are
/// given by coordinates, the corners of each one after the other.
#[pyfunction]
pub fn sides<'py>(
    py: Python<'py>,
    facets: PyReadonlyArray2<'py, f64>,
    points: PyReadonlyArray2<'py, f64>,
) -> PyResult<Bound<'py, PyArray2<i8>>> {
    let (rows, columns) = (points.shape()[0], facets.shape()[0] / points.shape()[1].max(1));
    let size = rows.saturating_mul(columns);
    let sides = if points.shape()[1] == 2 {
        let (facets, points) = (coordinates(&facets)?, coordinates(&points)?);
        interruptible(py, size, move || {
            table(&points, facets.as_chunks().0, |p, [a, b]| -orient2d(*a, *b, *p))
        })?
    } else {
        let (facets, points) = (coordinates(&facets)?, coordinates(&points)?);
        interruptible(py, size, move || {
            table(&points, facets.as_chunks().0, |p, [a, b, c]| orient3d(*a, *b, *c, *p))
        })?
    };
    PyArray1::from_vec(py, sides).reshape([rows, columns])
}

/// Signs of points and facets, as numbers.
fn table<const D: usize>(
    points: &[[f64; D]],
    facets: &[[[f64; D]; D]],
    side: impl Fn(&[f64; D], &[[f64; D]; D]) -> Sign,
) -> Vec<i8> {
    points.iter().flat_map(|p| facets.iter().map(|f| side(p, f) as i8).collect::<Vec<_>>()).collect()
}
