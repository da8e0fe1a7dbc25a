//! A triangulation of the plane or of space, by its arrays, its queries and its changes.

use std::convert::Infallible;

use delone::{Change, Coordinates, Delaunay2, Delaunay3, Error, Triangulation as _, VertexId};
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::exceptions::{PyIndexError, PyMemoryError, PyValueError};
use pyo3::prelude::*;

use crate::errors::python_error;
use crate::interrupt::{interruptible, size_of_points};
use crate::memory::TRIANGULATION;
use crate::pool::{SERIAL_ITEMS, shared};
use crate::shared::Shared;
use crate::state::{Rows, State, table};

/// Simplices whose centers one task finds.
const CENTRES: usize = SERIAL_ITEMS / 2;

/// The points given, as Python has them: a change of the triangulation and of this is one, however its caller fares.
pub struct Given {
    /// An array of all points, which is never written.
    pub points: Py<PyAny>,
    /// The removed ones, increasing.
    removed: Vec<usize>,
}

impl Given {
    pub fn of(points: &Bound<'_, PyAny>) -> Self {
        Self { points: points.clone().unbind(), removed: Vec::new() }
    }
}

type Held<T> = Shared<State<T, Given>>;

pub enum Core {
    Plane(Held<Delaunay2>),
    Space(Held<Delaunay3>),
}

/// See `_delone.pyi`.
#[pyclass(module = "delone._delone", frozen)]
pub struct Triangulation {
    pub core: Core,
}

/// Runs an expression for either dimension.
macro_rules! either {
    ($core:expr, $held:ident => $body:expr) => {
        match $core {
            Core::Plane($held) => $body,
            Core::Space($held) => $body,
        }
    };
}

#[pymethods]
impl Triangulation {
    #[new]
    fn new(py: Python<'_>, points: PyReadonlyArray2<'_, f64>) -> PyResult<Self> {
        let given = Given::of(points.as_any());
        let core = match points.shape()[1] {
            2 => Core::Plane(build(py, coordinates(&points)?, given)?),
            3 => Core::Space(build(py, coordinates(&points)?, given)?),
            columns => return Err(PyValueError::new_err(format!("points of {columns} coordinates"))),
        };
        Ok(Self { core })
    }

    /// Of points without some, from others where these equal each other and no other point.
    #[staticmethod]
    fn without(
        py: Python<'_>,
        points: &Bound<'_, PyAny>,
        moved: PyReadonlyArray2<'_, f64>,
        mut removed: Vec<usize>,
    ) -> PyResult<Self> {
        removed.sort_unstable();
        let given = Given { points: points.clone().unbind(), removed };
        let core = match moved.shape()[1] {
            2 => Core::Plane(build(py, coordinates(&moved)?, given)?),
            3 => Core::Space(build(py, coordinates(&moved)?, given)?),
            columns => return Err(PyValueError::new_err(format!("points of {columns} coordinates"))),
        };
        Ok(Self { core })
    }

    /// All points given, and those that were removed.
    fn given(&self, py: Python<'_>) -> PyResult<(Py<PyAny>, Vec<usize>)> {
        either!(&self.core, held => {
            let state = held.read(py)?;
            Ok((state.record.points.clone_ref(py), state.record.removed.clone()))
        })
    }

    #[getter]
    fn points(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        either!(&self.core, held => Ok(held.read(py)?.record.points.clone_ref(py)))
    }

    /// Another number after each change.
    #[getter]
    fn version(&self, py: Python<'_>) -> PyResult<usize> {
        either!(&self.core, held => Ok(held.read(py)?.version()))
    }

