//! `delone info`: what is in a file of points, and of segments.

use delone::{Constrained2, Coordinates, Dimension, Error};
use delone_io::{Cloud, Graph, LAS_CLASSES, LasFlag};
use delone_predicates::hypotenuse;
use serde_json::{Map, Value};

use crate::args::{GraphArgs, InfoArgs};
use crate::message::{Failure, answer};
use crate::room::{self, Room};
use crate::stats::Stats;
use crate::{constrained, files};

pub(crate) fn run<R: Room>(args: &InfoArgs, quiet: bool) -> Result<(), Failure> {
    files::keep_apart(&args.input.paths(), args.input.stats.as_deref())?;
    let mut stats = Stats::start();
    let mut graph = Graph::default();
    let mut segments = None;
    let (points, about) = if !R::is_space() && constrained::is_meant(&args.input, &GraphArgs::default()) {
        graph = files::graph(&args.input, None, quiet)?;
        segments = Some(judged(&graph));
        let mut cloud = std::mem::take(&mut graph.cloud);
        (R::take_points(&mut cloud, &args.input.label())?, cloud)
    } else {
        room::read::<R>(&args.input, quiet)?
    };
    stats.phase("read");
    let d: R = room::build(&points, R::FASTEST, &args.input.label(), quiet)?;
    stats.phase("build");
    stats.triangulation(&d, d.counters());
    let mut text = String::new();
    let mut line = |name: &str, value: String| text += &format!("{name:22} {value}\n");
    line("points", points.len().to_string());
    line("duplicates", d.duplicates().count().to_string());
    let span = match d.dimension() {
        Dimension::Empty => "nothing: there is no point",
        Dimension::Point => "a point",
        Dimension::Line => "a line: all points are collinear",
        Dimension::Plane if R::is_space() => "a plane: all points are coplanar",
        Dimension::Plane => "the plane",
        Dimension::Space => "space",
    };
    line("they span", span.to_owned());
    for (k, axis) in ["x", "y", "z"].into_iter().enumerate() {
        let range = if k < R::Point::COUNT {
            range(points.iter().map(|p| p.as_ref()[k]))
        } else {
            range(about.z.iter().flatten().copied())
        };
        range.into_iter().for_each(|range| line(axis, range));
    }
    file(&about, &mut line, &mut stats);
    if let Some(counts) = segments.filter(|_| !graph.segments.is_empty()) {
        describe(&graph, &counts, &mut line, &mut stats);
    }
    let simplices = d.simplex_count();
    if simplices > 0 {
        line(R::WORDS.simplex[1], simplices.to_string());
        d.describe(&mut line, &mut stats);
        let (ties, tied) = (ties(&d), R::WORDS.tied);
        line(&format!("{tied} neighbors"), format!("{ties} pairs of {}", R::WORDS.simplex[1]));
        stats.set(&format!("{tied}_pairs"), ties);
        let mut lengths = lengths(&d);
        lengths.sort_unstable_by(f64::total_cmp);
        if let (Some(shortest), Some(longest)) = (lengths.first(), lengths.last()) {
            let median = lengths[lengths.len() / 2];
            line("edge lengths", format!("{shortest:?} to {longest:?}, median {median:?}"));
        }
    }
    stats.phase("count");
    stats.write(args.input.stats.as_deref())?;
    answer(&text)
}

