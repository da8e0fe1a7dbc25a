//! `delone voronoi --of lines|areas`: the places nearest to each line or area.

use delone_predicates::hypotenuse;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use delone::{
    Bounds, Constrained2, Crossings, Delaunay2, Fill, LineCells2, Membership2, Overlaps2, PolygonRegion2,
    SegmentId,
};
use delone_io::{Format, Graph, LineDiagram, Rows};

use crate::antimeridian;
use crate::args::{OfName, VoronoiArgs};
use crate::clip::{is_polygon, polygon_region, region};
use crate::files;
use crate::message::{Failure, grouped, lost, note, say};
use crate::progress::Phase;
use crate::room::{self, Room};
use crate::stats::Stats;
use crate::weld;

/// The tolerance if none is given, as a part of the diagonal of the region.
const PART_OF_DIAGONAL: f64 = 1e-3;

pub(crate) fn run(
    args: &VoronoiArgs,
    outputs: &[(PathBuf, Format)],
    sites_format: Option<Format>,
    mut stats: Stats,
    quiet: bool,
) -> Result<(), Failure> {
    let label = args.input.label();
    let mut graph = match args.of {
        OfName::Areas => files::polygons(&args.input, quiet)?,
        _ => files::graph(&args.input, None, quiet)?,
    };
    antimeridian::heed(&mut graph, args.antimeridian, &args.input, &mut stats, quiet)?;
    weld::weld(&mut graph, args.weld, &label, &mut stats, quiet)?;
    let rings = if is_polygon(args) {
        antimeridian::rings_beside(&args.clip, args.antimeridian, &mut stats, quiet)?
    } else {
        Vec::new()
    };
    if args.of == OfName::Areas && graph.is_border.contains(&false) {
        lost(quiet, "lines are left out: they are no areas");
    }
    if graph.segments.is_empty() {
        let help = "leave --of out for the cells of points";
        return Err(Failure::new(format!("{}: there is no line in it", label.display()), help));
    }
    tell_left(&graph, quiet);
    let lines = Lines::of(&graph, args.of);
    stats.phase("read");
    if args.of == OfName::Areas {
        tell_overlaps(&graph, &lines, &label, quiet)?;
    }
    let given: Delaunay2 = room::build(&graph.cloud.xy, Delaunay2::FASTEST, &label, quiet)?;
    let region = if is_polygon(args) { polygon_region(args, &rings)? } else { region(args, &given)? };
    drop(given);
    let made = {
        let _phase = Phase::start(quiet, "placing sites");
        let segments: Vec<[usize; 2]> = lines.segments.iter().map(|&s| graph.segments[s]).collect();
        let tolerance = if args.tolerance > 0.0 { args.tolerance } else { tolerance_of(&region.bounds()) };
        stats.set("tolerance", tolerance);
        let make = if args.of == OfName::Areas { LineCells2::of_areas } else { LineCells2::new };
        make(&graph.cloud.xy, &segments, &lines.of_segments, &region, tolerance)
            .map_err(|error| Failure::graph(&label, &error))?
    };
    stats.phase("build");
    if made.shared > 0 && args.of != OfName::Areas {
        let shared = grouped(made.shared as u64);
        note(quiet, format_args!("pieces that several lines share: {shared}; the first line has them"));
    }
    let counts = [("points", graph.cloud.xy.len()), ("sites", made.sites.len()), ("rounds", made.rounds)];
    counts.iter().for_each(|&(name, count)| stats.set(name, count));
    stats.set("lines", lines.rows.len());
    stats.set("deviation", made.deviation);
    stats.set("area", region.area());
    let has_rows = lines.rows.iter().any(Option::is_some);
    let diagram = LineDiagram {
        cells: &made,
        crs: graph.cloud.crs.as_ref(),
        features: has_rows.then_some(Rows { table: &graph.cloud.features.table, of: &lines.rows }),
        count: lines.rows.len(),
    };
    let phase = Phase::start(quiet, "writing");
    for (path, format) in outputs {
        let crs = files::drawn_system(diagram.crs, *format);
        let diagram = LineDiagram { crs: crs.as_ref(), ..diagram };
        files::write(path, |out| delone_io::write_lines_diagram(out, *format, &diagram, args.camera.size))?;
    }
    if let (Some(path), Some(format)) = (&args.sites, sites_format) {
        files::write(path, |out| delone_io::write_points(out, format, &made.sites))?;
    }
    drop(phase);
    stats.phase("write");
    let [count, sites] = [lines.rows.len(), made.sites.len()].map(|count| grouped(count as u64));
    let (off, seconds) = (made.deviation, stats.total());
    say(
        quiet,
        format_args!("{count} cells, {sites} sites along them, borders within {off:.3e} ({seconds:.2} s)"),
    );
    stats.write(args.input.stats.as_deref())
}

