//! `delone generate`: named sets of points, and graphs.

use std::path::PathBuf;

use delone_generators::{Graph, Kind, Kind3, Random, moved};
use delone_io::{Cloud, Contents, Direction, Format, GraphRing};

use crate::args::GenerateArgs;
use crate::files;
use crate::message::{Failure, answer, note};
use crate::progress::Phase;
use crate::stats::Stats;

pub(crate) fn run(args: &GenerateArgs, quiet: bool) -> Result<(), Failure> {
    if args.kind == "list" {
        let line = |name: &str, about: &str| format!("{name:15} {about}\n");
        let plane = Kind::ALL.iter().map(|kind| line(kind.name(), kind.about()));
        let space = Kind3::ALL.iter().map(|kind| line(kind.name(), kind.about()));
        let graphs = Graph::ALL.iter().map(|graph| line(graph.name(), graph.about()));
        let lines = plane.chain(["\nIn space:\n".to_owned()]).chain(space);
        return answer(&lines.chain(["\nWith segments:\n".to_owned()]).chain(graphs).collect::<String>());
    }
    let (plane, space, graph) = (Kind::named(&args.kind), Kind3::named(&args.kind), Graph::named(&args.kind));
    if plane.is_none() && space.is_none() && graph.is_none() {
        return Err(Failure::usage(
            format!("there is no set named {:?}", args.kind),
            "see delone generate list",
        ));
    }
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
    if !args.noise.is_finite() {
        return Err(Failure::usage("--noise is a length", "as in --noise 0.5, in coordinate units"));
    }
    let mut stats = Stats::start();
    let outputs =
        args.wkt.of(files::outputs(args.output.as_slice(), args.to, args.stats.as_deref(), &[])?)?;
    if let Some(kind) = plane {
        make(|| noisy(kind.points(args.n, args.seed), args), &outputs, &mut stats, quiet)?;
    } else if let Some(kind) = space {
        make(|| noisy(kind.points(args.n, args.seed), args), &outputs, &mut stats, quiet)?;
    } else if let Some(graph) = graph {
        make_graph(graph, args, &outputs, &mut stats, quiet)?;
    }
    stats.phase("write");
    stats.tell(quiet, ["triangle", "triangles"]);
    stats.write(args.stats.as_deref())
}

/// The points, each moved at random if that is asked for.
fn noisy<const D: usize>(points: Vec<[f64; D]>, args: &GenerateArgs) -> Vec<[f64; D]> {
    if args.noise == 0.0 {
        return points;
    }
    // Numbers that have nothing to do with those that made the points.
    moved(&points, args.noise, &mut Random::new(args.seed ^ 0x6e6f_6973))
}

/// Makes points of D coordinates and writes them.
fn make<const D: usize>(
    points: impl FnOnce() -> Vec<[f64; D]>,
    outputs: &[(PathBuf, Format)],
    stats: &mut Stats,
    quiet: bool,
) -> Result<(), Failure> {
    let points = {
        let _phase = Phase::start(quiet, "generating");
        points()
    };
    stats.set("points", points.len());
    stats.phase("build");
    let _phase = Phase::start(quiet, "writing");
    for (path, format) in outputs {
        files::write(path, |out| delone_io::write_points(out, *format, &points))?;
    }
    Ok(())
}

/// Makes a graph and writes it; formats that hold no segments get the points.
fn make_graph(
    kind: Graph,
    args: &GenerateArgs,
    outputs: &[(PathBuf, Format)],
    stats: &mut Stats,
    quiet: bool,
) -> Result<(), Failure> {
    if args.noise != 0.0 {
        return Err(Failure::usage("--noise is for points", "leave it out: segments would cross"));
    }
    let (xy, segments) = {
        let _phase = Phase::start(quiet, "generating");
        kind.parts(args.n, args.seed)
    };
    stats.set("points", xy.len());
    stats.set("segments", segments.len());
    stats.phase("build");
    let ring = GraphRing { polygon: 0, ring: 0, segments: 0..segments.len() };
    let graph = delone_io::Graph {
        is_border: vec![true; segments.len()],
        rings: if kind.is_polygon() { vec![ring] } else { Vec::new() },
        segments,
        cloud: Cloud { xy, ..Cloud::default() },
        ..delone_io::Graph::default()
    };
    let _phase = Phase::start(quiet, "writing");
    for (path, format) in outputs {
        if format.holds(Contents::Lines, Direction::Written) {
            files::write(path, |out| delone_io::write_graph(out, *format, &graph))?;
        } else {
            files::write(path, |out| delone_io::write_points(out, *format, &graph.cloud.xy))?;
            note(quiet, format_args!("{}: {format} files hold no segments", path.display()));
        }
    }
    Ok(())
}
