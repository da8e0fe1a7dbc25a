//! `delone voronoi --medial-axis`: the middle lines of polygons, with widths.

use std::path::PathBuf;

use delone::{Constrained2, Crossings, MedialAxis2};
use delone_io::{Edges, Format, write_edges};

use crate::antimeridian;
use crate::args::VoronoiArgs;
use crate::constrained::features::shells_of;
use crate::files;
use crate::lines::{tell_left, tolerance_of};
use crate::message::{Failure, grouped, say};
use crate::progress::Phase;
use crate::stats::Stats;
use crate::weld;

pub(crate) fn run(
    args: &VoronoiArgs,
    angle: f64,
    outputs: &[(PathBuf, Format)],
    mut stats: Stats,
    quiet: bool,
) -> Result<(), Failure> {
    let label = args.input.label();
    let mut graph = files::polygons(&args.input, quiet)?;
    antimeridian::heed(&mut graph, args.antimeridian, &args.input, &mut stats, quiet)?;
    weld::weld(&mut graph, args.weld, &label, &mut stats, quiet)?;
    tell_left(&graph, quiet);
    stats.phase("read");
    let refused = |error: delone::Error| Failure::graph(&label, &error);
    let sides = graph.rings.iter().flat_map(|ring| &graph.segments[ring.segments.clone()]);
    let sides: Vec<[usize; 2]> = sides.copied().collect();
    let c = Constrained2::with_crossings(&graph.cloud.xy, &sides, Crossings::Split).map_err(refused)?;
    // Where polygons overlap, the borders of all count.
    let rings = graph.rings.iter().enumerate();
    let ring_of: Vec<usize> =
        rings.flat_map(|(number, ring)| std::iter::repeat_n(number, ring.segments.len())).collect();
    let domains = c.shells_minus_holes(|s| ring_of.get(s.index()).copied(), &shells_of(&graph));
    let tolerance = if args.tolerance > 0.0 { args.tolerance } else { tolerance_of(&graph.cloud.xy) };
    stats.set("tolerance", tolerance);
    let axis = {
        let _phase = Phase::start(quiet, "placing sites");
        if tolerance > 0.0 {
            MedialAxis2::new(&c, &domains, tolerance, angle)
                .map_err(|error| Failure::usage(error, "see delone voronoi --help"))?
        } else {
            MedialAxis2::default() // All is in one place.
        }
    };
    stats.phase("build");
    let edges = Edges {
        points: &axis.points,
        pairs: &axis.edges,
        widths: Some(&axis.widths),
        crs: graph.cloud.crs.as_ref(),
    };
    let length = edges.lengths().fold(0.0, |sum, length| sum + length);
    let counts = [("points", graph.cloud.xy.len()), ("sites", axis.sites), ("edges", axis.edges.len())];
    counts.iter().for_each(|&(name, count)| stats.set(name, count));
    stats.set("deviation", axis.deviation);
    stats.set("length", length);
    for (path, format) in outputs {
        files::write(path, |out| write_edges(out, *format, &edges))?;
    }
    stats.phase("write");
    let [count, sites] = [axis.edges.len(), axis.sites].map(|count| grouped(count as u64));
    let (off, seconds) = (axis.deviation, stats.total());
    say(
        quiet,
        format_args!(
            "{count} edges of the length {length}, {sites} sites along the border, within {off:.3e} ({seconds:.2} s)"
        ),
    );
    stats.write(args.input.stats.as_deref())
}
