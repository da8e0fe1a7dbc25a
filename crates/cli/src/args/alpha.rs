//! Arguments of `alpha`.

use std::path::PathBuf;

use clap::Args;
use delone_io::Format;

use super::formats::{self, IN_SPACE, IN_THE_PLANE};
use super::shapes::CameraArgs;
use super::{DimArgs, InputArgs, WeightArgs, WktArgs};

/// Alpha shapes.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  delone alpha points.csv --radius 1.5 -o outline.geojson
  delone alpha points.csv --optimal -o outline.geojson -o shape.png
  delone alpha scan.ply --dim 3 --optimal 2 -o surface.stl
  delone alpha scan.ply --dim 3 --radius 0.02 --manifold -o surface.ply
  delone alpha atoms.csv --dim 3 --columns x,y,z --radii r --alpha 0 -o surface.ply
  delone alpha points.npy --dim 3 --filtration filtration.npz

A face of the Delaunay triangulation has a value: the squared radius from which on balls around its corners meet in it; with weights, squared
radii too, balls have the squared radius `alpha` plus weight, so that --alpha 0 is the shape of the given balls. Values are correctly
rounded. The shape is the triangles (in space the tetrahedra) of at most that value.
In the plane geojson, fgb, gpkg, wkt and poly hold its outline, polygons with holes; all other formats its triangles, with the part that each belongs
to. In space files hold its closed surface, counter-clockwise seen from outside; npy and csv indices of input points. Where parts of the shape
touch in a vertex or along an edge the surface is pinched there, which programs call not watertight, not a manifold: with --manifold sheets
that touch have vertices of their own, in ply, obj and vtu; whoever joins vertices at one place, as readers of stl have to, pinches it again.
--filtration writes all faces with their values, corners by index: npz has for each dimension an array of corners and one of values in
the same order (vertices, vertex_values, edges, edge_values, triangles, triangle_values, tetrahedra, tetrahedron_values), csv a
face a line, value first, in the order of the filtration: by value, dimension, corners.
Exit status: 0 done, 1 bad data or failed work, 2 wrong usage.")]
pub(crate) struct AlphaArgs {
    #[command(flatten)]
    pub(crate) input: InputArgs,
    /// The squared radius.
    #[arg(long, value_name = "A", allow_hyphen_values = true, conflicts_with_all = ["radius", "optimal"])]
    pub(crate) alpha: Option<f64>,
    /// The radius, which is squared, rounded once.
    #[arg(long, value_name = "R", conflicts_with = "optimal", value_parser = super::length)]
    pub(crate) radius: Option<f64>,
    /// The least squared radius at which the shape has every point and at most so many parts [default: 1].
    #[arg(long, value_name = "PARTS", num_args = 0..=1, default_missing_value = "1", value_parser = super::count)]
    pub(crate) optimal: Option<usize>,
    /// In space: give sheets of the surface that touch vertices of their own, so that every edge has two faces.
    #[arg(long)]
    pub(crate) manifold: bool,
    /// Output files.
    #[arg(
        long, short, value_name = "OUT",
        help = format!(
            "Output file (in the plane {}; in space {}), or - for standard output; may be repeated",
            formats::written(IN_THE_PLANE), formats::written(IN_SPACE)
        )
    )]
    pub(crate) output: Vec<PathBuf>,
    /// Format of outputs whose extension does not tell.
    #[arg(long, value_name = "FORMAT")]
    pub(crate) to: Option<Format>,
    #[command(flatten)]
    pub(crate) wkt: WktArgs,
    /// Write all faces with their values (npz csv).
    #[arg(long, value_name = "FILE")]
    pub(crate) filtration: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) dim: DimArgs,
    #[command(flatten)]
    pub(crate) weights: WeightArgs,
    #[command(flatten)]
    pub(crate) camera: CameraArgs,
}
