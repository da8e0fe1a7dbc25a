//! The `delone` program: one file a command.

mod animate;
mod args;
mod check;
mod draw;
mod experiment;
mod files;
mod furthest;
mod generate;
mod hull;
mod info;
mod instances;
mod locate;
mod message;
mod nearest;
mod progress;
mod reduce;
mod replay;
mod space;
mod stats;
mod triangulate;
mod voronoi;

use std::process::ExitCode;

use clap::Parser;

use args::{Cli, Command};

fn main() -> ExitCode {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) => return message::usage(&error),
    };
    let quiet = cli.quiet;
    if let Some(threads) = cli.threads {
        // It fails only if there is a pool already, and there is none yet.
        _ = rayon::ThreadPoolBuilder::new().num_threads(threads.into()).build_global();
    }
    let result = match cli.command {
        Command::Triangulate(args) => triangulate::run(&args, quiet),
        Command::Check(args) => check::run(&args, quiet),
        Command::Generate(args) => generate::run(&args, quiet),
        Command::Draw(args) => draw::run(&args, quiet),
        Command::Animate(args) => animate::run(&args, quiet),
        Command::Info(args) => info::run(&args, quiet),
        Command::Reduce(args) => reduce::run(&args, quiet),
        Command::Locate(args) => locate::run(&args, quiet),
        Command::Nearest(args) => nearest::run(&args, quiet),
        Command::Hull(args) => hull::run(&args, quiet),
        Command::Furthest(args) => furthest::run(&args, quiet),
        Command::Voronoi(args) => voronoi::run(&args, quiet),
        Command::Replay(args) => replay::run(&args, quiet),
        Command::Experiment(args) => experiment::run(&args, quiet),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(),
    }
}
