//! Values between points: interpolation and its weights.

use delone::surface::{Interpolator, Outside, Weights, gradients};
use delone::{Coordinates, Error, Surround};
use numpy::{
    PyArray1, PyArray2, PyArray3, PyArrayMethods, PyReadonlyArray2, PyReadonlyArray3, PyUntypedArrayMethods,
};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::interrupt::in_pieces;
use crate::memory::room;
use crate::near::Near;
use crate::pool::{FEW, detached};
use crate::triangulation::{Core, State, Triangulation, coordinates};

/// Where rows begin and the last one ends, columns, and weights.
type Rows<'py> = (Bound<'py, PyArray1<i64>>, Bound<'py, PyArray1<i32>>, Bound<'py, PyArray1<f64>>);

/// Values at queries, a row for each, of values with a row for each point; NaN outside. With gradients, an array of them for each
/// column, the surface is smooth.
#[pyfunction]
#[pyo3(signature = (triangulation, method, outside, queries, values, gradients=None))]
pub fn interpolate<'py>(
    py: Python<'py>,
    triangulation: &Triangulation,
    method: &str,
    outside: &str,
    queries: PyReadonlyArray2<'py, f64>,
    values: PyReadonlyArray2<'py, f64>,
    gradients: Option<PyReadonlyArray3<'py, f64>>,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let (count, columns) = (queries.shape()[0], values.shape()[1]);
    room(count.saturating_mul(columns).saturating_mul(16), "values at so many points")?;
    let found = match &*triangulation.core.read(py)? {
        Core::Plane(state) => values_at(py, state, method, outside, &queries, &values, gradients.as_ref()),
        Core::Space(state) => values_at(py, state, method, outside, &queries, &values, gradients.as_ref()),
    }?;
    PyArray1::from_vec(py, found).reshape([count, columns])
}

fn values_at<T: Surround + Sync>(
    py: Python<'_>,
    state: &State<T>,
    method: &str,
    outside: &str,
    queries: &PyReadonlyArray2<'_, f64>,
    values: &PyReadonlyArray2<'_, f64>,
    slopes: Option<&PyReadonlyArray3<'_, f64>>,
) -> PyResult<Vec<f64>>
where
    for<'a> Interpolator<'a, T>: Clone + Send + Sync,
{
    let f = interpolator(&state.triangulation, method, outside)?;
    let queries: Vec<T::Point> = coordinates(queries)?;
    let (columns, table) = (values.shape()[1], values.as_slice()?);
    let surface = match method {
        "smooth" => Interpolator::<T>::smooth,
        "farin" => Interpolator::<T>::farin,
        _ => {
            let near = detached(py, queries.len() >= FEW, || Near::new(queries));
            let found = in_pieces(py, &near.queries, |piece| {
                state.asked(py, piece.len(), || f.many(piece, table, columns))
            })?;
            return Ok(py.detach(|| near.back(found, columns)));
        }
    };
    let slopes = slopes.ok_or_else(|| PyValueError::new_err("a smooth surface needs gradients"))?;
    let rows = slopes.as_slice()?.chunks_exact(T::Point::COUNT);
    let slopes: Vec<T::Point> = rows
        .map(|row| {
            let mut slope = T::Point::default();
            slope.as_mut().copy_from_slice(row);
            slope
        })
        .collect();
    let points = values.shape()[0];
    if slopes.len() != points * columns {
        return Err(PyValueError::new_err(format!(
            "{} gradients where there must be {points} for each of {columns} columns",
            slopes.len()
        )));
    }
    let near = detached(py, queries.len() >= FEW, || Near::new(queries));
    let mut result = vec![f64::NAN; near.queries.len() * columns];
    for column in 0..columns {
        let own: Vec<f64> = table.iter().skip(column).step_by(columns).copied().collect();
        let slopes = &slopes[column * points..][..points];
        let found = in_pieces(py, &near.queries, |piece| {
            state.asked(py, piece.len(), || f.many_bent(piece, |f, q| surface(f, q, &own, slopes)))
        })?;
        for (row, value) in result.chunks_exact_mut(columns).zip(found) {
            row[column] = value;
        }
    }
    Ok(py.detach(|| near.back(result, columns)))
}

