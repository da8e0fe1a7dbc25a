//! The command line: the commands and their common arguments; arguments of one command have files of
//! its own.

mod alpha;
mod ask;
mod edges;
pub mod formats;
mod graph;
mod heights;
mod las;
mod mesh;
mod periodic;
mod place;
mod points;
mod polygons;
mod proximity;
mod relief;
mod run;
mod shapes;
mod strategy;
mod surface;
mod tiles;
mod triangle;
mod triangulate;
mod weights;
mod wkt;

use std::path::{Path, PathBuf};

use clap::{Args, Parser, Subcommand};
use clap_complete::Shell;
use delone_io::{Contents, Format};

pub(crate) use alpha::AlphaArgs;
pub(crate) use ask::{FurthestArgs, LocateArgs, NearestArgs, QueryArgs};
pub(crate) use edges::EdgeArgs;
pub(crate) use formats::{IN_SPACE, IN_THE_PLANE};
pub use graph::{AntimeridianName, CrossingsName, FillName, GraphArgs, OverlapsName};
pub(crate) use heights::{ContoursArgs, SimplifyArgs};
pub use las::LasArgs;
pub(crate) use mesh::{ColorName, KeepName, LayerArgs, MeshArgs, PlacementName};
pub(crate) use periodic::{GridChoice, PeriodicArgs, PeriodicBox};
pub(crate) use place::PlaceArgs;
pub(crate) use points::{CheckArgs, GenerateArgs, InfoArgs};
pub(crate) use polygons::PolygonsArgs;
pub(crate) use proximity::{ProximityArgs, ProximityName};
pub(crate) use relief::{LightArgs, ReliefArgs, ReliefName};
pub use run::RunArgs;
pub(crate) use shapes::{CameraArgs, Choice, DrawArgs, HullAlgorithm, HullArgs, OfName, VoronoiArgs};
pub use strategy::{LocateName, StrategyArgs};
pub(crate) use surface::{DtmArgs, DuplicatesName, InterpolateArgs, MethodName, OutsideName};
pub(crate) use tiles::{TilesArgs, WindowArgs};
pub(crate) use triangle::{Switches, table as triangle_table};
pub use triangulate::AlgorithmName;
pub(crate) use triangulate::{HintOrderName, TriangulateArgs};
pub(crate) use weights::WeightArgs;
pub use wkt::WktArgs;

/// Exact Delaunay triangulation: one point set, one triangulation.
#[derive(Debug, Parser)]
#[command(name = "delone", version, arg_required_else_help = true, propagate_version = true)]
pub(crate) struct Cli {
    #[command(flatten)]
    pub(crate) run: RunArgs,
    #[command(subcommand)]
    pub(crate) command: Command,
}

/// The commands.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Triangulate points.
    Triangulate(TriangulateArgs),
    /// Triangulate more points than memory, in tiles.
    Tiles(TilesArgs),
    /// Make a raster of terrain of points with heights: a DEM, with hillshade and contours.
    Dtm(Box<DtmArgs>),
    /// Interpolate values between points: linear, natural neighbors, smooth.
    Interpolate(InterpolateArgs),
    /// Cut a part, or an overview, out of a folder of tiles.
    Window(WindowArgs),
    /// Make meshes with good angles and sizes: new vertices until all triangles are as wanted.
    Mesh(Box<MeshArgs>),
    /// Triangulate the insides of polygons, each alone.
    Polygons(PolygonsArgs),
    /// Find the triangle that contains each of many points.
    Locate(LocateArgs),
    /// Find the vertices nearest to each of many points.
    Nearest(NearestArgs),
    /// The corners of the convex hull in the plane, or its facets in space.
    Hull(HullArgs),
    /// Join points that are near each other: Gabriel graph, relative neighbors, spanning tree, skeletons, k nearest.
    Graph(ProximityArgs),
    /// Find the vertex furthest from each of many points.
    Furthest(FurthestArgs),
    /// Alpha shapes of points, with weights or without, and filtrations.
    Alpha(AlphaArgs),
    /// Voronoi cells in the plane, clipped, and in space, clipped or in a box that repeats.
    Voronoi(VoronoiArgs),
    /// Lines of equal height of points with heights or rasters, and the areas between them.
    Contours(ContoursArgs),
    /// Hillshade, slope or aspect of a raster of heights.
    Relief(ReliefArgs),
    /// Thin points with heights or rasters: a mesh of few of them that is near all others.
    Simplify(SimplifyArgs),
    /// Judge triangles from any program: Delaunay? canonical?
    Check(CheckArgs),
    /// Make a named set of points, or of points and segments; the same seed gives the same bytes on every machine.
    Generate(GenerateArgs),
    /// Draw points, triangles and hull as SVG or PNG.
    Draw(DrawArgs),
    /// Tell what is in a file of points: counts, bounds, duplicates, degeneracies.
    Info(InfoArgs),
    /// Print the version.
    Version,
    /// Print a script that completes commands and options in a shell.
    #[command(after_help = "Examples:
  delone completions bash > ~/.local/share/bash-completion/completions/delone
  delone completions zsh > ~/.zfunc/_delone
  delone completions fish > ~/.config/fish/completions/delone.fish")]
    Completions {
        /// The shell.
        shell: Shell,
    },
    /// Print the manual page, or write those of all commands into a folder.
    Man {
        /// Folder for the pages.
        #[arg(long, short, value_name = "FOLDER")]
        output: Option<PathBuf>,
    },
}

