//! Arguments of `tiles`.

use std::path::PathBuf;

use clap::Args;
use delone_io::Format;

use super::{InputArgs, WktArgs, count};

/// Triangulate more points than memory, in tiles.
#[expect(clippy::struct_excessive_bools, reason = "each is an option")]
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  delone tiles survey/*.laz --class ground --heights -o tiles --memory 4G
  delone tiles points.npy -o tiles --memory 1G --workers 4 --stats stats.json
  delone tiles points.npy -o tiles --memory 8G --resume
  delone info tiles
  delone check tiles

The triangles are those of delone triangulate, to the last tie, whatever the memory. Input: npy las laz csv xyz txt tsv bin; several
files are one set, in their order. Each file is read twice. The folder then holds
  tiles.json            count, triangles, fingerprint, cuts, and what each node has
  points-NNNNN.npy      the points of tile N that differ, along a curve: float64 (n, 2), with --heights (n, 3)
  ids-NNNNN.npy         for each of them its index in the input, from 0: uint64 (n,)
  triangles-NNNNN.npy   its triangles, counter-clockwise, as indices of its points: uint32 (t, 3)
  seam-NNNNN.npy        triangles between tiles, uint64 (t, 3): the number of the tile times 2^32, and the index there
With --neighbors, number k of a row being across the edge opposite to corner k:
  neighbors-NNNNN.npy   of a tile the rows of the same file, uint32 (t, 3), 2^32 - 1 where there is none; of a seam triangles,
                        uint64 (t, 3): the number of the node times 2^32, and the row there; 2^64 - 1 outside
  across-NNNNN.npy      of a tile what is across other edges, uint64 (k, 3): row, corner, triangle as above
With --parquet, tables whose names count over all tiles: the number of a tile times 2^32, and the index there:
  points-NNNNN.parquet      vertex, row of the input from 0, x, y, with --heights z, and geometry: GeoParquet, with the system
                            of coordinates where it is longitude and latitude or a zone of UTM
  triangles-NNNNN.parquet   a, b, c: vertices, of tiles and of seams
The fingerprint is that of the set of triangles by coordinates: delone triangulate --fingerprint prints the same.

A run that was stopped, at any moment, goes on with --resume, and what was finished is not done again.
Exit status: 0 done, 1 bad data or failed work, 2 wrong usage.")]
pub(crate) struct TilesArgs {
    #[command(flatten)]
    pub(crate) input: InputArgs,
    /// Folder for the tiles, which is made.
    #[arg(long, short, value_name = "FOLDER")]
    pub(crate) output: PathBuf,
    /// Memory that may be taken, as in 500M or 4G: it decides how many tiles there are. From 64M on.
    #[arg(long, value_name = "SIZE", default_value = "1G", value_parser = size)]
    pub(crate) memory: u64,
    /// Go on with a run that was stopped.
    #[arg(long)]
    pub(crate) resume: bool,
    /// Tiles that are triangulated at once, each on its share of threads and memory [default: as many as threads].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub(crate) workers: Option<u16>,
    /// Keep the heights of the points: the files must have them.
    #[arg(long)]
    pub(crate) heights: bool,
    /// Write what is across each edge too; with --resume also for tiles that are done.
    #[arg(long)]
    pub(crate) neighbors: bool,
    /// Write tables in Parquet too; with --resume also for tiles that are done.
    #[cfg_attr(
        not(feature = "parquet"),
        doc = "Not in this program, which was built without the feature parquet."
    )]
    #[arg(long)]
    pub(crate) parquet: bool,
    /// Points of a tile at most, instead of as many as memory allows.
    #[arg(long, value_name = "N", value_parser = count)]
    pub(crate) tile: Option<usize>,
}

/// Cut a part, or an overview, out of a folder of tiles.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  delone window tiles --box 637000,851000,637200,851200 -o part.vtu -o part.png
  delone window tiles --points 100000 -o overview.png
  delone window tiles --box 0,0,1,1 --tiles -o tiles.svg

Of a box all triangles that may meet it, which are those of all points, with heights where tiles have them. Of an overview as many
points as are asked for, about, at equal steps along the curve of each tile, triangulated. A picture shows the triangles across the
border of a box whole, and the box faintly.
Exit status: 0 done, 1 bad data or failed work, 2 wrong usage.")]
pub(crate) struct WindowArgs {
    /// Folder that delone tiles made.
    #[arg(value_name = "FOLDER")]
    pub(crate) folder: PathBuf,
    /// Mesh or picture; may be repeated.
    #[arg(long, short, value_name = "OUT", required = true)]
    pub(crate) output: Vec<PathBuf>,
    /// Format of outputs whose extension does not tell.
    #[arg(long, value_name = "FORMAT")]
    pub(crate) to: Option<Format>,
    #[command(flatten)]
    pub(crate) wkt: WktArgs,
    /// The part, in coordinate units: least x and y, greatest x and y.
    #[arg(
        long = "box",
        value_name = "X,Y,X,Y",
        value_delimiter = ',',
        num_args = 1,
        allow_hyphen_values = true
    )]
    pub(crate) box_: Vec<f64>,
    /// An overview of so many points.
    #[arg(long, value_name = "N")]
    pub(crate) points: Option<std::num::NonZero<u64>>,
    /// In pictures, color triangles by tile, those of seams apart, and draw the cuts.
    #[arg(long)]
    pub(crate) tiles: bool,
    /// The longer side of pictures in pixels.
    #[arg(long, value_name = "PIXELS", default_value_t = 1600, value_parser = clap::value_parser!(u32).range(16..=20_000))]
    pub(crate) size: u32,
    /// Write what was counted and timed, and on how many threads at most, to a JSON file.
    #[arg(long, value_name = "FILE")]
    pub(crate) stats: Option<PathBuf>,
}

/// A number of bytes: 64M, 1.5G, 2GiB, 1e9.
pub(super) fn size(text: &str) -> Result<u64, String> {
    let wrong = || "a size is a number of bytes, as in 500M or 4G".to_owned();
    let text = text.trim();
    let bare = text.trim_end_matches(['b', 'B']);
    let bare = bare.strip_suffix('i').unwrap_or(bare);
    let (number, scale) = match bare.char_indices().next_back() {
        Some((at, 'k' | 'K')) => (&bare[..at], 10),
        Some((at, 'm' | 'M')) => (&bare[..at], 20),
        Some((at, 'g' | 'G')) => (&bare[..at], 30),
        Some((at, 't' | 'T')) => (&bare[..at], 40),
        _ => (bare, 0),
    };
    let bytes = number.parse::<f64>().map_err(|_| wrong())? * f64::from(1_u32 << 10).powi(scale / 10);
    if (1.0..1e18).contains(&bytes) { Ok(bytes as u64) } else { Err(wrong()) }
}

#[cfg(test)]
mod tests {
    use super::size;

    #[test]
    fn sizes_are_read() {
        for (text, bytes) in [
            ("1", 1),
            ("1e9", 1_000_000_000),
            ("64M", 64 << 20),
            ("1.5G", 3 << 29),
            ("2GiB", 2 << 30),
            ("3kB", 3072),
            ("1T", 1 << 40),
        ] {
            assert_eq!(size(text), Ok(bytes), "{text}");
        }
        for text in ["", "M", "-1G", "0", "x", "1X", "nan", "inf", "1e30G", "1 2"] {
            assert!(size(text).is_err(), "{text}");
        }
    }
}
