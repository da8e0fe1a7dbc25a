//! `delone version`, `delone completions` and `delone man`: the program about itself.

use std::fs;
use std::path::Path;

use clap::CommandFactory;
use clap::builder::PossibleValuesParser;
use clap_complete::Shell;
use delone_generators::{Graph, Kind, Kind3};
use delone_io::{Contents, Direction, Format};

use crate::args::Cli;
use crate::message::{Failure, answer, say};

/// Prints name and version.
pub(crate) fn version() -> Result<(), Failure> {
    answer(&format!("delone {}\n", env!("CARGO_PKG_VERSION")))
}

/// Prints a script that completes commands, options and names.
pub(crate) fn completions(shell: Shell) -> Result<(), Failure> {
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut with_values(Cli::command()), "delone", &mut script);
    if shell == Shell::Fish {
        // The generator of scripts for this shell leaves out values without an option.
        let condition = "__fish_delone_using_subcommand generate";
        let line = format!("complete -c delone -n \"{condition}\" -f -a \"{}\"\n", sets().join(" "));
        script.extend_from_slice(line.as_bytes());
    }
    answer(&String::from_utf8_lossy(&script))
}

/// The command with the values of arguments that are read by functions: formats, and names of sets.
fn with_values(command: clap::Command) -> clap::Command {
    let formats = |direction: Direction| {
        let is_one = |&format: &Format| Contents::ALL.iter().any(|&any| format.holds(any, direction));
        let names = Format::all().filter(is_one).flat_map(|format| format.names()[0]);
        let mut names: Vec<&str> = names.copied().collect();
        names.sort_unstable();
        names.dedup();
        PossibleValuesParser::new(names)
    };
    let values = move |arg: clap::Arg| match arg.get_id().as_str() {
        "from" => arg.value_parser(formats(Direction::Read)),
        "to" => arg.value_parser(formats(Direction::Written)),
        "kind" if arg.get_long().is_none() => arg.value_parser(PossibleValuesParser::new(sets())),
        _ => arg,
    };
    command.mut_subcommands(move |command| command.mut_args(values))
}

/// The names of all sets that are generated.
fn sets() -> Vec<&'static str> {
    let plane = Kind::ALL.iter().map(|kind| kind.name());
    let space = Kind3::ALL.iter().map(|kind| kind.name());
    let graphs = Graph::ALL.iter().map(|graph| graph.name());
    plane.chain(space).chain(graphs).chain(["list"]).collect()
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
