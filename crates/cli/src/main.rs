//! The `delone` program: one file a command.

mod args;
mod check;
mod draw;
mod files;
mod generate;
mod info;
mod message;
mod progress;
mod reduce;
mod stats;
mod triangulate;

use std::process::ExitCode;

use clap::Parser;

use args::{Cli, Command};

fn main() -> ExitCode {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) => return message::usage(&error),
    };
    let quiet = cli.quiet;
    let result = match cli.command {
        Command::Triangulate(args) => triangulate::run(&args, quiet),
        Command::Check(args) => check::run(&args, quiet),
        Command::Generate(args) => generate::run(&args, quiet),
        Command::Draw(args) => draw::run(&args, quiet),
        Command::Info(args) => info::run(&args, quiet),
        Command::Reduce(args) => reduce::run(&args, quiet),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.report(),
    }
}
