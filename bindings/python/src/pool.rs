//! The threads that everything long runs on: those of the library for bindings.

pub use delone_pool::{SERIAL_ITEMS, alone, generation, pool, shared};
use pyo3::prelude::*;

/// To be called in the child of a fork: `os.register_at_fork` does.
#[pyfunction]
pub fn after_fork() {
    delone_pool::after_fork();
}
