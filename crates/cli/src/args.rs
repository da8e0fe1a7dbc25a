//! What can be said on the command line.

use std::path::{Path, PathBuf};

use clap::{Args, Parser, Subcommand, ValueEnum};
use clap_complete::Shell;
use delone::{Hierarchy, JumpAndWalk, Locate, Walk};
use delone_io::picture::Camera;
use delone_io::{Format, LAS_CLASSES};

use crate::message::Failure;

/// Exact Delaunay triangulation: one point set, one triangulation.
#[derive(Debug, Parser)]
#[command(name = "delone", version, arg_required_else_help = true, propagate_version = true)]
pub(crate) struct Cli {
    /// No progress and no notes on standard error; errors still appear.
    #[arg(long, short, global = true)]
    pub(crate) quiet: bool,
    /// Threads at most [default: RAYON_NUM_THREADS, or as many as there are cores]. Results do not depend on it;
    /// the default constructions use them, in the plane and in space.
    #[arg(long, value_name = "N", global = true, value_parser = clap::value_parser!(u16).range(1..))]
    pub(crate) threads: Option<u16>,
    #[command(subcommand)]
    pub(crate) command: Command,
}

/// The commands.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Triangulate points.
    Triangulate(TriangulateArgs),
    /// Find the triangle that contains each of many points.
    Locate(LocateArgs),
    /// Find the vertices nearest to each of many points.
    Nearest(NearestArgs),
    /// The corners of the convex hull in the plane, or its facets in space.
    Hull(HullArgs),
    /// Find the vertex furthest from each of many points.
    Furthest(FurthestArgs),
    /// Voronoi cells, clipped, as polygons or as a picture.
    Voronoi(VoronoiArgs),
    /// Insert, remove, move and ask, as a text file says, one operation a line.
    Replay(ReplayArgs),
    /// Judge triangles from any program: Delaunay? canonical?
    Check(CheckArgs),
    /// Make a named set of points; the same seed gives the same bytes on every machine.
    Generate(GenerateArgs),
    /// Draw points, triangles and hull as SVG or PNG.
    Draw(DrawArgs),
    /// Show points in Brownian motion as a moving picture.
    Animate(AnimateArgs),
    /// Tell what is in a file of points: counts, bounds, duplicates, degeneracies.
    Info(InfoArgs),
    /// Shrink points on which algorithms disagree, and print them as a test.
    Reduce(ReduceArgs),
    /// Repeat the experiments of the papers, with the papers' figures beside.
    Experiment(ExperimentArgs),
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
pub(crate) struct InputArgs {
    /// Files of points, or - for standard input: csv xyz txt tsv pts npy npz bin node las laz e57 ply obj off stl
    /// vtk vtu pcd geojson, each also with .gz. Several files are one set.
    #[arg(value_name = "IN", required = true)]
    pub(crate) input: Vec<PathBuf>,
    /// Format of the input, if its extension does not tell.
    #[arg(long, value_name = "FORMAT")]
    pub(crate) from: Option<Format>,
    /// LAS classes to keep, by number or name (ground, building, water, ...), separated by commas.
    #[arg(long, value_name = "CLASS", value_delimiter = ',', value_parser = class)]
    pub(crate) class: Vec<u8>,
    /// Columns of text that are x, y and perhaps z: names or numbers from 1, separated by commas.
    #[arg(long, value_name = "COLUMN", value_delimiter = ',')]
    pub(crate) columns: Vec<String>,
    /// Write what was counted and timed to a JSON file.
    #[arg(long, value_name = "FILE")]
    pub(crate) stats: Option<PathBuf>,
}

impl InputArgs {
    /// The files that are read.
    pub(crate) fn paths(&self) -> Vec<&Path> {
        self.input.iter().map(PathBuf::as_path).collect()
    }

    /// The files that are read, and another one.
    pub(crate) fn paths_and<'a>(&'a self, other: &'a Path) -> Vec<&'a Path> {
        self.paths().into_iter().chain([other]).collect()
    }

