//! All tests of readers and writers from outside, in one program.

mod chunks;
mod constrained;
mod elements;
mod graphs;
mod new_kind;
mod numbers;
mod rasters;
mod same_points;
mod scene;
mod stl;
mod triangle;
