//! `delone dtm`: points with heights to a raster of terrain, in memory or in tiles on disk.
//!
//! The raster is made in bands of rows, so it may be larger than memory. Which triangle a cell is in is exact, and what it has depends
//! on the points alone: the same file comes out with and without `--memory`.

mod bands;
mod failure;
mod held;
mod inputs;

use std::mem::ManuallyDrop;
use std::ops::Range;
use std::path::{Path, PathBuf};

use delone::Bounds;
use delone::surface::Grid;
use delone_io::{Cloud, Contents, ContourMap, Crs, Direction, Format, besides_of_raster, write_contours};
use delone_terrain::{Clip, Error, Options, Product, Terrain, is_map};

use crate::args::{DtmArgs, MethodName, TilesArgs};
use crate::files;
use crate::message::{Failure, grouped, say, warn};
use crate::place::Place;
use crate::progress::Phase;
use crate::stats::Stats;
use crate::tiles::Held;
use failure::failure;

/// Bytes of a cell of the row that is made, at the most.
const ROW: f64 = 64.0;
/// Cells that are made at a time, where nobody limits memory.
const AT_ONCE: usize = 1 << 24;

pub(crate) fn run(args: &DtmArgs, quiet: bool) -> Result<(), Failure> {
    let input = inputs::resolve(args);
    let mut inputs = input.paths();
    inputs.extend(
        args.breaklines
            .iter()
            .chain(&args.flat)
            .chain(&args.clip)
            .chain(&args.place.like)
            .map(PathBuf::as_path),
    );
    let stats_path = args.input.stats.as_deref();
    let outputs = files::outputs(&args.output, args.to, stats_path, &inputs)?;
    check(args, &outputs)?;
    keep_besides_apart(&outputs, &inputs, stats_path)?;
    let clip = args.clip.as_deref().map(|path| inputs::clip(path, quiet)).transpose()?;
    let place = Place::read(&args.place, args.cell, quiet)?;
    let mut stats = Stats::start();
    let mut job = Job { args, outputs: &outputs, clip, place, label: input.label(), quiet };
    let in_chunks = input.input.iter().all(|path| {
        let format = input.from.or_else(|| Format::of(path).ok());
        path.is_file() && format.is_some_and(|format| format.holds(Contents::Pieces, Direction::Read))
    });
    match args.memory {
        Some(memory) if in_chunks => {
            let folder = inputs::workspace(&outputs)?;
            let tiles = TilesArgs {
                output: folder.path().to_owned(),
                memory,
                heights: true,
                duplicates: args.duplicates.rule(),
                tile: args.tile,
                ..inputs::tiles(input)
            };
            let (held, about) = Held::make(&tiles, &mut stats, quiet)?;
            job.held(&held, &about, memory, &mut stats)?;
        }
        memory => {
            if memory.is_some() {
                warn(quiet, "--memory is not kept: files of this kind are read whole");
            }
            // What is large is given back by the end of the program, all at once.
            let cloud = ManuallyDrop::new(files::points(&input, 3, quiet)?);
            stats.phase("read");
            job.in_memory(&cloud, &mut stats)?;
        }
    }
    stats.write(stats_path)
}

/// Refuses files beside rasters that would go over others, even if they turn out not to be needed.
fn keep_besides_apart(
    outputs: &[(PathBuf, Format)],
    inputs: &[&Path],
    stats_path: Option<&Path>,
) -> Result<(), Failure> {
    let besides: Vec<PathBuf> =
        outputs.iter().flat_map(|(path, format)| besides_of_raster(path, *format)).collect();
    let named = outputs.iter().map(|output| output.0.as_path()).chain(stats_path);
    files::keep_names_apart(inputs, named.chain(besides.iter().map(PathBuf::as_path)))
}

