//! All tests of readers and writers from outside, in one program.

mod chunks;
mod constrained;
mod elements;
mod graphs;
mod new_kind;
mod rasters;
mod scene;
mod triangle;