/// The weights of points at queries, compressed rows; empty ones outside.
#[pyfunction]
pub fn interpolation_weights<'py>(
    py: Python<'py>,
    triangulation: &Triangulation,
    method: &str,
    outside: &str,
    queries: PyReadonlyArray2<'py, f64>,
) -> PyResult<Rows<'py>> {
    room(queries.shape()[0].saturating_mul(256), "weights at so many points")?;
    let weights = match &*triangulation.core.read(py)? {
        Core::Plane(state) => weights_at(py, state, method, outside, &queries),
        Core::Space(state) => weights_at(py, state, method, outside, &queries),
    }?;
    Ok((
        PyArray1::from_iter(py, weights.starts.into_iter().map(|start| start as i64)),
        PyArray1::from_iter(py, weights.columns.into_iter().map(|column| column as i32)),
        PyArray1::from_vec(py, weights.values),
    ))
}

fn weights_at<T: Surround + Sync>(
    py: Python<'_>,
    state: &State<T>,
    method: &str,
    outside: &str,
    queries: &PyReadonlyArray2<'_, f64>,
) -> PyResult<Weights>
where
    for<'a> Interpolator<'a, T>: Clone + Send + Sync,
{
    let f = interpolator(&state.triangulation, method, outside)?;
    let queries: Vec<T::Point> = coordinates(queries)?;
    state.asked(py, queries.len(), || {
        let near = Near::new(queries);
        let found = f.matrix(&near.queries)?;
        let mut weights = Weights { starts: vec![0], ..Weights::default() };
        for row in near.order() {
            let row = found.starts[row]..found.starts[row + 1];
            weights.columns.extend_from_slice(&found.columns[row.clone()]);
            weights.values.extend_from_slice(&found.values[row]);
            weights.starts.push(weights.values.len());
        }
        Ok(weights)
    })
}

/// The gradients at the points for each column of values: (columns, points, dimensions).
#[pyfunction]
pub fn vertex_gradients<'py>(
    py: Python<'py>,
    triangulation: &Triangulation,
    values: PyReadonlyArray2<'py, f64>,
) -> PyResult<Bound<'py, PyArray3<f64>>> {
    let (found, dimension) = match &*triangulation.core.read(py)? {
        Core::Plane(state) => (slopes(py, state, &values)?, 2),
        Core::Space(state) => (slopes(py, state, &values)?, 3),
    };
    PyArray1::from_vec(py, found).reshape([values.shape()[1], values.shape()[0], dimension])
}

fn slopes<T: Surround>(
    py: Python<'_>,
    state: &State<T>,
    values: &PyReadonlyArray2<'_, f64>,
) -> PyResult<Vec<f64>> {
    let (points, columns, table) = (values.shape()[0], values.shape()[1], values.as_slice()?);
    room(points.saturating_mul(columns).saturating_mul(48), "gradients at so many points")?;
    state.asked(py, points, || {
        let mut all = Vec::new();
        for column in 0..columns {
            let own: Vec<f64> = table.iter().skip(column).step_by(columns).copied().collect();
            let found = gradients(&state.triangulation, &own)?;
            all.extend(found.iter().flat_map(|slope| slope.as_ref().iter().copied()));
        }
        Ok::<_, Error>(all)
    })
}

/// By the name that Python has for it.
pub fn interpolator<'t, T: Surround>(d: &'t T, method: &str, outside: &str) -> PyResult<Interpolator<'t, T>> {
    let f = match method {
        "nearest" => Interpolator::nearest(d),
        "linear" => Interpolator::linear(d),
        "laplace" => Interpolator::laplace(d),
        "sibson" | "smooth" | "farin" => Interpolator::sibson(d),
        other => return Err(PyValueError::new_err(format!("there is no interpolation {other:?}"))),
    };
    let outside = match outside {
        "fill" => Outside::Nothing,
        "nearest" => Outside::Nearest,
        "hull" => Outside::Hull,
        other => return Err(PyValueError::new_err(format!("there is nothing {other:?} outside"))),
    };
    Ok(f.outside(outside))
}
