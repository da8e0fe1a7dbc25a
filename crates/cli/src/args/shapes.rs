//! Arguments of commands that make shapes and pictures: `hull`, `voronoi`, `draw`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use delone::MERGE_AUTO;
use delone_io::Cut;
use delone_io::picture::Camera;
use delone_io::{Contents, Format};

use super::formats;
use super::{AntimeridianName, DimArgs, GraphArgs, InputArgs, PeriodicArgs, WeightArgs, WktArgs, length};
use crate::message::Failure;

/// Convex hull.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  delone hull points.csv -o corners.npy
  delone hull points.csv -o - --to csv
  delone hull model.ply --dim 3 -o facets.npy -o hull.stl -o hull.png
  delone hull tile.laz --dim 3 --view 200,30 -o hull.svg
  delone hull turned-part.stl --dim 3 --merge auto -o hull.obj

npy and csv hold indices of input points. In the plane: the corners, counter-clockwise from the lexicographically
smallest. In space: a facet a row, counter-clockwise seen from outside; flat faces are cut into triangles. No corner is
on the line of its neighbors or inside of a face, and of equal points the first is taken. Mesh files hold the corners
of the hull alone; pictures show flat faces whole.")]
pub(crate) struct HullArgs {
    #[command(flatten)]
    pub(crate) input: InputArgs,
    /// Output files.
    #[arg(
        long, short, value_name = "OUT", required = true,
        help = format!(
            "Output file ({}; in space also {}), or - for standard output; may be repeated",
            formats::written(&[Contents::Indices]), formats::written(&[Contents::Surfaces])
        )
    )]
    pub(crate) output: Vec<PathBuf>,
    /// Format of outputs whose extension does not tell.
    #[arg(long, value_name = "FORMAT")]
    pub(crate) to: Option<Format>,
    #[command(flatten)]
    pub(crate) dim: DimArgs,
    /// Algorithm in space; the hull is the same [default: quickhull].
    #[arg(long, value_name = "NAME")]
    pub(crate) algorithm: Option<HullAlgorithm>,
    /// Seed of the random order of `history` and `flips` [default: 0].
    #[arg(long, value_name = "S")]
    pub(crate) seed: Option<u64>,
    /// Leave out corners within this distance of the hull of the others, in coordinate units, and join faces in one plane within it: those that
    /// rounding has made. `auto` is 2^-40 of the largest coordinate.
    #[arg(long, value_name = "LENGTH|auto", value_parser = Merge::parse, allow_negative_numbers = true)]
    pub(crate) merge: Option<Merge>,
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
    /// Random order, edges flipped one by one (the same).
    Flips,
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

/// The part of a picture in space that is taken away.
#[derive(Debug, Args)]
pub(crate) struct CutArgs {
    /// In space, take away the tetrahedra, or in pictures the cells, whose middle is beyond the plane A x + B y + C z = D.
    #[arg(long, value_name = "A,B,C,D", value_delimiter = ',', num_args = 1, allow_hyphen_values = true)]
    cut: Vec<f64>,
}

impl CutArgs {
    pub(crate) fn is_given(&self) -> bool {
        !self.cut.is_empty()
    }

    pub(crate) fn cut(&self) -> Result<Option<Cut>, Failure> {
        match self.cut[..] {
            [] => Ok(None),
            [a, b, c, offset] if self.cut.iter().all(|x| x.is_finite()) => {
                Ok(Some(Cut { normal: [a, b, c], offset }))
            }
            _ => Err(Failure::usage(
                "--cut takes four numbers",
                "as in --cut 1,0,0,0.5: what has x above 0.5 is taken away",
            )),
        }
    }
}

/// Voronoi cells.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  delone voronoi shops.csv -o cells.geojson -o cells.png
  delone voronoi shops.csv --clip border.geojson -o cells.geojson
  delone voronoi shops.csv -o cells.csv -o cells.wkt -o cells.wkb
  delone generate uniform -n 500 -o - --to csv | delone voronoi - --from csv --box 0,0,1,1 --relax 30 -o even.svg
  delone voronoi shops.csv --order 3 -o three-nearest.geojson
  delone voronoi roads.geojson --of lines --tolerance 1 -o nearest-road.geojson
  delone voronoi rivers.geojson --medial-axis --tolerance 5 -o middle.gpkg
  delone voronoi shops.csv --areas customers -o districts.geojson
  delone voronoi grains.csv --dim 3 --radii r -o cells.vtu -o cells.json
  delone voronoi atoms.csv --dim 3 --periodic 20,20,20 --grid auto -o volumes.csv
  delone voronoi hcp.extxyz --dim 3 --periodic --min-relative-area 1e-6 -o neighbors.csv
  delone voronoi disks.csv --periodic 40,30 --radii r -o cells.geojson -o cells.svg
  delone voronoi slab.csv --dim 3 --periodic 20,20,35 --axes xy --origin 0,0,-5 -o cells.vtu
  delone voronoi dump.lammpstrj --dim 3 --periodic --radii radius -o cells.vtu
  delone voronoi foam.csv --dim 3 --cut 1,0,0,0.5 --view 30,25 -o inside.png

