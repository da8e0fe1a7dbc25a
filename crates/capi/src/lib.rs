//! libdelone: the library for C, by `include/delone.h`.
//!
//! | module | functions |
//! | --- | --- |
//! | `library` | versions, statuses, threads |
//! | `plane` | triangulations of the plane: building and freeing |
//! | `mesh` | meshes: options and callbacks |
//! | `rows` | triangles, edges, stars as rows |
//! | `queries`, `changes` | location, nearest vertices, values; insertion and removal |
//! | `cells` | Voronoi cells in a box |
//! | `space` | tetrahedra |
//! | `points`, `failure`, `memory`, `run` | input, errors, memory and threads, the same way for all |
//!
//! A function checks its pointers, makes slices of them, and leaves the rest to safe code. Whatever it does runs under `failure::guard`: no
//! panic crosses into C.

// Pointers of C are followed here, and nowhere else in the project.
#![allow(unsafe_code)]

mod cells;
mod changes;
mod failure;
mod library;
mod memory;
mod mesh;
mod plane;
mod points;
mod queries;
mod rows;
mod run;
mod space;
