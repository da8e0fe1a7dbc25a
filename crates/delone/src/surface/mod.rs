//! Surfaces: values at the points of a triangulation, and what is between them.

mod contours;
mod grid;

pub use contours::{ContourBand, ContourLine, Contours, Levels};
pub use grid::Grid;