fn check(args: &DtmArgs, outputs: &[(PathBuf, Format)]) -> Result<(), Failure> {
    let holds = |format: Format| {
        format.holds(Contents::Rasters, Direction::Written) || format == Format::Png || is_map(format)
    };
    if let Some((path, format)) = outputs.iter().find(|output| !holds(output.1)) {
        let what = format!("{}: {format} is no format of terrain", path.display());
        let rasters = Format::with(&[Contents::Rasters], Direction::Written);
        return Err(Failure::usage(
            what,
            format!("choose among {rasters} png (hillshade) geojson fgb gpkg (contours)"),
        ));
    }
    args.compress.check(outputs.iter().map(|output| output.1))?;
    if args.memory.is_some() && args.method.is_bent() {
        return Err(Failure::usage(
            "--memory is for the methods linear, natural, laplace and nearest",
            "choose one of them, or leave --memory out",
        ));
    }
    if args.memory.is_some() && args.edges.max_edge.is_some() {
        return Err(Failure::usage(
            "--max-edge needs all triangles in memory: it goes from the hull inwards",
            "take --max-edge-anywhere, or leave --memory out",
        ));
    }
    if args.memory.is_some() && outputs.iter().any(|output| is_map(output.1)) {
        return Err(Failure::usage(
            "contours need all triangles in memory",
            "leave --memory or the contours out, or make them of the raster with delone contours",
        ));
    }
    let bad = |x: Option<f64>| x.filter(|x| !(*x > 0.0 && x.is_finite()));
    if let Some(cell) = bad(args.cell) {
        return Err(Failure::usage(
            format!("--cell {cell}: a cell has a positive size"),
            "give it as in --cell 0.5",
        ));
    }
    if let Some(interval) = bad(args.interval) {
        return Err(Failure::usage(
            format!("--interval {interval}: it must be positive"),
            "give it as in --interval 5",
        ));
    }
    Ok(())
}

/// The job, whatever the surface comes from.
struct Job<'a> {
    args: &'a DtmArgs,
    outputs: &'a [(PathBuf, Format)],
    clip: Option<Clip>,
    place: Place,
    label: PathBuf,
    quiet: bool,
}

