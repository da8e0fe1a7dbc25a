//! A regular triangulation, by its arrays and its changes, and its power cells in the plane.

use delone::{Coordinates, Region2, Regular as Weighted, Regular2, Regular3, VertexId};
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::errors::python_error;
use crate::interrupt::{in_pieces, interruptible, size_of_points, size_of_queries};
use crate::memory::TRIANGULATION;
use crate::shared::Shared;
use crate::state::{QUERIES, Rows, State, indices, table};
use crate::triangulation::coordinates;

/// With the array of the weights, which is never written.
type Held<T> = Shared<State<T, Py<PyAny>>>;

enum Core {
    Plane(Held<Regular2>),
    Space(Held<Regular3>),
}

/// See `_delone.pyi`.
#[pyclass(module = "delone._delone", frozen)]
pub struct Regular(Core);

/// Runs an expression for either dimension.
macro_rules! either {
    ($core:expr, $held:ident => $body:expr) => {
        match $core {
            Core::Plane($held) => $body,
            Core::Space($held) => $body,
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
        let columns = points.shape()[1];
        Ok(Self(match columns {
            2 => Core::Plane(build(py, coordinates(&points)?, &weights)?),
            3 => Core::Space(build(py, coordinates(&points)?, &weights)?),
            columns => return Err(PyValueError::new_err(format!("points of {columns} coordinates"))),
        }))
    }

    /// Another number after each change.
    #[getter]
    fn version(&self, py: Python<'_>) -> PyResult<usize> {
        either!(&self.0, held => Ok(held.read(py)?.version()))
    }

    #[getter]
    fn weights(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        either!(&self.0, held => Ok(held.read(py)?.record.clone_ref(py)))
    }

    /// Corners and neighbors of the finite simplices.
    fn arrays<'py>(&self, py: Python<'py>) -> PyResult<(Rows<'py>, Rows<'py>)> {
        either!(&self.0, held => held.read(py)?.arrays(py))
    }

    fn hull<'py>(&self, py: Python<'py>) -> PyResult<Rows<'py>> {
        either!(&self.0, held => held.read(py)?.hull(py))
    }

    fn edges<'py>(&self, py: Python<'py>) -> PyResult<Rows<'py>> {
        either!(&self.0, held => held.read(py)?.edges(py))
    }

    fn duplicates<'py>(&self, py: Python<'py>) -> PyResult<Rows<'py>> {
        either!(&self.0, held => held.read(py)?.duplicates(py, |_, _| true))
    }

    #[getter]
    fn vertex_count(&self, py: Python<'_>) -> PyResult<usize> {
        either!(&self.0, held => Ok(held.read(py)?.vertex_count()))
    }

    /// The indices of sites that others hide.
    fn hidden<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray1<i32>>> {
        let hidden = either!(&self.0, held => {
            held.read(py)?.make(py, |state| indices(state.triangulation.hidden().map(|v| [v])))
        })?;
        Ok(PyArray1::from_vec(py, hidden))
    }

    /// Gives all sites other weights.
    fn set_weights(&self, py: Python<'_>, weights: PyReadonlyArray1<'_, f64>) -> PyResult<()> {
        let (array, weights) = (weights.as_any().clone().unbind(), weights.to_vec()?);
        let set = either!(&self.0, held => held.change(py, State::size, move |state| {
            state.forget();
            state.triangulation.set_weights(&weights)?;
            state.record = array;
            Ok(())
        }))?;
        set.map_err(python_error)
    }

    /// Takes the weights for which the cells in a polygon with holes have prescribed areas, in proportion: by how much of itself an area is
    /// wrong at most.
    fn adjust_weights<'py>(
        &self,
        py: Python<'py>,
        areas: PyReadonlyArray1<'_, f64>,
        rings: Vec<PyReadonlyArray2<'py, f64>>,
        tolerance: f64,
    ) -> PyResult<f64> {
        let held = self.plane()?;
        let rings = rings.iter().map(coordinates).collect::<PyResult<Vec<Vec<[f64; 2]>>>>()?;
        let shares = areas.to_vec()?;
        // The weights that there are do not matter.
        let built = held.read(py)?.make(py, move |state| {
            let (r, count) = (&state.triangulation, shares.len());
            let point = |i| r.site(VertexId::new(i)).map(|site| site.0);
            let points: Vec<[f64; 2]> = (0..count).filter_map(point).collect();
            let region = Region2::polygon(&rings)?;
            let (r, prescribed) = Regular2::with_areas(&points, &shares, &region, tolerance)?;
            let weight = |i| r.site(VertexId::new(i)).map_or(0.0, |site| site.1);
            let weights: Vec<f64> = (0..count).map(weight).collect();
            Ok((r, weights, prescribed.error))
        })?;
        let (r, weights, error) = built.map_err(python_error)?;
        let weights = PyArray1::from_vec(py, weights).into_any().unbind();
        held.replace(py, State::of(r, weights))?;
        Ok(error)
    }

    /// The site with the least power at each point; -1 if there is none.
    fn nearest<'py>(
        &self,
        py: Python<'py>,
        queries: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray1<i64>>> {
        let found = match &self.0 {
            Core::Plane(held) => nearest(py, held, coordinates(&queries)?),
            Core::Space(held) => nearest(py, held, coordinates(&queries)?),
        };
        Ok(PyArray1::from_vec(py, found?))
    }

    /// Integrals over the cells of so many sites, clipped to a polygon with holes.
    fn integrals<'py>(
        &self,
        py: Python<'py>,
        sites: usize,
        rings: Vec<PyReadonlyArray2<'py, f64>>,
    ) -> PyResult<Integrals<'py>> {
        let rings = rings.iter().map(coordinates).collect::<PyResult<Vec<Vec<[f64; 2]>>>>()?;
        // Each side of the polygon may cut each cell.
        let border: usize = rings.iter().map(Vec::len).sum();
        let size = sites.saturating_mul(border.max(1));
        let integrals = self.plane()?.ask(
            py,
            |_| size,
            move |state| {
                let r = &state.triangulation;
                let region = Region2::polygon(&rings)?;
                let jacobian = r.power().jacobian(&region);
                let cells = r.power().clip(&region);
                let all = || (0..sites).map(VertexId::new);
                let centroids = all().flat_map(|v| cells.centroid(v).unwrap_or([f64::NAN; 2])).collect();
                let moment = |v| r.site(v).map_or(0.0, |(p, _)| cells.second_moment(v, p));
                let moments = all().map(moment).collect();
                let pairs = indices(jacobian.derivatives.iter().map(|&(ends, _)| ends));
                let values = jacobian.derivatives.iter().map(|&(_, value)| value).collect();
                Ok((jacobian.areas, pairs, values, centroids, moments))
            },
        )?;
        let (areas, pairs, values, centroids, moments) = integrals.map_err(python_error)?;
        let list = |values: Vec<f64>| PyArray1::from_vec(py, values);
        Ok((list(areas), table(py, 2, pairs)?, list(values), table(py, 2, centroids)?, list(moments)))
    }
}