    /// Corners and neighbors of the finite simplices.
    fn arrays<'py>(&self, py: Python<'py>) -> PyResult<(Rows<'py>, Rows<'py>)> {
        either!(&self.core, held => held.read(py)?.arrays(py))
    }

    /// The circumcenters of the finite simplices, each the nearest number to the exact one; infinite where that is too large.
    fn centers<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        fn rows<I: Sync, const D: usize>(
            simplices: Vec<I>,
            center: impl Fn(&I) -> Option<[f64; D]> + Sync + Send,
        ) -> Vec<f64> {
            let center = |simplex: &I| Ok::<_, Infallible>(center(simplex).unwrap_or([f64::INFINITY; D]));
            let Ok(centers) = shared(&simplices, CENTRES, center);
            centers.into_flattened()
        }
        match &self.core {
            Core::Plane(held) => {
                let state = held.read(py)?;
                let centers = interruptible(py, state.triangulation.slot_count(), move || {
                    let d = &state.triangulation;
                    rows(d.mesh().triangles().collect(), |&t| d.circumcenter(t))
                })?;
                table(py, 2, centers)
            }
            Core::Space(held) => {
                let state = held.read(py)?;
                let centers = interruptible(py, state.triangulation.slot_count(), move || {
                    let d = &state.triangulation;
                    rows(d.tetrahedron_ids().collect(), |&t| d.circumcenter(t))
                })?;
                table(py, 3, centers)
            }
        }
    }

    fn hull<'py>(&self, py: Python<'py>) -> PyResult<Rows<'py>> {
        either!(&self.core, held => held.read(py)?.hull(py))
    }

    fn edges<'py>(&self, py: Python<'py>) -> PyResult<Rows<'py>> {
        either!(&self.core, held => held.read(py)?.edges(py))
    }

    /// Points that are no vertices because they equal one, each with this; without those that were removed.
    fn duplicates<'py>(&self, py: Python<'py>) -> PyResult<Rows<'py>> {
        let is_left = |given: &Given, point: usize| given.removed.binary_search(&point).is_err();
        either!(&self.core, held => held.read(py)?.duplicates(py, is_left))
    }

    #[getter]
    fn vertex_count(&self, py: Python<'_>) -> PyResult<usize> {
        either!(&self.core, held => Ok(held.read(py)?.vertex_count()))
    }

    #[getter]
    fn span(&self, py: Python<'_>) -> PyResult<i32> {
        either!(&self.core, held => Ok(held.read(py)?.span()))
    }

    /// Adds points, if all of them are so many rows more than there are; says whether they are.
    fn extend(
        &self,
        py: Python<'_>,
        points: PyReadonlyArray2<'_, f64>,
        all: PyReadonlyArray2<'_, f64>,
    ) -> PyResult<bool> {
        either!(&self.core, held => extend(py, held, coordinates(&points)?, &all))
    }

    /// Removes vertices, and duplicates of these.
    fn remove(&self, py: Python<'_>, vertices: Vec<i64>) -> PyResult<()> {
        either!(&self.core, held => remove(py, held, vertices))
    }

    fn is_vertex(&self, py: Python<'_>, index: usize) -> PyResult<bool> {
        either!(&self.core, held => Ok(held.read(py)?.is_vertex(VertexId::new(index))))
    }

    /// The rows of simplices that hold points; -1 outside.
    fn find<'py>(
        &self,
        py: Python<'py>,
        queries: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray1<i32>>> {
        let found = either!(&self.core, held => State::find(held, py, coordinates(&queries)?))?;
        Ok(PyArray1::from_vec(py, found))
    }

    /// The nearest vertices; -1 if there is none.
    fn nearest<'py>(
        &self,
        py: Python<'py>,
        queries: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray1<i64>>> {
        let found = either!(&self.core, held => State::nearest(held, py, coordinates(&queries)?))?;
        Ok(PyArray1::from_vec(py, found))
    }

    /// The k nearest vertices, nearest first; -1 where there are not so many.
    fn k_nearest<'py>(
        &self,
        py: Python<'py>,
        queries: PyReadonlyArray2<'py, f64>,
        k: usize,
    ) -> PyResult<Bound<'py, PyArray2<i64>>> {
        let count = queries.shape()[0];
        let found = either!(&self.core, held => State::k_nearest(held, py, coordinates(&queries)?, k))?;
        PyArray1::from_vec(py, found).reshape([count, k])
    }

    fn copy(&self, py: Python<'_>) -> PyResult<Self> {
        let core = match &self.core {
            Core::Plane(held) => Core::Plane(copied(py, held)?),
            Core::Space(held) => Core::Space(copied(py, held)?),
        };
        Ok(Self { core })
    }
}

