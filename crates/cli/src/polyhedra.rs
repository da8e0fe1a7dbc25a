//! `delone voronoi --dim 3`: cells of space, in a region or in a box that repeats.

use std::borrow::Cow;
use std::path::{Path, PathBuf};

use delone::{
    Bounds, Cells3, CellularKind, DecimalGrid, Delaunay3, Lattice3, Periodic, Periodic3, PeriodicRegular3,
    Region3,
};
use delone_io::{Cloud, Contents, Cut, Format, Polyhedra, picture, write_polyhedra};

use crate::args::{CameraArgs, GridChoice, VoronoiArgs};
use crate::clip::is_polygon;
use crate::files;
use crate::message::{Failure, note};
use crate::progress::Phase;
use crate::repeated::{self, NO_GRID, tell_grid};
use crate::room::{self, Room};
use crate::stats::Stats;
use crate::weighted;

pub(crate) fn run(args: &VoronoiArgs, quiet: bool) -> Result<(), Failure> {
    refuse_flat(args)?;
    let of_numbers: Option<Lattice3> = args.space.of_numbers()?;
    let stats_path = args.input.stats.as_deref();
    let inputs: Vec<&Path> = args.input.paths().into_iter().chain(args.weights.file()).collect();
    let outputs = files::outputs_of(&args.output, args.to, stats_path, &inputs, as_cells)?;
    files::check_formats(&outputs, &[Contents::Polyhedra])?;
    let outputs = args.wkt.of(outputs)?;
    let has_neighbors = |format: Format| matches!(format, Format::Text | Format::Json | Format::Vtu);
    if args.space.least().is_some() && !outputs.iter().any(|(_, format)| has_neighbors(*format)) {
        return Err(Failure::usage(
            "neighbors are counted, and no output has room for their numbers",
            "write csv, json or vtu, or leave --min-area and --min-relative-area out",
        ));
    }
    if args.cut.is_given() && !outputs.iter().any(|(_, format)| matches!(format, Format::Svg | Format::Png)) {
        return Err(Failure::usage("--cut is for pictures", "write svg or png, or leave --cut out"));
    }
    files::keep_attributes(Contents::Polyhedra);
    let mut stats = Stats::start();
    let (points, weights, about) = weighted::read::<Delaunay3>(&args.input, &args.weights, quiet)?;
    stats.phase("read");
    let lattice = repeated::lattice(args, of_numbers, &about, quiet)?;
    let weights = args.weights.given().is_some().then_some(&weights[..]);
    let work = Work { args, points: &points, weights, about: &about, outputs: &outputs, quiet };
    match lattice {
        Some(lattice) => work.repeat(&lattice, &mut stats)?,
        None => work.clip(&mut stats)?,
    }
    stats.phase("write");
    stats.tell(quiet, Delaunay3::WORDS.simplex);
    stats.write(stats_path)
}

/// Refuses what is for the plane.
fn refuse_flat(args: &VoronoiArgs) -> Result<(), Failure> {
    let flat = [
        (args.order.is_some(), "--order"),
        (args.relax > 0, "--relax"),
        (args.sites.is_some(), "--sites"),
        (args.areas.is_some(), "--areas"),
        (args.merge.is_some(), "--merge"),
    ];
    if let Some((_, option)) = flat.iter().find(|option| option.0) {
        return Err(Failure::usage(
            format!("{option} is for cells in the plane"),
            format!("leave {option} or --dim 3 out"),
        ));
    }
    if is_polygon(args) {
        return Err(Failure::usage(
            "in space --clip takes box or hull, no file",
            "give --clip hull, or a box as --box x0,y0,z0,x1,y1,z1",
        ));
    }
    Ok(())
}

/// The format of a file of cells: of JSON that of its own, unless it is said to be GeoJSON.
fn as_cells(path: &Path, format: Format) -> Format {
    let name = path.to_string_lossy().to_lowercase();
    let is_geojson = name.trim_end_matches(".gz").ends_with(".geojson");
    if format == Format::GeoJson && !is_geojson { Format::Json } else { format }
}

/// Points, and the cells that are to be made of them.
struct Work<'a> {
    args: &'a VoronoiArgs,
    points: &'a [[f64; 3]],
    weights: Option<&'a [f64]>,
    about: &'a Cloud,
    outputs: &'a [(PathBuf, Format)],
    quiet: bool,
}

impl<'a> Work<'a> {
    fn failed(&self, error: &delone::Error) -> Failure {
        Failure::points(&self.args.input.label(), error)
    }

    /// Cells in a region.
    fn clip(&self, stats: &mut Stats) -> Result<(), Failure> {
        let grid = self.grid(stats)?;
        let points = match grid {
            None => Cow::Borrowed(self.points),
            Some(grid) => self.points.iter().map(|p| p.map(|x| grid.index(x))).collect(),
        };
        let cells = if let Some(weights) = self.weights {
            let weights: Vec<f64> = weights.iter().map(|&w| grid.map_or(w, |grid| grid.area(w))).collect();
            let phase = Phase::start(self.quiet, "triangulating");
            let r = Delaunay3::regular(&points, &weights, None).map_err(|error| self.failed(&error))?;
            drop(phase);
            weighted::tell(&r, stats, self.quiet);
            self.clipped(&points, grid, stats, |region| r.power().clip(region))?
        } else {
            let label = self.args.input.label();
            let d = room::build::<Delaunay3>(&points, Delaunay3::FASTEST, &label, self.quiet)?;
            stats.phase("build");
            room::remark(&d, self.quiet);
            stats.triangulation(&d, d.counters());
            self.clipped(&points, grid, stats, |region| d.voronoi().clip(region))?
        };
        self.write(Polyhedra::of_cells(self.points, &cells, grid), stats)
    }