/// Tells what is no line.
pub(crate) fn tell_left(graph: &Graph, quiet: bool) {
    if graph.lone_points().contains(&true) {
        lost(quiet, "points without a line are left out");
    }
    if !graph.arcs.is_empty() {
        lost(quiet, format_args!("arcs are taken for their chords: {}", graph.arcs.len()));
    }
}

/// The tolerance for points, if none is given.
pub(crate) fn tolerance_of(points: &[[f64; 2]]) -> f64 {
    let [width, height] = Bounds::of(points.iter().copied()).extent();
    PART_OF_DIAGONAL * hypotenuse(width, height)
}

/// Lines by number, in the order of the input.
struct Lines {
    /// The segments that count.
    segments: Vec<usize>,
    /// The line of each of them.
    of_segments: Vec<usize>,
    /// The row of the attributes of each line.
    rows: Vec<Option<usize>>,
}

/// A line before it has a number.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Name {
    Row(usize),
    Polygon(usize),
    /// The first segment of a chain.
    Chain(usize),
}

impl Lines {
    /// A feature is a line, a polygon without attributes is one, and so is a chain of segments without any.
    fn of(graph: &Graph, of: OfName) -> Self {
        let mut polygons = vec![None; graph.segments.len()];
        for ring in &graph.rings {
            polygons[ring.segments.clone()].fill(Some(ring.polygon));
        }
        let mut lines = Self { segments: Vec::new(), of_segments: Vec::new(), rows: Vec::new() };
        let mut numbers: BTreeMap<Name, usize> = BTreeMap::new();
        let mut chain = 0;
        for (segment, &[start, _]) in graph.segments.iter().enumerate() {
            let follows = segment > 0 && graph.segments[segment - 1][1] == start;
            if !follows {
                chain = segment;
            }
            if of == OfName::Areas && polygons[segment].is_none() {
                continue;
            }
            let row = graph.row_of_segment(segment);
            let name = match (row, polygons[segment]) {
                (Some(row), _) => Name::Row(row),
                (None, Some(polygon)) => Name::Polygon(polygon),
                (None, None) => Name::Chain(chain),
            };
            let number = *numbers.entry(name).or_insert_with(|| {
                lines.rows.push(row);
                lines.rows.len() - 1
            });
            lines.segments.push(segment);
            lines.of_segments.push(number);
        }
        lines
    }
}

/// Tells of areas that overlap: the first one has the places in several.
fn tell_overlaps(graph: &Graph, lines: &Lines, label: &Path, quiet: bool) -> Result<(), Failure> {
    let failed = |error| Failure::graph(label, &error);
    let segments: Vec<[usize; 2]> = lines.segments.iter().map(|&s| graph.segments[s]).collect();
    let c = Constrained2::with_crossings(&graph.cloud.xy, &segments, Crossings::Split).map_err(failed)?;
    let line = |segment: SegmentId| lines.of_segments[segment.index()];
    let mut domains = c.domains(&Fill::All).map_err(failed)?;
    let regions = vec![PolygonRegion2::new(0.0); lines.rows.len()];
    let all = c.claim_polygons_as(
        &mut domains,
        |s| Some(line(s)),
        &regions,
        Overlaps2::Combined,
        Membership2::EvenOdd,
    );
    if let Some([first, second, ..]) = all.first().map(Vec::as_slice) {
        let count = grouped(all.len() as u64);
        lost(
            quiet,
            format_args!(
                "areas overlap in {count} places, such as {first} and {second}: the first has the place"
            ),
        );
    }
    Ok(())
}
