//! The options of the command line.

use clap::{Parser, ValueEnum};

/// Attacks the engine with seeded random input. Exit status 1 if anything was found.
#[derive(Clone, Debug, Parser)]
#[command(name = "delone-fuzz", version)]
pub(crate) struct Options {
    /// The mode: what to attack.
    pub(crate) mode: Mode,
    /// Decides all cases.
    #[arg(long, default_value_t = 1)]
    pub(crate) seed: u64,
    /// How long; each mode in turn for `all`.
    #[arg(long, default_value_t = 60.0)]
    pub(crate) seconds: f64,
    /// Only this case, by its own seed as a finding names it.
    #[arg(long, value_parser = number)]
    pub(crate) case: Option<u64>,
    /// Of this case only some items, such as 0,4,7-9.
    #[arg(long, requires = "case")]
    pub(crate) keep: Option<String>,
    /// Go on after a finding until the time is over.
    #[arg(long)]
    pub(crate) go_on: bool,
    /// Modes of `all` that run at the same time.
    #[arg(long, default_value_t = 1)]
    pub(crate) jobs: usize,
    /// Seconds after which a case hangs.
    #[arg(long, default_value_t = 20.0)]
    pub(crate) limit: f64,
    /// Megabytes of memory that a case may take.
    #[arg(long, default_value_t = 4096)]
    pub(crate) memory: u64,
    /// Run cases in this process and report to the parent.
    #[arg(long, hide = true)]
    pub(crate) worker: bool,
    /// The number of the first case.
    #[arg(long, hide = true, default_value_t = 0)]
    pub(crate) first: u64,
}

/// A mode of attack.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Mode {
    /// Small sets in the plane against the definition.
    Plane,
    /// Small sets in space against the definition.
    Space,
    /// Changes and queries in plane and space.
    Lives,
    /// Points that move, imprecise points.
    Motion,
    /// Voronoi cells clipped to regions.
    Cells,
    /// Voronoi and power cells of space in boxes and convex bodies: corners, faces, volumes, orders.
    Cells3,
    /// Segments between points: building, crossings, changes.
    Graphs,
    /// Segments that are welded, and their cells.
    Outlines,
    /// Refinement of graphs: bounds of angles and sizes, what is kept, orders of the input.
    Mesh,
    /// Surfaces over points: interpolation, rasters, contours, thinning.
    Surfaces,
    /// Points in tiles of plane and space: cuts, borders, joins, bytes.
    Tiles,
    /// Points with weights: building, hidden sites, changes.
    Weights,
    /// Alpha complexes and their shapes, with weights.
    Alphas,
    /// Sites in boxes that repeat, with weights: spheres, orders, cells.
    Periodic,
    /// Voronoi diagrams of all orders: regions, circles, points, cells, changes.
    Orders,
    /// Hulls, furthest and nearest sites, the smallest circle.
    Hulls,
    /// Gabriel graphs, relative neighbors, spanning trees, skeletons, k nearest.
    Proximity,
    /// Predicates and filters on hostile operands.
    Predicates,
    /// Sets of thousands of points: all algorithms, orders and threads alike.
    Mixtures,
    /// Readers: columns of text.
    ReadText,
    /// Readers: GeoJSON, well-known text and binary.
    ReadGeojson,
    /// Readers: NumPy arrays and archives, rasters.
    ReadArrays,
    /// Readers: LAS and LAZ tiles.
    ReadLas,
    /// Readers: PLY.
    ReadPly,
    /// Readers: OBJ, OFF, STL, Triangle's files.
    ReadMeshes,
    /// Readers: E57 scans.
    ReadE57,
    /// Readers: FlatGeobuf, GeoPackage, shapefiles, drawings.
    ReadMaps,
    /// The program on mutated files, with little memory, killed now and then.
    Program,
    /// All of these.
    All,
    /// A wrong answer on purpose, which tests of the supervision need.
    #[value(hide = true)]
    BrokenAnswer,
    /// A panic on purpose.
    #[value(hide = true)]
    BrokenPanic,
    /// A hang on purpose.
    #[value(hide = true)]
    BrokenHang,
    /// A runaway of memory on purpose.
    #[value(hide = true)]
    BrokenMemory,
    /// A stack overflow on purpose.
    #[value(hide = true)]
    BrokenStack,
    /// Nothing wrong at all.
    #[value(hide = true)]
    Sound,
}

impl Mode {
    /// The modes that `all` runs.
    pub(crate) const REAL: [Self; 28] = [
        Self::Plane,
        Self::Space,
        Self::Lives,
        Self::Motion,
        Self::Cells,
        Self::Cells3,
        Self::Graphs,
        Self::Outlines,
        Self::Mesh,
        Self::Surfaces,
        Self::Tiles,
        Self::Weights,
        Self::Alphas,
        Self::Periodic,
        Self::Orders,
        Self::Hulls,
        Self::Proximity,
        Self::Predicates,
        Self::Mixtures,
        Self::ReadText,
        Self::ReadGeojson,
        Self::ReadArrays,
        Self::ReadLas,
        Self::ReadPly,
        Self::ReadMeshes,
        Self::ReadE57,
        Self::ReadMaps,
        Self::Program,
    ];

    /// As it is written on the command line.
    pub(crate) fn name(self) -> String {
        self.to_possible_value().map(|value| value.get_name().to_owned()).unwrap_or_default()
    }
}

/// A decimal number, or a hexadecimal one after 0x.
fn number(text: &str) -> Result<u64, String> {
    let parsed = match text.strip_prefix("0x") {
        Some(digits) => u64::from_str_radix(digits, 16),
        None => text.parse(),
    };
    parsed.map_err(|error| error.to_string())
}

/// Indices such as 0,4,7-9.
pub(crate) fn indices(text: &str) -> Result<Vec<usize>, String> {
    let one = |digits: &str| digits.trim().parse::<usize>().map_err(|error| format!("{digits:?}: {error}"));
    let mut all = Vec::new();
    for part in text.split(',').filter(|part| !part.trim().is_empty()) {
        match part.split_once('-') {
            Some((first, last)) => all.extend(one(first)?..=one(last)?),
            None => all.push(one(part)?),
        }
    }
    Ok(all)
}

/// Writes increasing indices.
pub(crate) fn written(indices: &[usize]) -> String {
    let runs = indices.chunk_by(|i, j| i + 1 == *j);
    let text: Vec<String> = runs
        .map(|run| match run {
            [one] => one.to_string(),
            _ => format!("{}-{}", run[0], run[run.len() - 1]),
        })
        .collect();
    text.join(",")
}

#[cfg(test)]
mod tests {
    use super::{Mode, indices, number, written};
    use clap::ValueEnum;

    #[test]
    fn all_runs_every_mode_that_is_shown() {
        let shown = Mode::value_variants().iter().filter(|mode| {
            mode.to_possible_value().is_some_and(|value| !value.is_hide_set()) && **mode != Mode::All
        });
        assert_eq!(shown.copied().collect::<Vec<_>>(), Mode::REAL);
    }

    #[test]
    fn lists_of_indices_are_read_as_they_are_written() {
        let list = [0, 4, 5, 6, 9];
        assert_eq!(written(&list), "0,4-6,9");
        assert_eq!(indices("0,4-6,9"), Ok(list.to_vec()));
        assert_eq!(indices(""), Ok(vec![]));
        assert!(indices("x").is_err());
    }

    #[test]
    fn seeds_are_decimal_or_hexadecimal() {
        assert_eq!((number("17"), number("0xff")), (Ok(17), Ok(255)));
        assert!(number("ff").is_err());
    }
}