    /// What messages call the set.
    pub(crate) fn label(&self) -> PathBuf {
        match &self.input[..] {
            [one] => one.clone(),
            [first, rest @ ..] => format!("{} and {} more", first.display(), rest.len()).into(),
            [] => PathBuf::new(),
        }
    }
}

/// A LAS class by its number or its name.
fn class(text: &str) -> Result<u8, String> {
    let named = LAS_CLASSES.iter().find(|(name, _)| text.eq_ignore_ascii_case(name)).map(|class| class.1);
    named.or_else(|| text.parse().ok()).ok_or_else(|| {
        let names: Vec<&str> = LAS_CLASSES.iter().map(|class| class.0).collect();
        format!("a class is a number up to 255 or one of {}", names.join(", "))
    })
}

/// A length in coordinate units.
fn length(text: &str) -> Result<f64, String> {
    text.parse().ok().filter(|x: &f64| *x >= 0.0).ok_or_else(|| "it is no length".to_owned())
}

/// A number of things, 1e6 as well as 1000000.
fn count(text: &str) -> Result<usize, String> {
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
pub(crate) struct DimArgs {
    /// Dimension: 2 takes x and y, 3 takes z too.
    #[arg(long, value_name = "DIM", default_value_t = 2, value_parser = clap::value_parser!(u8).range(2..=3))]
    pub(crate) dim: u8,
}

impl DimArgs {
    pub(crate) fn is_space(self) -> bool {
        self.dim == 3
    }
}

/// Triangulate points.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  delone triangulate points.csv -o mesh.ply -o picture.png
  delone triangulate tile.laz --class ground --max-edge 50 -o terrain.ply -o terrain.png
  delone triangulate north.laz south.laz -o both.ply
  delone triangulate points.npy -o triangles.npy --check --stats stats.json
  delone generate uniform -n 1000 -o - --to csv | delone triangulate - --from csv -o - --to ele
  delone triangulate model.ply --dim 3 -o tetrahedra.npy -o grid.vtu -o hull.stl -o picture.png
  delone triangulate measured.npy --hints nominal.npy -o triangles.npy --stats stats.json
  delone triangulate run-*.npy --hints nominal.npy -o 'mesh-{}.npy'

x and y are triangulated; heights are kept. With --dim 3 npy, ele and vtu hold tetrahedra (the first three corners are
seen counter-clockwise from the fourth), ply, obj, stl and pictures their hull. Indices are those of the input points,
from 0.
Exit status: 0 done, 1 bad data or failed work, 2 wrong usage.")]
pub(crate) struct TriangulateArgs {
    #[command(flatten)]
    pub(crate) input: InputArgs,
    /// Output file (npy node ele neigh edge ply obj stl vtu geojson svg png), or - for standard output; may be
    /// repeated. For several instances {} stands for the name of each.
    #[arg(long, short, value_name = "OUT", required = true)]
    pub(crate) output: Vec<PathBuf>,
    /// Format of outputs whose extension does not tell.
    #[arg(long, value_name = "FORMAT")]
    pub(crate) to: Option<Format>,
    #[command(flatten)]
    pub(crate) dim: DimArgs,
    /// Algorithm; the result is the same [default: divide-conquer in the plane, incremental in space].
    #[arg(long, value_name = "NAME")]
    pub(crate) algorithm: Option<AlgorithmName>,
    /// Point location of the incremental algorithm [default: spatial].
    #[arg(long, value_name = "NAME")]
    pub(crate) locate: Option<LocateName>,
    /// File of approximate positions, row by row those of the points: they are preprocessed, and the points located from
    /// their hints.
    #[arg(long, value_name = "CENTRES", conflicts_with_all = ["algorithm", "locate"])]
    pub(crate) hints: Option<PathBuf>,
    /// Seed of randomized algorithms; it changes their course, not their result.
    #[arg(long, value_name = "S", default_value_t = 0)]
    pub(crate) seed: u64,
    /// In the plane, leave out triangles with an edge longer than this, from the hull inwards: what bridges bays and
    /// gaps at the border of the data.
    #[arg(long, value_name = "LENGTH", value_parser = length)]
    pub(crate) max_edge: Option<f64>,
    /// Prove the result with exact arithmetic before writing it.
    #[arg(long)]
    pub(crate) check: bool,
}

/// Bulk algorithms.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum AlgorithmName {
    /// Divide and conquer in Morton order: the fastest, in the plane.
    DivideConquer,
    /// One by one in random order; --locate says how points are located.
    Incremental,
}

