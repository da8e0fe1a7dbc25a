//! Alpha complexes.

use delone::{Alpha2, Alpha3, Delaunay2, Delaunay3, Error, Regular2, Regular3, VertexId};
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::errors::python_error;
use crate::interrupt::interruptible;
use crate::memory::ALPHA;
use crate::triangulation::coordinates;

enum Complexes {
    Plane(Alpha2),
    Space(Alpha3),
}

/// All alpha complexes of points, with weights or without.
#[pyclass(module = "delone._delone", frozen)]
pub struct Alpha(Complexes);

/// Calls one of two that have the same name.
macro_rules! either {
    ($self:ident, $alpha:ident => $result:expr) => {
        match &$self.0 {
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
        let weights = weights.map(|weights| weights.to_vec()).transpose()?;
        ALPHA.check(points.shape()[1], count)?;
        let made: Result<Complexes, Error> = if points.shape()[1] == 2 {
            let points: Vec<[f64; 2]> = coordinates(&points)?;
            interruptible(py, count, move || {
                Ok(Complexes::Plane(match weights {
                    None => Delaunay2::from_vec(points)?.alpha(),
                    Some(weights) => Regular2::with_seed(&points, &weights, 0)?.alpha(),
                }))
            })?
        } else {
            let points: Vec<[f64; 3]> = coordinates(&points)?;
            interruptible(py, count, move || {
                Ok(Complexes::Space(match weights {
                    None => Delaunay3::from_vec(points)?.alpha(),
                    Some(weights) => Regular3::with_seed(&points, &weights, 0)?.alpha(),
                }))
            })?
        };
        Ok(Self(made.map_err(python_error)?))
    }

    /// The faces of a dimension by their corners, in the order of the filtration.
    fn simplices<'py>(&self, py: Python<'py>, dimension: usize) -> PyResult<Bound<'py, PyArray2<i32>>> {
        let corners = either!(self, alpha => {
            let all = alpha.all();
            match dimension {
                0 => indices(all.vertices),
                1 => indices(all.edges),
                2 => indices(all.triangles),
                _ => indices(all.tetrahedra),
            }
        });
        let count = corners.len() / (dimension + 1);
        PyArray1::from_vec(py, corners).reshape([count, dimension + 1])
    }

    /// Their values.
    fn values<'py>(&self, py: Python<'py>, dimension: usize) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, either!(self, alpha => alpha.values(dimension)))
    }

    /// In the plane the corners of all rings, the lengths of rings and their number in each polygon; in space the corners of triangles.
    fn outline<'py>(&self, py: Python<'py>, alpha: f64) -> [Bound<'py, PyArray1<i32>>; 3] {
        let (corners, rings, parts) = py.detach(|| match &self.0 {
            Complexes::Plane(complexes) => {
                let outline = complexes.outline(alpha);
                let all = || outline.iter().flatten();
                let corners = all().flatten().map(|v| v.index() as i32).collect();
                let rings = all().map(|ring| ring.len() as i32).collect();
                (corners, rings, outline.iter().map(|part| part.len() as i32).collect())
            }
            Complexes::Space(complexes) => (indices(&complexes.outline(alpha)), Vec::new(), Vec::new()),
        });
        [corners, rings, parts].map(|array| PyArray1::from_vec(py, array))
    }

    /// In space, of the outline without pinches: the point of each vertex, and the corners of triangles among vertices.
    fn manifold<'py>(&self, py: Python<'py>, alpha: f64) -> PyResult<[Bound<'py, PyArray1<i32>>; 2]> {
        let Complexes::Space(complexes) = &self.0 else {
            return Err(PyValueError::new_err("outlines in the plane have no pinches"));
        };
        let (vertices, corners) = py.detach(|| {
            let surface = complexes.manifold(alpha);
            let vertices: Vec<i32> = surface.vertices.iter().map(|v| v.index() as i32).collect();
            let corners: Vec<i32> = surface.triangles.iter().flatten().map(|&i| i as i32).collect();
            (vertices, corners)
        });
        Ok([vertices, corners].map(|array| PyArray1::from_vec(py, array)))
    }

    /// The component of each point, -1 for none.
    fn components<'py>(&self, py: Python<'py>, alpha: f64) -> Bound<'py, PyArray1<i32>> {
        let labels = py.detach(|| either!(self, complexes => complexes.components(alpha)));
        PyArray1::from_iter(py, labels.into_iter().map(|label| label.map_or(-1, |label| label as i32)))
    }

    /// The least value at which all points are in at most so many parts.
    fn optimal(&self, py: Python<'_>, parts: usize) -> Option<f64> {
        py.detach(|| either!(self, complexes => complexes.optimal(parts)))
    }

    /// All values, each once.
    fn spectrum<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        let values = py.detach(|| either!(self, complexes => complexes.spectrum()));
        PyArray1::from_vec(py, values)
    }
}

fn indices<const N: usize>(faces: &[[VertexId; N]]) -> Vec<i32> {
    faces.as_flattened().iter().map(|v| v.index() as i32).collect()
}
