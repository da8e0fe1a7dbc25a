//! Proximity graphs.

use delone::{Change, Coordinates, Delaunay2, Delaunay3, Error, Graph, VertexId};
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::errors::python_error;
use crate::interrupt::{interruptible, size_of_points};
use crate::memory::TRIANGULATION;
use crate::triangulation::coordinates;

type Pairs = Vec<[VertexId; 2]>;

/// The edges of a graph of points, by its name and what it is given, each from the smaller index to the larger, sorted.
#[pyfunction]
pub fn proximity_graph<'py>(
    py: Python<'py>,
    points: PyReadonlyArray2<'py, f64>,
    kind: &str,
    parameter: f64,
) -> PyResult<Bound<'py, PyArray2<i64>>> {
    let graph = match kind {
        "gabriel" => Graph::Gabriel,
        "relative neighbors" => Graph::RelativeNeighbors,
        "spanning tree" => Graph::SpanningTree,
        "beta" => Graph::Beta(parameter),
        "nearest" => Graph::Nearest(parameter as usize),
        other => return Err(PyValueError::new_err(format!("there is no graph {other:?}"))),
    };
    let edges = match points.shape()[1] {
        2 => found(py, coordinates(&points)?, graph, Delaunay2::graph),
        3 => found(py, coordinates(&points)?, graph, Delaunay3::graph),
        columns => return Err(PyValueError::new_err(format!("points of {columns} coordinates"))),
    }?;
    let count = edges.len();
    let indices: Vec<i64> = edges.into_iter().flatten().map(|v| v.index() as i64).collect();
    PyArray1::from_vec(py, indices).reshape([count, 2])
}

fn found<T: Change>(
    py: Python<'_>,
    points: Vec<T::Point>,
    graph: Graph,
    edges: impl Fn(&T, Graph) -> Result<Pairs, Error> + Send + 'static,
) -> PyResult<Pairs> {
    let count = points.len();
    let each = if let Graph::Nearest(k) = graph { 64 * k.min(count) } else { 0 };
    TRIANGULATION.check_with(T::Point::COUNT, count, each.saturating_mul(count))?;
    interruptible(py, size_of_points(T::Point::COUNT, 0, count), move || edges(&T::from_vec(points)?, graph))?
        .map_err(python_error)
}
