//! The attacks, a file each.

pub(crate) mod alphas;
pub(crate) mod broken;
pub(crate) mod builds;
pub(crate) mod cells;
pub(crate) mod cells3;
pub(crate) mod files;
pub(crate) mod graph_lives;
pub(crate) mod graphs;
pub(crate) mod hulls;
pub(crate) mod lives;
pub(crate) mod mesh;
pub(crate) mod mixtures;
pub(crate) mod motion;
pub(crate) mod orders;
pub(crate) mod outlines;
pub(crate) mod periodic;
pub(crate) mod plane;
pub(crate) mod predicates;
pub(crate) mod program;
pub(crate) mod proximity;
pub(crate) mod queries;
pub(crate) mod space;
pub(crate) mod spheres;
pub(crate) mod surfaces;
pub(crate) mod tiles;
pub(crate) mod weights;