/// Point location strategies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum LocateName {
    /// A k-d tree of hints: the fastest for any set and any change.
    Tree,
    /// Walk from the vertex inserted last.
    Walk,
    /// Walk from the nearest of n^(1/3) random vertices.
    JumpAndWalk,
    /// Descend through triangulations of random samples (the Delaunay hierarchy).
    Hierarchy,
    /// Trace all triangles that ever were; no removal.
    History,
    /// Triangles keep lists of the points to come; bulk only.
    Conflict,
    /// Walk from the previous point in spatial order; bulk only.
    Spatial,
}

impl LocateName {
    /// The strategy of a triangulation that changes, if this is one.
    pub(crate) fn strategy(self, seed: u64) -> Option<Locate> {
        Some(match self {
            Self::Tree => Locate::Tree,
            Self::Walk => Locate::Walk(Walk::Visibility),
            Self::JumpAndWalk => Locate::JumpAndWalk(JumpAndWalk { seed, ..JumpAndWalk::default() }),
            Self::Hierarchy => Locate::Hierarchy(Hierarchy { seed, ..Hierarchy::default() }),
            Self::History => Locate::History,
            Self::Conflict | Self::Spatial => return None,
        })
    }
}

/// How queries are read and answers are written.
#[derive(Debug, Args)]
pub(crate) struct QueryArgs {
    /// File of points to ask for, in any format that points have.
    #[arg(long, value_name = "Q", required = true)]
    pub(crate) queries: PathBuf,
    /// Output file (npy: int64, or csv), or - for standard output.
    #[arg(long, short, value_name = "OUT", required = true)]
    pub(crate) output: PathBuf,
    /// Format of the output, if its extension does not tell.
    #[arg(long, value_name = "FORMAT")]
    pub(crate) to: Option<Format>,
    /// Point location; the answers are the same.
    #[arg(long, value_name = "NAME", default_value = "tree")]
    pub(crate) locate: LocateName,
    /// Seed of randomized strategies.
    #[arg(long, value_name = "S", default_value_t = 0)]
    pub(crate) seed: u64,
}

/// Locate points.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  delone locate points.npy --queries queries.npy -o triangles.npy
  delone locate points.csv --queries queries.csv -o - --to csv --locate hierarchy

Row i holds the vertices, counter-clockwise, of the triangle that contains query i; of one such triangle if the
query is on an edge or a vertex; -1 -1 -1 if it is outside of the convex hull. With --dim 3 likewise of a tetrahedron,
in positive order, with four columns.")]
pub(crate) struct LocateArgs {
    #[command(flatten)]
    pub(crate) input: InputArgs,
    #[command(flatten)]
    pub(crate) dim: DimArgs,
    #[command(flatten)]
    pub(crate) query: QueryArgs,
}

/// Find nearest vertices.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  delone nearest points.npy --queries queries.npy -o nearest.npy
  delone nearest points.csv --queries queries.csv -k 5 -o - --to csv

Row i holds the k vertices nearest to query i, nearest first, -1 where there are fewer. Of vertices at the same
distance the lexicographically smaller comes first.")]
pub(crate) struct NearestArgs {
    #[command(flatten)]
    pub(crate) input: InputArgs,
    #[command(flatten)]
    pub(crate) dim: DimArgs,
    #[command(flatten)]
    pub(crate) query: QueryArgs,
    /// How many vertices for each query.
    #[arg(short, value_name = "K", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) k: u32,
}