/// Contents of the file besides its points.
fn file(cloud: &Cloud, line: &mut impl FnMut(&str, String), stats: &mut Stats) {
    if let Some(crs) = &cloud.crs {
        line("coordinates", crs.to_string());
        stats.set("crs", crs.to_string());
        if crs.is_degrees() {
            line("unit of x and y", "degree".to_owned());
        }
        let units = [("x and y", crs.metres()), ("heights", crs.metres_of_heights())];
        for (of, metres) in units.into_iter().filter_map(|(of, metres)| Some((of, metres?))) {
            line(&format!("unit of {of}"), unit(metres));
        }
    }
    for (name, kind) in &cloud.dimensions {
        line("extra bytes", format!("{name}: {kind}"));
    }
    if !cloud.dimensions.is_empty() {
        let kinds: Map<String, Value> =
            cloud.dimensions.iter().map(|(name, kind)| (name.clone(), kind.as_str().into())).collect();
        stats.set("extra_bytes", kinds);
    }
    if !cloud.classes.is_empty() {
        let name = |class: u8| {
            let known = LAS_CLASSES.iter().find(|entry| entry.1 == class).map(|entry| entry.0);
            known.map_or_else(|| class.to_string(), |name| format!("{class} {name}"))
        };
        for &(class, count) in &cloud.classes {
            line(&format!("class {}", name(class)), count.to_string());
        }
        let counts: Map<String, Value> =
            cloud.classes.iter().map(|&(class, count)| (class.to_string(), count.into())).collect();
        stats.set("classes", counts);
        for (flag, &count) in LasFlag::ALL.iter().zip(&cloud.flags).filter(|entry| *entry.1 > 0) {
            line(flag.name(), count.to_string());
            stats.set(&flag.name().replace('-', "_"), count);
        }
    }
}

/// A unit of length by its metres. Feet of the United States are two in a million longer than others.
fn unit(metres: f64) -> String {
    match metres {
        1.0 => "metre".to_owned(),
        0.3047..0.3049 => "foot".to_owned(),
        _ => format!("{metres} metres"),
    }
}

/// Counts of remarkable segments, by name: only crossings where there are some.
fn judged(graph: &Graph) -> Vec<(&'static str, usize)> {
    match Constrained2::from_parts(&graph.cloud.xy, &graph.segments) {
        Ok(c) => {
            let report = c.report();
            vec![
                ("crossings", 0),
                ("of no length", report.zero_length),
                ("repeated", report.repeated),
                ("overlapping", report.overlapping),
                ("through vertices", report.through_vertices),
                ("constraint edges", c.constraint_edges().count()),
            ]
        }
        Err(Error::SegmentsCross { count, .. }) => vec![("crossings", count)],
        // The points are not valid, which is told next.
        Err(_) => Vec::new(),
    }
}

/// The segments, and what files say beside them.
fn describe(graph: &Graph, counts: &[(&str, usize)], line: &mut impl FnMut(&str, String), stats: &mut Stats) {
    let polygons = graph.rings.iter().filter(|ring| ring.ring == 0).count();
    let ours = [("segments", graph.segments.len())];
    let rest = [("polygons", polygons), ("holes", graph.holes.len()), ("regions", graph.regions.len())];
    for &(name, count) in ours.iter().chain(counts).chain(&rest) {
        stats.set(&name.replace(' ', "_"), count);
        if count > 0 || matches!(name, "segments" | "crossings") {
            line(name, count.to_string());
        }
    }
}

/// Pairs of neighbors that could be divided in another way.
fn ties<R: Room>(d: &R) -> usize {
    let position = |v| d.position(v).unwrap_or_default();
    let is_tie = |s: R::Simplex, next: R::Simplex| {
        let corners = d.corners(s);
        let beyond = d.corners(next);
        let apex = beyond.as_ref().iter().find(|v| !corners.as_ref().contains(v));
        let simplex: Vec<R::Point> = corners.as_ref().iter().map(|&v| position(v)).collect();
        apex.is_some_and(|&v| R::is_tie(&simplex, position(v)))
    };
    let neighbors = |s| (0..=R::Point::COUNT).filter_map(move |k| d.across(s, k));
    let tied = |s| neighbors(s).filter(|&next| s < next && is_tie(s, next)).count();
    d.simplices().map(tied).sum()
}

fn lengths<R: Room>(d: &R) -> Vec<f64> {
    let length = |[v, w]: [delone::VertexId; 2]| {
        let [p, q] = [v, w].map(|v| d.position(v).unwrap_or_default());
        p.as_ref().iter().zip(q.as_ref()).map(|(x, y)| x - y).fold(0.0, hypotenuse)
    };
    d.edges().map(length).collect()
}

fn range(values: impl Iterator<Item = f64>) -> Option<String> {
    let (low, high) =
        values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (x.min(low), x.max(high)));
    (low <= high).then(|| format!("{low:?} to {high:?}"))
}
