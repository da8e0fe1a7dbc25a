//! Convex hulls.

use delone::{Error, Hull2, Hull3};
use delone_predicates::{Sign, orient2d, orient3d};
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::errors::python_error;
use crate::interrupt::interruptible;
use crate::memory::HULL;
use crate::state::Rows;
use crate::triangulation::coordinates;

/// Facets as rows of indices, the face of each, and the corners of faces with where each begins.
type Facets<'py> = (Rows<'py>, Column<'py, i32>, Column<'py, i32>, Column<'py, i64>);
type Column<'py, T> = Bound<'py, PyArray1<T>>;

/// The facets of the hull, and the faces that they are parts of; none of points that span less. Corners within a length of the hull of the others
/// are left out, if one is given; where nothing is left then there are no facets, if that is no error.
#[pyfunction]
#[pyo3(signature = (points, merge=None, may_be_flat=false))]
pub fn convex_hull<'py>(
    py: Python<'py>,
    points: PyReadonlyArray2<'py, f64>,
    merge: Option<f64>,
    may_be_flat: bool,
) -> PyResult<Facets<'py>> {
    let is_flat = |error: &Error| {
        may_be_flat && matches!(error, Error::Parameter { value, .. } if *value >= 0.0 && value.is_finite())
    };
    match points.shape()[1] {
        2 => {
            let points: Vec<[f64; 2]> = coordinates(&points)?;
            HULL.check(2, points.len())?;
            let hull = interruptible(py, points.len(), move || {
                let hull = Hull2::from_points(&points)?;
                match merge {
                    None => Ok(hull),
                    Some(length) => hull.merged(&points, length),
                }
            })?;
            let edges = match hull {
                Err(error) if is_flat(&error) => Vec::new(),
                hull => hull.map_err(python_error)?.facets().collect(),
            };
            rows(py, &edges, 0..edges.len(), edges.iter().map(|edge| &edge[..]))
        }
        3 => {
            let points: Vec<[f64; 3]> = coordinates(&points)?;
            HULL.check(3, points.len())?;
            let hull = interruptible(py, points.len(), move || {
                let hull = Hull3::from_points(&points)?;
                match merge {
                    None => Ok(hull),
                    Some(length) => hull.merged(&points, length),
                }
            })?;
            let hull = match hull {
                Err(error) if is_flat(&error) => Hull3::from_points::<[f64; 3]>(&[]),
                hull => hull,
            };
            let hull = hull.map_err(python_error)?;
            let (of, parts): (Vec<usize>, Vec<[usize; 3]>) = hull.facets_of_faces().unzip();
            let is_body = hull.dimension() == delone::Dimension::Space;
            rows(py, &parts, of, hull.faces().filter(|_| is_body))
        }
        columns => Err(PyValueError::new_err(format!("points of {columns} coordinates"))),
    }
}

/// Facets, which are the parts of faces, and faces as arrays.
fn rows<'py, 'a, const D: usize>(
    py: Python<'py>,
    parts: &[[usize; D]],
    of: impl IntoIterator<Item = usize>,
    faces: impl Iterator<Item = &'a [usize]>,
) -> PyResult<Facets<'py>> {
    let numbers: Vec<i32> = parts.iter().flatten().map(|&v| v as i32).collect();
    let of: Vec<i32> = of.into_iter().map(|face| face as i32).collect();
    let (mut corners, mut starts) = (Vec::<i32>::new(), vec![0]);
    for face in faces {
        corners.extend(face.iter().map(|&v| v as i32));
        starts.push(corners.len() as i64);
    }
    let parts = PyArray1::from_vec(py, numbers).reshape([parts.len(), D])?;
    let [of, corners] = [of, corners].map(|values| PyArray1::from_vec(py, values));
    Ok((parts, of, corners, PyArray1::from_vec(py, starts)))
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
