//! Surfaces: values at the points of a triangulation, and what is between them.

mod grid;

pub use grid::Grid;
