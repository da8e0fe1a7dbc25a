//! Arguments of `experiment`.

use std::path::PathBuf;

use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use delone_cli::args::count;
use delone_experiments::{EXPERIMENTS, Experiment};

const EXPERIMENT_EXAMPLES: &str = "Examples:
  delone-lab experiment hierarchy --largest 50000
  delone-lab experiment jump-and-walk -o results
  delone-lab experiment history -o results
  delone-lab experiment radial --largest 1000000
  delone-lab experiment imprecise --largest 10000000 -o results
  delone-lab experiment scan model.ply
  delone-lab experiment growth --largest 10000000 -o results

A table goes to standard output; with -o, tables as CSV and plots as SVG go into that folder. While an
experiment runs, its rows are there in NAME.part.csv. Times are seconds on this machine and differ from
run to run; counts depend on the seed alone.";

/// Repeat experiments.
#[derive(Debug, Args)]
#[command(after_help = experiment_help())]
pub(crate) struct ExperimentArgs {
    /// Which experiment.
    #[arg(value_name = "NAME", value_parser = experiment_names(), hide_possible_values = true)]
    name: String,
    /// File of points in space, for scan.
    #[arg(value_name = "MODEL")]
    pub(crate) model: Option<PathBuf>,
    /// Folder for tables and plots.
    #[arg(long, short, value_name = "FOLDER")]
    pub(crate) output: Option<PathBuf>,
    /// The largest set.
    #[arg(long, value_name = "N", default_value = "500000", value_parser = count)]
    pub(crate) largest: usize,
    /// How often each quantity is measured, from other points and in other orders; tables give mean and standard error.
    #[arg(long, value_name = "T", default_value_t = 3, value_parser = clap::value_parser!(u16).range(1..=1000))]
    pub(crate) trials: u16,
    /// Seed of points and orders.
    #[arg(long, value_name = "S", default_value_t = 1)]
    pub(crate) seed: u64,
    /// Write what was counted and timed, and on how many threads at most, to a JSON file.
    #[arg(long, value_name = "FILE")]
    pub(crate) stats: Option<PathBuf>,
}

/// The names of all experiments.
fn experiment_names() -> impl TypedValueParser<Value = String> {
    PossibleValuesParser::new(EXPERIMENTS.iter().map(|experiment| experiment.name))
}

/// A line on each experiment, and examples.
fn experiment_help() -> String {
    let list = EXPERIMENTS.iter().map(|e| format!("  {:<15} {}\n", e.name, e.about)).collect::<String>();
    format!("Experiments:\n{list}\n{EXPERIMENT_EXAMPLES}")
}

impl ExperimentArgs {
    /// The experiment asked for.
    pub(crate) fn experiment(&self) -> &'static Experiment {
        Experiment::named(&self.name).expect("the parser takes these names alone")
    }
}
