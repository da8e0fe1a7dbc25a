//! Arguments of commands that make, describe and judge points and meshes: `generate`, `info`, `check`.

use std::path::{Path, PathBuf};

use clap::Args;
use delone_io::{Contents, Format};

use super::formats;
use super::{DimArgs, InputArgs, WeightArgs, WktArgs, count, length};

/// Make points.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  delone generate uniform -n 1000000 --seed 1 -o points.npy
  delone generate ellipse2 -n 5000 -o points.csv
  delone generate disks -n 5000 -o centers.npy
  delone generate disks -n 5000 --noise 1 -o measured.npy
  delone generate koch -n 3000 -o koch.poly
  delone generate planar-subset -n 100000 -o graph.geojson
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
    /// Move each point at random, by this at most: an instance of the same set, row by row, as imprecise points have them.
    #[arg(long, value_name = "RADIUS", default_value_t = 0.0, value_parser = length, allow_negative_numbers = true)]
    pub(crate) noise: f64,
    /// Output files.
    #[arg(
        long, short, value_name = "OUT",
        help = format!(
            "Output file ({}; with segments {}), or - for standard output",
            formats::written(&[Contents::Points]), formats::written(&[Contents::Lines])
        )
    )]
    pub(crate) output: Option<PathBuf>,
    /// Format of the output, if its extension does not tell.
    #[arg(long, value_name = "FORMAT")]
    pub(crate) to: Option<Format>,
    #[command(flatten)]
    pub(crate) wkt: WktArgs,
    /// Write what was counted and timed, and on how many threads at most, to a JSON file.
    #[arg(long, value_name = "FILE")]
    pub(crate) stats: Option<PathBuf>,
}

/// Describe points.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  delone info tile.laz --class 2
  delone info plan.poly
  delone info tiles

Of a folder that delone tiles made it tells how far the tiles are, and what came out.")]
pub(crate) struct InfoArgs {
    #[command(flatten)]
    pub(crate) input: InputArgs,
    #[command(flatten)]
    pub(crate) dim: DimArgs,
}

impl InfoArgs {
    /// The folder of tiles that is to be described.
    pub(crate) fn folder(&self) -> Option<&Path> {
        match &self.input.input[..] {
            [one] if one.is_dir() => Some(one),
            _ => None,
        }
    }
}

/// Judge triangles.
#[derive(Debug, Args)]
#[command(
    override_usage = "delone check [OPTIONS] <IN>... <MESH>\n       delone check [OPTIONS] <FOLDER>",
    after_help = "Examples:
  delone check points.npy triangles.npy
  delone check points.node other.1.ele
  delone check points.npy tetrahedra.npy --dim 3
  delone check plan.poly other.1.ele
  delone check points.csv triangles.npy --segments segments.csv
  delone check sites.csv triangles.npy --weights w
  delone check tiles

The last file has the triangles (npy ele ply obj off msh) or tetrahedra (npy ele msh). Of a folder that delone tiles made all
tiles and seams are judged, and all files held to the hashes of what was written.
Of points with segments all triangles of the hull are judged: whether they are the constrained Delaunay triangulation; of points
with weights, whether they are a regular triangulation, and hidden points are hidden.

Exit status: 0 Delaunay (the answer says whether canonical too), 1 not Delaunay or bad data, 2 wrong usage."
)]
pub(crate) struct CheckArgs {
    #[command(flatten)]
    pub(crate) input: InputArgs,
    #[command(flatten)]
    pub(crate) dim: DimArgs,
    /// The last of the files.
    #[arg(skip)]
    pub(crate) mesh: PathBuf,
    /// Segments between the points.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["weights", "radii"], help = formats::segments())]
    pub(crate) segments: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) weights: WeightArgs,
}

impl CheckArgs {
    /// The folder of tiles that is to be judged; otherwise the last file is set apart, which has the triangles.
    pub(crate) fn folder(&mut self) -> Option<PathBuf> {
        let files = &mut self.input.input;
        if let [one] = &files[..]
            && one.is_dir()
        {
            return files.pop();
        }
        self.mesh = files.pop().unwrap_or_default();
        None
    }
}
