//! `delone triangulate`: points in, simplices out.

use std::path::Path;

use clap::ValueEnum;

use crate::args::{AlgorithmName, DuplicatesName, LocateName, TriangulateArgs};
use crate::message::Failure;
use crate::room::{self, Room};
use crate::stats::Stats;
use crate::{constrained, files, instances, outcome, weighted};

pub(crate) fn run<R: Room>(args: &TriangulateArgs, quiet: bool) -> Result<(), Failure> {
    if args.max_edge.is_some() && R::is_space() {
        return Err(Failure::usage("--max-edge is for the plane", "leave it or --dim 3 out"));
    }
    if args.drop_slivers.is_some() && R::is_space() {
        return Err(Failure::usage("--drop-slivers is for the plane", "leave it or --dim 3 out"));
    }
    if args.duplicates != DuplicatesName::default() && R::is_space() {
        return Err(Failure::usage(
            "--duplicates is for heights, in the plane: in space equal points have one height",
            "leave it or --dim 3 out",
        ));
    }
    // A file that can have segments may have none.
    let mut is_graph = !R::is_space() && constrained::is_meant(&args.input, &args.graph);
    if args.fingerprint {
        is_graph = is_graph && (args.graph.is_given() || has_segments(args)?);
        refuse_beside_fingerprint(args, is_graph)?;
    }
    let by_points = args.algorithm.is_some() || args.strategy.locate.is_some() || args.hints.is_some();
    if args.graph.is_given() && (R::is_space() || by_points) {
        return Err(Failure::usage(
            "segments are for the plane and the default algorithm",
            "leave --segments, --crossings and --fill out, or --dim 3, --algorithm, --locate and --hints",
        ));
    }
    if args.weights.given().is_some() {
        if args.algorithm.is_some() || args.hints.is_some() || args.graph.is_given() {
            return Err(Failure::usage(
                "weights are for the default algorithm, and for points without segments",
                "leave --weights and --radii out, or --algorithm, --hints, --segments, --crossings and --fill",
            ));
        }
        return weighted::triangulate::<R>(args, quiet);
    }
    if is_graph && !by_points {
        args.strategy.refuse("segments")?;
        return constrained::triangulate(args, quiet);
    }
    if let Some(centers) = &args.hints {
        args.strategy.refuse("--hints")?;
        return instances::run::<R>(args, centers, quiet);
    }
    if let Some(path) = args.output.iter().find(|path| path.to_string_lossy().contains(instances::NAME)) {
        return Err(Failure::usage(
            format!("{}: {{}} in the name of an output is for instances of imprecise points", path.display()),
            "name their centers with --hints, or choose another name: several inputs are one set",
        ));
    }
    if args.hint_order.is_some() {
        return Err(Failure::usage("--hint-order is for --hints", "name the file of centers with --hints"));
    }
    let plan = R::plan(args.algorithm, &args.strategy)?;
    let stats_path = args.input.stats.as_deref();
    let outputs = args.wkt.of(files::outputs(&args.output, args.to, stats_path, &args.input.paths())?)?;
    room::check_formats::<R>(&outputs)?;
    let mut stats = Stats::start();
    let (points, mut about) = room::read::<R>(&args.input, quiet)?;
    stats.phase("read");
    let d: R = room::build(&points, plan.algorithm, &args.input.label(), quiet)?;
    stats.phase("build");
    room::settle(args.duplicates.rule(), &d, &mut about);
    let name = |value: &dyn Fn() -> Option<clap::builder::PossibleValue>| {
        value().map(|value| value.get_name().to_owned())
    };
    stats.set("algorithm", name(&|| plan.name.to_possible_value()));
    if let Some(locate) = plan.locate {
        stats.set("locate", name(&|| locate.to_possible_value()));
    }
    // Of the insertions one by one, that of space along a curve alone is shared.
    let is_shared = R::is_space() && plan.locate == Some(LocateName::Spatial);
    if plan.name == AlgorithmName::Incremental && !is_shared {
        stats.set("threads", 1);
    }
    outcome::finish(args, &outputs, &d, &points, &about, &mut stats, quiet)?;
    stats.write(stats_path)
}

/// Whether files that can have segments do. What is not read twice is taken to have some.
fn has_segments(args: &TriangulateArgs) -> Result<bool, Failure> {
    let is_read_twice = args.input.input.iter().all(|path| path.is_file());
    Ok(!is_read_twice || !files::graph(&args.input, None, true)?.segments.is_empty())
}

/// Fingerprints are of points alone, and alone on standard output.
fn refuse_beside_fingerprint(args: &TriangulateArgs, is_graph: bool) -> Result<(), Failure> {
    if is_graph || args.weights.given().is_some() || args.hints.is_some() {
        return Err(Failure::usage(
            "--fingerprint is for points without segments, weights and hints",
            "leave --fingerprint out, or those",
        ));
    }
    if args.output.iter().any(|path| path == Path::new("-")) {
        return Err(Failure::usage(
            "the fingerprint goes to standard output, and so would the triangles",
            "name a file for the triangles",
        ));
    }
    Ok(())
}
