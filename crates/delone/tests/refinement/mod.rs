//! Refinement: what it promises, judged by big integers; the same mesh whatever the order; an end whatever the input.

mod again;
mod arcs;
mod asked;
mod bounds;
mod coarsen;
mod ends;
mod frontal;
mod judge;
mod kept;
mod layers;
mod nasty;
mod quads;
mod short;
