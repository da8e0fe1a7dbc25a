//! `delone-lab animate`: points in motion, and what the algorithms do, as moving pictures.

mod build;
mod locate;
mod motion;
mod scene;

use std::path::PathBuf;

use delone::Delaunay2;
use delone_cli::files;
use delone_cli::message::{Failure, note};
use delone_cli::progress::Phase;
use delone_cli::stats::Stats;
use delone_io::{Error, Format, Mesh, picture, write_mesh};

use crate::args::{AnimateArgs, Show};

/// The placeholder of the number of a picture in the name of an output.
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
    if args.radius.is_some() && !matches!(args.show, Show::Motion | Show::Hints) {
        return Err(Failure::usage(
            "--radius is for points that move",
            "choose --show motion or hints, or leave --radius out",
        ));
    }
    let mut stats = Stats::start();
    let cloud = files::points(&args.input, 2, quiet)?;
    stats.phase("read");
    if args.show != Show::Motion {
        let scene =
            scene::of(&cloud.xy, args).map_err(|error| Failure::points(&args.input.label(), &error))?;
        stats.phase("build");
        stats.set("points", cloud.xy.len());
        stats.set("pictures", scene.sketches.len());
        write_sketches(&scene, args, is_series.then_some(&outputs), quiet)?;
        stats.phase("write");
        return stats.write(stats_path);
    }
    let mut film = motion::Film::new(cloud.xy, args)?;
    stats.phase("build");
    let start = film.moving.triangulation();
    stats.triangulation(start, start.counters());
    write_motion(&mut film, args, is_series.then_some(&outputs), quiet)?;
    stats.phase("write");
    note(quiet, format_args!("{} steps repaired, {} rebuilt", film.repaired, film.rebuilt));
    stats.set("repaired", film.repaired);
    stats.set("rebuilt", film.rebuilt);
    stats.write(stats_path)
}

/// The files of a series.
type Series<'a> = Option<&'a Vec<(PathBuf, Format)>>;

/// Writes a motion as one file, or as a series.
fn write_motion(
    film: &mut motion::Film,
    args: &AnimateArgs,
    series: Series<'_>,
    quiet: bool,
) -> Result<(), Failure> {
    let options =
        picture::Options { size: args.size, window: Some(film.window), ..picture::Options::default() };
    let phase = Phase::count(quiet, "drawing", u64::from(args.steps) + 1);
    let draw = |d: &Delaunay2, on: &mut dyn FnMut(&Mesh<Delaunay2>) -> Result<(), Error>| {
        phase.advance();
        on(&Mesh::new(d, d.points()))
    };
    if let Some(files) = series {
        for (step, (path, format)) in files.iter().enumerate() {
            files::write(path, |out| {
                draw(film.at(step)?, &mut |mesh| write_mesh(out, *format, mesh, &options).map(drop))
            })?;
        }
        return Ok(());
    }
    files::write(&args.output, |out| {
        let (pictures, delay) = (args.steps + 1, args.delay());
        let mut animation = picture::Animation::start(out, film.window, pictures, delay, options)?;
        for step in 0..pictures as usize {
            draw(film.at(step)?, &mut |mesh| animation.add(mesh))?;
        }
        animation.finish()
    })
}

/// Writes the pictures of sketches.
fn write_sketches(
    scene: &scene::Scene,
    args: &AnimateArgs,
    series: Series<'_>,
    quiet: bool,
) -> Result<(), Failure> {
    let scene::Scene { sketches, window } = scene;
    let phase = Phase::count(quiet, "drawing", sketches.len() as u64);
    if let Some(files) = series {
        for (sketch, (path, format)) in sketches.iter().zip(files) {
            phase.advance();
            files::write(path, |out| picture::write_sketch(out, *format, sketch, *window, args.size))?;
        }
        return Ok(());
    }
    files::write(&args.output, |out| {
        let options = picture::Options { size: args.size, ..picture::Options::default() };
        let count = sketches.len() as u32;
        let mut animation = picture::Animation::start(out, *window, count, args.delay(), options)?;
        for sketch in sketches {
            phase.advance();
            animation.sketch(sketch)?;
        }
        animation.finish()
    })
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
