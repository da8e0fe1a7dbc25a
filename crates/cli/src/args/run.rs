//! Arguments of all commands.

use clap::Args;
use delone_io::Crs;

use super::{count, tiles};

/// How a program works, whatever its command.
#[derive(Debug, Args)]
pub struct RunArgs {
    /// No progress and no notes on standard error; errors still appear.
    #[arg(long, short, global = true)]
    pub quiet: bool,
    /// Fail, and write nothing, where an output has no room for something that the input has (attributes, the system of coordinates, heights,
    /// lines), or triangles of a mesh are not as they were to be. Otherwise a line on standard error says so.
    #[arg(long, global = true)]
    pub(crate) strict: bool,
    /// The system of coordinates of the input by its EPSG number, perhaps with that of its heights (25832+7837), where files do not tell it or
    /// are wrong; files beside the input have it if they tell none. Outputs say it; nothing is transformed.
    #[arg(long, value_name = "NUMBER", global = true, value_parser = system)]
    pub(crate) epsg: Option<Crs>,
    /// Threads at most [default: RAYON_NUM_THREADS, or as many as there are cores]. Results do not depend on it;
    /// the default constructions use them, in the plane and in space.
    #[arg(long, value_name = "N", global = true, value_parser = clap::value_parser!(u16).range(1..))]
    pub(crate) threads: Option<u16>,
    /// Memory at most, in bytes or with K, M, G, T [default on Linux: as much as there is]. Compressed input may be of any length then;
    /// without it, 1,000 times as long as its file.
    #[arg(long, value_name = "SIZE", global = true, value_parser = tiles::size)]
    pub(crate) max_memory: Option<u64>,
    /// Bytes of all outputs at most, as for --max-memory.
    #[arg(long, value_name = "SIZE", global = true, value_parser = tiles::size)]
    pub(crate) max_output: Option<u64>,
    /// Points of the input at most.
    #[arg(long, value_name = "N", global = true, value_parser = count)]
    pub(crate) max_points: Option<usize>,
}

/// A system of coordinates by its number, and perhaps that of a system of heights.
fn system(text: &str) -> Result<Crs, String> {
    let is_number = |text: &str| text.parse().is_ok_and(|number: u32| (1024..=32766).contains(&number));
    let bare = text.rsplit(':').next().unwrap_or_default();
    let named = bare.split('+').count() <= 2 && bare.split('+').all(is_number);
    named
        .then(|| Crs::of_name(&format!("EPSG:{bare}")))
        .flatten()
        .ok_or_else(|| "it is no number from 1024 to 32766, nor two of them as in 25832+7837".to_owned())
}
