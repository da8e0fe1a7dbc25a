//! A regular triangulation, by its arrays and its changes, and its power cells in the plane.

use delone::{Region2, Regular2, Regular3, VertexId};
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::errors::python_error;
use crate::interrupt::interruptible;
use crate::memory::TRIANGULATION;
use crate::pool::{FEW, detached};
use crate::shared::Shared;
use crate::triangulation::{Rows, State, coordinates};

enum Core {
    Plane(Box<State<Regular2>>),
    Space(Box<State<Regular3>>),
}

/// See `_delone.pyi`.
#[pyclass(module = "delone._delone", frozen)]
pub struct Regular {
    core: Shared<Core>,
}

/// The same for either dimension.
macro_rules! either {
    ($core:expr, $state:ident => $body:expr) => {
        match $core {
            Core::Plane($state) => $body,
            Core::Space($state) => $body,
        }
    };
}

/// Areas; rows, columns and values of derivatives; centroids; and second moments about the sites.
type Integrals<'py> = (
    Bound<'py, PyArray1<f64>>,
    Rows<'py>,
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray2<f64>>,
    Bound<'py, PyArray1<f64>>,
);

#[pymethods]
impl Regular {
    #[new]
    fn new(
        py: Python<'_>,
        points: PyReadonlyArray2<'_, f64>,
        weights: PyReadonlyArray1<'_, f64>,
    ) -> PyResult<Self> {
        let weights = weights.as_slice()?.to_vec();
        let (count, columns) = (points.shape()[0], points.shape()[1]);
        TRIANGULATION.check_with(columns.clamp(2, 3), count, 16 * count)?;
        let core = match columns {
            2 => {
                let points: Vec<[f64; 2]> = coordinates(&points)?;
                let built = interruptible(py, count, move || Regular2::from_parts(&points, &weights))?;
                Core::Plane(Box::new(State::of(built.map_err(python_error)?)))
            }
            3 => {
                let points: Vec<[f64; 3]> = coordinates(&points)?;
                let built = interruptible(py, count, move || Regular3::from_parts(&points, &weights))?;
                Core::Space(Box::new(State::of(built.map_err(python_error)?)))
            }
            columns => return Err(PyValueError::new_err(format!("points of {columns} coordinates"))),
        };
        Ok(Self { core: Shared::new(core) })
    }