impl Job<'_> {
    fn in_memory(&mut self, cloud: &Cloud, stats: &mut Stats) -> Result<(), Failure> {
        let Self { args, quiet, .. } = *self;
        inputs::check(cloud, &self.label, args)?;
        let crs = self.crs(cloud);
        let lines = inputs::lines(args, quiet)?;
        let options = Options::new()
            .method(args.method.method())
            .duplicates(args.duplicates.rule())
            .border(args.edges.border());
        let has_lines = !lines.is_empty();
        let phase = Phase::start(quiet, "triangulating");
        let made = Terrain::new(cloud, lines, &self.place.cells, &options);
        let mut terrain = made.map_err(|error| failure(&self.label, &error))?.with_crs(crs);
        drop(phase);
        if let Some(clip) = self.clip.take() {
            terrain = terrain.clipped(clip).map_err(|error| failure(&self.label, &error))?;
        }
        let terrain = ManuallyDrop::new(terrain);
        terrain.remarks().iter().for_each(|remark| inputs::tell(remark, None, quiet));
        let counts = terrain.surface().counts();
        if has_lines {
            stats.set("crossings", counts.crossings);
        }
        stats.set("points", counts.points);
        stats.set("duplicates", counts.duplicates);
        stats.set("vertices", counts.vertices);
        stats.set("simplices", counts.triangles);
        stats.set("hull", counts.hull);
        stats.phase("build");
        let maps: Vec<_> = self.outputs.iter().filter(|output| is_map(output.1)).collect();
        let mut contours = Vec::new();
        if !maps.is_empty() {
            let drawn = terrain.surface().contours(args.interval);
            contours = drawn.map_err(|error| failure(&self.label, &error))?;
            stats.set("lines", contours.len());
        }
        let map = ContourMap { lines: &contours, bands: &[], crs: terrain.crs() };
        for (path, format) in maps {
            files::write(path, |out| write_contours(out, *format, &map, 0))?;
        }
        self.rasters(terrain.grid(), terrain.crs(), &terrain.bands(), stats, |rows| {
            terrain.rows(rows).map_err(|error| failure(&self.label, &error))
        })
    }

    fn held(&self, held: &Held, about: &Cloud, memory: u64, stats: &mut Stats) -> Result<(), Failure> {
        let Self { args, .. } = *self;
        let count = stats.get("points").as_u64().unwrap_or(0);
        inputs::check_count(count, &self.label, args)?;
        if stats.get("simplices").as_u64() == Some(0) {
            return Err(failure(&self.label, &Error::OneLine));
        }
        let crs = self.crs(about);
        let grid = self.grid(&held.bounds, count)?;
        let free = (memory - (40 << 20)) as f64;
        // A band has its values twice, and where neighbors are asked its points.
        let rows = (free / 8.0 / 16.0 / grid.columns() as f64) as usize;
        if rows == 0 && free < ROW * grid.columns() as f64 {
            let what = format!(
                "{}: a row of {} cells does not fit into --memory",
                self.label.display(),
                grid.columns()
            );
            return Err(Failure::new(what, "allow more memory, or choose a larger --cell"));
        }
        let rows = rows.max(1);
        let rows = if args.tile.is_some() { 7 } else { rows };
        let mut bands = even(&grid, rows.min((AT_ONCE / grid.columns()).max(1)));
        if args.method != MethodName::Linear {
            let most = free / 2.0 / 700.0;
            bands = bands.into_iter().flat_map(|rows| split(held, &grid, rows, most)).collect();
        }
        self.rasters(&grid, crs.as_ref(), &bands, stats, |rows| {
            let window = grid.window(0..grid.columns(), rows);
            let mut values = held::values(held, args.method.method(), args.edges.max_edge_anywhere, &window)?;
            self.clip.iter().for_each(|clip| clip.apply(&window, &mut values));
            Ok(values)
        })
    }

    fn rasters(
        &self,
        grid: &Grid,
        crs: Option<&Crs>,
        bands: &[Range<usize>],
        stats: &mut Stats,
        values: impl Fn(Range<usize>) -> Result<Vec<f64>, Failure>,
    ) -> Result<(), Failure> {
        let product = Product::new()
            .nodata(self.args.nodata)
            .compression(self.args.compress.into())
            .relief(self.args.light.hillshade());
        let rasters: Vec<_> = self.outputs.iter().filter(|output| !is_map(output.1)).cloned().collect();
        if rasters.is_empty() {
            stats.tell(self.quiet, ["triangle", "triangles"]);
            return Ok(());
        }
        let known = bands::write(&rasters, (grid, crs, &product), bands, self.quiet, values)?;
        stats.set("cells", grid.cells());
        stats.set("columns", grid.columns());
        stats.set("rows", grid.rows());
        stats.set("no_data", grid.cells() - known as f64);
        stats.phase("write");
        if known == 0 {
            warn(self.quiet, "no cell has a height: no center of a cell is in a triangle that is shown");
        }
        let duplicates = stats.get("duplicates").as_u64().unwrap_or(0);
        if duplicates > 0 {
            let rule = clap::ValueEnum::to_possible_value(&self.args.duplicates);
            let rule = rule.map(|value| value.get_name().to_owned()).unwrap_or_default();
            crate::message::note(
                self.quiet,
                format_args!(
                    "{} points are at the place of another one: the rule is {rule}",
                    grouped(duplicates)
                ),
            );
        }
        let points = grouped(stats.get("points").as_u64().unwrap_or(0));
        say(
            self.quiet,
            format_args!(
                "{points} points, {} x {} cells, {} with heights ({:.2} s)",
                grouped(grid.columns() as u64),
                grouped(grid.rows() as u64),
                grouped(known),
                stats.total()
            ),
        );
        Ok(())
    }

    /// The cells of the raster, of tiles.
    fn grid(&self, bounds: &Bounds<2>, count: u64) -> Result<Grid, Failure> {
        let made = self.place.cells.grid(bounds, count);
        let grid = made.map_err(|error| failure(&self.label, &error))?;
        self.place
            .cells
            .remark(bounds, &grid)
            .iter()
            .for_each(|remark| inputs::tell(remark, None, self.quiet));
        Ok(grid)
    }

    fn crs(&self, about: &Cloud) -> Option<Crs> {
        let crs = self.place.crs(about.crs.as_ref());
        if crs.is_none() && self.outputs.iter().any(|output| output.1 == Format::Tiff) {
            warn(self.quiet, "the files do not tell their system of coordinates: name it with --epsg");
        }
        crs
    }
}

/// Rows in bands of so many.
fn even(grid: &Grid, rows: usize) -> Vec<Range<usize>> {
    (0..grid.rows()).step_by(rows).map(|first| first..(first + rows).min(grid.rows())).collect()
}

/// Halves a band until it does not have more points than are allowed, about.
fn split(held: &Held, grid: &Grid, rows: Range<usize>, most: f64) -> Vec<Range<usize>> {
    let count = held.count_between([grid.y(rows.end - 1), grid.y(rows.start)]);
    if count <= most || rows.len() < 2 {
        return vec![rows];
    }
    let middle = usize::midpoint(rows.start, rows.end);
    let halves = [rows.start..middle, middle..rows.end];
    halves.into_iter().flat_map(|half| split(held, grid, half, most)).collect()
}