GeoJSON has a feature for each site with the properties `site`, the index of the input point, and `area`, null if it is
beyond the range of numbers; a cell outside of the clip region has no geometry. Of equal points the first is the site. With --order it has a feature
for each set of sites that are nearest somewhere, `sites` for `site`. CSV has the same in the columns `site,area,wkt`: GIS find the geometry by
the name `wkt`; several sites are apart by spaces. Well-known text and binary hold the geometries alone, empty ones too.
In space csv and npy have a row for each input point: volume, area and the three coordinates of the centroid, in csv after `site`; and the number of neighbors with --min-area. json has an object
for each input point, with `vertices` and `faces`: the corners of each, `neighbor` (null for the wall of a box, `wall` from 0: low x, high x,
low y, ..., or those of the axes), `area`, and with --periodic `offset`, how many axes of the box away the neighbor is. vtu has polyhedra with the arrays `site`, `volume` and `area`;
ply and obj have polygons, those between two cells once for each of the two, in ply with `site` and `neighbor`, in obj an object for
each cell. svg and png are pictures, with --cut of what is left. Cells of a box that repeats are around the points as these were given.")]
pub(crate) struct VoronoiArgs {
    #[command(flatten)]
    pub(crate) input: InputArgs,
    /// Output files.
    #[arg(long, short, value_name = "OUT", required = true, help = formats::cells())]
    pub(crate) output: Vec<PathBuf>,
    /// Format of outputs whose extension does not tell.
    #[arg(long, value_name = "FORMAT")]
    pub(crate) to: Option<Format>,
    #[command(flatten)]
    pub(crate) dim: DimArgs,
    #[command(flatten)]
    pub(crate) wkt: WktArgs,
    /// The region to clip to: `box`, `hull` (the convex hull of the sites), or in the plane a file with polygons (geojson) or with
    /// the corners of one polygon (any format of points).
    #[arg(long, value_name = "REGION", default_value = "box")]
    pub(crate) clip: PathBuf,
    /// The box to clip to, in space of six numbers X0,Y0,Z0,X1,Y1,Z1 [default: the bounding box of the sites].
    #[arg(long = "box", value_name = "X0,Y0,X1,Y1", value_delimiter = ',', allow_hyphen_values = true)]
    pub(crate) bounds: Vec<f64>,
    /// Contract sides of cells up to this length, in coordinate units: corners become one that rounding has parted. `auto` is 2^-40 of the
    /// largest coordinate.
    #[arg(long, value_name = "LENGTH|auto", value_parser = Merge::parse, allow_negative_numbers = true)]
    pub(crate) merge: Option<Merge>,
    /// Treatment of polygons to clip to, of longitude and latitude, that cross the meridian of 180 degrees or hold a pole [default: keep].
    #[arg(long, value_name = "HOW")]
    pub(crate) antimeridian: Option<AntimeridianName>,
    /// Sites at most this far apart become one, before the cells are made.
    #[arg(long, value_name = "DISTANCE", value_parser = length, allow_negative_numbers = true)]
    pub(crate) weld: Option<f64>,
    /// The sites: points, lines (each feature, which may be a polygon for its border), or areas (polygons; what is inside of one is its own). The cell of a line is where it is the nearest one.
    #[arg(long, value_name = "WHAT", default_value = "points")]
    pub(crate) of: OfName,
    /// Instead of cells the medial axis of polygons: edges in their middle, with `width`, as GeoJSON, FlatGeobuf, GeoPackage, text or npy. Both sides of the border are seen under at least so many degrees, which leaves corners out that are nearly straight.
    #[arg(long, value_name = "DEGREES", num_args = 0..=1, require_equals = true, default_missing_value = "60", conflicts_with_all = ["of", "clip", "bounds", "sites"])]
    pub(crate) medial_axis: Option<f64>,
    /// Where which K sites are the nearest: the diagram of order K, at most the number of sites.
    #[arg(long, value_name = "K", conflicts_with_all = ["relax", "tolerance", "weights", "radii"])]
    pub(crate) order: Option<usize>,
    /// Move sites to the centroids of their cells, at most so many times (Lloyd relaxation).
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub(crate) relax: usize,
    /// Stop relaxing when no site moves further than this, in coordinate units. With --of lines, --of areas and --medial-axis the largest distance
    /// of a border from the exact one; 0 is a thousandth of the diagonal of the region.
    #[arg(long, value_name = "DISTANCE", default_value_t = 0.0)]
    pub(crate) tolerance: f64,
    /// Write the sites, as relaxed, to a file of points.
    #[arg(long, value_name = "FILE")]
    pub(crate) sites: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) weights: WeightArgs,
    /// Weights for which the cells have these areas, in proportion: `equal`, or a file with one for each site, or a column of the
    /// text input by name or number from 1.
    #[arg(long, value_name = "equal|FILE|COLUMN", conflicts_with_all = ["weights", "radii", "order"], help_heading = "Weights")]
    pub(crate) areas: Option<String>,
    #[command(flatten)]
    pub(crate) space: PeriodicArgs,
    #[command(flatten)]
    pub(crate) camera: CameraArgs,
    #[command(flatten)]
    pub(crate) cut: CutArgs,
}

