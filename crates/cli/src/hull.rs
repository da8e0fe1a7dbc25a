//! `delone hull`: the corners of the convex hull in the plane, the facets of that in space.

use delone::hull::spatial::{Hull3, Span};

use crate::args::HullArgs;
use crate::files;
use crate::message::{Failure, note};
use crate::progress::Phase;
use crate::stats::Stats;

pub(crate) fn run(args: &HullArgs, quiet: bool) -> Result<(), Failure> {
    let stats_path = args.input.stats.as_deref();
    files::keep_apart(&[&args.input.input], std::iter::once(args.output.as_path()).chain(stats_path))?;
    let format = files::index_format(&args.output, args.to)?;
    let mut stats = Stats::start();
    let cloud = files::points(&args.input, usize::from(args.dim), quiet)?;
    stats.phase("read");
    stats.set("points", cloud.xy.len());
    let failed = |error: delone::Error| Failure::points(&args.input.input, &error);
    let phase = Phase::start(quiet, "building");
    if args.dim == 2 {
        let hull = delone::convex_hull(&cloud.xy).map_err(failed)?;
        drop(phase);
        stats.phase("build");
        stats.set("hull", hull.len());
        let corners: Vec<i64> = hull.into_iter().map(|i| i as i64).collect();
        files::write(&args.output, |out| delone_io::write_index_list(out, format, &corners))?;
    } else {
        let Some(z) = &cloud.z else {
            return Err(Failure::new(
                format!("{}: the points have no third coordinate", args.input.input.display()),
                "leave --dim 3 out, or name three columns with --columns",
            ));
        };
        let points: Vec<[f64; 3]> = cloud.xy.iter().zip(z).map(|(&[x, y], &z)| [x, y, z]).collect();
        let hull = Hull3::of(&points).map_err(failed)?;
        drop(phase);
        stats.phase("build");
        if hull.span() < Span::Space {
            let span = format!("{:?}", hull.span()).to_lowercase();
            note(quiet, format_args!("the points span only this: {span}, so there are no facets"));
        }
        stats.set("dimension", format!("{:?}", hull.span()).to_lowercase());
        stats.set("hull", hull.corners().len());
        stats.set("faces", hull.faces().len());
        stats.set("simplices", hull.facets().count());
        let facets: Vec<i64> = hull.facets().flatten().map(|i| i as i64).collect();
        files::write(&args.output, |out| delone_io::write_indices(out, format, 3, &facets))?;
    }
    stats.phase("write");
    stats.write(stats_path)
}
