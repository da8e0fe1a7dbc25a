//! `delone contours`: points with heights in, lines and areas of heights out.

use delone::Delaunay2;
use delone::surface::{Contours, Levels};
use delone_io::{Contents, ContourMap, Format, write_contours};

use crate::args::ContoursArgs;
use crate::files;
use crate::message::Failure;
use crate::progress::Phase;
use crate::room::{self, Room};
use crate::stats::Stats;

pub(crate) fn run(args: &ContoursArgs, quiet: bool) -> Result<(), Failure> {
    let stats_path = args.input.stats.as_deref();
    let outputs = files::outputs(&args.output, args.to, stats_path, &args.input.paths())?;
    files::check_formats(&outputs, &[Contents::Contours])?;
    let mut stats = Stats::start();
    let (points, mut heights, about) = files::surface(&args.input, quiet)?;
    stats.phase("read");
    args.duplicates.rule().settle_equal(&points, &mut heights);
    let label = args.input.label();
    let refused = |error| Failure::points(&label, &error);
    let d: Delaunay2 = room::build(&points, Delaunay2::FASTEST, &label, quiet)?;
    room::remark(&d, quiet);
    stats.phase("build");
    stats.triangulation(&d, d.counters());
    let trim = room::trim_border(&d, &args.edges.border(), &mut stats, quiet);
    let phase = Phase::start(quiet, "drawing contours");
    let kept = |t: delone::TriangleId| trim.as_ref().is_none_or(|trim| trim.keeps(t.index()));
    let surface = Contours::of_triangles(&d, &heights, kept).map_err(refused)?;
    let wrong =
        |error: delone::Error| Failure::usage(error, "give other heights with --interval or --levels");
    let levels = match args.interval {
        None => Levels::given(&args.levels),
        // Nothing to be drawn is drawn at any height.
        Some(interval) => {
            Levels::every(interval, args.base.unwrap_or(0.0), surface.range().unwrap_or_default())
        }
    }
    .map_err(wrong)?;
    let is_picture = |format: Format| matches!(format, Format::Svg | Format::Png);
    let bands = if args.bands { surface.bands(&levels).map_err(wrong)? } else { Vec::new() };
    let needs_lines = !args.bands || outputs.iter().any(|(_, format)| is_picture(*format));
    let lines = if needs_lines { surface.lines(&levels).map_err(wrong)? } else { Vec::new() };
    drop(phase);
    stats.phase("contours");
    stats.set("levels", levels.values().len());
    stats.set("lines", lines.len());
    stats.set("bands", bands.len());
    let _phase = Phase::start(quiet, "writing");
    for (path, format) in &outputs {
        let lines = if args.bands && !is_picture(*format) { &[][..] } else { &lines[..] };
        let crs = files::drawn_system(about.crs.as_ref(), *format);
        let map = ContourMap { lines, bands: &bands, crs: crs.as_ref() };
        files::write(path, |out| write_contours(out, *format, &map, args.size))?;
    }
    stats.phase("write");
    stats.tell(quiet, Delaunay2::WORDS.simplex);
    stats.write(stats_path)
}
