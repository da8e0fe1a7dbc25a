//! Arguments of `reduce`.

use std::path::PathBuf;

use clap::Args;
use delone_cli::args::{InputArgs, WktArgs, formats};
use delone_io::Contents;

/// Shrink points.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  delone-lab reduce points.csv -o small.csv
  delone-lab reduce plan.poly -o small.poly
  delone-lab reduce points.npy --against 'python3 other.py {points} {triangles}'

Without --against, points fail on which Delone's algorithms disagree or a check fails; with segments also where the order of
the input makes a difference. With it, points fail for
which the command fails, or writes triangles that are not Delaunay; {points} and {triangles} are .npy files.")]
pub(crate) struct ReduceArgs {
    #[command(flatten)]
    pub(crate) input: InputArgs,
    /// Another program to judge instead.
    #[arg(long, value_name = "COMMAND")]
    pub(crate) against: Option<String>,
    /// Segments between the points.
    #[arg(long, value_name = "FILE", help = formats::segments())]
    pub(crate) segments: Option<PathBuf>,
    /// The reduced points.
    #[arg(
        long, short, value_name = "OUT",
        help = format!(
            "File for the reduced points ({}; with segments {})",
            formats::written(&[Contents::Points]), formats::written(&[Contents::Lines])
        )
    )]
    pub(crate) output: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) wkt: WktArgs,
}
