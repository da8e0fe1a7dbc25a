//! Delone
pub mod ids;
pub mod error;
mod order;
pub mod mesh;
pub mod plane;
pub use ids::*;
