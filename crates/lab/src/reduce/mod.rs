//! `delone-lab reduce`: the smallest set that still fails, as a test.
//!
//! Delta debugging (Zeller & Hildebrandt, "Simplifying and isolating failure-inducing input", TSE 2002): drop
//! ever smaller pieces as long as the rest still fails. O(n log n) trials when few points matter.

mod graph;

use std::panic::{self, AssertUnwindSafe};
use std::path::Path;
use std::process::{Command, Stdio};

use delone::verify::verify2;
use delone::{Algorithm2, Delaunay2};
use delone_cli::args::GraphArgs;
use delone_cli::message::{Failure, answer, note};
use delone_cli::progress::Phase;
use delone_cli::stats::Stats;
use delone_cli::{constrained, files};
use delone_io::{Format, TemporaryFolder};

use crate::args::ReduceArgs;

type Points = [[f64; 2]];

pub(crate) fn run(args: &ReduceArgs, quiet: bool) -> Result<(), Failure> {
    let is_graph = || constrained::is_meant(&args.input, &GraphArgs::default());
    if args.segments.is_some() || (args.against.is_none() && is_graph()) {
        return graph::run(args, quiet);
    }
    let stats_path = args.input.stats.as_deref();
    let outputs =
        args.wkt.of(files::outputs(args.output.as_slice(), None, stats_path, &args.input.paths())?)?;
    let mut stats = Stats::start();
    let points = files::points(&args.input, 2, quiet)?.xy;
    stats.phase("read");
    stats.set("points", points.len());
    let folder = TemporaryFolder::create(&std::env::temp_dir());
    let folder = folder.map_err(|error| Failure::new(error, "check the temporary folder"))?;
    let reason = |points: &Points| match &args.against {
        Some(command) => failure_of_command(command, points, folder.path()),
        None => Ok(failure_of_delone(points)),
    };
    let Some(first) = reason(&points)? else {
        answer("nothing to reduce: these points do not fail\n")?;
        stats.set("fails", false);
        return stats.write(args.input.stats.as_deref());
    };
    note(quiet, format_args!("{} points fail: {first}", points.len()));
    let small = {
        let _phase = Phase::start(quiet, "reducing");
        reduce(points, |points| reason(points).is_ok_and(|why| why.is_some()))
    };
    stats.phase("build");
    let why = reason(&small)?.unwrap_or(first);
    let rows: String = small.iter().map(|[x, y]| format!("        [{x:?}, {y:?}],\n")).collect();
    answer(&format!(
        "// {} points: {why}
#[test]
fn reduced() {{
    let points = [
{rows}    ];
    let d = delone::Delaunay2::from_points(&points).unwrap();
    assert_eq!(d.check(), Ok(()));
}}
",
        small.len()
    ))?;
    stats.set("fails", true);
    stats.set("reduced", small.len());
    for (path, format) in &outputs {
        files::write(path, |out| delone_io::write_points(out, *format, &small))?;
    }
    stats.phase("write");
    stats.write(args.input.stats.as_deref())
}

/// A subset that fails, nothing of which can be left out.
fn reduce<T: Copy>(mut all: Vec<T>, fails: impl Fn(&[T]) -> bool) -> Vec<T> {
    let mut piece = all.len() / 2;
    while piece > 0 {
        let mut at = 0;
        let before = all.len();
        while at < all.len() {
            let end = (at + piece).min(all.len());
            let rest: Vec<_> = all[..at].iter().chain(&all[end..]).copied().collect();
            if fails(&rest) {
                all = rest;
            } else {
                at = end;
            }
        }
        // Single ones are tried again until none goes.
        if piece > 1 {
            piece /= 2;
        } else if all.len() == before {
            break;
        }
    }
    all
}

/// A triangle from its least corner on, so that it has one form: negative zero compares as zero.
fn from_least([a, b, c]: [[f64; 2]; 3]) -> [[f64; 2]; 3] {
    if a < b && a < c {
        [a, b, c]
    } else if b < a && b < c {
        [b, c, a]
    } else {
        [c, a, b]
    }
}

