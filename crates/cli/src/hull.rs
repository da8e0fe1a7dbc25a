//! `delone hull`: the corners of the convex hull.

use crate::args::HullArgs;
use crate::files;
use crate::message::Failure;
use crate::progress::Phase;
use crate::stats::Stats;

pub(crate) fn run(args: &HullArgs, quiet: bool) -> Result<(), Failure> {
    if args.dim == 3 {
        return Err(Failure::usage(
            "hulls in space (--dim 3) are not available in this version",
            "leave --dim out: x and y are taken",
        ));
    }
    let stats_path = args.input.stats.as_deref();
    files::keep_apart(&[&args.input.input], std::iter::once(args.output.as_path()).chain(stats_path))?;
    let format = files::index_format(&args.output, args.to)?;
    let mut stats = Stats::start();
    let cloud = files::points(&args.input, 2, quiet)?;
    stats.phase("read");
    let hull = {
        let _phase = Phase::start(quiet, "building");
        delone::convex_hull(&cloud.xy).map_err(|error| Failure::points(&args.input.input, &error))?
    };
    stats.phase("build");
    stats.set("points", cloud.xy.len());
    stats.set("hull", hull.len());
    let corners: Vec<i64> = hull.into_iter().map(|i| i as i64).collect();
    files::write(&args.output, |out| delone_io::write_index_list(out, format, &corners))?;
    stats.phase("write");
    stats.write(stats_path)
}
