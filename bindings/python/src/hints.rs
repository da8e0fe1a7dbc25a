//! Points that are nearly known beforehand.

use delone::{Coordinates, HintOrder, Hints2, Hints3, Imprecise};
use numpy::{PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::errors::python_error;
use crate::interrupt::interruptible;
use crate::memory::{HINTS, TRIANGULATION};
use crate::pool::{FEW, detached};
use crate::shared::Shared;
use crate::triangulation::{Core, State, Triangulation, coordinates};

enum Either {
    Plane(Box<Hints2>),
    Space(Box<Hints3>),
}

/// See `_delone.pyi`.
#[pyclass(module = "delone._delone", frozen)]
pub struct Hints(Shared<Either>);

/// The points of what hints make.
type Point<H> = <<H as Imprecise>::Triangulation as delone::Triangulation>::Point;

fn preprocess<H: Imprecise + 'static>(
    py: Python<'_>,
    centres: &PyReadonlyArray2<'_, f64>,
) -> PyResult<Box<H>> {
    let centres: Vec<Point<H>> = coordinates(centres)?;
    HINTS.check(Point::<H>::COUNT, centres.len())?;
    let hints = interruptible(py, centres.len(), move || H::from_centres(&centres, HintOrder::default()))?;
    hints.map(Box::new).map_err(python_error)
}

#[pymethods]
impl Hints {
    #[new]
    fn new(py: Python<'_>, centres: PyReadonlyArray2<'_, f64>) -> PyResult<Self> {
        Ok(Self(Shared::new(match centres.shape()[1] {
            2 => Either::Plane(preprocess(py, &centres)?),
            3 => Either::Space(preprocess(py, &centres)?),
            columns => return Err(PyValueError::new_err(format!("points of {columns} coordinates"))),
        })))
    }

    fn triangulate(&self, py: Python<'_>, points: PyReadonlyArray2<'_, f64>) -> PyResult<Triangulation> {
        let core = match &mut *self.0.write(py)? {
            Either::Plane(hints) => Core::Plane(State::of(instance(py, &mut **hints, &points)?)),
            Either::Space(hints) => Core::Space(State::of(instance(py, &mut **hints, &points)?)),
        };
        Ok(Triangulation { core: Shared::new(core) })
    }
}

fn instance<H: Imprecise>(
    py: Python<'_>,
    hints: &mut H,
    points: &PyReadonlyArray2<'_, f64>,
) -> PyResult<H::Triangulation> {
    let points: Vec<Point<H>> = coordinates(points)?;
    TRIANGULATION.check(Point::<H>::COUNT, points.len())?;
    let made = detached(py, points.len() >= FEW, || hints.triangulate(&points).cloned());
    made.map_err(python_error)
}
