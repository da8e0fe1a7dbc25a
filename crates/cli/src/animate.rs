//! `delone animate`: points in Brownian motion (Devillers 2011, §5), and their triangulation kept up.

use std::path::PathBuf;

use delone::{Bounds, Delaunay2, Moving2, Step2};
use delone_generators::{Random, in_ball};
use delone_io::{Error, Format, Mesh, picture, write_mesh};

use crate::args::AnimateArgs;
use crate::files;
use crate::message::{Failure, note};
use crate::progress::Phase;
use crate::stats::Stats;

/// What stands for the number of a picture in the name of an output.
const NUMBER: &str = "{}";

pub(crate) fn run(args: &AnimateArgs, quiet: bool) -> Result<(), Failure> {
    let is_series = args.output.to_string_lossy().contains(NUMBER);
    let stats_path = args.input.stats.as_deref();
    let outputs = files::outputs(&names(args, is_series), args.to, stats_path, &args.input.paths())?;
    let shows = |format: Format| format == Format::Png || (is_series && format == Format::Svg);
    if let Some((path, format)) = outputs.iter().find(|(_, format)| !shows(*format)) {
        return Err(Failure::usage(
            format!("{}: {format} is no moving picture", path.display()),
            "write one png, or a series of png or svg with {} in its name: -o 'frame-{}.png'",
        ));
    }
    if args.radius.is_some_and(|radius| !radius.is_finite() || radius < 0.0) {
        return Err(Failure::usage("--radius is a length", "as in --radius 0.5, in coordinate units"));
    }
    let mut stats = Stats::start();
    let cloud = files::points(&args.input, 2, quiet)?;
    stats.phase("read");
    let mut film = Film::new(cloud.xy, args)?;
    stats.phase("build");
    let start = film.moving.triangulation();
    stats.triangulation(start, start.counters());
    let options =
        picture::Options { size: args.size, window: Some(film.window), ..picture::Options::default() };
    {
        let phase = Phase::count(quiet, "drawing", u64::from(args.steps) + 1);
        let draw = |d: &Delaunay2, on: &mut dyn FnMut(&Mesh<Delaunay2>) -> Result<(), Error>| {
            phase.advance();
            on(&Mesh::new(d, d.points()))
        };
        if is_series {
            for (step, (path, format)) in outputs.iter().enumerate() {
                files::write(path, |out| {
                    draw(film.at(step)?, &mut |mesh| write_mesh(out, *format, mesh, &options).map(drop))
                })?;
            }
        } else {
            files::write(&args.output, |out| {
                let (pictures, delay) = (args.steps + 1, args.delay);
                let mut animation = picture::Animation::start(out, film.window, pictures, delay, options)?;
                for step in 0..pictures as usize {
                    draw(film.at(step)?, &mut |mesh| animation.add(mesh))?;
                }
                animation.finish()
            })?;
        }
    }
    stats.phase("write");
    note(quiet, format_args!("{} steps repaired, {} rebuilt", film.repaired, film.rebuilt));
    stats.set("repaired", film.repaired);
    stats.set("rebuilt", film.rebuilt);
    stats.write(stats_path)
}

/// The file of the animation, or of each of its pictures.
fn names(args: &AnimateArgs, is_series: bool) -> Vec<PathBuf> {
    if !is_series {
        return vec![args.output.clone()];
    }
    let digits = args.steps.to_string().len();
    let name = |step: u32| args.output.to_string_lossy().replace(NUMBER, &format!("{step:0>digits$}"));
    (0..=args.steps).map(|step| name(step).into()).collect()
}

/// Points that move at random inside of their box.
struct Film {
    moving: Moving2,
    positions: Vec<[f64; 2]>,
    window: [[f64; 2]; 2],
    radius: f64,
    random: Random,
    repaired: usize,
    rebuilt: usize,
}

impl Film {
    fn new(positions: Vec<[f64; 2]>, args: &AnimateArgs) -> Result<Self, Failure> {
        let moving =
            Moving2::from_points(&positions).map_err(|error| Failure::points(&args.input.label(), &error))?;
        let bounds = Bounds::of(positions.iter().copied());
        // A window has finite corners, around no point too.
        let [low, high] = [bounds.low, bounds.high].map(|corner| corner.map(|x| x.clamp(f64::MIN, f64::MAX)));
        // A tenth of the distance of neighbours in an even set.
        let longer = [0, 1].into_iter().map(|k| high[k] / 2.0 - low[k] / 2.0).fold(0.0, f64::max);
        let radius = args.radius.unwrap_or(0.2 * longer / (positions.len().max(1) as f64).sqrt());
        let random = Random::new(args.seed);
        Ok(Self { moving, positions, window: [low, high], radius, random, repaired: 0, rebuilt: 0 })
    }

    /// The triangulation at a step: the start, or one step after the last.
    fn at(&mut self, step: usize) -> Result<&Delaunay2, Error> {
        if step > 0 {
            let [low, high] = self.window;
            for p in &mut self.positions {
                let shift: [f64; 2] = in_ball(&mut self.random);
                // Those that reach the border stay there until they turn.
                *p = [0, 1].map(|k| (p[k] + self.radius * shift[k]).clamp(low[k], high[k]));
            }
            let step =
                self.moving.step(&self.positions).map_err(|error| Error::Content(error.to_string()))?;
            match step {
                Step2::Repaired { .. } => self.repaired += 1,
                _ => self.rebuilt += 1,
            }
        }
        Ok(self.moving.triangulation())
    }
}
