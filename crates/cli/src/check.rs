//! `delone check`: an exact verdict on anyone's triangles.

use delone::plane::verify::{Objection2, verify};

use crate::args::CheckArgs;
use crate::message::{Failure, answer, note};
use crate::progress::Phase;
use crate::stats::Stats;
use crate::{files, space};

pub(crate) fn run(args: &CheckArgs, quiet: bool) -> Result<(), Failure> {
    files::keep_apart(&args.input.paths_and(&args.mesh), args.input.stats.as_deref())?;
    if args.dim.is_space() {
        return space::check(args, quiet);
    }
    let mut stats = Stats::start();
    let cloud = files::points(&args.input, 2, quiet)?;
    let triangles = files::triangles(&args.mesh, quiet)?;
    stats.phase("read");
    let verdict = {
        let _phase = Phase::start(quiet, "checking");
        verify(&cloud.xy, &triangles)
    };
    stats.phase("check");
    stats.set("points", cloud.xy.len());
    stats.set("simplices", triangles.len());
    stats.set("delaunay", verdict.is_ok());
    stats.set("canonical", verdict.is_ok_and(|verdict| verdict.is_canonical()));
    if let Ok(verdict) = verdict {
        stats.set("duplicates", verdict.duplicates);
        stats.set("hull", verdict.hull);
        stats.set("clockwise", verdict.negative);
        stats.set("other_diagonals", verdict.other_ties);
    }
    stats.write(args.input.stats.as_deref())?;
    let verdict = match verdict {
        Ok(verdict) => verdict,
        Err(Objection2::Points(error)) => return Err(Failure::points(&args.input.label(), &error)),
        Err(objection) => {
            return Err(Failure::new(
                format!("{}: not Delaunay: {objection}", args.mesh.display()),
                "triangles and points are counted from 0",
            ));
        }
    };
    let count = triangles.len();
    let text = if verdict.is_canonical() {
        format!("Delaunay, and the canonical triangulation: {count} triangles\n")
    } else {
        let others = verdict.other_ties;
        format!(
            "Delaunay, not the canonical triangulation: {others} of its cocircular diagonals are the other one; {count} triangles\n"
        )
    };
    answer(&text)?;
    if verdict.negative > 0 {
        note(quiet, format_args!("{} triangles are clockwise", verdict.negative));
    }
    Ok(())
}
