//! All tests of the program from outside, in one program.

/// The program.
const PROGRAM: &str = env!("CARGO_BIN_EXE_delone");

mod alpha;
mod antimeridian;
mod arcs;
mod attributes;
#[cfg(target_os = "linux")]
mod bytes;
mod cells;
mod completions;
mod diagrams;
mod districts;
mod dtm;
#[cfg(feature = "parquet")]
mod features;
mod files;
mod fills;
mod folder;
mod folders;
mod graph;
mod helps;
mod inputs;
mod layers;
mod lengths;
mod lidar;
mod limits;
mod mesh;
mod metamorphic;
mod names;
mod narrow;
#[cfg(unix)]
mod outputs;
mod outside;
mod pictures;
mod place;
mod polyhedra;
mod program;
mod quads;
mod rasters;
mod refined_again;
mod regions;
mod repeated;
mod resume;
mod segments;
mod slivers;
mod space;
mod strategies;
mod surface;
mod switches;
mod terrain;
mod threads;
mod tiles;
mod weights;
mod weld;
mod window;
mod wkt;