/// Why Delone fails on some points, if it does: a panic, a failed check, two algorithms that disagree.
fn failure_of_delone(points: &Points) -> Option<String> {
    let build = |algorithm| {
        let attempt = panic::catch_unwind(AssertUnwindSafe(|| Delaunay2::with_algorithm(points, algorithm)));
        let d = attempt.map_err(|_| format!("{algorithm:?} panics"))?.map_err(|error| error.to_string())?;
        d.check().map_err(|flaw| format!("{algorithm:?}: {flaw}"))?;
        let mut triangles: Vec<_> =
            d.triangles().map(|corners| from_least(corners.map(|v| d.point(v)))).collect();
        triangles.sort_by(|a, b| a.partial_cmp(b).expect("finite"));
        Ok::<_, String>(triangles)
    };
    let outcome = build(Algorithm2::DivideAndConquer)
        .and_then(|fast| Ok((fast, build(Algorithm2::Incremental { seed: 0 })?)));
    match outcome {
        Err(why) => Some(why),
        Ok((fast, slow)) => (fast != slow).then(|| "the algorithms disagree".to_owned()),
    }
}

/// Why another program fails on some points, if it does; an error if it cannot be run at all.
fn failure_of_command(command: &str, points: &Points, folder: &Path) -> Result<Option<String>, Failure> {
    /// The exit codes of a shell for a program that is not there, or that it may not run.
    const NO_PROGRAM: [Option<i32>; 2] = [Some(127), Some(126)];
    let (input, output) = (folder.join("points.npy"), folder.join("triangles.npy"));
    _ = std::fs::remove_file(&output);
    files::write_own(&input, |out| delone_io::write_points(out, Format::Npy, points))?;
    let not_run = |why: String| {
        Failure::new(format!("the command {command:?} cannot be run: {why}"), "check the name of the program")
    };
    let text = command
        .replace("{points}", &input.display().to_string())
        .replace("{triangles}", &output.display().to_string());
    let status = Command::new("sh")
        .args(["-c", &text])
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status();
    match status {
        Err(error) => return Err(not_run(error.to_string())),
        Ok(status) if NO_PROGRAM.contains(&status.code()) => return Err(not_run(status.to_string())),
        Ok(status) if !status.success() => return Ok(Some(format!("the command fails ({status})"))),
        Ok(_) => {}
    }
    Ok(match files::simplices(&output, true, delone_io::read_triangles) {
        Err(_) => Some("the command writes no triangles".to_owned()),
        Ok(triangles) => verify2(points, &triangles).err().map(|objection| objection.to_string()),
    })
}

#[cfg(test)]
mod tests {
    use super::{failure_of_command, failure_of_delone, reduce};
    use delone_generators::Kind;

    #[test]
    fn reduces_to_the_points_that_matter() {
        let points = Kind::Uniform.points(500, 1);
        let culprits = [points[17], points[18], points[400]];
        let small = reduce(points, |points| culprits.iter().all(|p| points.contains(p)));
        assert_eq!(small, culprits);
        assert!(reduce(vec![[0.0; 2]; 5], |_| true).is_empty());
    }

    #[test]
    fn delone_does_not_fail() {
        assert_eq!(failure_of_delone(&Kind::SmallIntegers.points(300, 2)), None);
    }

    #[test]
    fn a_command_that_fails_is_seen() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let points = Kind::Uniform.points(5, 1);
        for (command, expected) in [("exit 3", "fails"), ("true", "no triangles")] {
            let why = failure_of_command(command, &points, folder.path()).expect("it runs");
            assert!(why.is_some_and(|why| why.contains(expected)), "{command}");
        }
        assert!(failure_of_command("no-such-program-anywhere", &points, folder.path()).is_err());
    }
}
