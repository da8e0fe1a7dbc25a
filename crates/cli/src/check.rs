//! `delone check`: an exact verdict on anyone's simplices.

use delone::verify::{Objection2, verify_constrained2};
use delone::{Constrained2, Delaunay2, Verdict};

use crate::args::{CheckArgs, GraphArgs};
use crate::message::{Failure, answer, note};
use crate::progress::Phase;
use crate::room::{self, Objection, Room, Words};
use crate::stats::Stats;
use crate::{constrained, files, weighted};

pub(crate) fn run<R: Room>(args: &CheckArgs, quiet: bool) -> Result<(), Failure> {
    if args.input.input.is_empty() {
        return Err(Failure::usage(
            format!("{}: points and triangles are needed", args.mesh.display()),
            "name the file of points, then the file of triangles; or a folder that delone tiles made",
        ));
    }
    let mut inputs = args.input.paths_and(&args.mesh);
    inputs.extend(args.segments.as_deref());
    inputs.extend(args.weights.file());
    files::keep_apart(&inputs, args.input.stats.as_deref())?;
    if args.segments.is_some() && R::is_space() {
        return Err(Failure::usage("--segments is for the plane", "leave it or --dim 3 out"));
    }
    let asked = GraphArgs { segments: args.segments.clone(), ..GraphArgs::default() };
    let has_weights = args.weights.given().is_some();
    if !R::is_space() && !has_weights && constrained::is_meant(&args.input, &asked) {
        return with_segments(args, quiet);
    }
    let mut stats = Stats::start();
    let (points, weights) = if has_weights {
        let (points, weights, _) = weighted::read::<R>(&args.input, &args.weights, quiet)?;
        (points, Some(weights))
    } else {
        (room::read::<R>(&args.input, quiet)?.0, None)
    };
    let simplices = files::simplices(&args.mesh, quiet, R::read_simplices)?;
    if !R::is_space() {
        files::tell_quads(&args.mesh, quiet)?;
    }
    stats.phase("read");
    let verdict = {
        let _phase = Phase::start(quiet, "checking");
        R::verify(&points, weights.as_deref(), &simplices)
    };
    stats.phase("check");
    stats.set("points", points.len());
    let many = R::WORDS.simplex[1];
    let help = format!("{many} and points are counted from 0");
    tell(args, &R::WORDS, (verdict, simplices.len()), &help, stats, quiet)
}

/// Judges triangles of points and segments, all of the hull.
fn with_segments(args: &CheckArgs, quiet: bool) -> Result<(), Failure> {
    let mut stats = Stats::start();
    let graph = files::graph(&args.input, args.segments.as_deref(), quiet)?;
    let triangles = files::simplices(&args.mesh, quiet, Delaunay2::read_simplices)?;
    files::tell_quads(&args.mesh, quiet)?;
    stats.phase("read");
    let (points, segments) = (&graph.cloud.xy, &graph.segments);
    let verdict = {
        let _phase = Phase::start(quiet, "checking");
        verify_constrained2(points, segments, &triangles)
    };
    stats.phase("check");
    stats.set("points", points.len());
    stats.set("segments", segments.len());
    let verdict = verdict.map_err(|objection| match objection {
        Objection2::Points(error) => Objection::Points(error),
        // Where segments cross, that is why one is missing.
        Objection2::Segment { .. } => match Constrained2::from_parts(points, segments) {
            Err(error) => Objection::Points(error),
            Ok(_) => Objection::Simplices(objection.to_string()),
        },
        other => Objection::Simplices(other.to_string()),
    });
    let help = "triangles, points and segments are counted from 0; all triangles of the hull are wanted, as \
                triangulate --fill all writes them";
    tell(args, &Delaunay2::WORDS, (verdict, triangles.len()), help, stats, quiet)
}

/// Says what was found of so many simplices.
fn tell(
    args: &CheckArgs,
    words: &Words,
    (verdict, count): (Result<Verdict, Objection>, usize),
    help: &str,
    mut stats: Stats,
    quiet: bool,
) -> Result<(), Failure> {
    let many = words.simplex[1];
    stats.set("simplices", count);
    let is_weighted = args.weights.given().is_some();
    let (key, name, not) = if is_weighted {
        ("regular", "Regular", "not regular")
    } else {
        ("delaunay", "Delaunay", "not Delaunay")
    };
    stats.set(key, verdict.is_ok());
    stats.set("canonical", verdict.as_ref().is_ok_and(|verdict| verdict.is_canonical()));
    if let Ok(verdict) = &verdict {
        stats.set("duplicates", verdict.duplicates);
        stats.set("hull", verdict.hull);
        stats.set(words.negative[0], verdict.negative);
        stats.set(words.other[0], verdict.other_ties);
    }
    stats.write(args.input.stats.as_deref())?;
    let verdict = verdict.map_err(|objection| match objection {
        Objection::Points(error) => Failure::graph(&args.input.label(), &error),
        Objection::Simplices(what) => Failure::new(format!("{}: {not}: {what}", args.mesh.display()), help),
    })?;
    let text = if verdict.is_canonical() {
        format!("{name}, and the canonical triangulation: {count} {many}\n")
    } else {
        let others = format!("{} {}", verdict.other_ties, words.other[1]);
        format!("{name}, not the canonical triangulation: {others}; {count} {many}\n")
    };
    answer(&text)?;
    if verdict.negative > 0 {
        note(quiet, format_args!("{} {many} are {}", verdict.negative, words.negative[1]));
    }
    Ok(())
}
