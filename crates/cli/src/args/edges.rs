//! Which triangles are left out for their long edges.

use clap::Args;
use delone_io::Border;

use super::length;

/// Long edges, of surfaces.
#[derive(Debug, Args)]
pub(crate) struct EdgeArgs {
    /// Leave out triangles with an edge longer than this, from the hull inwards: gaps in the middle stay filled.
    #[arg(long, alias = "carve", value_name = "LENGTH", value_parser = length, help_heading = "Borders")]
    pub(crate) max_edge: Option<f64>,
    /// Leave out triangles with an edge longer than this, wherever they are.
    #[arg(long, value_name = "LENGTH", value_parser = length, help_heading = "Borders", conflicts_with = "max_edge")]
    pub(crate) max_edge_anywhere: Option<f64>,
}

impl EdgeArgs {
    /// The rule for simplices that are left out.
    pub(crate) fn border(&self) -> Border {
        Border::long_edges(self.max_edge.or(self.max_edge_anywhere))
            .anywhere(self.max_edge_anywhere.is_some())
    }
}
