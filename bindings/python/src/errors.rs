//! Errors of the library as those of Python, with its words.

use delone::Error;
use pyo3::exceptions::{PyIndexError, PyValueError};
use pyo3::prelude::*;

/// An `IndexError` for what is not there, `delone.CrossingError` for segments that cross, else a `ValueError`.
pub fn python_error(error: Error) -> PyErr {
    error_in(None, error)
}

/// The exception of an error, with the polygon at fault before its words.
pub fn error_in(polygon: Option<usize>, error: Error) -> PyErr {
    let place = polygon.map(|polygon| format!("polygon {polygon}: ")).unwrap_or_default();
    let words = format!("{place}{error}");
    match error {
        Error::NoSuchVertex { .. } | Error::NoSuchPoint { .. } | Error::NoSuchSegment { .. } => {
            PyIndexError::new_err(words)
        }
        Error::SegmentsCross { first, second, near, count } => {
            Python::attach(|py| crossing(py, (words, first, second, (near[0], near[1]), count)))
        }
        _ => PyValueError::new_err(words),
    }
}

/// It has a class of its own, which Python defines.
fn crossing(py: Python<'_>, arguments: (String, usize, usize, (f64, f64), usize)) -> PyErr {
    let made = py
        .import("delone._errors")
        .and_then(|module| module.getattr("CrossingError"))
        .and_then(|class| class.call1(arguments));
    made.map_or_else(|error| error, PyErr::from_value)
}
