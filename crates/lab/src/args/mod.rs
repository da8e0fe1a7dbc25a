//! The command line: the commands; their arguments have files of their own.

mod animate;
mod experiment;
mod reduce;
mod replay;

use clap::{Parser, Subcommand};
use delone_cli::args::RunArgs;

pub(crate) use animate::{AnimateArgs, Show};
pub(crate) use experiment::ExperimentArgs;
pub(crate) use reduce::ReduceArgs;
pub(crate) use replay::ReplayArgs;

/// Experiments with Delone: the figures of the papers, what algorithms do, and reports of bugs.
#[derive(Debug, Parser)]
#[command(name = "delone-lab", version, arg_required_else_help = true, propagate_version = true)]
pub(crate) struct Cli {
    #[command(flatten)]
    pub(crate) run: RunArgs,
    #[command(subcommand)]
    pub(crate) command: Command,
}

/// The commands.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Repeat the experiments of the papers, with the papers' figures beside.
    Experiment(ExperimentArgs),
    /// Show points in motion, or what an algorithm does, as a moving picture.
    Animate(AnimateArgs),
    /// Shrink points on which algorithms disagree, and print them as a test.
    Reduce(ReduceArgs),
    /// Insert, remove, move and ask, as a text file says, one operation a line.
    Replay(ReplayArgs),
}
