//! Values between points: interpolation and its weights.

use delone::surface::{Interpolator, Outside, Weights, gradients};
use delone::{Coordinates, Surround};
use numpy::{
    PyArray1, PyArray2, PyArray3, PyArrayMethods, PyReadonlyArray2, PyReadonlyArray3, PyUntypedArrayMethods,
};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::errors::python_error;
use crate::interrupt::{joined, size_of_queries};
use crate::memory::room;
use crate::near::Near;
use crate::shared::Shared;
use crate::state::State;
use crate::triangulation::{Core, Given, Triangulation, coordinates, of_row};

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
    let copies = values.len() + gradients.as_ref().map_or(0, |gradients| gradients.len());
    let numbers = count.saturating_mul(columns).saturating_mul(2).saturating_add(copies);
    room(numbers.saturating_mul(8), "values at so many points")?;
    let found = match &triangulation.core {
        Core::Plane(held) => values_at(py, held, [method, outside], &queries, &values, gradients.as_ref()),
        Core::Space(held) => values_at(py, held, [method, outside], &queries, &values, gradients.as_ref()),
    }?;
    PyArray1::from_vec(py, found).reshape([count, columns])
}

fn values_at<T: Surround + 'static>(
    py: Python<'_>,
    held: &Shared<State<T, Given>>,
    names: [&str; 2],
    queries: &PyReadonlyArray2<'_, f64>,
    values: &PyReadonlyArray2<'_, f64>,
    slopes: Option<&PyReadonlyArray3<'_, f64>>,
) -> PyResult<Vec<f64>>
where
    for<'a> Interpolator<'a, T>: Clone + Send + Sync,
{
    let [method, outside] = names.map(str::to_owned);
    let queries: Vec<T::Point> = coordinates(queries)?;
    let (points, columns, table) = (values.shape()[0], values.shape()[1], values.to_vec()?);
    let is_smooth = matches!(method.as_str(), "smooth" | "farin");
    let slopes: Vec<T::Point> = match slopes {
        _ if !is_smooth => Vec::new(),
        None => return Err(PyValueError::new_err("a smooth surface needs gradients")),
        Some(slopes) => slopes.as_slice()?.chunks_exact(T::Point::COUNT).map(of_row).collect(),
    };
    if is_smooth && slopes.len() != points * columns {
        return Err(PyValueError::new_err(format!(
            "{} gradients where there must be {points} for each of {columns} columns",
            slopes.len()
        )));
    }
    let size = size_of_queries(queries.len(), columns);
    State::asked(held, py, size, move |state, wanted| {
        let f = interpolator(&state.triangulation, &method, &outside)?;
        let near = Near::new(queries);
        if !is_smooth {
            let found = joined(wanted, &near.queries, |piece| f.many(piece, &table, columns));
            let found = found.map_err(python_error)?;
            // There are not all of them if nobody wants them.
            return Ok(if wanted.is() { near.back(found, columns) } else { found });
        }
        let is_farin = method == "farin";
        let mut result = vec![f64::NAN; near.queries.len() * columns];
        for column in (0..columns).take_while(|_| wanted.is()) {
            let own: Vec<f64> = table.iter().skip(column).step_by(columns).copied().collect();
            let slopes = &slopes[column * points..][..points];
            let found = joined(wanted, &near.queries, |piece| {
                f.many_bent(piece, |f, q| {
                    if is_farin { f.farin(q, &own, slopes) } else { f.smooth(q, &own, slopes) }
                })
            });
            for (row, value) in result.chunks_exact_mut(columns).zip(found.map_err(python_error)?) {
                row[column] = value;
            }
        }
        Ok(near.back(result, columns))
    })
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
    let weights = match &triangulation.core {
        Core::Plane(held) => weights_at(py, held, [method, outside], &queries),
        Core::Space(held) => weights_at(py, held, [method, outside], &queries),
    }?;
    Ok((
        PyArray1::from_iter(py, weights.starts.into_iter().map(|start| start as i64)),
        PyArray1::from_iter(py, weights.columns.into_iter().map(|column| column as i32)),
        PyArray1::from_vec(py, weights.values),
    ))
}

fn weights_at<T: Surround + 'static>(
    py: Python<'_>,
    held: &Shared<State<T, Given>>,
    names: [&str; 2],
    queries: &PyReadonlyArray2<'_, f64>,
) -> PyResult<Weights>
where
    for<'a> Interpolator<'a, T>: Clone + Send + Sync,
{
    let [method, outside] = names.map(str::to_owned);
    let queries: Vec<T::Point> = coordinates(queries)?;
    State::asked(held, py, size_of_queries(queries.len(), 1), move |state, _| {
        let f = interpolator(&state.triangulation, &method, &outside)?;
        let near = Near::new(queries);
        let found = f.matrix(&near.queries).map_err(python_error)?;
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
    let (found, dimension) = match &triangulation.core {
        Core::Plane(held) => (slopes(py, held, &values)?, 2),
        Core::Space(held) => (slopes(py, held, &values)?, 3),
    };
    PyArray1::from_vec(py, found).reshape([values.shape()[1], values.shape()[0], dimension])
}

fn slopes<T: Surround + 'static>(
    py: Python<'_>,
    held: &Shared<State<T, Given>>,
    values: &PyReadonlyArray2<'_, f64>,
) -> PyResult<Vec<f64>> {
    let [points, columns] = [values.shape()[0], values.shape()[1]];
    room(points.saturating_mul(columns).saturating_mul(56), "gradients at so many points")?;
    let table = values.to_vec()?;
    State::asked(held, py, size_of_queries(points, columns), move |state, wanted| {
        let mut all = Vec::new();
        for column in (0..columns).take_while(|_| wanted.is()) {
            let own: Vec<f64> = table.iter().skip(column).step_by(columns).copied().collect();
            let found = gradients(&state.triangulation, &own).map_err(python_error)?;
            all.extend(found.iter().flat_map(|slope| slope.as_ref().iter().copied()));
        }
        Ok(all)
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
