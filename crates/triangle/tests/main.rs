//! The C interface, called as C calls it.

#![allow(unsafe_code, reason = "an interface of C has pointers")]

mod bad;
mod client;
mod compiled;
mod meshes;
mod processes;
mod tables;