impl Regular {
    fn plane(&self) -> PyResult<&Held<Regular2>> {
        match &self.0 {
            Core::Plane(held) => Ok(held),
            Core::Space(_) => Err(PyValueError::new_err("power cells are clipped in the plane")),
        }
    }
}

fn build<T: Weighted + 'static>(
    py: Python<'_>,
    points: Vec<T::Point>,
    weights: &PyReadonlyArray1<'_, f64>,
) -> PyResult<Held<T>> {
    let count = points.len();
    TRIANGULATION.check_with(T::Point::COUNT, count, 16 * count)?;
    let (array, weights) = (weights.as_any().clone().unbind(), weights.to_vec()?);
    let size = size_of_points(T::Point::COUNT, 0, count);
    let built = interruptible(py, size, move || T::from_parts(&points, &weights))?;
    Ok(Shared::new(State::of(built.map_err(python_error)?, array)))
}

fn nearest<T: Weighted + 'static>(
    py: Python<'_>,
    held: &Held<T>,
    queries: Vec<T::Point>,
) -> PyResult<Vec<i64>> {
    // Any place does.
    let get_ready = |r: &T| _ = r.nearest(T::Point::default());
    let size = size_of_queries(queries.len(), 1);
    State::asked_after(held, py, size, get_ready, move |state, wanted| {
        let index = |v: Option<VertexId>| v.map_or(-1, |v| v.index() as i64);
        let answer = |&q: &T::Point| state.triangulation.nearest(q).map(index);
        in_pieces(wanted, &queries, QUERIES, answer).map_err(python_error)
    })
}