    /// Corners and neighbours of the finite simplices.
    fn arrays<'py>(&self, py: Python<'py>) -> PyResult<(Rows<'py>, Rows<'py>)> {
        either!(&*self.core.read(py)?, state => state.arrays(py))
    }

    fn hull<'py>(&self, py: Python<'py>) -> PyResult<Rows<'py>> {
        either!(&*self.core.read(py)?, state => state.hull(py))
    }

    fn edges<'py>(&self, py: Python<'py>) -> PyResult<Rows<'py>> {
        either!(&*self.core.read(py)?, state => state.edges(py))
    }

    fn duplicates<'py>(&self, py: Python<'py>) -> PyResult<Rows<'py>> {
        either!(&*self.core.read(py)?, state => state.duplicates(py))
    }

    #[getter]
    fn vertex_count(&self, py: Python<'_>) -> PyResult<usize> {
        Ok(either!(&*self.core.read(py)?, state => state.vertex_count()))
    }

    /// The indices of sites that others hide.
    fn hidden<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<i32>>> {
        let hidden: Vec<i32> = either!(&*self.core.read(py)?, state => state.triangulation.hidden().map(|v| v.index() as i32).collect());
        Ok(PyArray1::from_vec(py, hidden))
    }

    /// Gives all sites other weights.
    fn set_weights(&self, py: Python<'_>, weights: PyReadonlyArray1<'_, f64>) -> PyResult<()> {
        let weights = weights.as_slice()?;
        either!(&mut *self.core.write(py)?, state => {
            let is_long = state.change(weights.len());
            detached(py, is_long, || state.triangulation.set_weights(weights)).map_err(python_error)?;
        });
        Ok(())
    }

    /// Takes the weights for which the cells in a polygon with holes have prescribed areas, in proportion: these weights, and by how
    /// much of itself an area is wrong at most.
    fn adjust_weights<'py>(
        &self,
        py: Python<'py>,
        areas: PyReadonlyArray1<'_, f64>,
        rings: Vec<PyReadonlyArray2<'py, f64>>,
        tolerance: f64,
    ) -> PyResult<(Bound<'py, PyArray1<f64>>, f64)> {
        let mut core = self.core.write(py)?;
        let Core::Plane(state) = &mut *core else {
            return Err(PyValueError::new_err("power cells are clipped in the plane"));
        };
        let rings = rings.iter().map(coordinates).collect::<PyResult<Vec<Vec<[f64; 2]>>>>()?;
        let shares = areas.as_slice()?.to_vec();
        let (r, count) = (&state.triangulation, shares.len());
        let points: Vec<[f64; 2]> =
            (0..count).filter_map(|i| r.site(VertexId::new(i)).map(|site| site.0)).collect();
        let built = interruptible(py, count, move || {
            let region = Region2::polygon(&rings)?;
            Regular2::with_areas(&points, &shares, &region, tolerance)
        })?;
        let (r, prescribed) = built.map_err(python_error)?;
        let weight = |i| r.site(VertexId::new(i)).map_or(0.0, |site| site.1);
        let weights: Vec<f64> = (0..count).map(weight).collect();
        **state = State::of(r);
        Ok((PyArray1::from_vec(py, weights), prescribed.error))
    }

    /// The site with the least power at each point; -1 if there is none.
    fn nearest<'py>(
        &self,
        py: Python<'py>,
        queries: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray1<i64>>> {
        let index = |v: Option<VertexId>| v.map_or(-1, |v| v.index() as i64);
        let found = match &*self.core.read(py)? {
            Core::Plane(state) => {
                let queries: Vec<[f64; 2]> = coordinates(&queries)?;
                let nearest = |q| state.triangulation.nearest(q).map(index);
                py.detach(|| queries.into_iter().map(nearest).collect::<Result<Vec<i64>, _>>())
            }
            Core::Space(state) => {
                let queries: Vec<[f64; 3]> = coordinates(&queries)?;
                let nearest = |q| state.triangulation.nearest(q).map(index);
                py.detach(|| queries.into_iter().map(nearest).collect::<Result<Vec<i64>, _>>())
            }
        };
        Ok(PyArray1::from_vec(py, found.map_err(python_error)?))
    }

    /// Integrals over the cells of so many sites, clipped to a polygon with holes.
    fn integrals<'py>(
        &self,
        py: Python<'py>,
        sites: usize,
        rings: Vec<PyReadonlyArray2<'py, f64>>,
    ) -> PyResult<Integrals<'py>> {
        let core = self.core.read(py)?;
        let Core::Plane(state) = &*core else {
            return Err(PyValueError::new_err("power cells are clipped in the plane"));
        };
        let rings = rings.iter().map(coordinates).collect::<PyResult<Vec<Vec<[f64; 2]>>>>()?;
        let r = &state.triangulation;
        let (jacobian, centroids, moments) = detached(py, sites >= FEW, || {
            let region = Region2::polygon(&rings).map_err(python_error)?;
            let jacobian = r.power().jacobian(&region);
            let cells = r.power().clip(&region);
            let all = || (0..sites).map(VertexId::new);
            let centroids: Vec<[f64; 2]> =
                all().map(|v| cells.centroid(v).unwrap_or([f64::NAN; 2])).collect();
            let moment = |v| r.site(v).map_or(0.0, |(p, _)| cells.second_moment(v, p));
            Ok::<_, PyErr>((jacobian, centroids, all().map(moment).collect::<Vec<f64>>()))
        })?;
        let pairs: Vec<i32> =
            jacobian.derivatives.iter().flat_map(|(ends, _)| ends.map(|v| v.index() as i32)).collect();
        let values: Vec<f64> = jacobian.derivatives.iter().map(|&(_, value)| value).collect();
        Ok((
            PyArray1::from_vec(py, jacobian.areas),
            PyArray1::from_vec(py, pairs).reshape([values.len(), 2])?,
            PyArray1::from_vec(py, values),
            PyArray1::from_vec(py, centroids.into_flattened()).reshape([sites, 2])?,
            PyArray1::from_vec(py, moments),
        ))
    }
}
