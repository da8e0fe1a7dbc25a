//! `delone draw`: pictures.

use delone::surface::Duplicates;
use delone::{Coordinates, Delaunay2, HintOrder, Hints2, VertexId};
use delone_io::{Contents, Trim, picture, write_mesh};

use crate::args::{Choice, DrawArgs};
use crate::message::Failure;
use crate::progress::Phase;
use crate::room::{self, Room};
use crate::stats::Stats;
use crate::{constrained, files, weighted};

pub(crate) fn run<R: Room>(args: &DrawArgs, quiet: bool) -> Result<(), Failure> {
    let by_points = args.disks.is_some() || args.hints;
    if args.graph.is_given() && (R::is_space() || by_points) {
        return Err(Failure::usage(
            "segments are for the plane, and for points that are where they are",
            "leave --segments, --crossings and --fill out, or --dim 3, --disks and --hints",
        ));
    }
    let mut inputs = args.input.paths();
    inputs.extend(args.graph.segments.as_deref());
    inputs.extend(args.weights.file());
    let outputs = files::outputs(&args.output, args.to, args.input.stats.as_deref(), &inputs)?;
    files::check_formats(&outputs, &[Contents::Pictures])?;
    let mut options = options(args, R::is_space())?;
    let cut = args.cut.cut()?;
    if args.weights.given().is_some() {
        if by_points || args.graph.is_given() || cut.is_some() {
            return Err(Failure::usage(
                "weights are for points without segments, disks, hints and cuts",
                "leave --weights and --radii out, or --segments, --crossings, --fill, --disks, --hints and --cut",
            ));
        }
        return weighted::draw::<R>(args, &outputs, &options, quiet);
    }
    if !R::is_space() && !by_points && constrained::is_meant(&args.input, &args.graph) {
        options.outside = args.max_edge.is_none();
        return constrained::draw(args, &outputs, &options, quiet);
    }
    let mut stats = Stats::start();
    let (points, mut about) = room::read::<R>(&args.input, quiet)?;
    stats.phase("read");
    if args.hints {
        options.links = links(&points, args)?;
    }
    if let (true, Some(radius)) = (args.certain, args.disks) {
        [options.links, options.faint] = disk_edges(&points, radius, args)?;
        options.edges = Some(false);
    }
    let d: R = room::build(&points, R::FASTEST, &args.input.label(), quiet)?;
    room::remark(&d, quiet);
    stats.phase("build");
    stats.triangulation(&d, d.counters());
    room::settle(Duplicates::default(), &d, &mut about);
    let cut = cut.map(|cut| Trim::beyond(&d, &cut));
    let trim = cut.or_else(|| room::trim(&d, args.max_edge, &mut stats));
    let mesh = room::mesh(&d, &points, &about, trim.as_ref());
    let _phase = Phase::start(quiet, "drawing");
    for (path, format) in &outputs {
        files::write(path, |out| write_mesh(out, *format, &mesh, &files::drawn(&options)))?;
    }
    stats.phase("write");
    stats.tell(quiet, R::WORDS.simplex);
    stats.write(args.input.stats.as_deref())
}

/// The options of a drawing, if the dimension has them.
fn options(args: &DrawArgs, is_space: bool) -> Result<picture::Options, Failure> {
    if args.disks.is_some_and(|radius| !radius.is_finite() || radius < 0.0) {
        return Err(Failure::usage("--disks takes a radius", "as in --disks 0.5, in coordinate units"));
    }
    if is_space && (args.disks.is_some() || args.hints || args.max_edge.is_some()) {
        return Err(Failure::usage(
            "--disks, --hints and --max-edge are for the plane",
            "leave them or --dim 3 out",
        ));
    }
    if !is_space && (args.cut.is_given() || args.wireframe) {
        return Err(Failure::usage("--cut and --wireframe are for space", "add --dim 3, or leave them out"));
    }
    let camera = if is_space { args.camera.camera()? } else { picture::Camera::default() };
    let yes = |choice: Option<Choice>| choice.map(|choice| choice == Choice::Yes);
    Ok(picture::Options {
        size: args.camera.size,
        camera: picture::Camera { wireframe: args.wireframe, ..camera },
        edges: yes(args.edges),
        points: yes(args.points),
        fill: yes(args.colors),
        disks: args.disks,
        ..picture::Options::default()
    })
}

fn flat<P: Coordinates>(points: &[P]) -> Vec<[f64; 2]> {
    points.iter().map(|p| [0, 1].map(|k| p.as_ref()[k])).collect()
}

/// The edges of all sets with a point in each disk, and those of some only.
fn disk_edges<P: Coordinates>(
    points: &[P],
    radius: f64,
    args: &DrawArgs,
) -> Result<[Vec<[[f64; 2]; 2]>; 2], Failure> {
    let refused = |error| Failure::points(&args.input.label(), &error);
    let d = Delaunay2::from_points(&flat(points)).map_err(refused)?;
    let edges = d.disk_edges(radius).map_err(refused)?;
    let is_uncertain = |edge: &&[VertexId; 2]| edges.certain().binary_search(edge).is_err();
    let segment = |edge: &[VertexId; 2]| edge.map(|v| d.point(v));
    let faint = edges.possible().iter().filter(is_uncertain).map(segment).collect();
    Ok([edges.certain().iter().map(segment).collect(), faint])
}

/// From each point of the plane to its hint.
fn links<P: Coordinates>(points: &[P], args: &DrawArgs) -> Result<Vec<[[f64; 2]; 2]>, Failure> {
    let points = flat(points);
    let hints = Hints2::from_points(&points, HintOrder::Random { seed: args.seed })
        .map_err(|error| Failure::points(&args.input.label(), &error))?;
    Ok(hints.order().zip(hints.hints()).skip(1).map(|(i, j)| [points[i], points[j]]).collect())
}
