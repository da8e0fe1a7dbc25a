//! Alpha complexes.

use std::sync::Arc;

use delone::{Alpha2, Alpha3, Delaunay2, Delaunay3, Error, Regular2, Regular3};
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::errors::python_error;
use crate::interrupt::{interruptible, size_of_points};
use crate::memory::ALPHA;
use crate::state::{indices, table};
use crate::triangulation::coordinates;

enum Complexes {
    Plane(Alpha2),
    Space(Alpha3),
}

/// All alpha complexes of points, with weights or without.
#[pyclass(module = "delone._delone", frozen)]
pub struct Alpha(Arc<Complexes>);

/// Calls one of two that have the same name.
macro_rules! either {
    ($all:expr, $alpha:ident => $result:expr) => {
        match $all {
            Complexes::Plane($alpha) => $result,
            Complexes::Space($alpha) => $result,
        }
    };
}

#[pymethods]
impl Alpha {
    #[new]
    #[pyo3(signature = (points, weights=None))]
    fn new(
        py: Python<'_>,
        points: PyReadonlyArray2<'_, f64>,
        weights: Option<PyReadonlyArray1<'_, f64>>,
    ) -> PyResult<Self> {
        let count = points.shape()[0];
        let size = size_of_points(points.shape()[1], 0, count);
        let weights = weights.map(|weights| weights.to_vec()).transpose()?;
        ALPHA.check(points.shape()[1], count)?;
        let made: Result<Complexes, Error> = if points.shape()[1] == 2 {
            let points: Vec<[f64; 2]> = coordinates(&points)?;
            interruptible(py, size, move || {
                Ok(Complexes::Plane(match weights {
                    None => Delaunay2::from_vec(points)?.alpha(),
                    Some(weights) => Regular2::with_seed(&points, &weights, 0)?.alpha(),
                }))
            })?
        } else {
            let points: Vec<[f64; 3]> = coordinates(&points)?;
            interruptible(py, size, move || {
                Ok(Complexes::Space(match weights {
                    None => Delaunay3::from_vec(points)?.alpha(),
                    Some(weights) => Regular3::with_seed(&points, &weights, 0)?.alpha(),
                }))
            })?
        };
        Ok(Self(Arc::new(made.map_err(python_error)?)))
    }

    /// The faces of a dimension by their corners, in the order of the filtration.
    fn simplices<'py>(&self, py: Python<'py>, dimension: usize) -> PyResult<Bound<'py, PyArray2<i32>>> {
        let corners = self.of(py, move |complexes| {
            either!(complexes, alpha => {
                let all = alpha.all();
                match dimension {
                    0 => indices(all.vertices.iter().copied()),
                    1 => indices(all.edges.iter().copied()),
                    2 => indices(all.triangles.iter().copied()),
                    _ => indices(all.tetrahedra.iter().copied()),
                }
            })
        })?;
        table(py, dimension + 1, corners)
    }

    /// Their values.
    fn values<'py>(&self, py: Python<'py>, dimension: usize) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let values =
            self.of(py, move |complexes| either!(complexes, alpha => alpha.values(dimension).to_vec()))?;
        Ok(PyArray1::from_vec(py, values))
    }

    /// In the plane the corners of all rings, the lengths of rings and their number in each polygon; in space the corners of triangles.
    fn outline<'py>(&self, py: Python<'py>, alpha: f64) -> PyResult<[Bound<'py, PyArray1<i32>>; 3]> {
        let arrays = self.of(py, move |complexes| match complexes {
            Complexes::Plane(complexes) => {
                let outline = complexes.outline(alpha);
                let all = || outline.iter().flatten();
                let corners = all().flatten().map(|v| v.index() as i32).collect();
                let rings = all().map(|ring| ring.len() as i32).collect();
                [corners, rings, outline.iter().map(|part| part.len() as i32).collect()]
            }
            Complexes::Space(complexes) => {
                [indices(complexes.outline(alpha).into_iter()), Vec::new(), Vec::new()]
            }
        })?;
        Ok(arrays.map(|array| PyArray1::from_vec(py, array)))
    }

    /// In space, of the outline without pinches: the point of each vertex, and the corners of triangles among vertices.
    fn manifold<'py>(&self, py: Python<'py>, alpha: f64) -> PyResult<[Bound<'py, PyArray1<i32>>; 2]> {
        let arrays = self.of(py, move |complexes| {
            let Complexes::Space(complexes) = complexes else { return None };
            let surface = complexes.manifold(alpha);
            let vertices: Vec<i32> = surface.vertices.iter().map(|v| v.index() as i32).collect();
            let corners: Vec<i32> = surface.triangles.iter().flatten().map(|&i| i as i32).collect();
            Some([vertices, corners])
        })?;
        let arrays = arrays.ok_or_else(|| PyValueError::new_err("outlines in the plane have no pinches"))?;
        Ok(arrays.map(|array| PyArray1::from_vec(py, array)))
    }

    /// The component of each point, -1 for none.
    fn components<'py>(&self, py: Python<'py>, alpha: f64) -> PyResult<Bound<'py, PyArray1<i32>>> {
        let labels = self.of(py, move |complexes| {
            let labels = either!(complexes, complexes => complexes.components(alpha));
            labels.into_iter().map(|label| label.map_or(-1, |label| label as i32)).collect()
        })?;
        Ok(PyArray1::from_vec(py, labels))
    }

    /// The least value at which all points are in at most so many parts.
    fn optimal(&self, py: Python<'_>, parts: usize) -> PyResult<Option<f64>> {
        self.of(py, move |complexes| either!(complexes, complexes => complexes.optimal(parts)))
    }

    /// All values, each once.
    fn spectrum<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let values = self.of(py, |complexes| either!(complexes, complexes => complexes.spectrum()))?;
        Ok(PyArray1::from_vec(py, values))
    }
}

impl Alpha {
    /// Runs work on all complexes.
    fn of<A: Send + 'static>(
        &self,
        py: Python<'_>,
        make: impl FnOnce(&Complexes) -> A + Send + 'static,
    ) -> PyResult<A> {
        let complexes = Arc::clone(&self.0);
        let size = either!(&*complexes, alpha => alpha.all().edges.len());
        interruptible(py, size, move || make(&complexes))
    }
}