/// Convex hull.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  delone hull points.csv -o corners.npy
  delone hull points.csv -o - --to csv
  delone hull model.ply --dim 3 -o facets.npy -o hull.stl -o hull.png
  delone hull tile.laz --dim 3 --view 200,30 -o hull.svg

npy and csv hold indices of input points. In the plane: the corners, counter-clockwise from the lexicographically
smallest. In space: a facet a row, counter-clockwise seen from outside; flat faces are cut into triangles. No corner is
on the line of its neighbours or inside of a face, and of equal points the first is taken. Mesh files hold the corners
of the hull alone; pictures show flat faces whole.")]
pub(crate) struct HullArgs {
    #[command(flatten)]
    pub(crate) input: InputArgs,
    /// Output file (npy csv; in space also ply obj stl vtu svg png), or - for standard output; may be repeated.
    #[arg(long, short, value_name = "OUT", required = true)]
    pub(crate) output: Vec<PathBuf>,
    /// Format of outputs whose extension does not tell.
    #[arg(long, value_name = "FORMAT")]
    pub(crate) to: Option<Format>,
    #[command(flatten)]
    pub(crate) dim: DimArgs,
    /// Algorithm in space; the hull is the same.
    #[arg(long, value_name = "NAME", default_value = "quickhull")]
    pub(crate) algorithm: HullAlgorithm,
    /// Seed of the random order of `history`.
    #[arg(long, value_name = "S", default_value_t = 0)]
    pub(crate) seed: u64,
    #[command(flatten)]
    pub(crate) camera: CameraArgs,
}

/// Algorithms for hulls in space.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum HullAlgorithm {
    /// The furthest points first (Barber, Dobkin & Huhdanpaa 1996).
    Quickhull,
    /// Random order, located by history (Guibas, Knuth & Sharir 1992, §4.1).
    History,
}

/// Where a picture in space is seen from.
#[derive(Debug, Args)]
pub(crate) struct CameraArgs {
    /// Where pictures are seen from, in degrees: around from the x axis, and up.
    #[arg(
        long,
        value_name = "AROUND,UP",
        value_delimiter = ',',
        num_args = 1,
        allow_hyphen_values = true,
        default_value = "-60,25"
    )]
    view: Vec<f64>,
    /// The longer side of pictures in pixels.
    #[arg(long, value_name = "PIXELS", default_value_t = 1600, value_parser = clap::value_parser!(u32).range(16..=20_000))]
    pub(crate) size: u32,
}

impl CameraArgs {
    pub(crate) fn camera(&self) -> Result<Camera, Failure> {
        match self.view[..] {
            [azimuth, elevation] if azimuth.is_finite() && (-90.0..=90.0).contains(&elevation) => {
                Ok(Camera { azimuth, elevation, wireframe: false })
            }
            _ => Err(Failure::usage(
                "--view takes two angles, the second from -90 to 90",
                "as in --view 200,30: from the direction 200 degrees around, 30 degrees up",
            )),
        }
    }
}

/// Find furthest vertices.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  delone furthest points.npy --queries queries.npy -o furthest.npy
  delone furthest points.csv --queries queries.csv -o - --to csv --stats circle.json

Of vertices at the same distance the lexicographically smallest is taken; -1 where there is none. The statistics hold
the smallest circle around all points.")]
pub(crate) struct FurthestArgs {
    #[command(flatten)]
    pub(crate) input: InputArgs,
    /// File of points to ask for, in any format that points have.
    #[arg(long, value_name = "Q", required = true)]
    pub(crate) queries: PathBuf,
    /// Output file (npy: int64, or csv), or - for standard output.
    #[arg(long, short, value_name = "OUT", required = true)]
    pub(crate) output: PathBuf,
    /// Format of the output, if its extension does not tell.
    #[arg(long, value_name = "FORMAT")]
    pub(crate) to: Option<Format>,
}

