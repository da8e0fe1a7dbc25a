//! Arguments of `replay`.

use std::path::PathBuf;

use clap::Args;
use delone_cli::args::{DimArgs, StrategyArgs};
use delone_io::Format;

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
  delone-lab replay bug.txt -o triangles.npy --check
  printf '+ 0 0\\n+ 1 0\\n+ 0 1\\n? .2 .2\\n' | delone-lab replay - -o picture.svg")]
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
