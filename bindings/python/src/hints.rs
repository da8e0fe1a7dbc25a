//! Points that are nearly known beforehand.

use delone::{Coordinates, HintOrder, Hints2, Hints3, Imprecise};
use numpy::{PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::errors::python_error;
use crate::interrupt::{interruptible, size_of_points};
use crate::memory::{HINTS, TRIANGULATION};
use crate::shared::Shared;
use crate::state::State;
use crate::triangulation::{Core, Given, Triangulation, coordinates};

enum Either {
    Plane(Shared<Hints2>),
    Space(Shared<Hints3>),
}

/// See `_delone.pyi`.
#[pyclass(module = "delone._delone", frozen)]
pub struct Hints(Either);

/// The points of what hints make.
type Point<H> = <<H as Imprecise>::Triangulation as delone::Triangulation>::Point;

fn preprocess<H: Imprecise + 'static>(
    py: Python<'_>,
    centers: &PyReadonlyArray2<'_, f64>,
) -> PyResult<Shared<H>> {
    let centers: Vec<Point<H>> = coordinates(centers)?;
    HINTS.check(Point::<H>::COUNT, centers.len())?;
    let hints = interruptible(py, size_of_points(Point::<H>::COUNT, 0, centers.len()), move || {
        H::from_centers(&centers, HintOrder::default())
    })?;
    hints.map(Shared::new).map_err(python_error)
}

#[pymethods]
impl Hints {
    #[new]
    fn new(py: Python<'_>, centers: PyReadonlyArray2<'_, f64>) -> PyResult<Self> {
        Ok(Self(match centers.shape()[1] {
            2 => Either::Plane(preprocess(py, &centers)?),
            3 => Either::Space(preprocess(py, &centers)?),
            columns => return Err(PyValueError::new_err(format!("points of {columns} coordinates"))),
        }))
    }

    fn triangulate(&self, py: Python<'_>, points: PyReadonlyArray2<'_, f64>) -> PyResult<Triangulation> {
        let given = Given::of(points.as_any());
        let core = match &self.0 {
            Either::Plane(hints) => Core::Plane(Shared::new(State::of(instance(py, hints, &points)?, given))),
            Either::Space(hints) => Core::Space(Shared::new(State::of(instance(py, hints, &points)?, given))),
        };
        Ok(Triangulation { core })
    }
}

fn instance<H: Imprecise + 'static>(
    py: Python<'_>,
    hints: &Shared<H>,
    points: &PyReadonlyArray2<'_, f64>,
) -> PyResult<H::Triangulation> {
    let points: Vec<Point<H>> = coordinates(points)?;
    TRIANGULATION.check(Point::<H>::COUNT, points.len())?;
    let size = size_of_points(Point::<H>::COUNT, 0, points.len());
    let made = hints.change(py, |_| size, move |hints| hints.triangulate(&points).cloned())?;
    made.map_err(python_error)
}