/// Triangulates points. Where some of these were removed, they equal each other, and go.
fn build<T: Change + 'static>(py: Python<'_>, points: Vec<T::Point>, given: Given) -> PyResult<Held<T>> {
    TRIANGULATION.check(T::Point::COUNT, points.len())?;
    let first = given.removed.first().copied();
    let size = size_of_points(T::Point::COUNT, 0, points.len());
    let built = interruptible(py, size, move || {
        let mut d = T::from_vec(points)?;
        first.map_or(Ok(()), |first| d.remove_observed(VertexId::new(first), &mut ()))?;
        Ok::<_, Error>(d)
    })?;
    Ok(Shared::new(State::of(built.map_err(python_error)?, given)))
}

fn extend<T: Change + 'static>(
    py: Python<'_>,
    held: &Held<T>,
    points: Vec<T::Point>,
    all: &PyReadonlyArray2<'_, f64>,
) -> PyResult<bool> {
    TRIANGULATION.check(T::Point::COUNT, points.len())?;
    let (count, more, given) = (all.shape()[0], points.len(), all.as_any().clone().unbind());
    let extended = held.change(
        py,
        |state| size_of_points(T::Point::COUNT, state.size(), more),
        move |state| {
            if state.triangulation.ids_given() + more != count {
                return Ok(false);
            }
            state.forget();
            state.triangulation.extend(&points, 0)?;
            state.record.points = given;
            Ok(true)
        },
    )?;
    extended.map_err(python_error)
}

/// All or none.
fn remove<T: Change + 'static>(py: Python<'_>, held: &Held<T>, vertices: Vec<i64>) -> PyResult<()> {
    let count = vertices.len();
    held.change(
        py,
        |state| state.size() + count,
        move |state| {
            let mut wanted = Vec::with_capacity(count);
            for index in vertices {
                let v = usize::try_from(index).ok().map(VertexId::new);
                match v.filter(|&v| state.is_vertex(v)) {
                    Some(v) => wanted.push(v),
                    None => return Err(PyIndexError::new_err(format!("point {index} is no vertex"))),
                }
            }
            wanted.sort_unstable();
            if let Some(twice) = wanted.windows(2).find(|pair| pair[0] == pair[1]) {
                let twice = twice[0].index();
                return Err(PyValueError::new_err(format!("point {twice} is to be removed twice")));
            }
            let twins = state.triangulation.duplicates().filter(|d| wanted.binary_search(&d.vertex).is_ok());
            let mut gone: Vec<usize> = twins.map(|d| d.point).collect();
            state.forget();
            for &v in &wanted {
                state.triangulation.remove_observed(v, &mut ()).map_err(python_error)?;
            }
            let removed = &mut state.record.removed;
            removed.append(&mut gone);
            removed.extend(wanted.iter().map(|v| v.index()));
            removed.sort_unstable();
            removed.dedup();
            Ok(())
        },
    )?
}

fn copied<T: Change + 'static>(py: Python<'_>, held: &Held<T>) -> PyResult<Held<T>> {
    let state = held.read(py)?;
    let Given { points, removed } = &state.record;
    let given = Given { points: points.clone_ref(py), removed: removed.clone() };
    Ok(Shared::new(State::of(state.make(py, |state| state.triangulation.clone())?, given)))
}

/// The points of an array that has a column for each coordinate.
pub fn coordinates<P: Coordinates>(points: &PyReadonlyArray2<'_, f64>) -> PyResult<Vec<P>> {
    if points.shape()[1] != P::COUNT {
        let (columns, expected) = (points.shape()[1], P::COUNT);
        return Err(PyValueError::new_err(format!(
            "points of {columns} coordinates where there must be {expected}"
        )));
    }
    let rows = points.as_slice()?.chunks_exact(P::COUNT);
    let mut copy = Vec::new();
    if copy.try_reserve_exact(rows.len()).is_err() {
        return Err(PyMemoryError::new_err(format!("a copy of {} points", rows.len())));
    }
    copy.extend(rows.map(of_row::<P>));
    Ok(copy)
}

/// A point from as many numbers.
pub fn of_row<P: Coordinates>(row: &[f64]) -> P {
    let mut point = P::default();
    point.as_mut().copy_from_slice(row);
    point
}
