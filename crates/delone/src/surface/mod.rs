//! Surfaces: values at the vertices of a triangulation, and what is between them.
//!
//! | wanted | how | cost |
//! | --- | --- | --- |
//! | a value, or weights, at one point after the other | [`Interpolator`]: nearest, linear, natural neighbors by Laplace and by Sibson | O(1) expected each from nearby |
//! | the same, smooth at the vertices too | [`Interpolator::smooth`], [`Interpolator::farin`] with [`gradients`] | the same |
//! | at many points, on all threads | [`Interpolator::many`], [`Interpolator::matrix`] for the [`Weights`] alone | |
//! | a linear raster | [`rasterize`], or [`Raster::paint`] for triangles from anywhere | O(1) a triangle, row and cell |
//! | lines of equal height, and what is between them | [`Contours`] at [`Levels`] | linear in triangles and points of lines |
//! | another raster | that first, which says which cells have values; then [`Interpolator::fill`] | |
//! | lines of equal height, and the areas between | [`Contours`] at [`Levels`] | O(k log k) for k points |
//! | what of it is shown, without long triangles or slivers along its border | [`Trim`] by a [`Border`] | O(n) |
//! | few of the points, near all of them | [`Thinning`] | O(log n) for each that is chosen, and what is in its star |
//!
//! Which triangle a point is in and who its neighbors are is exact; values are rounded.

mod border;
mod bulk;
mod contours;
mod duplicates;
mod gradients;
mod grid;
mod interpolator;
mod linear;
mod natural;
mod raster;
mod real;
mod smooth;
mod thin;
mod trim;

pub use bulk::Weights;
pub use contours::{ContourBand, ContourLine, Contours, Levels};
pub use duplicates::{Duplicates, Several};
pub use gradients::gradients;
pub use grid::Grid;
pub use interpolator::{Interpolator, Outside};
pub use raster::{Raster, rasterize};
pub use thin::{Thinned, Thinning};
pub use trim::{Border, Cut, Trim};
