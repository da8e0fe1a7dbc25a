//! The `delone` program: one file a command.

mod about;
mod alpha;
mod animate;
mod args;
mod check;
mod clip;
mod closed;
mod constrained;
mod contours;
mod draw;
mod dtm;
#[cfg(feature = "experiments")]
mod experiment;
mod files;
mod folders;
mod furthest;
mod generate;
mod graph;
mod hull;
mod info;
mod instances;
mod interpolate;
mod limits;
mod locate;
mod memory;
mod mesh;
mod message;
mod nearest;
mod orders;
mod outcome;
mod place;
mod polygons;
mod powers;
mod progress;
mod queries;
mod reduce;
mod relief;
mod replay;
mod room;
mod signals;
mod simplify;
mod sites;
mod stats;
mod threads;
mod tiles;
mod triangulate;
mod voronoi;
mod weighted;

use std::process::ExitCode;

use clap::Parser;
use delone::{Delaunay2, Delaunay3};

use args::{Cli, Command};

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

fn main() -> ExitCode {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) => return message::usage(&error),
    };
    let quiet = cli.quiet;
    limits::start(cli.max_memory, cli.max_points, cli.max_output);
    signals::clean_up();
    message::be_strict(cli.strict);
    cli.epsg.into_iter().for_each(files::say_system);
    threads::start(cli.threads, quiet);
    let mut command = cli.command;
    if let Err(failure) = folders::expand(&mut command) {
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
        Command::Animate(args) => animate::run(&args, quiet),
        Command::Info(args) => match args.folder() {
            Some(folder) => tiles::describe(folder, args.input.stats.as_deref()),
            None => in_room!(info, args, quiet),
        },
        Command::Reduce(args) => reduce::run(&args, quiet),
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
        Command::Replay(args) => in_room!(replay, args, quiet),
        #[cfg(feature = "experiments")]
        Command::Experiment(args) => experiment::run(&args, quiet),
        #[cfg(not(feature = "experiments"))]
        Command::Experiment { .. } => Err(message::Failure::left_out("delone experiment", "experiments")),
        Command::Version => about::version(),
        Command::Completions { shell } => about::completions(shell),
        Command::Man { output } => about::man(output.as_deref(), quiet),
    };
    match result.and_then(|()| files::publish(quiet)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            delone_io::remove_unfinished();
            failure.report()
        }
    }
}
