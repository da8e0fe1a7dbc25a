//! `delone version`, `delone completions` and `delone man`: the program about itself.

use std::fs;
use std::path::Path;

use clap::CommandFactory;
use clap_complete::Shell;

use crate::args::Cli;
use crate::message::{Failure, answer, say};

/// Prints name and version.
pub(crate) fn version() -> Result<(), Failure> {
    answer(&format!("delone {}\n", env!("CARGO_PKG_VERSION")))
}

/// Prints a script that completes commands, options and names.
pub(crate) fn completions(shell: Shell) -> Result<(), Failure> {
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut Cli::command(), "delone", &mut script);
    answer(&String::from_utf8_lossy(&script))
}

/// Prints the manual page, or writes one of each command into a folder.
pub(crate) fn man(folder: Option<&Path>, quiet: bool) -> Result<(), Failure> {
    let failed =
        |error: std::io::Error| Failure::new(format!("cannot write manual pages: {error}"), "name a folder");
    // Without pages of `help`, which has none of its own.
    let mut command = Cli::command().name("delone").disable_help_subcommand(true);
    command.build();
    let Some(folder) = folder else {
        let mut page = Vec::new();
        clap_mangen::Man::new(command).render(&mut page).map_err(failed)?;
        return answer(&String::from_utf8_lossy(&page));
    };
    fs::create_dir_all(folder).map_err(failed)?;
    clap_mangen::generate_to(command, folder).map_err(failed)?;
    say(quiet, format_args!("manual pages are in {}: read one with man -l", folder.display()));
    Ok(())
}