/// Voronoi cells.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  delone voronoi shops.csv -o cells.geojson -o cells.png
  delone voronoi shops.csv --clip border.geojson -o cells.geojson
  delone generate uniform -n 500 -o - --to csv | delone voronoi - --from csv --box 0,0,1,1 --relax 30 -o even.svg

GeoJSON has a feature for each site with the properties `site`, the index of the input point, and `area`, null if it is
beyond the range of numbers; a cell outside of the clip region has no geometry. Of equal points the first is the site.")]
pub(crate) struct VoronoiArgs {
    #[command(flatten)]
    pub(crate) input: InputArgs,
    /// Output file (geojson svg png), or - for standard output; may be repeated.
    #[arg(long, short, value_name = "OUT", required = true)]
    pub(crate) output: Vec<PathBuf>,
    /// Format of outputs whose extension does not tell.
    #[arg(long, value_name = "FORMAT")]
    pub(crate) to: Option<Format>,
    /// What to clip to: `box`, `hull` (the convex hull of the sites), or a file with polygons (geojson) or with the
    /// corners of one polygon (any format of points).
    #[arg(long, value_name = "REGION", default_value = "box")]
    pub(crate) clip: PathBuf,
    /// The box to clip to [default: the bounding box of the sites].
    #[arg(long = "box", value_name = "X0,Y0,X1,Y1", value_delimiter = ',', allow_hyphen_values = true)]
    pub(crate) bounds: Vec<f64>,
    /// Move sites to the centroids of their cells, at most so many times (Lloyd relaxation).
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub(crate) relax: usize,
    /// Stop relaxing when no site moves further than this, in coordinate units.
    #[arg(long, value_name = "DISTANCE", default_value_t = 0.0)]
    pub(crate) tolerance: f64,
    /// Write the sites, as relaxed, to a file of points.
    #[arg(long, value_name = "FILE")]
    pub(crate) sites: Option<PathBuf>,
    /// The longer side of pictures in pixels.
    #[arg(long, value_name = "PIXELS", default_value_t = 1600, value_parser = clap::value_parser!(u32).range(16..=20_000))]
    pub(crate) size: u32,
}

/// Replay operations.
#[derive(Debug, Args)]
#[command(after_help = "Operations, one a line; # starts a comment:
  + X Y      insert; answers '+ ID', or '= ID' if that vertex has the same coordinates
  - ID       remove
  > ID X Y   move
  ? X Y      locate; answers '? triangle A B C', '? edge A B', '? vertex A', '? outside A B' (a hull edge that
             the point is beyond) or '? nowhere' (there is no triangle, and the point is on no edge)
  @ X Y      nearest vertex; answers '@ ID' or '@ none'
With --dim 3 points have three coordinates, and '?' answers 'tetrahedron A B C D', 'facet A B C', 'edge A B',
'vertex A', 'outside A B C' or 'nowhere'.
Ids count up from 0 and are never used again.

Examples:
  delone replay bug.txt -o triangles.npy --check
  printf '+ 0 0\\n+ 1 0\\n+ 0 1\\n? .2 .2\\n' | delone replay - -o picture.svg")]
pub(crate) struct ReplayArgs {
    /// File of operations, or - for standard input.
    #[arg(value_name = "OPS")]
    pub(crate) operations: PathBuf,
    #[command(flatten)]
    pub(crate) dim: DimArgs,
    /// Output file for the triangles at the end, in any format that meshes have; may be repeated.
    #[arg(long, short, value_name = "OUT", required = true)]
    pub(crate) output: Vec<PathBuf>,
    /// Format of outputs whose extension does not tell.
    #[arg(long, value_name = "FORMAT")]
    pub(crate) to: Option<Format>,
    /// Point location; the answers are the same.
    #[arg(long, value_name = "NAME", default_value = "tree")]
    pub(crate) locate: LocateName,
    /// Seed of randomized strategies.
    #[arg(long, value_name = "S", default_value_t = 0)]
    pub(crate) seed: u64,
    /// Prove the triangulation with exact arithmetic after every operation up to 1,000 vertices, after every
    /// thousandth beyond, and at the end.
    #[arg(long)]
    pub(crate) check: bool,
    /// Write what was counted and timed to a JSON file.
    #[arg(long, value_name = "FILE")]
    pub(crate) stats: Option<PathBuf>,
}