    fn clipped(
        &self,
        points: &[[f64; 3]],
        grid: Option<DecimalGrid>,
        stats: &mut Stats,
        clip: impl Fn(&Region3) -> Cells3,
    ) -> Result<Cells3, Failure> {
        let region = region(self.args, points, grid)?;
        let _phase = Phase::start(self.quiet, "clipping");
        let cells = clip(&region);
        stats.phase("clip");
        Ok(cells)
    }

    /// The decimal grid that points are put on, if one is asked for.
    fn grid(&self, stats: &mut Stats) -> Result<Option<DecimalGrid>, Failure> {
        /// The largest integer up to which all are numbers.
        const MOST_STEPS: f64 = (1_u64 << 53) as f64;
        let grid = match self.args.space.grid {
            None => return Ok(None),
            Some(GridChoice::Step(grid)) => Some(grid),
            Some(GridChoice::Auto) => DecimalGrid::find(self.points.as_flattened()),
        };
        let Some(grid) = grid else {
            note(self.quiet, NO_GRID);
            return Ok(None);
        };
        let mut most = 0.0_f64;
        for (index, &x) in self.points.as_flattened().iter().enumerate() {
            if x.is_finite() && grid.index(x).abs() > MOST_STEPS {
                let axis = ["x", "y", "z"][index % 3];
                return Err(Failure::usage(
                    format!(
                        "--grid: point {} has the {axis} coordinate {x:?}, more steps than can be counted",
                        index / 3
                    ),
                    "choose a larger step, or --grid auto",
                ));
            }
            most = most.max((grid.nearest(x) - x).abs());
        }
        tell_grid(grid.step(), most, stats, self.quiet);
        Ok(Some(grid))
    }

    /// Cells in a box that repeats.
    fn repeat(&self, lattice: &Lattice3, stats: &mut Stats) -> Result<(), Failure> {
        let phase = Phase::start(self.quiet, "triangulating");
        if let Some(weights) = self.weights {
            let made = PeriodicRegular3::from_parts(self.points, weights, lattice);
            let made = made.map_err(|error| self.failed(&error))?;
            drop(phase);
            self.repeated(&made, stats)
        } else {
            let made = Periodic3::from_points(self.points, lattice);
            let made = made.map_err(|error| self.failed(&error))?;
            drop(phase);
            self.repeated(&made, stats)
        }
    }

    fn repeated<T: CellularKind<3, 4>>(
        &self,
        made: &Periodic<T, 3, 4>,
        stats: &mut Stats,
    ) -> Result<(), Failure> {
        stats.phase("build");
        repeated::tell(made, self.args, stats, self.quiet);
        let phase = Phase::start(self.quiet, "cutting cells");
        let cells = made.cells().map_err(|error| self.failed(&error))?;
        drop(phase);
        stats.phase("cells");
        let cells = Polyhedra::of_periodic(self.points, &cells);
        repeated::tell_beyond(made.vertices().count() - cells.count(), stats, self.quiet);
        self.write(cells, stats)
    }

    /// The cut of pictures, and their camera.
    fn picture(&self) -> Result<(Option<Cut>, picture::Options), Failure> {
        let CameraArgs { size, .. } = self.args.camera;
        let camera = self.args.camera.camera()?;
        Ok((self.args.cut.cut()?, picture::Options { size, camera, ..picture::Options::default() }))
    }

    fn write(&self, mut cells: Polyhedra<'a>, stats: &mut Stats) -> Result<(), Failure> {
        cells.crs = self.about.crs.as_ref();
        cells.least = self.args.space.least();
        (cells.cut, cells.picture) = self.picture()?;
        cells.features = files::are_attributes_kept().then_some(&self.about.features);
        stats.set("cells", cells.count());
        stats.set("volume", cells.volume());
        let _phase = Phase::start(self.quiet, "writing");
        for (path, format) in self.outputs {
            files::write_mesh(path, self.quiet, |out| write_polyhedra(out, *format, &cells))?;
        }
        Ok(())
    }
}

/// The region to clip to, in steps of the grid if there is one.
fn region(args: &VoronoiArgs, points: &[[f64; 3]], grid: Option<DecimalGrid>) -> Result<Region3, Failure> {
    const HELP: &str = "give a box with --box x0,y0,z0,x1,y1,z1";
    if args.clip == Path::new("hull") {
        return Region3::convex(points)
            .map_err(|_| Failure::new("the sites span no volume, so their hull has none", HELP));
    }
    let in_steps = |x: f64| grid.map_or(x, |grid| grid.in_steps(x));
    let [low, high] = match args.bounds[..] {
        [] => {
            let bounds = Bounds::of(points.iter().copied());
            [bounds.low, bounds.high]
        }
        [x0, y0, z0, x1, y1, z1] => [[x0, y0, z0], [x1, y1, z1]].map(|p| p.map(in_steps)),
        _ => {
            let what = "--box needs six numbers in space";
            return Err(Failure::usage(what, "give it as --box x0,y0,z0,x1,y1,z1"));
        }
    };
    Region3::cuboid(low, high).map_err(|error| {
        if args.bounds.is_empty() {
            Failure::new("the bounding box of the sites has no volume", HELP)
        } else {
            let help = "give it as --box x0,y0,z0,x1,y1,z1 with x0 < x1, y0 < y1 and z0 < z1";
            Failure::usage(format!("--box: {error}"), help)
        }
    })
}
