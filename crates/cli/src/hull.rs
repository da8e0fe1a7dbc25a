//! `delone hull`: the corners of the convex hull in the plane, the facets of that in space.

use std::path::PathBuf;

use delone::{Delaunay2, Delaunay3, Dimension, Error, Hull2, Hull3, HullHistory3};
use delone_io::{Contents, Direction, Format, Solid, picture};

use crate::args::{HullAlgorithm, HullArgs};
use crate::files;
use crate::message::{Failure, note};
use crate::progress::Phase;
use crate::room;
use crate::stats::{Stats, work_done};

pub(crate) fn run(args: &HullArgs, quiet: bool) -> Result<(), Failure> {
    let stats_path = args.input.stats.as_deref();
    let outputs = files::outputs(&args.output, args.to, stats_path, &args.input.paths())?;
    let mut stats = Stats::start();
    let is_random = !matches!(args.algorithm, None | Some(HullAlgorithm::Quickhull));
    if !args.dim.is_space() && args.algorithm.is_some() {
        return Err(Failure::usage(
            "--algorithm is for hulls in space",
            "leave --algorithm out, or give --dim 3",
        ));
    }
    if args.seed.is_some() && !is_random {
        return Err(Failure::usage(
            "--seed is for random orders",
            "choose --dim 3 --algorithm history or flips, or leave --seed out",
        ));
    }
    if args.dim.is_space() {
        space(args, &outputs, &mut stats, quiet)?;
    } else {
        plane(args, &outputs, &mut stats, quiet)?;
    }
    stats.phase("write");
    stats.tell(quiet, ["facet", "facets"]);
    stats.write(stats_path)
}

fn is_list(format: Format) -> bool {
    format.holds(Contents::Indices, Direction::Written)
}

/// The length up to which corners are left out, if any are.
fn merge<const D: usize>(args: &HullArgs, points: &[[f64; D]], stats: &mut Stats) -> Option<f64> {
    let length = args.merge?.of(points.iter().flatten().copied());
    stats.set("merge", length);
    Some(length)
}

/// Why corners within a length are not left out.
fn not_merged(args: &HullArgs, error: &Error) -> Failure {
    Failure::new(
        format!("{}: {error}", args.input.label().display()),
        "give a smaller --merge, or leave it out",
    )
}

fn plane(
    args: &HullArgs,
    outputs: &[(PathBuf, Format)],
    stats: &mut Stats,
    quiet: bool,
) -> Result<(), Failure> {
    if let Some((path, _)) = outputs.iter().find(|(_, format)| !is_list(*format)) {
        return Err(Failure::usage(
            format!("{}: a hull in the plane is a list of corners, written as npy or csv", path.display()),
            "choose one of these, or give --dim 3; delone alpha --alpha inf writes it as a polygon, delone draw as a picture",
        ));
    }
    let (points, _) = room::read::<Delaunay2>(&args.input, quiet)?;
    stats.phase("read");
    stats.set("points", points.len());
    let phase = Phase::start(quiet, "building");
    let hull = Hull2::from_points(&points).map_err(|error| Failure::points(&args.input.label(), &error))?;
    let hull = match merge(args, &points, stats) {
        Some(length) => hull.merged(&points, length).map_err(|error| not_merged(args, &error))?,
        None => hull,
    };
    drop(phase);
    stats.phase("build");
    stats.set("hull", hull.corners().len());
    let corners: Vec<i64> = hull.corners().iter().map(|&i| i as i64).collect();
    for (path, format) in outputs {
        files::write(path, |out| delone_io::write_index_list(out, *format, &corners))?;
    }
    Ok(())
}

fn space(
    args: &HullArgs,
    outputs: &[(PathBuf, Format)],
    stats: &mut Stats,
    quiet: bool,
) -> Result<(), Failure> {
    files::check_formats(outputs, &[Contents::Surfaces, Contents::Indices])?;
    let camera = args.camera.camera()?;
    let options = picture::Options { size: args.camera.size, camera, ..picture::Options::default() };
    let (points, _) = room::read::<Delaunay3>(&args.input, quiet)?;
    stats.phase("read");
    stats.set("points", points.len());
    let phase = Phase::start(quiet, "building");
    let seed = args.seed.unwrap_or_default();
    let hull = match args.algorithm.unwrap_or(HullAlgorithm::Quickhull) {
        HullAlgorithm::Quickhull => Hull3::from_points(&points),
        HullAlgorithm::History => {
            let history = HullHistory3::from_points(&points, seed);
            let work = history.as_ref().ok().and_then(|history| history.counters().work());
            stats.set("counters", work_done(&work.unwrap_or_default()));
            history.map(|history| history.hull().clone())
        }
        HullAlgorithm::Flips => Hull3::by_flips(&points, seed).map(|(hull, counters)| {
            stats.set("counters", work_done(&counters.work().unwrap_or_default()));
            hull
        }),
    }
    .map_err(|error| Failure::points(&args.input.label(), &error))?;
    let hull = match merge(args, &points, stats) {
        Some(length) => hull.merged(&points, length).map_err(|error| not_merged(args, &error))?,
        None => hull,
    };
    drop(phase);
    stats.phase("build");
    let span = format!("{:?}", hull.dimension()).to_lowercase();
    if hull.dimension() < Dimension::Space {
        note(quiet, format_args!("the points span only this: {span}, so there are no facets"));
    }
    stats.set("dimension", span);
    stats.set("hull", hull.corners().len());
    stats.set("faces", hull.faces().len());
    stats.set("simplices", hull.facets().count());
    let _phase = Phase::start(quiet, "writing");
    let solid = Solid::of_hull(&hull, &points);
    for (path, format) in outputs {
        if is_list(*format) {
            let facets: Vec<i64> = hull.facets().flatten().map(|i| i as i64).collect();
            files::write(path, |out| delone_io::write_indices(out, *format, 3, &facets))?;
        } else {
            files::write_mesh(path, quiet, |out| delone_io::write_solid(out, *format, &solid, &options))?;
        }
    }
    Ok(())
}
