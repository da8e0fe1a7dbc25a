//! `delone graph`: proximity graphs, as pairs of points and as pictures.

use delone::Graph;
use delone_io::{Contents, Edges, Format, picture, write_edges, write_mesh};

use crate::args::{ProximityArgs, ProximityName};
use crate::files;
use crate::message::Failure;
use crate::progress::Phase;
use crate::room::{self, Room};
use crate::stats::Stats;

pub(crate) fn run<R: Room>(args: &ProximityArgs, quiet: bool) -> Result<(), Failure> {
    let graph = graph(args)?;
    let outputs = files::outputs(&args.output, args.to, args.input.stats.as_deref(), &args.input.paths())?;
    files::check_formats(&outputs, &[Contents::Edges, Contents::Pictures])?;
    let is_picture = |format: Format| matches!(format, Format::Svg | Format::Png);
    for (path, format) in &outputs {
        if is_picture(*format) && R::is_space() {
            return Err(Failure::usage(
                format!("{}: pictures of graphs are for the plane", path.display()),
                "choose npy, csv or geojson, or leave --dim 3 out",
            ));
        }
    }
    let mut stats = Stats::start();
    let (points, about) = room::read::<R>(&args.input, quiet)?;
    stats.phase("read");
    let d: R = room::build(&points, R::FASTEST, &args.input.label(), quiet)?;
    room::remark(&d, quiet);
    stats.phase("build");
    stats.triangulation(&d, d.counters());
    let pairs: Vec<[usize; 2]> = {
        let _phase = Phase::start(quiet, "finding edges");
        let found = d
            .graph(graph)
            .map_err(|error| Failure::usage(format!("--beta: {error}"), "give a beta from 1 on"))?;
        found.into_iter().map(|edge| edge.map(|v| v.index())).collect()
    };
    stats.phase("graph");
    let edges = Edges { points: &points, pairs: &pairs, widths: None, crs: about.crs.as_ref() };
    stats.set("edges", pairs.len());
    stats.set("length", edges.lengths().fold(0.0, |sum, length| sum + length));
    let _phase = Phase::start(quiet, "writing");
    for (path, format) in &outputs {
        if is_picture(*format) {
            let flat = |i: usize| [0, 1].map(|k| points[i].as_ref()[k]);
            let links = pairs.iter().map(|edge| edge.map(flat)).collect();
            let options = picture::Options {
                size: args.size,
                edges: Some(false),
                fill: Some(false),
                links,
                ..picture::Options::default()
            };
            let mesh = room::mesh(&d, &points, &about, None);
            files::write(path, |out| write_mesh(out, *format, &mesh, &files::drawn(&options)))?;
        } else {
            files::write(path, |out| write_edges(out, *format, &edges))?;
        }
    }
    stats.phase("write");
    stats.tell(quiet, R::WORDS.simplex);
    stats.write(args.input.stats.as_deref())
}

/// The graph that is meant.
fn graph(args: &ProximityArgs) -> Result<Graph, Failure> {
    let is = |kind: ProximityName| args.kind == kind;
    if args.beta.is_some() != is(ProximityName::Beta) {
        return Err(Failure::usage(
            "--beta goes with --kind beta, and that with it",
            "as in --kind beta --beta 1.5",
        ));
    }
    if args.k.is_some() != is(ProximityName::Nearest) {
        return Err(Failure::usage(
            "-k goes with --kind nearest, and that with it",
            "as in --kind nearest -k 8",
        ));
    }
    Ok(match args.kind {
        ProximityName::Gabriel => Graph::Gabriel,
        ProximityName::RelativeNeighbors => Graph::RelativeNeighbors,
        ProximityName::SpanningTree => Graph::SpanningTree,
        ProximityName::Beta => Graph::Beta(args.beta.unwrap_or(1.0)),
        ProximityName::Nearest => Graph::Nearest(args.k.unwrap_or(1) as usize),
    })
}
