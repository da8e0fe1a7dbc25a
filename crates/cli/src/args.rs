//! What can be said on the command line.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};
use delone_io::Format;

/// Exact Delaunay triangulation: one point set, one triangulation.
#[derive(Debug, Parser)]
#[command(name = "delone", version, arg_required_else_help = true, propagate_version = true)]
pub(crate) struct Cli {
    /// No progress and no notes on standard error; errors still appear.
    #[arg(long, short, global = true)]
    pub(crate) quiet: bool,
    #[command(subcommand)]
    pub(crate) command: Command,
}

/// The commands.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Triangulate points.
    Triangulate(TriangulateArgs),
    /// Judge triangles from any program: Delaunay? canonical?
    Check(CheckArgs),
    /// Make a named set of points; the same seed gives the same bytes on every machine.
    Generate(GenerateArgs),
    /// Draw points, triangles and hull as SVG or PNG.
    Draw(DrawArgs),
    /// Tell what is in a file of points: counts, bounds, duplicates, degeneracies.
    Info(InfoArgs),
    /// Shrink points on which algorithms disagree, and print them as a test.
    Reduce(ReduceArgs),
}

/// How points are read.
#[derive(Debug, Args)]
pub(crate) struct InputArgs {
    /// File of points, or - for standard input: csv xyz txt npy bin node las laz ply obj geojson.
    #[arg(value_name = "IN")]
    pub(crate) input: PathBuf,
    /// Format of the input, if its extension does not tell.
    #[arg(long, value_name = "FORMAT")]
    pub(crate) from: Option<Format>,
    /// LAS classes to keep (2 is ground), separated by commas.
    #[arg(long, value_name = "CLASS", value_delimiter = ',')]
    pub(crate) class: Vec<u8>,
    /// Columns of text that are x, y and perhaps z: names or numbers from 1, separated by commas.
    #[arg(long, value_name = "COLUMN", value_delimiter = ',')]
    pub(crate) columns: Vec<String>,
    /// Write what was counted and timed to a JSON file.
    #[arg(long, value_name = "FILE")]
    pub(crate) stats: Option<PathBuf>,
}

/// Triangulate points.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  delone triangulate points.csv -o mesh.ply -o picture.png
  delone triangulate tile.laz --class 2 -o terrain.ply -o terrain.png
  delone triangulate points.npy -o triangles.npy --check --stats stats.json
  delone generate uniform -n 1000 -o - --to csv | delone triangulate - --from csv -o - --to ele

x and y are triangulated; heights are kept. Indices are those of the input points, from 0.
Exit status: 0 done, 1 bad data or failed work, 2 wrong usage.")]
pub(crate) struct TriangulateArgs {
    #[command(flatten)]
    pub(crate) input: InputArgs,
    /// Output file (npy node ele neigh edge ply obj stl vtu geojson svg png), or - for standard output; may be
    /// repeated.
    #[arg(long, short, value_name = "OUT", required = true)]
    pub(crate) output: Vec<PathBuf>,
    /// Format of outputs whose extension does not tell.
    #[arg(long, value_name = "FORMAT")]
    pub(crate) to: Option<Format>,
    /// Dimension: 2 triangulates x and y.
    #[arg(long, value_name = "DIM", default_value_t = 2, value_parser = clap::value_parser!(u8).range(2..=3))]
    pub(crate) dim: u8,
    /// Algorithm; the triangles are the same.
    #[arg(long, value_name = "NAME", default_value = "divide-conquer")]
    pub(crate) algorithm: AlgorithmName,
    /// Point location of the incremental algorithm.
    #[arg(long, value_name = "NAME")]
    pub(crate) locate: Option<LocateName>,
    /// Threads at most; the result does not depend on it. The present algorithms use one.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub(crate) threads: Option<u16>,
    /// Seed of randomized algorithms; it changes their course, not their result.
    #[arg(long, value_name = "S", default_value_t = 0)]
    pub(crate) seed: u64,
    /// Prove the result with exact arithmetic before writing it.
    #[arg(long)]
    pub(crate) check: bool,
}

/// Bulk algorithms.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum AlgorithmName {
    /// Divide and conquer in Morton order: the fastest.
    DivideConquer,
    /// One by one in a biased randomized order.
    Incremental,
}

