//! Arguments of commands that query a triangulation: `locate`, `nearest`, `furthest`.

use std::path::PathBuf;

use clap::Args;
use delone_io::{Contents, Format};

use super::formats;
use super::{DimArgs, InputArgs, StrategyArgs};

/// How queries are read and answers are written.
#[derive(Debug, Args)]
pub(crate) struct QueryArgs {
    /// File of points to ask for, in any format that points have.
    #[arg(long, value_name = "Q", required = true)]
    pub(crate) queries: PathBuf,
    /// Output file.
    #[arg(
        long, short, value_name = "OUT", required = true,
        help = format!(
            "Output file, or - for standard output: npy has the answers alone (int64), {} have the queries with their attributes too",
            formats::written(&[Contents::Answers])
        )
    )]
    pub(crate) output: PathBuf,
    /// Format of the output, if its extension does not tell.
    #[arg(long, value_name = "FORMAT")]
    pub(crate) to: Option<Format>,
    #[command(flatten)]
    pub(crate) strategy: StrategyArgs,
}

/// Locate points.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  delone locate points.npy --queries queries.npy -o triangles.npy
  delone locate points.csv --queries queries.csv -o - --to csv --locate hierarchy --ratio 8 --phase3 exact

Row i holds the vertices, counter-clockwise, of the triangle that contains query i; if the query is on an edge or a
vertex, of that with the lexicographically least corners; -1 -1 -1 if it is outside of the convex hull. With --dim 3
likewise of a tetrahedron, in positive order, with four columns.")]
pub(crate) struct LocateArgs {
    #[command(flatten)]
    pub(crate) input: InputArgs,
    #[command(flatten)]
    pub(crate) dim: DimArgs,
    #[command(flatten)]
    pub(crate) query: QueryArgs,
}

/// Find nearest vertices.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  delone nearest points.npy --queries queries.npy -o nearest.npy
  delone nearest points.csv --queries queries.csv -k 5 -o - --to csv

Row i holds the k vertices nearest to query i, nearest first, -1 where there are fewer. Of vertices at the same
distance the lexicographically smaller comes first.")]
pub(crate) struct NearestArgs {
    #[command(flatten)]
    pub(crate) input: InputArgs,
    #[command(flatten)]
    pub(crate) dim: DimArgs,
    #[command(flatten)]
    pub(crate) query: QueryArgs,
    /// How many vertices for each query.
    #[arg(short, value_name = "K", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) k: u32,
}

/// Find furthest vertices.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  delone furthest points.npy --queries queries.npy -o furthest.npy
  delone furthest points.csv --queries queries.csv -o - --to csv --stats circle.json

Of vertices at the same distance the lexicographically smallest is taken; -1 where there is none. The statistics hold
the smallest circle around all points.")]
pub(crate) struct FurthestArgs {
    #[command(flatten)]
    pub(crate) input: InputArgs,
    /// File of points to ask for, in any format that points have.
    #[arg(long, value_name = "Q", required = true)]
    pub(crate) queries: PathBuf,
    /// Output file.
    #[arg(
        long, short, value_name = "OUT", required = true,
        help = format!(
            "Output file, or - for standard output: npy has the answers alone (int64), {} have the queries with their attributes too",
            formats::written(&[Contents::Answers])
        )
    )]
    pub(crate) output: PathBuf,
    /// Format of the output, if its extension does not tell.
    #[arg(long, value_name = "FORMAT")]
    pub(crate) to: Option<Format>,
}
