//! `delone generate`: named sets of points.

use delone_oracle::generate::Kind;

use crate::args::GenerateArgs;
use crate::files;
use crate::message::{Failure, answer};
use crate::progress::Phase;
use crate::stats::Stats;

pub(crate) fn run(args: &GenerateArgs, quiet: bool) -> Result<(), Failure> {
    if args.kind == "list" {
        let line = |kind: &Kind| format!("{:15} {}\n", kind.name(), kind.about());
        return answer(&Kind::ALL.iter().map(line).collect::<String>());
    }
    let kind = Kind::named(&args.kind).ok_or_else(|| {
        Failure::usage(format!("there is no set named {:?}", args.kind), "see delone generate list")
    })?;
    if args.output.is_none() {
        return Err(Failure::usage(
            "the output file is missing",
            "add -o FILE, or -o - --to csv for standard output",
        ));
    }
    if args.n > delone::MAX_POINTS {
        return Err(Failure::usage(
            format!("{} points are too many", args.n),
            format!("at most {} fit one triangulation", delone::MAX_POINTS),
        ));
    }
    let mut stats = Stats::start();
    let outputs = files::outputs(args.output.as_slice(), args.to, args.stats.as_deref(), &[])?;
    let points = {
        let _phase = Phase::start(quiet, "generating");
        kind.points(args.n, args.seed)
    };
    stats.set("points", points.len());
    stats.phase("build");
    let _phase = Phase::start(quiet, "writing");
    for (path, format) in &outputs {
        files::write(path, |out| delone_io::write_points(out, *format, &points))?;
    }
    stats.phase("write");
    stats.write(args.stats.as_deref())
}