/// Repeat experiments.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  delone experiment hierarchy --largest 50000
  delone experiment jump-and-walk -o results
  delone experiment history -o results
  delone experiment radial --largest 1000000
  delone experiment imprecise --largest 10000000 -o results
  delone experiment scan model.ply
  delone experiment growth --largest 10000000 -o results

A table goes to standard output; with -o, tables as CSV and plots as SVG go into that folder. Times are
seconds on this machine and differ from run to run; counts depend on the seed alone.")]
pub(crate) struct ExperimentArgs {
    /// Which experiment.
    #[arg(value_name = "NAME")]
    pub(crate) name: ExperimentName,
    /// File of points in space, for scan.
    #[arg(value_name = "MODEL")]
    pub(crate) model: Option<PathBuf>,
    /// Folder for tables and plots.
    #[arg(long, short, value_name = "FOLDER")]
    pub(crate) output: Option<PathBuf>,
    /// The largest set.
    #[arg(long, value_name = "N", default_value = "500000", value_parser = count)]
    pub(crate) largest: usize,
    /// Seed of points and orders.
    #[arg(long, value_name = "S", default_value_t = 1)]
    pub(crate) seed: u64,
    /// Write what was counted and timed to a JSON file.
    #[arg(long, value_name = "FILE")]
    pub(crate) stats: Option<PathBuf>,
}

/// Experiments by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum ExperimentName {
    /// Build five kinds of sets with the Delaunay hierarchy and its simpler modes (Devillers 1998, §5.5.2).
    Hierarchy,
    /// Triangles visited by jump-and-walk, and its cost against the sample size (Devroye, Mücke & Zhu 1998).
    JumpAndWalk,
    /// What ever appears in randomized incremental construction, and what locating costs (Guibas, Knuth & Sharir
    /// 1992, §2 and §3).
    History,
    /// Nearest sites by the history of radial triangles: its size, the work of a query, and its time beside other
    /// ways (the same, §5).
    Radial,
    /// Triangulate instances of imprecise points by hints, in the plane and in space (Devillers 2011, §5).
    Imprecise,
    /// Follow points in Brownian motion by the hints of the last step (the same), and automatically.
    Brownian,
    /// Add noise to the points of a scanned model, and triangulate by hints (the same).
    Scan,
    /// Time of a construction by the number of points, in the plane on one thread and on all, and in space.
    Growth,
}

/// Judge triangles.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  delone check points.npy triangles.npy
  delone check points.node other.1.ele
  delone check points.npy tetrahedra.npy --dim 3