/// How points are read.
#[derive(Clone, Debug, Args)]
pub struct InputArgs {
    /// Files of points.
    #[arg(
        value_name = "IN", required = true,
        help = format!(
            "Files of points, or - for standard input: {}, each also with .gz. Several files are one set; a folder stands for the las and laz files in it and below, or for its ept.json",
            formats::read(Contents::Points)
        )
    )]
    pub input: Vec<PathBuf>,
    /// Format of the input, if its extension does not tell.
    #[arg(long, value_name = "FORMAT")]
    pub(crate) from: Option<Format>,
    #[command(flatten)]
    pub(crate) las: LasArgs,
    /// Columns of text that are x, y and perhaps z: names or numbers from 1, separated by commas. Of LAS points x, y and a dimension that is
    /// the height (intensity, gps_time, ..., or a name of extra bytes).
    #[arg(long, value_name = "COLUMN", value_delimiter = ',')]
    pub(crate) columns: Vec<String>,
    /// Leave out rows of text without coordinates, which are empty or words such as NA, NaN and null; a line on standard error says which.
    #[arg(long)]
    pub(crate) skip_missing: bool,
    /// Write what was counted and timed, and on how many threads at most, to a JSON file.
    #[arg(long, value_name = "FILE")]
    pub stats: Option<PathBuf>,
}

impl InputArgs {
    /// Files that nothing else is said of.
    pub(crate) fn of(paths: &[PathBuf]) -> Self {
        let (las, columns) = (LasArgs::default(), Vec::new());
        Self { input: paths.to_vec(), from: None, las, columns, skip_missing: false, stats: None }
    }

    /// The files that are read.
    pub fn paths(&self) -> Vec<&Path> {
        self.input.iter().map(PathBuf::as_path).collect()
    }

    /// The files that are read, and another one.
    pub(crate) fn paths_and<'a>(&'a self, other: &'a Path) -> Vec<&'a Path> {
        self.paths().into_iter().chain([other]).collect()
    }

    /// The name of the set in messages.
    pub fn label(&self) -> PathBuf {
        match &self.input[..] {
            [one] => one.clone(),
            [first, rest @ ..] => format!("{} and {} more", first.display(), rest.len()).into(),
            [] => PathBuf::new(),
        }
    }
}

/// A part of a length.
fn ratio(text: &str) -> Result<f64, String> {
    text.parse()
        .ok()
        .filter(|x: &f64| (0.0..=1.0).contains(x))
        .ok_or_else(|| "a ratio is from 0 to 1".to_owned())
}

/// A length in coordinate units.
fn length(text: &str) -> Result<f64, String> {
    text.parse().ok().filter(|x: &f64| *x >= 0.0).ok_or_else(|| "it is no length".to_owned())
}

/// A number of things, 1e6 as well as 1000000.
pub fn count(text: &str) -> Result<usize, String> {
    let plain = text.replace('_', "");
    let scientific = || plain.parse::<f64>().ok().filter(|n| n.fract() == 0.0 && (0.0..9e15).contains(n));
    plain
        .parse()
        .ok()
        .or_else(|| scientific().map(|n| n as usize))
        .ok_or_else(|| "it is no whole number".to_owned())
}

/// The plane or space.
#[derive(Clone, Copy, Debug, Args)]
pub struct DimArgs {
    /// Dimension: 2 takes x and y, 3 takes z too.
    #[arg(long, value_name = "DIM", default_value_t = 2, value_parser = clap::value_parser!(u8).range(2..=3))]
    pub(crate) dim: u8,
}

impl DimArgs {
    pub fn is_space(self) -> bool {
        self.dim == 3
    }
}

#[cfg(test)]
mod tests {
    use clap::Parser;

    use super::{Cli, Command};

    /// Numbers whose nearest double is not found by a few digits: halves between two doubles and beside these, subnormal numbers.
    const HARD: [(&str, f64); 6] = [
        ("9007199254740993", 9_007_199_254_740_992.0),
        (
            "9007199254740993.0000000000000000000000000000000000000000000000000000000000000001",
            9_007_199_254_740_994.0,
        ),
        ("0.98456000000000010001", 0.984_560_000_000_000_1),
        ("2.4703282292062327208e-324", 0.0),
        ("2.5e-324", 5e-324),
        ("1.79769313486231580793728971405303415e308", f64::MAX),
    ];

    #[test]
    fn options_are_the_nearest_doubles() {
        for (text, nearest) in HARD {
            let line = format!("delone window f -o m.ply --box {text},-{text},{text},0");
            let Ok(Cli { command: Command::Window(args), .. }) = Cli::try_parse_from(line.split(' ')) else {
                panic!("{line}");
            };
            let expected = [nearest, -nearest, nearest, 0.0].map(f64::to_bits);
            assert_eq!(args.box_.iter().map(|x| x.to_bits()).collect::<Vec<_>>(), expected, "{text}");
            let line = format!("delone triangulate p -o m.ply --max-edge {text}");
            let Ok(Cli { command: Command::Triangulate(args), .. }) = Cli::try_parse_from(line.split(' '))
            else {
                panic!("{line}");
            };
            assert_eq!(args.max_edge.map(f64::to_bits), Some(nearest.to_bits()), "{text}");
            let line = format!("delone contours p -o l.geojson --levels {text},-{text}");
            let Ok(Cli { command: Command::Contours(args), .. }) = Cli::try_parse_from(line.split(' '))
            else {
                panic!("{line}");
            };
            let expected = [nearest, -nearest].map(f64::to_bits);
            assert_eq!(args.levels.iter().map(|x| x.to_bits()).collect::<Vec<_>>(), expected, "{text}");
        }
    }
}
