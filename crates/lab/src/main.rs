//! The `delone-lab` program: experiments with the engine, one file a command.

mod animate;
mod args;
mod experiment;
mod reduce;
mod replay;

use std::process::ExitCode;

use clap::{CommandFactory, Parser};
use delone::{Delaunay2, Delaunay3};
use delone_cli::{finish, folders, message, start};

use args::{Cli, Command};

fn main() -> ExitCode {
    let Cli { run, mut command } = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) => return message::usage(&error, "delone-lab", &Cli::command()),
    };
    let quiet = run.quiet;
    start(&run);
    let expanded = match &mut command {
        Command::Animate(args) => folders::expand(&mut args.input, false),
        Command::Reduce(args) => folders::expand(&mut args.input, false),
        Command::Experiment(_) | Command::Replay(_) => Ok(()),
    };
    if let Err(failure) = expanded {
        return failure.report();
    }
    let result = match command {
        Command::Experiment(args) => experiment::run(&args, quiet),
        Command::Animate(args) => animate::run(&args, quiet),
        Command::Reduce(args) => reduce::run(&args, quiet),
        Command::Replay(args) if args.dim.is_space() => replay::run::<Delaunay3>(&args, quiet),
        Command::Replay(args) => replay::run::<Delaunay2>(&args, quiet),
    };
    finish(result, quiet)
}
