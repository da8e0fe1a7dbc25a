//! Surfaces: values at the points of a triangulation, and what is between them.

mod contours;
mod grid;
mod thin;

pub use contours::{ContourBand, ContourLine, Contours, Levels};
pub use grid::Grid;
pub use thin::{Thinned, Thinning};
