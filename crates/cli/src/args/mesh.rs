//! Arguments of `mesh`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use delone_io::{Contents, Format};

use super::formats;
use super::triangle::{Switches, table};
use super::{GraphArgs, InputArgs, WktArgs, count};

/// Options that Triangle's switches say too.
const SAID: [&str; 9] = [
    "min_angle",
    "max_area",
    "max_vertices",
    "keep",
    "conforming",
    "convex",
    "ignore_holes",
    "second_order",
    "drop_unused",
];

/// Make meshes.
#[derive(Debug, Args)]
#[command(after_help = mesh_help())]
#[allow(clippy::struct_excessive_bools)] // they are options
pub(crate) struct MeshArgs {
    #[command(flatten)]
    pub(crate) input: InputArgs,
    /// Output files.
    #[arg(
        long, short, value_name = "OUT", required_unless_present = "triangle",
        help = format!(
            "Output file ({} v.node v.edge), or - for standard output; may be repeated. With --triangle it may be left out",
            formats::written(&[Contents::Triangles])
        )
    )]
    pub(crate) output: Vec<PathBuf>,
    /// Format of outputs whose extension does not tell.
    #[arg(long, value_name = "FORMAT")]
    pub(crate) to: Option<Format>,
    #[command(flatten)]
    pub(crate) wkt: WktArgs,
    /// Triangle's switches, such as pq30a.1; without -o its files are written beside the input.
    #[arg(long, value_name = "SWITCHES", value_parser = Switches::parse, allow_hyphen_values = true, conflicts_with_all = SAID)]
    pub(crate) triangle: Option<Switches>,
    /// No smaller angles, in degrees, but where the input forces them: from 0 to less than 60. More than 34 are tried, with twice the vertices of 34 at most if --max-vertices says nothing [default: 20].
    #[arg(long, allow_negative_numbers = true, value_name = "DEGREES", help_heading = "Quality")]
    pub(crate) min_angle: Option<f64>,
    /// No larger triangles. Regions of .poly files may have smaller bounds of their own.
    #[arg(long, allow_negative_numbers = true, value_name = "AREA", help_heading = "Quality")]
    pub(crate) max_area: Option<f64>,
    /// No longer edges.
    #[arg(long, allow_negative_numbers = true, value_name = "LENGTH", help_heading = "Quality")]
    pub(crate) max_edge: Option<f64>,
    /// No shorter edges with a new vertex: triangles that would need some are left.
    #[arg(long, allow_negative_numbers = true, value_name = "LENGTH", help_heading = "Quality")]
    pub(crate) min_edge: Option<f64>,
    /// The length that edges are to have: nearly equilateral triangles that grow smoothly. A --size is a length wanted then, too.
    #[arg(long, allow_negative_numbers = true, value_name = "LENGTH", help_heading = "Quality")]
    pub(crate) edge: Option<f64>,
    /// With --edge, the largest ratio of the lengths of neighboring edges: more than 1 [default: 1.2].
    #[arg(
        long,
        allow_negative_numbers = true,
        value_name = "RATIO",
        requires = "edge",
        help_heading = "Quality"
    )]
    pub(crate) growth: Option<f64>,
    /// Largest number of new vertices.
    #[arg(long, value_name = "N", value_parser = count, help_heading = "Quality")]
    pub(crate) max_vertices: Option<usize>,
    /// Segments that may not be split [default: nothing].
    #[arg(long, value_name = "WHAT", help_heading = "Quality")]
    pub(crate) keep: Option<KeepName>,
    /// Where new vertices go for the sake of angles [default: offcenter].
    #[arg(long, value_name = "WHERE", help_heading = "Quality")]
    pub(crate) placement: Option<PlacementName>,
    /// No vertex inside of the circle around a segment, so that what is inside is a Delaunay triangulation.
    #[arg(long, help_heading = "Quality")]
    pub(crate) conforming: bool,
    /// File of points with the longest edge that is wanted there (the third column of text, the height, the first attribute of a
    /// .node file); linear between the points, the value of the nearest one around them.
    #[arg(long, value_name = "FILE", help_heading = "Quality")]
    pub(crate) size: Option<PathBuf>,
    /// Columns of a text file of --size that are x, y and the size: names or numbers from 1.
    #[arg(long, value_name = "COLUMN", value_delimiter = ',', requires = "size", help_heading = "Quality")]
    pub(crate) size_columns: Vec<String>,
    /// Attribute of polygons that is the longest edge in each; with --edge, the length that edges are to have there.
    #[arg(long, value_name = "COLUMN", conflicts_with = "refine", help_heading = "Quality")]
    pub(crate) size_by: Option<String>,
    /// Attribute of polygons that is the largest area of a triangle in each.
    #[arg(long, value_name = "COLUMN", conflicts_with = "refine", help_heading = "Quality")]
    pub(crate) area_by: Option<String>,
    /// Triangles that are refined.
    #[arg(
        long, value_name = "FILE", help_heading = "Quality",
        help = format!(
            "Triangles between the points of the input ({}), which are refined: a mesh once more",
            formats::read(Contents::Triangles)
        )
    )]
    pub(crate) refine: Option<PathBuf>,
    /// Make the triangles of --refine anew, Delaunay within their borders. Otherwise they stay until a new vertex comes near, but with --edge.
    #[arg(long, requires = "refine", help_heading = "Quality")]
    pub(crate) rebuild: bool,
    /// File of the largest area within each triangle of --refine (area).
    #[arg(long, value_name = "FILE", requires = "refine", help_heading = "Quality")]
    pub(crate) areas: Option<PathBuf>,
    /// Rounds of smoothing: new vertices inside move to where angles are larger [default: 0; 5 for the quadrilaterals of --all-quads].
    #[arg(long, value_name = "N", value_parser = count, help_heading = "Quality")]
    pub(crate) smooth: Option<usize>,
    #[command(flatten)]
    pub(crate) layers: LayerArgs,
    #[command(flatten)]
    pub(crate) graph: GraphArgs,
    /// Keep the bays of the convex hull that no segments close, where seeds say what is inside.
    #[arg(long, help_heading = "Segments")]
    pub(crate) convex: bool,
    /// Fill the holes of .poly files.
    #[arg(long, help_heading = "Segments")]
    pub(crate) ignore_holes: bool,
    /// Triangles with six nodes: their corners and the middles of their edges, which are on the arcs of drawings.
    #[arg(long)]
    pub(crate) second_order: bool,
    /// Quadrilaterals where two triangles make one with angles from 30 to 150 degrees, and triangles elsewhere.
    #[arg(long, conflicts_with = "second_order")]
    pub(crate) quads: bool,
    /// Quadrilaterals alone: each of --quads becomes four and each triangle three, so edges are about half as long as asked for.
    #[arg(long, conflicts_with_all = ["second_order", "quads"])]
    pub(crate) all_quads: bool,
    /// The type of elements in .inp files, such as CPS6 for plane stress [default: CPS3; CPE6 with --second-order, which is plane strain, because
    /// more programs know it].
    #[arg(long, value_name = "TYPE", value_parser = element)]
    pub(crate) element: Option<String>,
    /// The name of the boundary that has a marker, as in 2=inlet; may be repeated. It goes before a name that a file has.
    #[arg(long, value_name = "MARKER=NAME", value_parser = named::<i64>, allow_hyphen_values = true, help_heading = "Names")]
    pub(crate) boundary: Vec<(i64, String)>,
    /// The name of the region that has a number, as in 1=steel; may be repeated.
    #[arg(long, value_name = "NUMBER=NAME", value_parser = named::<f64>, allow_hyphen_values = true, help_heading = "Names")]
    pub(crate) region: Vec<(f64, String)>,
    /// The attribute that is the name of features: of lines as boundaries, of polygons as regions [default: name, where it is a text].
    #[arg(long, value_name = "COLUMN", help_heading = "Names")]
    pub(crate) names: Option<String>,
    /// Leave out vertices that no triangle uses: the others are numbered anew, in their order.
    #[arg(long)]
    pub(crate) drop_unused: bool,
    /// Prove the result with exact arithmetic, and measure all of its triangles again, before writing it.
    #[arg(long)]
    pub(crate) check: bool,
    /// Print how many angles there are of each size.
    #[arg(long)]
    pub(crate) histogram: bool,
    /// The longer side of pictures in pixels.
    #[arg(long, value_name = "PIXELS", default_value_t = 1600, value_parser = clap::value_parser!(u32).range(16..=20_000))]
    pub(crate) picture_size: u32,
    /// Meaning of colors in pictures [default: regions, heights or density].
    #[arg(long, value_name = "WHAT")]
    pub(crate) color: Option<ColorName>,
}

