//! Arguments of commands that query a triangulation: `locate`, `nearest`, `furthest`, `replay`.

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

/// Replay operations.
#[derive(Debug, Args)]
#[command(after_help = "Operations, one a line; # starts a comment:
  + X Y      insert; answers '+ ID', or '= ID' if that vertex has the same coordinates
  - ID       remove
  > ID X Y   move
  ? X Y      locate; answers '? triangle A B C', '? edge A B', '? vertex A', '? outside A B' (the
             hull edge nearest to it) or '? nowhere' (there is no triangle, and the point is on no edge)
  @ X Y      nearest vertex; answers '@ ID' or '@ none'
With --dim 3 points have three coordinates, and '?' answers 'tetrahedron A B C D', 'facet A B C', 'edge A B',
'vertex A', 'outside A B C' or 'nowhere'.
Ids count up from 0 and are never used again.

Examples:
  delone replay bug.txt -o triangles.npy --check
  printf '+ 0 0\\n+ 1 0\\n+ 0 1\\n? .2 .2\\n' | delone replay - -o picture.svg")]
pub(crate) struct ReplayArgs {
    /// File of operations, or - for standard input.
    #[arg(value_name = "OPS")]
    pub(crate) operations: PathBuf,
    #[command(flatten)]
    pub(crate) dim: DimArgs,
    /// Output file for the triangles at the end, in any format that meshes have, or - for standard output: answers go to standard error
    /// then; may be repeated.
    #[arg(long, short, value_name = "OUT", required = true)]
    pub(crate) output: Vec<PathBuf>,
    /// Format of outputs whose extension does not tell.
    #[arg(long, value_name = "FORMAT")]
    pub(crate) to: Option<Format>,
    /// Prove the triangulation with exact arithmetic after every operation up to 1,000 vertices, after every
    /// thousandth beyond, and at the end.
    #[arg(long)]
    pub(crate) check: bool,
    /// Write what was counted and timed, and on how many threads at most, to a JSON file.
    #[arg(long, value_name = "FILE")]
    pub(crate) stats: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) strategy: StrategyArgs,
}
