//! The independent judge: what a Delaunay triangulation *is*, computed as slowly and as plainly as the
//! definition reads.
//!
//! This crate depends on no other crate of the project, so a mistake there cannot hide here.
//!
//! - [`exact`]: orientation and lifted determinants over the integers, by Laplace expansion;
//! - [`brute`]: the canonical triangulation of up to 64 points and of all their subsets, by trying all
//!   triples against all points;
//! - [`lines`]: where lines meet, as fractions;
//! - [`nearest`]: which of two segments or triangles is nearer to a point;
//! - [`constrained`]: the canonical constrained triangulation of up to 40 points, by what triangles see;
//! - [`crossings`]: which segments cross, where, and what is left once they are split;
//! - [`alpha`]: alpha complexes of few sites, with sizes as fractions;
//! - [`graphs`]: proximity graphs, by trying all pairs against all points;
//! - [`orders`]: Voronoi diagrams of order k, by trying all triples;
//! - [`solid`]: where planes meet, as fractions, and polyhedra by all triples of planes;
//! - [`power`]: regular triangulations of few sites with weights;
//! - [`share`], [`some_of`] and [`all_cases`]: how many cases of a test are judged;
//! - [`certificate`]: the proof that a large triangulation is the canonical constrained one.

pub mod alpha;
pub mod brute;
pub mod certificate;
pub mod constrained;
pub mod crossings;
pub mod exact;
pub mod graphs;
pub mod lines;
pub mod nearest;
pub mod orders;
pub mod power;
mod quick;
#[cfg(test)]
mod samples;
mod share;
pub mod solid;

pub use share::{all_cases, is_due, share, some_of};