/// Boundary layers.
#[derive(Debug, Args)]
#[command(next_help_heading = "Boundary layers")]
pub(crate) struct LayerArgs {
    /// Height of the first row of thin triangles along the border, as flows need them along walls.
    #[arg(long, allow_negative_numbers = true, value_name = "HEIGHT", conflicts_with = "refine")]
    pub(crate) layer_height: Option<f64>,
    /// Rows [default: 5].
    #[arg(long, value_name = "N", value_parser = count, requires = "layer_height")]
    pub(crate) layer_count: Option<usize>,
    /// How many times as high as the row before each row is [default: 1.2].
    #[arg(long, allow_negative_numbers = true, value_name = "RATIO", requires = "layer_height")]
    pub(crate) layer_growth: Option<f64>,
    /// Height of all rows together: fewer rows, if that comes nearer to it.
    #[arg(long, allow_negative_numbers = true, value_name = "HEIGHT", requires = "layer_height")]
    pub(crate) layer_thickness: Option<f64>,
    /// Markers of the segments with layers [default: all of the border].
    #[arg(
        long,
        allow_negative_numbers = true,
        value_name = "MARKER",
        value_delimiter = ',',
        requires = "layer_height"
    )]
    pub(crate) layers: Vec<i64>,
}

/// Segments that may not be split.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum KeepName {
    /// All may.
    Nothing,
    /// Constraints with the mesh on one side only.
    Border,
    /// All segments.
    Constraints,
}