/// The sites of a diagram.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum OfName {
    Points,
    Lines,
    Areas,
}

/// The length up to which sides are contracted.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Merge {
    /// That of rounding.
    Auto,
    /// In coordinate units.
    Length(f64),
}

impl Merge {
    /// The length, if these are the coordinates.
    pub(crate) fn of(self, coordinates: impl Iterator<Item = f64>) -> f64 {
        match self {
            Self::Auto => MERGE_AUTO * coordinates.fold(0.0_f64, |largest, x| largest.max(x.abs())),
            Self::Length(length) => length,
        }
    }

    fn parse(text: &str) -> Result<Self, String> {
        if text == "auto" {
            return Ok(Self::Auto);
        }
        length(text).map(Self::Length).map_err(|_| "a length, or `auto`, is expected".to_owned())
    }
}

/// Draw points.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  delone draw points.csv -o picture.svg
  delone draw tile.laz --class 2 -o relief.png --size 3000 --edges=no
  delone draw model.ply --dim 3 --view 200,30 --cut 1,0,0,0.5 -o inside.png
  delone draw centers.csv --disks 1 --hints -o imprecise.svg
  delone draw centers.csv --disks 0.5 --certain -o certain.svg
  delone draw plan.poly --crossings split -o plan.svg

What is drawn follows from the room there is; --edges, --points and --colors decide otherwise. Segments are heavier
lines, regions have colors, which the legend tells, and what is outside is faint. Longitude and latitude have the shape of the ground
at their middle. Of a million points png is smaller than svg. With --dim 3 the hull is drawn, or what a cut leaves of the
tetrahedra.")]
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
    #[command(flatten)]
    pub(crate) cut: CutArgs,
    /// In space, draw edges alone, those behind too.
    #[arg(long)]
    pub(crate) wireframe: bool,
    /// Draw edges.
    #[arg(long, value_name = "YES", require_equals = true, num_args = 0..=1, default_missing_value = "yes")]
    pub(crate) edges: Option<Choice>,
    /// Draw vertices.
    #[arg(long, value_name = "YES", require_equals = true, num_args = 0..=1, default_missing_value = "yes")]
    pub(crate) points: Option<Choice>,
    /// Color triangles by region, height or density.
    #[arg(long, value_name = "YES", require_equals = true, num_args = 0..=1, default_missing_value = "yes")]
    pub(crate) colors: Option<Choice>,
    /// In the plane, leave out triangles with an edge longer than this, from the hull inwards.
    #[arg(long, value_name = "LENGTH", value_parser = length)]
    pub(crate) max_edge: Option<f64>,
    /// In the plane, draw a disk of this radius around each point: how imprecise it is.
    #[arg(long, value_name = "RADIUS")]
    pub(crate) disks: Option<f64>,
    /// In the plane, join each point to its hint: the nearest of those before it in a random order.
    #[arg(long)]
    pub(crate) hints: bool,
    /// Instead of the edges of the points those of points anywhere in the disks: strongly what all such sets have, faintly what
    /// some have.
    #[arg(long, requires = "disks", conflicts_with_all = ["hints", "edges"])]
    pub(crate) certain: bool,
    /// Seed of the random order of --hints.
    #[arg(long, value_name = "S", default_value_t = 0)]
    pub(crate) seed: u64,
    #[command(flatten)]
    pub(crate) graph: GraphArgs,
    #[command(flatten)]
    pub(crate) weights: WeightArgs,
}

/// Yes or no.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Choice {
    Yes,
    No,
}
