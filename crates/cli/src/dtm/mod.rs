//! `delone dtm`: points with heights to a raster of terrain, in memory or in tiles on disk.
//!
//! The raster is made in bands of rows, so it may be larger than memory. Which triangle a cell is in is exact, and what it has depends
//! on the points alone: the same file comes out with and without `--memory`.

mod bands;
mod failure;
mod inputs;

use std::mem::ManuallyDrop;
use std::path::{Path, PathBuf};

use delone_io::{Cloud, Contents, ContourMap, Crs, Direction, Format, besides_of_raster, write_contours};
use delone_store::Store;
use delone_terrain::{Clip, Options, Product, Surface, Terrain, Tiled, is_map};

use crate::args::DtmArgs;
use crate::files;
use crate::message::{Failure, grouped, say, warn};
use crate::place::Place;
use crate::progress::Phase;
use crate::stats::Stats;
use crate::tiles::Watched;
use failure::failure;

/// The rows of a band where tiles are small for tests.
const ROWS_OF_TESTS: usize = 7;

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
            // The folder itself is locked, so that others leave it alone.
            let tiles = folder.path().join("tiles");
            let store = {
                let watch = Watched::of(&tiles, &mut stats, quiet).until_read();
                inputs::tiles(args, &input, (&tiles, memory), &watch)?
            };
            job.in_tiles(store, memory, &tiles, &mut stats)?;
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
        let has_lines = !lines.is_empty();
        let phase = Phase::start(quiet, "triangulating");
        let made = Terrain::new(cloud, lines, &self.place.cells, &self.options());
        let terrain = made.map_err(|error| failure(&self.label, error))?;
        drop(phase);
        let terrain = ManuallyDrop::new(self.finished(terrain, crs)?);
        let counts = terrain.surface().map(Surface::counts).unwrap_or_default();
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
            let drawn = terrain.contours(args.interval);
            contours = drawn.map_err(|error| failure(&self.label, error))?;
            stats.set("lines", contours.len());
        }
        let map = ContourMap { lines: &contours, bands: &[], crs: terrain.crs() };
        for (path, format) in maps {
            files::write(path, |out| write_contours(out, *format, &map, 0))?;
        }
        self.rasters(&terrain, stats)
    }

    fn in_tiles(
        &mut self,
        (store, about): (Store, Cloud),
        memory: u64,
        folder: &Path,
        stats: &mut Stats,
    ) -> Result<(), Failure> {
        let Self { args, quiet, .. } = *self;
        let summary = store.summary();
        inputs::check_count(summary.points, &self.label, args)?;
        stats.set("points", summary.points);
        stats.set("duplicates", summary.duplicates);
        stats.set("vertices", summary.vertices);
        stats.set("simplices", summary.triangles);
        stats.set("hull", summary.hull);
        stats.set("tiles", summary.tiles);
        let watch = Watched::new(folder, quiet);
        let tiles = Tiled::new(store, memory, &self.options(), &watch)
            .map_err(|error| failure(&self.label, error))?
            .rows(args.tile.map(|_| ROWS_OF_TESTS));
        stats.phase("build");
        let crs = self.crs(&about);
        let terrain = Terrain::of_tiles(tiles, &self.place.cells);
        let terrain = self.finished(terrain.map_err(|error| failure(&self.label, error))?, crs)?;
        self.rasters(&terrain, stats)
    }

    /// How the surface is made.
    fn options(&self) -> Options {
        let args = self.args;
        Options::new()
            .method(args.method.method())
            .duplicates(args.duplicates.rule())
            .border(args.edges.border())
    }

    /// The model with its system and its polygons; tells its remarks.
    fn finished(&mut self, terrain: Terrain, crs: Option<Crs>) -> Result<Terrain, Failure> {
        let terrain = terrain.with_crs(crs);
        terrain.remarks().iter().for_each(|remark| inputs::tell(remark, None, self.quiet));
        match self.clip.take() {
            Some(clip) => terrain.clipped(clip).map_err(|error| failure(&self.label, error)),
            None => Ok(terrain),
        }
    }

    fn rasters(&self, terrain: &Terrain, stats: &mut Stats) -> Result<(), Failure> {
        let product = Product::new()
            .nodata(self.args.nodata)
            .compression(self.args.compress.into())
            .relief(self.args.light.hillshade());
        let rasters: Vec<_> = self.outputs.iter().filter(|output| !is_map(output.1)).cloned().collect();
        if rasters.is_empty() {
            stats.tell(self.quiet, ["triangle", "triangles"]);
            return Ok(());
        }
        let failed = |error| failure(&self.label, error);
        let (grid, bands) = (terrain.grid(), terrain.bands().map_err(failed)?);
        let known = bands::write(&rasters, (grid, terrain.crs(), &product), &bands, self.quiet, |rows| {
            terrain.rows(rows).map_err(failed)
        })?;
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

    fn crs(&self, about: &Cloud) -> Option<Crs> {
        let crs = self.place.crs(about.crs.as_ref());
        if crs.is_none() && self.outputs.iter().any(|output| output.1 == Format::Tiff) {
            warn(self.quiet, "the files do not tell their system of coordinates: name it with --epsg");
        }
        crs
    }
}
