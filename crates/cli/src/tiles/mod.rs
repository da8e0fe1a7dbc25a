//! `delone tiles`, `window`, and `check` and `info` of folders: arguments and messages around the library of stores (`delone_store`).

mod describe;
mod failure;
mod verdict;
mod watch;
mod window;

use std::fs;
use std::path::{Path, PathBuf};

use delone_store::{Build, Files, Summary};

pub(crate) use delone_store::MANIFEST;
pub(crate) use describe::describe;
pub(crate) use failure::failure;
pub(crate) use verdict::check;
pub(crate) use watch::Watched;
pub(crate) use window::run as window;

use crate::args::{InputArgs, TilesArgs};
use crate::files;
#[cfg(feature = "parquet")]
use crate::message::lost;
use crate::message::{Failure, grouped, note, say};
use crate::stats::Stats;

pub(crate) fn run(args: &TilesArgs, quiet: bool) -> Result<(), Failure> {
    #[cfg(not(feature = "parquet"))]
    if args.parquet {
        return Err(Failure::left_out("--parquet", "parquet"));
    }
    let stats_path = args.input.stats.as_deref();
    files::keep_apart(&args.input.paths(), stats_path)?;
    let build = Build::new()
        .memory(args.memory)
        .workers(args.workers.map(usize::from))
        .heights(args.heights)
        .tile(args.tile)
        .resume(args.resume)
        .neighbors(args.neighbors)
        .apart(stats_path.map(Path::to_owned).into_iter().collect());
    #[cfg(feature = "parquet")]
    let build = build.tables(args.parquet);
    let mut stats = Stats::start();
    let watch = Watched::of(&args.output, &mut stats, quiet);
    let made = build.run(&input(&args.input, args.heights)?, &args.output, &watch);
    let (store, _) = made.map_err(failure)?;
    drop(watch);
    #[cfg(feature = "parquet")]
    if let Some(crs) = store.crs().filter(|crs| args.parquet && !crs.is_said_by_geoparquet()) {
        let folder = args.output.display();
        lost(quiet, format_args!("{folder}: nothing in its tables says that their coordinates are {crs}"));
    }
    tell(&store.summary(), &mut stats, quiet);
    stats.write(stats_path)
}

/// The files of a command, and how they are read.
pub(crate) fn input(args: &InputArgs, has_heights: bool) -> Result<Files, Failure> {
    let formats = files::formats(args)?;
    let dimension = if has_heights { 3 } else { 2 };
    let files = Files::with_formats(args.input.iter().zip(formats));
    let mut files = files.options(crate::files::options(args, dimension));
    files.from = args.from;
    Ok(files)
}

/// Refuses outputs in a folder of tiles that is read, or that are files of it by other names, or cannot be written.
fn keep_apart<'a>(folder: &Path, outputs: impl IntoIterator<Item = &'a Path>) -> Result<(), Failure> {
    let outputs: Vec<&Path> = outputs.into_iter().collect();
    delone_store::keep_out(folder, outputs.iter().copied()).map_err(failure)?;
    let own: Vec<_> =
        fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path()).collect();
    files::keep_apart(&own.iter().map(PathBuf::as_path).collect::<Vec<_>>(), outputs)
}

/// A number of tiles, in words.
fn in_tiles(count: usize) -> String {
    format!("{} {}", grouped(count as u64), if count == 1 { "tile" } else { "tiles" })
}

/// Says what was done.
fn tell(summary: &Summary, stats: &mut Stats, quiet: bool) {
    if summary.duplicates > 0 {
        note(
            quiet,
            format_args!(
                "{} of {} points equal earlier ones and are no vertices",
                summary.duplicates, summary.points
            ),
        );
    }
    stats.set("points", summary.points);
    stats.set("duplicates", summary.duplicates);
    stats.set("vertices", summary.vertices);
    stats.set("simplices", summary.triangles);
    stats.set("hull", summary.hull);
    stats.set("fingerprint", summary.fingerprint.to_string());
    stats.set("tiles", summary.tiles);
    stats.set("joins", summary.joins);
    stats.set("border", summary.border);
    say(
        quiet,
        format_args!(
            "{} points, {} triangles, {} on the hull, in {} with {} points of borders ({:.2} s)",
            grouped(summary.points),
            grouped(summary.triangles),
            grouped(summary.hull),
            in_tiles(summary.tiles),
            grouped(summary.border),
            stats.total()
        ),
    );
}
