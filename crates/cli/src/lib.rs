//! The `delone` program: one file a command.
//!
//! Its interface is [`run`]. The hidden modules are for `delone-lab` and change without notice.

mod about;
mod alpha;
mod antimeridian;
#[doc(hidden)]
pub mod args;
mod check;
mod clip;
mod closed;
#[doc(hidden)]
pub mod constrained;
mod contours;
mod draw;
mod dtm;
#[doc(hidden)]
pub mod files;
#[doc(hidden)]
pub mod folders;
mod furthest;
mod generate;
mod graph;
mod hull;
mod info;
mod instances;
mod interpolate;
mod limits;
mod lines;
mod locate;
mod medial;
mod memory;
mod mesh;
#[doc(hidden)]
pub mod message;
mod nearest;
mod orders;
mod outcome;
mod place;
mod polygons;
mod polyhedra;
mod powers;
#[doc(hidden)]
pub mod progress;
mod queries;
mod relief;
mod repeated;
#[doc(hidden)]
pub mod room;
mod signals;
mod simplify;
mod sites;
#[doc(hidden)]
pub mod stats;
mod threads;
mod tiles;
mod triangulate;
mod voronoi;
mod weighted;
mod weld;

use std::process::ExitCode;

use clap::{CommandFactory, Parser};
use delone::{Delaunay2, Delaunay3};

use args::{Cli, Command, RunArgs};
use message::Failure;

/// Runs a command in the plane or in space, as its arguments say.
macro_rules! in_room {
    ($command:ident, $args:ident, $quiet:ident) => {
        if $args.dim.is_space() {
            $command::run::<Delaunay3>(&$args, $quiet)
        } else {
            $command::run::<Delaunay2>(&$args, $quiet)
        }
    };
}

/// Runs the program `delone`.
#[must_use]
pub fn run() -> ExitCode {
    let Cli { run, mut command } = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) => return message::usage(&error, "delone", &Cli::command()),
    };
    let quiet = run.quiet;
    start(&run);
    if let Err(failure) = folders::expand_all(&mut command) {
        return failure.report();
    }
    let result = match command {
        Command::Triangulate(args) => in_room!(triangulate, args, quiet),
        Command::Tiles(args) => tiles::run(&args, quiet),
        Command::Dtm(args) => dtm::run(&args, quiet),
        Command::Interpolate(args) => interpolate::run(&args, quiet),
        Command::Window(args) => tiles::window(&args, quiet),
        Command::Mesh(args) => mesh::run(&args, quiet),
        Command::Polygons(args) => polygons::run(&args, quiet),
        Command::Check(mut args) => match args.folder() {
            Some(folder) => tiles::check(&folder, args.input.stats.as_deref(), quiet),
            None => in_room!(check, args, quiet),
        },
        Command::Generate(args) => generate::run(&args, quiet),
        Command::Draw(args) => in_room!(draw, args, quiet),
        Command::Info(args) => match args.folder() {
            Some(folder) => tiles::describe(folder, args.input.stats.as_deref()),
            None => in_room!(info, args, quiet),
        },
        Command::Locate(args) => in_room!(locate, args, quiet),
        Command::Nearest(args) => in_room!(nearest, args, quiet),
        Command::Alpha(args) => alpha::run(&args, quiet),
        Command::Graph(args) => in_room!(graph, args, quiet),
        Command::Hull(args) => hull::run(&args, quiet),
        Command::Furthest(args) => furthest::run(&args, quiet),
        Command::Voronoi(args) => voronoi::run(&args, quiet),
        Command::Contours(args) => contours::run(&args, quiet),
        Command::Relief(args) => relief::run(&args, quiet),
        Command::Simplify(args) => simplify::run(&args, quiet),
        Command::Version => about::version(),
        Command::Completions { shell } => about::completions(shell),
        Command::Man { output } => about::man(output.as_deref(), quiet),
    };
    finish(result, quiet)
}

/// Does as the arguments of all commands say.
#[doc(hidden)]
pub fn start(args: &RunArgs) {
    limits::start(args.max_memory, args.max_points, args.max_output);
    signals::clean_up();
    message::be_strict(args.strict);
    args.epsg.iter().cloned().for_each(files::say_system);
    threads::start(args.threads, args.quiet);
}

/// Publishes the outputs of a command, or reports why there are none.
#[doc(hidden)]
pub fn finish(result: Result<(), Failure>, quiet: bool) -> ExitCode {
    match result.and_then(|()| files::publish(quiet)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            delone_io::remove_unfinished();
            failure.report()
        }
    }
}
