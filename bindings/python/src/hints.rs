//! Points that are nearly known beforehand.

use delone::{Hints2, Hints3};
use numpy::{PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

use crate::engine::Imprecise;
use crate::interrupt::interruptible;
use crate::memory::{HINTS, TRIANGULATION};
use crate::pool::{FEW, detached};
use crate::triangulation::{Core, State, Triangulation, coordinates};
use crate::value_error;

enum Either {
    Plane(Box<Hints2>),
    Space(Box<Hints3>),
}

/// See `_delone.pyi`.
#[pyclass(module = "delone._delone")]
pub struct Hints(Either);

fn preprocess<H: Imprecise<D, C>, const D: usize, const C: usize>(
    py: Python<'_>,
    centres: &PyReadonlyArray2<'_, f64>,
) -> PyResult<Box<H>> {
    let centres: Vec<[f64; D]> = coordinates(centres)?;
    HINTS.check::<D>(centres.len())?;
    let hints = interruptible(py, centres.len(), move || H::preprocess(&centres))?;
    hints.map(Box::new).map_err(value_error)
}

#[pymethods]
impl Hints {
    #[new]
    fn new(py: Python<'_>, centres: PyReadonlyArray2<'_, f64>) -> PyResult<Self> {
        Ok(Self(match centres.shape()[1] {
            2 => Either::Plane(preprocess(py, &centres)?),
            3 => Either::Space(preprocess(py, &centres)?),
            columns => return Err(PyValueError::new_err(format!("points of {columns} coordinates"))),
        }))
    }

    fn triangulate(&mut self, py: Python<'_>, points: PyReadonlyArray2<'_, f64>) -> PyResult<Triangulation> {
        let core = match &mut self.0 {
            Either::Plane(hints) => Core::Plane(State::of(instance(py, &mut **hints, &points)?)),
            Either::Space(hints) => Core::Space(State::of(instance(py, &mut **hints, &points)?)),
        };
        Ok(Triangulation { core })
    }
}

fn instance<H: Imprecise<D, C>, const D: usize, const C: usize>(
    py: Python<'_>,
    hints: &mut H,
    points: &PyReadonlyArray2<'_, f64>,
) -> PyResult<H::Engine> {
    let points = coordinates(points)?;
    TRIANGULATION.check::<D>(points.len())?;
    detached(py, points.len() >= FEW, || hints.instance(&points))?.map_err(value_error)
}
