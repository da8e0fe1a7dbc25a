//! How large elements of a mesh may be: numbers for all places, or what Python says for each.
//!
//! Cost: a question costs one location of a point, some hundred nanoseconds, or a call of Python.

use std::cell::{Cell, RefCell};

use delone::{Ask, Constrained2, Delaunay2, Error, Triangulation as _, VertexId};
use numpy::{PyArray1, PyArrayMethods};
use pyo3::prelude::*;

/// A number for each place, asked for without Python.
pub enum Field {
    /// None wanted.
    Everywhere,
    /// Lengths, linear on the triangles of points that have one each; infinite outside of their hull.
    Lengths(Box<Delaunay2>, Vec<f64>),
    /// Areas, one for each triangle of a mesh, in the order of its triangles; infinite outside.
    Areas(Box<Constrained2>, Vec<f64>),
}

impl Field {
    /// Of values at points; of equal points the first one counts.
    pub fn lengths(points: Vec<[f64; 2]>, values: Vec<f64>) -> Result<Self, Error> {
        Ok(Self::Lengths(Box::new(Delaunay2::from_vec(points)?), values))
    }

    /// Of areas of the triangles of a mesh, by their indices among all slots; infinite for those that have none.
    pub fn areas(mesh: Constrained2, areas: Vec<f64>) -> Self {
        Self::Areas(Box::new(mesh), areas)
    }

    /// Whether it says anything.
    pub fn is_asked(&self) -> bool {
        !matches!(self, Self::Everywhere)
    }

    /// The length wanted at a place.
    pub fn length(&self, at: [f64; 2]) -> f64 {
        match self {
            Self::Lengths(d, values) => linear(d, values, at).unwrap_or(f64::INFINITY),
            _ => f64::INFINITY,
        }
    }

    /// The area wanted at a place.
    pub fn area(&self, at: [f64; 2]) -> f64 {
        let Self::Areas(mesh, areas) = self else { return f64::INFINITY };
        let found = mesh.find(at).ok().and_then(|found| found.simplex);
        found.and_then(|t| areas.get(t.index()).copied()).unwrap_or(f64::INFINITY)
    }
}

/// Linear interpolation: a positive mean of what is at the corners of the triangle that holds a point.
fn linear(d: &Delaunay2, values: &[f64], at: [f64; 2]) -> Option<f64> {
    let corners: [VertexId; 3] = d.corners(d.find(at).ok()?.simplex?);
    let [a, b, c] = corners.map(|v| d.point(v));
    let twice = |p: [f64; 2], q: [f64; 2], r: [f64; 2]| {
        ((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])).max(0.0)
    };
    // Rounded, they may be none of them positive in a flat triangle; any corner is as good then.
    let weights = [twice(b, c, at), twice(c, a, at), twice(a, b, at)];
    let sum: f64 = weights.iter().sum();
    let value = |k: usize| values[corners[k].index()];
    let mean = || (0..3).map(|k| weights[k] / sum * value(k)).sum();
    Some(if sum.is_normal() { mean() } else { value(0) })
}

/// Questions between looking for signals.
const QUESTIONS: u32 = 256;

/// Functions of Python that are asked. The first exception ends the work, and is kept.
pub struct Asked<'py> {
    py: Python<'py>,
    error: RefCell<Option<PyErr>>,
    count: Cell<u32>,
}

impl<'py> Asked<'py> {
    pub fn new(py: Python<'py>) -> Self {
        Self { py, error: RefCell::new(None), count: Cell::new(0) }
    }

    /// The length at a place; NaN, which is no bound, after an exception.
    pub fn length(&self, function: &Bound<'py, PyAny>, at: [f64; 2]) -> f64 {
        self.answer(|| function.call1((at[0], at[1]))?.extract()).unwrap_or(f64::NAN)
    }

    /// Whether a triangle is to be refined; not after an exception.
    pub fn test(&self, function: &Bound<'py, PyAny>, corners: [[f64; 2]; 3], area: f64) -> bool {
        let ask = || {
            let corners = PyArray1::from_slice(self.py, corners.as_flattened()).reshape([3, 2])?;
            function.call1((corners, area))?.extract()
        };
        self.answer(ask).unwrap_or(false)
    }

    /// An answer; none after an exception.
    fn answer<A>(&self, ask: impl FnOnce() -> PyResult<A>) -> Option<A> {
        if self.error.borrow().is_some() {
            return None;
        }
        self.count.set(self.count.get().wrapping_add(1));
        let signals = match self.count.get() % QUESTIONS {
            0 => self.py.check_signals(),
            _ => Ok(()),
        };
        match signals.and_then(|()| ask()) {
            Ok(answer) => Some(answer),
            Err(error) => {
                *self.error.borrow_mut() = Some(error);
                None
            }
        }
    }

    /// Whether there was an exception.
    pub fn has_failed(&self) -> bool {
        self.error.borrow().is_some()
    }

    /// The exception, if there was one.
    pub fn end(self) -> PyResult<()> {
        self.error.into_inner().map_or(Ok(()), Err)
    }
}
