//! `delone check`: an exact verdict on anyone's simplices.

use crate::args::CheckArgs;
use crate::files;
use crate::message::{Failure, answer, note};
use crate::progress::Phase;
use crate::room::{self, Objection, Room};
use crate::stats::Stats;

pub(crate) fn run<R: Room>(args: &CheckArgs, quiet: bool) -> Result<(), Failure> {
    files::keep_apart(&args.input.paths_and(&args.mesh), args.input.stats.as_deref())?;
    let mut stats = Stats::start();
    let (points, _) = room::read::<R>(&args.input, quiet)?;
    let simplices = files::simplices(&args.mesh, quiet, R::read_simplices)?;
    stats.phase("read");
    let verdict = {
        let _phase = Phase::start(quiet, "checking");
        R::verify(&points, &simplices)
    };
    stats.phase("check");
    let words = R::WORDS;
    let (count, many) = (simplices.len(), words.simplex[1]);
    stats.set("points", points.len());
    stats.set("simplices", count);
    stats.set("delaunay", verdict.is_ok());
    stats.set("canonical", verdict.as_ref().is_ok_and(|verdict| verdict.is_canonical()));
    if let Ok(verdict) = &verdict {
        stats.set("duplicates", verdict.duplicates);
        stats.set("hull", verdict.hull);
        stats.set(words.negative[0], verdict.negative);
        stats.set(words.other[0], verdict.other_ties);
    }
    stats.write(args.input.stats.as_deref())?;
    let verdict = verdict.map_err(|objection| match objection {
        Objection::Points(error) => Failure::points(&args.input.label(), &error),
        Objection::Simplices(what) => Failure::new(
            format!("{}: not Delaunay: {what}", args.mesh.display()),
            format!("{many} and points are counted from 0"),
        ),
    })?;
    let text = if verdict.is_canonical() {
        format!("Delaunay, and the canonical triangulation: {count} {many}\n")
    } else {
        let others = format!("{} {}", verdict.other_ties, words.other[1]);
        format!("Delaunay, not the canonical triangulation: {others}; {count} {many}\n")
    };
    answer(&text)?;
    if verdict.negative > 0 {
        note(quiet, format_args!("{} {many} are {}", verdict.negative, words.negative[1]));
    }
    Ok(())
}
