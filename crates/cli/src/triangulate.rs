//! `delone triangulate`: points in, triangles out.

use std::path::{Path, PathBuf};

use clap::ValueEnum;
use delone::{Algorithm2, Delaunay2, Dimension};
use delone_io::{Cloud, Format, Surface, Trim};

use crate::args::{AlgorithmName, LocateName, TriangulateArgs};
use crate::message::{Failure, note};
use crate::progress::Phase;
use crate::stats::Stats;
use crate::{files, instances, space};

pub(crate) fn run(args: &TriangulateArgs, quiet: bool) -> Result<(), Failure> {
    if let Some(centres) = &args.hints {
        return instances::run(args, centres, quiet);
    }
    if let Some(path) = args.output.iter().find(|path| path.to_string_lossy().contains(instances::NAME)) {
        return Err(Failure::usage(
            format!("{}: {{}} in the name of an output is for instances of imprecise points", path.display()),
            "name their centres with --hints, or choose another name: several inputs are one set",
        ));
    }
    if args.dim.is_space() {
        return space::triangulate(args, quiet);
    }
    let name = args.algorithm.unwrap_or(AlgorithmName::DivideConquer);
    if args.locate.is_some() && name != AlgorithmName::Incremental {
        return Err(Failure::usage(
            "--locate is for the incremental algorithm",
            "add --algorithm incremental",
        ));
    }
    let stats_path = args.input.stats.as_deref();
    let outputs = files::outputs(&args.output, args.to, stats_path, &args.input.paths())?;
    check_formats(&outputs)?;
    let mut stats = Stats::start();
    let mut cloud = files::points(&args.input, 2, quiet)?;
    stats.phase("read");
    let algorithm = match name {
        AlgorithmName::DivideConquer => Algorithm2::DivideAndConquer,
        AlgorithmName::Incremental => incremental(args.locate.unwrap_or(LocateName::Spatial), args.seed),
    };
    let xy = std::mem::take(&mut cloud.xy);
    let triangulation = build(xy, algorithm, &args.input.label(), quiet)?;
    stats.phase("build");
    stats.set(
        "algorithm",
        if algorithm == Algorithm2::DivideAndConquer { "divide-conquer" } else { "incremental" },
    );
    if name == AlgorithmName::Incremental {
        let locate = args.locate.unwrap_or(LocateName::Spatial).to_possible_value();
        stats.set("locate", locate.map(|value| value.get_name().to_owned()));
    }
    finish(args, &outputs, &triangulation, &cloud, &mut stats, quiet)?;
    if algorithm == Algorithm2::DivideAndConquer {
        stats.set("threads", rayon::current_num_threads());
    }
    stats.write(stats_path)
}

/// Refuses formats that hold no triangles.
pub(crate) fn check_formats(outputs: &[(PathBuf, Format)]) -> Result<(), Failure> {
    match outputs.iter().find(|(_, format)| !format.holds_meshes()) {
        Some((path, format)) => Err(Failure::file(path, &delone_io::Error::NotAMesh(*format))),
        None => Ok(()),
    }
}

/// Remarks, checks, counts and writes.
pub(crate) fn finish(
    args: &TriangulateArgs,
    outputs: &[(PathBuf, Format)],
    triangulation: &Delaunay2,
    cloud: &Cloud,
    stats: &mut Stats,
    quiet: bool,
) -> Result<(), Failure> {
    stats.set("threads", 1);
    remark(triangulation, quiet);
    if args.check {
        let _phase = Phase::start(quiet, "checking");
        triangulation.check().map_err(|flaw| {
            Failure::new(
                format!("the triangulation is wrong: {flaw}"),
                "please report this with the input: it is a bug",
            )
        })?;
        stats.phase("check");
        note(quiet, "checked: this is the canonical Delaunay triangulation");
    }
    stats.triangulation(triangulation);
    let trim = trim(triangulation, args.max_edge, stats);
    let surface = surface(triangulation, cloud, trim.as_ref());
    let phase = Phase::start(quiet, "writing");
    for (path, format) in outputs {
        files::write_mesh(path, quiet, |out| delone_io::write_surface(out, *format, &surface))?;
    }
    drop(phase);
    stats.phase("write");
    stats.tell(quiet, ["triangle", "triangles"]);
    Ok(())
}

/// What is left out for its length.
pub(crate) fn trim(d: &Delaunay2, longest: Option<f64>, stats: &mut Stats) -> Option<Trim> {
    let trim = Trim::long_edges(d, longest?);
    stats.set("left_out", trim.count());
    Some(trim)
}

/// What is written of a triangulation.
pub(crate) fn surface<'a>(d: &'a Delaunay2, cloud: &'a Cloud, trim: Option<&'a Trim>) -> Surface<'a> {
    Surface {
        heights: cloud.z.as_deref(),
        crs: cloud.crs.as_ref(),
        base: cloud.base,
        trim,
        ..Surface::new(d)
    }
}

/// The incremental algorithm with a way to locate points.
fn incremental(locate: LocateName, seed: u64) -> Algorithm2 {
    match (locate.strategy(seed), locate) {
        (Some(locate), _) => Algorithm2::Located { locate, seed },
        (None, LocateName::Conflict) => Algorithm2::ConflictLists { seed },
        (None, _) => Algorithm2::Incremental { seed },
    }
}

/// Triangulates, with progress.
pub(crate) fn build(
    xy: Vec<[f64; 2]>,
    algorithm: Algorithm2,
    input: &Path,
    quiet: bool,
) -> Result<Delaunay2, Failure> {
    let _phase = Phase::start(quiet, "triangulating");
    Delaunay2::with_algorithm(&xy, algorithm).map_err(|error| Failure::points(input, &error))
}

/// Notes on what might surprise.
pub(crate) fn remark(d: &Delaunay2, quiet: bool) {
    let (points, duplicates) = (d.points().len(), d.duplicates().count());
    if duplicates > 0 {
        let text = match duplicates {
            1 => "equals an earlier one and is no vertex",
            _ => "equal earlier ones and are no vertices",
        };
        note(quiet, format_args!("{duplicates} of {points} points {text}"));
    }
    match d.dimension() {
        Dimension::Empty => note(quiet, "there are no points, so there are no triangles"),
        Dimension::Point => note(quiet, "there is only one distinct point, so there are no triangles"),
        Dimension::Line => note(quiet, "all points are on one line, so there are no triangles"),
        Dimension::Plane | Dimension::Space => {}
    }
}