Exit status: 0 Delaunay (the answer says whether canonical too), 1 not Delaunay or bad data, 2 wrong usage.")]
pub(crate) struct CheckArgs {
    #[command(flatten)]
    pub(crate) input: InputArgs,
    #[command(flatten)]
    pub(crate) dim: DimArgs,
    /// File of triangles (npy ele ply obj) or of tetrahedra (npy ele).
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
    /// Number of points, as in 5000 or 1e6.
    #[arg(short, value_name = "N", default_value = "1000", value_parser = count)]
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
  delone draw model.ply --dim 3 --view 200,30 --cut 1,0,0,0.5 -o inside.png
  delone draw centres.csv --disks 1 --hints -o imprecise.svg

What is drawn follows from the room there is; --edges, --points and --fill decide otherwise. With --dim 3 the hull is
drawn, or what a cut leaves of the tetrahedra.")]
pub(crate) struct DrawArgs {
    #[command(flatten)]
    pub(crate) input: InputArgs,
    /// Picture: svg or png, or - for standard output; may be repeated.
    #[arg(long, short, value_name = "OUT", required = true)]
    pub(crate) output: Vec<PathBuf>,
    /// Format of outputs whose extension does not tell.
    #[arg(long, value_name = "FORMAT")]
    pub(crate) to: Option<Format>,
    #[command(flatten)]
    pub(crate) dim: DimArgs,
    #[command(flatten)]
    pub(crate) camera: CameraArgs,
    /// In space, take away the tetrahedra whose middle is beyond the plane A x + B y + C z = D.
    #[arg(long, value_name = "A,B,C,D", value_delimiter = ',', num_args = 1, allow_hyphen_values = true)]
    pub(crate) cut: Vec<f64>,
    /// In space, draw edges alone, those behind too.
    #[arg(long)]
    pub(crate) wireframe: bool,
    /// Draw edges.
    #[arg(long, value_name = "YES", require_equals = true, num_args = 0..=1, default_missing_value = "yes")]
    pub(crate) edges: Option<Choice>,
    /// Draw vertices.
    #[arg(long, value_name = "YES", require_equals = true, num_args = 0..=1, default_missing_value = "yes")]
    pub(crate) points: Option<Choice>,
    /// Fill triangles by height or density.
    #[arg(long, value_name = "YES", require_equals = true, num_args = 0..=1, default_missing_value = "yes")]
    pub(crate) fill: Option<Choice>,
    /// In the plane, leave out triangles with an edge longer than this, from the hull inwards.
    #[arg(long, value_name = "LENGTH", value_parser = length)]
    pub(crate) max_edge: Option<f64>,
    /// In the plane, draw a disk of this radius around each point: how imprecise it is.
    #[arg(long, value_name = "RADIUS")]
    pub(crate) disks: Option<f64>,
    /// In the plane, join each point to its hint: the nearest of those before it in a random order.
    #[arg(long)]
    pub(crate) hints: bool,
    /// Seed of the random order of --hints.
    #[arg(long, value_name = "S", default_value_t = 0)]
    pub(crate) seed: u64,
}

/// Show a motion.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  delone animate points.csv -o motion.png
  delone generate disks -n 300 -o - --to csv | delone animate - --from csv --radius 1 --steps 100 -o motion.png
  delone animate points.csv -o 'frame-{}.svg'

Every step moves each point at random inside of a disk around it; the triangulation is repaired, or rebuilt where that is
faster, and the statistics tell how often. The output is one animated PNG, or a file for each step.")]
pub(crate) struct AnimateArgs {
    #[command(flatten)]
    pub(crate) input: InputArgs,
    /// Animated picture: png; or, with {} where the number of the step shall stand, a series of png or svg.
    #[arg(long, short, value_name = "OUT", required = true)]
    pub(crate) output: PathBuf,
    /// Format of an output whose extension does not tell.
    #[arg(long, value_name = "FORMAT")]
    pub(crate) to: Option<Format>,
    /// Number of steps.
    #[arg(long, value_name = "N", default_value_t = 60, value_parser = clap::value_parser!(u32).range(..10_000))]
    pub(crate) steps: u32,
    /// How far a point goes in a step at most [default: a fifth of the distance of neighbours in an even set].
    #[arg(long, value_name = "RADIUS")]
    pub(crate) radius: Option<f64>,
    /// Milliseconds a picture is shown.
    #[arg(long, value_name = "MS", default_value_t = 40)]
    pub(crate) delay: u16,
    /// The longer side in pixels.
    #[arg(long, value_name = "PIXELS", default_value_t = 600, value_parser = clap::value_parser!(u32).range(16..=20_000))]
    pub(crate) size: u32,
    /// Seed of the motion.
    #[arg(long, value_name = "S", default_value_t = 0)]
    pub(crate) seed: u64,
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
    #[command(flatten)]
    pub(crate) dim: DimArgs,
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