/// Where new vertices go for the sake of angles.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum PlacementName {
    /// Behind the shortest side, no farther than the angle asks for: fewer triangles.
    Offcenter,
    /// In circumcenters.
    Circumcenter,
}

/// The meaning of colors.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum ColorName {
    /// The smallest angle of each triangle.
    Angle,
}

/// Parses a number and a name.
fn named<N: std::str::FromStr>(text: &str) -> Result<(N, String), String> {
    let (number, name) = text.split_once('=').ok_or("it is no number, = and a name, such as 2=inlet")?;
    let number = number.trim().parse().map_err(|_| format!("{number:?} is no number of that kind"))?;
    let name = name.trim();
    if name.is_empty() || name.contains(char::is_control) {
        return Err("a name has at least one letter, and no characters that cannot be seen".to_owned());
    }
    Ok((number, name.to_owned()))
}

/// Parses a type of elements, as Abaqus has them.
fn element(text: &str) -> Result<String, String> {
    /// Letters and digits of the longest names.
    const LONGEST: usize = 8;
    let is_name = text.starts_with(|c: char| c.is_ascii_uppercase())
        && text.len() <= LONGEST
        && text.chars().all(|c| c.is_ascii_uppercase() || c.is_ascii_digit());
    if is_name { Ok(text.to_owned()) } else { Err("it is no type of elements, such as CPS6".to_owned()) }
}

/// Examples, and Triangle's letters.
fn mesh_help() -> String {
    format!(
        "Examples:
  delone mesh plan.poly --min-angle 30 -o plan.msh -o plan.png --color angle
  delone mesh plate.poly --edge 0.5 --min-angle 30 -o plate.vtu
  delone mesh channel.poly --edge 0.1 --layer-height 0.002 --layer-count 8 --layers 2,3 -o channel.su2
  delone mesh lakes.geojson --max-area 100 --check --stats stats.json -o lakes.vtu
  delone mesh coast.poly --size depth.csv --size-columns x,y,edge -o coast.1.node -o coast.1.ele
  delone mesh coast.1.node --refine coast.1.ele --areas coast.1.area -o coast.2.node -o coast.2.ele
  delone mesh plan.poly --triangle pq30a.1
  delone mesh plate.geojson --second-order --element CPS6 -o plate.inp
  delone mesh channel.poly --boundary 2=inlet --boundary 3=outlet --region 1=water -o channel.msh -o channel.su2

New vertices follow those of the input, in the order in which they came. What is inside is written, as --fill says; vertices
outside stay, without triangles, unless --drop-unused. Heights and attributes of new vertices are linear between those of the
input. Names of regions and boundaries come from these options, from groups of .msh files, from comments of .poly files
(# boundary 2 inlet, # region 1 steel), and from features. Triangles that could not be refined are counted in a warning, with the reasons.

Triangle's switches:
{}
With --triangle segments that cross are split, as Triangle does. Files without a known extension are .poly with p, or else
.node. x.poly becomes x.1.node, x.1.ele and x.1.poly; x.1.poly becomes x.2.node, and so on.
Exit status: 0 done, 1 bad data or failed work, 2 wrong usage.",
        table()
    )
}
