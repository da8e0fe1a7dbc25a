//! Arguments of `graph`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use delone_io::{Contents, Format};

use super::formats;
use super::{DimArgs, InputArgs};

/// Proximity graphs.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  delone graph points.csv --kind spanning-tree -o tree.npy -o tree.svg
  delone graph tile.laz --class building --kind gabriel -o edges.geojson
  delone graph points.npy --kind beta --beta 1.5 -o edges.csv --stats edges.json
  delone graph points.npy --kind nearest -k 8 --dim 3 -o edges.npy

A row of npy and csv is an edge: the indices of its ends, the smaller first, rows sorted; csv has a header and the length as
a third column. Of equal points the first stands for all. npy may be given to --segments of other commands.

On every set of points the edges of the spanning tree are among the relative neighbors, these in the Gabriel graph, and
that in the Delaunay triangulation; they do not depend on the order of the points.")]
pub(crate) struct ProximityArgs {
    #[command(flatten)]
    pub(crate) input: InputArgs,
    #[command(flatten)]
    pub(crate) dim: DimArgs,
    /// Which graph.
    #[arg(long, value_name = "KIND")]
    pub(crate) kind: ProximityName,
    /// Of --kind beta: how large lunes are, from 1 on.
    #[arg(long, value_name = "B", allow_negative_numbers = true)]
    pub(crate) beta: Option<f64>,
    /// Of --kind nearest: with how many each point is joined at least.
    #[arg(short, long, value_name = "K")]
    pub(crate) k: Option<u32>,
    /// Output files.
    #[arg(
        long, short, value_name = "OUT", required = true,
        help = format!(
            "Output file ({}; in the plane also {}), or - for standard output; may be repeated",
            formats::written(&[Contents::Edges]), formats::written(&[Contents::Pictures])
        )
    )]
    pub(crate) output: Vec<PathBuf>,
    /// Format of outputs whose extension does not tell.
    #[arg(long, value_name = "FORMAT")]
    pub(crate) to: Option<Format>,
    /// The longer side of pictures in pixels.
    #[arg(long, value_name = "PIXELS", default_value_t = 1600, value_parser = clap::value_parser!(u32).range(16..=20_000))]
    pub(crate) size: u32,
}

/// Proximity graphs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum ProximityName {
    /// No other point in the closed disk with both ends on a diameter.
    Gabriel,
    /// No other point nearer to both ends than they are to each other.
    #[value(alias = "relative-neighbours")]
    RelativeNeighbors,
    /// The Euclidean minimum spanning tree.
    SpanningTree,
    /// No other point in the open lune of this beta: 1 gives gabriel, 2 the relative neighbors.
    Beta,
    /// One end is among the k points nearest to the other.
    Nearest,
}