/// Point location strategies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum LocateName {
    /// Walk from the previous point in spatial order.
    Spatial,
}

/// Judge triangles.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  delone check points.npy triangles.npy
  delone check points.node other.1.ele

Exit status: 0 Delaunay (the answer says whether canonical too), 1 not Delaunay or bad data, 2 wrong usage.")]
pub(crate) struct CheckArgs {
    #[command(flatten)]
    pub(crate) input: InputArgs,
    /// File of triangles: npy ele ply obj.
    #[arg(value_name = "MESH")]
    pub(crate) mesh: PathBuf,
}

/// Make points.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  delone generate uniform -n 1000000 --seed 1 -o points.npy
  delone generate ellipse2 -n 5000 -o points.csv
  delone generate list")]
pub(crate) struct GenerateArgs {
    /// Name of the set, or `list` to see them all.
    #[arg(value_name = "KIND")]
    pub(crate) kind: String,
    /// Number of points.
    #[arg(short, value_name = "N", default_value_t = 1000)]
    pub(crate) n: usize,
    /// Seed of the random numbers.
    #[arg(long, value_name = "S", default_value_t = 0)]
    pub(crate) seed: u64,
    /// Output file (csv xyz txt npy bin node ply obj geojson), or - for standard output.
    #[arg(long, short, value_name = "OUT")]
    pub(crate) output: Option<PathBuf>,
    /// Format of the output, if its extension does not tell.
    #[arg(long, value_name = "FORMAT")]
    pub(crate) to: Option<Format>,
    /// Write what was counted and timed to a JSON file.
    #[arg(long, value_name = "FILE")]
    pub(crate) stats: Option<PathBuf>,
}

/// Draw points.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  delone draw points.csv -o picture.svg
  delone draw tile.laz --class 2 -o relief.png --size 3000 --edges=no

What is drawn follows from the room there is; --edges, --points and --fill decide otherwise.")]
pub(crate) struct DrawArgs {
    #[command(flatten)]
    pub(crate) input: InputArgs,
    /// Picture: svg or png, or - for standard output; may be repeated.
    #[arg(long, short, value_name = "OUT", required = true)]
    pub(crate) output: Vec<PathBuf>,
    /// Format of outputs whose extension does not tell.
    #[arg(long, value_name = "FORMAT")]
    pub(crate) to: Option<Format>,
    /// The longer side in pixels.
    #[arg(long, value_name = "PIXELS", default_value_t = 1600, value_parser = clap::value_parser!(u32).range(16..=20_000))]
    pub(crate) size: u32,
    /// Draw edges.
    #[arg(long, value_name = "YES", require_equals = true, num_args = 0..=1, default_missing_value = "yes")]
    pub(crate) edges: Option<Choice>,
    /// Draw vertices.
    #[arg(long, value_name = "YES", require_equals = true, num_args = 0..=1, default_missing_value = "yes")]
    pub(crate) points: Option<Choice>,
    /// Fill triangles by height or density.
    #[arg(long, value_name = "YES", require_equals = true, num_args = 0..=1, default_missing_value = "yes")]
    pub(crate) fill: Option<Choice>,
}

/// Yes or no.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Choice {
    Yes,
    No,
}

/// Describe points.
#[derive(Debug, Args)]
#[command(after_help = "Example:
  delone info tile.laz --class 2")]
pub(crate) struct InfoArgs {
    #[command(flatten)]
    pub(crate) input: InputArgs,
}

/// Shrink points.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  delone reduce points.csv -o small.csv
  delone reduce points.npy --against 'python3 other.py {points} {triangles}'

Without --against, points fail on which Delone's algorithms disagree or a check fails. With it, points fail for
which the command fails, or writes triangles that are not Delaunay; {points} and {triangles} are .npy files.")]
pub(crate) struct ReduceArgs {
    #[command(flatten)]
    pub(crate) input: InputArgs,
    /// Another program to judge instead.
    #[arg(long, value_name = "COMMAND")]
    pub(crate) against: Option<String>,
    /// File for the reduced points.
    #[arg(long, short, value_name = "OUT")]
    pub(crate) output: Option<PathBuf>,
}
