//! The module behind the npm package: thin functions over the library, called by hand-written JavaScript.
//!
//! # The protocol
//!
//! Triangulations live here and are known by a number. Arrays are passed by the tray ([`tray`]): JavaScript asks for room, writes, and
//! calls; what comes back lies on the tray until the next call, and JavaScript copies it. Views of memory are never handed out, because
//! memory that grows leaves them empty. Whatever can fail returns -1 and leaves a fault ([`fault`]): a code and numbers, which JavaScript
//! puts into words, so that nothing here formats text.
//!
//! The module imports nothing: no clock, no random numbers, no console. There is no `unsafe` but the attribute that exports a name:
//! memory is written by the host between calls, in vectors that have been filled with zeros.

#[macro_use]
mod export;

mod arrays;
#[cfg(feature = "changes")]
mod change;
#[cfg(feature = "constraints")]
mod constrained;
mod fault;
mod locate;
mod memory;
#[cfg(feature = "paths")]
mod paths;
mod planes;
#[cfg(feature = "weights")]
mod power;
#[cfg(feature = "surface")]
mod surface;
mod tray;
mod voronoi;
