//! Arguments of `animate`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use delone_cli::args::InputArgs;
use delone_io::Format;

/// Show a motion, or what an algorithm does.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  delone-lab animate points.csv -o motion.png
  delone generate disks -n 30 -o - --to csv | delone-lab animate - --from csv --show flips -o flips.png
  delone-lab animate points.csv --show levels -o 'level-{}.svg'
  delone generate disks -n 300 -o - --to csv | delone-lab animate - --from csv --radius 1 --steps 100 -o motion.png
  delone-lab animate points.csv -o 'frame-{}.svg'

A motion moves each point in every step at random inside of a disk around it; the triangulation is repaired, or rebuilt where that is
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
    /// The animation to show.
    #[arg(long, value_name = "WHAT", default_value = "motion")]
    pub(crate) show: Show,
    /// Number of steps, at most.
    #[arg(long, value_name = "N", default_value_t = 60, value_parser = clap::value_parser!(u32).range(..10_000))]
    pub(crate) steps: u32,
    /// Of motion: how far a point goes in a step at most [default: a fifth of the distance of neighbors in an even set]; of
    /// hints: how far an instance is from its hint at most [default: half of the least distance of two points].
    #[arg(long, value_name = "RADIUS", allow_negative_numbers = true)]
    pub(crate) radius: Option<f64>,
    /// Milliseconds a picture is shown [default: 40, where an algorithm is shown 600].
    #[arg(long, value_name = "MS")]
    delay: Option<u16>,
    /// The longer side in pixels.
    #[arg(long, value_name = "PIXELS", default_value_t = 600, value_parser = clap::value_parser!(u32).range(16..=20_000))]
    pub(crate) size: u32,
    /// Seed of the motion, and of whatever is random in an algorithm.
    #[arg(long, value_name = "S", default_value_t = 0)]
    pub(crate) seed: u64,
}

/// The subject of an animation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Show {
    /// Points in Brownian motion, and their triangulation.
    Motion,
    /// Insertion by flips: each triangle in conflict with the new point goes by one.
    Flips,
    /// Conflict lists: the points to come, by the triangle that they are in.
    Lists,
    /// Straight walks from the vertex inserted last.
    Walk,
    /// Jump-and-walk: to the nearest of a few random vertices, and from there.
    Jump,
    /// The descent through the levels of a Delaunay hierarchy.
    Levels,
    /// Imprecise points, each found from the instance of its hint.
    Hints,
}

impl AnimateArgs {
    /// Milliseconds a picture is shown.
    pub(crate) fn delay(&self) -> u16 {
        self.delay.unwrap_or(if self.show == Show::Motion { 40 } else { 600 })
    }
}
