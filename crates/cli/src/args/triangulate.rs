//! Arguments of `triangulate`, and names of algorithms.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use delone_io::{Border, Contents, Format};

use super::formats;
use super::{DimArgs, DuplicatesName, GraphArgs, InputArgs, StrategyArgs, WeightArgs, WktArgs, length};

/// Triangulate points.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  delone triangulate points.csv -o mesh.ply -o picture.png
  delone triangulate tile.laz --class ground --max-edge 50 -o terrain.ply -o terrain.png
  delone triangulate north.laz south.laz -o both.ply
  delone triangulate points.npy -o triangles.npy --check --stats stats.json
  delone triangulate points.npy --fingerprint
  delone triangulate points.npy -o triangles.npy --algorithm incremental --locate hierarchy --ratio 8 --stats stats.json
  delone generate uniform -n 1000 -o - --to csv | delone triangulate - --from csv -o - --to ele
  delone triangulate model.ply --dim 3 -o tetrahedra.npy -o grid.vtu -o hull.stl -o picture.png
  delone triangulate measured.npy --hints nominal.npy -o triangles.npy --stats stats.json
  delone triangulate run-*.npy --hints nominal.npy -o 'mesh-{}.npy'
  delone triangulate lakes.geojson -o lakes.ply -o lakes.png
  delone triangulate plan.poly --fill all --crossings split -o plan.1.node -o plan.1.ele -o plan.svg
  delone triangulate survey.laz --segments breaklines.csv -o terrain.ply
  delone triangulate spheres.csv --columns x,y,z --radii r --dim 3 -o tetrahedra.npy
  delone triangulate points.npy --weights weights.npy -o triangles.npy

x and y are triangulated; heights are kept. Segments of poly, geojson, fgb, gpkg, wkt and wkb files and of --segments are edges of
the triangulation, and what is inside is written, as --fill says. With --dim 3 npy, ele, vtu, msh and inp hold tetrahedra (the first three corners are
seen counter-clockwise from the fourth), ply, obj, stl and pictures their hull. Indices are those of the input points,
from 0.
Exit status: 0 done, 1 bad data or failed work, 2 wrong usage.")]
pub(crate) struct TriangulateArgs {
    #[command(flatten)]
    pub(crate) input: InputArgs,
    /// Output files.
    #[arg(
        long, short, value_name = "OUT", required_unless_present = "fingerprint",
        help = format!(
            "Output file ({}), or - for standard output; may be repeated. For several instances {{}} stands for the name of each",
            formats::written(&[Contents::Triangles])
        )
    )]
    pub(crate) output: Vec<PathBuf>,
    /// Format of outputs whose extension does not tell.
    #[arg(long, value_name = "FORMAT")]
    pub(crate) to: Option<Format>,
    #[command(flatten)]
    pub(crate) wkt: WktArgs,
    #[command(flatten)]
    pub(crate) dim: DimArgs,
    /// In the plane, which height a place has at which there are several points.
    #[arg(long, value_name = "RULE", default_value = "lowest")]
    pub(crate) duplicates: DuplicatesName,
    /// Algorithm; the result is the same [default: divide-conquer in the plane, incremental in space].
    #[arg(long, value_name = "NAME")]
    pub(crate) algorithm: Option<AlgorithmName>,
    /// File of approximate positions, row by row those of the points: they are preprocessed, and the points located from
    /// their hints. In the plane many points are divided and conquered instead where there are several threads, without --stats.
    #[arg(long, value_name = "CENTRES", conflicts_with_all = ["algorithm", "locate"])]
    pub(crate) hints: Option<PathBuf>,
    /// The order in which --hints inserts points [default: spatial].
    #[arg(long, value_name = "ORDER")]
    pub(crate) hint_order: Option<HintOrderName>,
    /// In the plane, leave out triangles with an edge longer than this, from the hull inwards: what bridges bays and
    /// gaps at the border of the data.
    #[arg(long, value_name = "LENGTH", value_parser = length)]
    pub(crate) max_edge: Option<f64>,
    /// In the plane, leave out triangles whose height over their longest edge is less than this part of it, from the hull inwards: such
    /// as rounding makes along straight borders. 1e-9 takes these alone. Segments stay edges.
    #[arg(long, value_name = "RATIO", value_parser = super::ratio)]
    pub(crate) drop_slivers: Option<f64>,
    /// Print the fingerprint of the set of triangles: a number that depends on the coordinates of their corners alone, as delone
    /// tiles and delone check FOLDER have it.
    #[arg(long)]
    pub(crate) fingerprint: bool,
    /// Prove the result with exact arithmetic before writing it.
    #[arg(long)]
    pub(crate) check: bool,
    #[command(flatten)]
    pub(crate) graph: GraphArgs,
    #[command(flatten)]
    pub(crate) weights: WeightArgs,
    #[command(flatten)]
    pub(crate) strategy: StrategyArgs,
}

impl TriangulateArgs {
    /// The rule for simplices that are left out along the border.
    pub(crate) fn border(&self) -> Border {
        Border::long_edges(self.max_edge).slivers(self.drop_slivers)
    }
}

/// Bulk algorithms.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum AlgorithmName {
    /// Divide and conquer in Morton order: the fastest, in the plane.
    DivideConquer,
    /// One by one in random order; --locate says how points are located.
    Incremental,
}

/// Orders in which the centers of imprecise points are inserted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum HintOrderName {
    /// Along a curve, in biased random rounds: the cache knows it.
    Spatial,
    /// At random, as in the analysis.
    Random,
}
