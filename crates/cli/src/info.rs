//! `delone info`: what is in a file of points.

use delone::{Algorithm2, Delaunay2, Dimension};
use delone_io::{Cloud, LAS_CLASSES};
use delone_predicates::{in_circle_with_ties, orient2d};
use serde_json::{Map, Value};

use crate::args::InfoArgs;
use crate::message::{Failure, answer};
use crate::stats::Stats;
use crate::{files, space, triangulate};

pub(crate) fn run(args: &InfoArgs, quiet: bool) -> Result<(), Failure> {
    if args.dim.is_space() {
        return space::info(args, quiet);
    }
    files::keep_apart(&args.input.paths(), args.input.stats.as_deref())?;
    let mut stats = Stats::start();
    let mut cloud = files::points(&args.input, 2, quiet)?;
    stats.phase("read");
    let heights = cloud.z.take();
    let xy = std::mem::take(&mut cloud.xy);
    let d = triangulate::build(xy, Algorithm2::default(), &args.input.label(), quiet)?;
    stats.phase("build");
    stats.triangulation(&d);
    let mut text = String::new();
    let mut line = |name: &str, value: String| text += &format!("{name:22} {value}\n");
    line("points", d.points().len().to_string());
    line("duplicates", d.duplicates().count().to_string());
    let span = match d.dimension() {
        Dimension::Empty => "nothing: there is no point",
        Dimension::Point => "a point",
        Dimension::Line => "a line: all points are collinear",
        Dimension::Plane | Dimension::Space => "the plane",
    };
    line("they span", span.to_owned());
    for (axis, values) in [("x", 0), ("y", 1)] {
        if let Some(range) = range(d.points().iter().map(|p| p[values])) {
            line(axis, range);
        }
    }
    if let Some(range) = heights.and_then(|z| range(z.into_iter())) {
        line("z", range);
    }
    file(&cloud, &mut line, &mut stats);
    if d.dimension() == Dimension::Plane {
        plane(&d, &mut line, &mut stats);
    }
    stats.phase("count");
    stats.write(args.input.stats.as_deref())?;
    answer(&text)
}

/// What the file tells besides its points.
pub(crate) fn file(cloud: &Cloud, line: &mut impl FnMut(&str, String), stats: &mut Stats) {
    if let Some(crs) = &cloud.crs {
        line("coordinates", crs.to_string());
        stats.set("crs", crs.to_string());
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
    }
}

fn plane(d: &Delaunay2, line: &mut impl FnMut(&str, String), stats: &mut Stats) {
    let hull: Vec<_> = d.hull_vertices().map(|v| d.point(v)).collect();
    let h = hull.len();
    let straight =
        (0..h).filter(|&i| orient2d(hull[i], hull[(i + 1) % h], hull[(i + 2) % h]).is_zero()).count();
    let mesh = d.mesh();
    let ties = mesh
        .undirected_edges()
        .filter(|&e| {
            let f = mesh.twin(e);
            let corners = [mesh.origin(e), mesh.destination(e), mesh.apex(e), mesh.apex(f)];
            !corners.iter().any(|v| v.is_ghost()) && {
                let [a, b, c, q] = corners.map(|v| d.point(v));
                in_circle_with_ties(a, b, c, q).is_zero()
            }
        })
        .count();
    line("triangles", d.triangle_count().to_string());
    let area: f64 = mesh.triangles().map(|t| d.area(t)).sum();
    let density = d.points().len() as f64 / area;
    line("area of the hull", format!("{area:.6}, {density:.6} points on a unit"));
    stats.set("area", area);
    stats.set("density", density);
    line("hull vertices", format!("{h}, {straight} of them inside a straight side"));
    line("cocircular neighbours", format!("{ties} pairs of triangles"));
    let mut lengths: Vec<f64> = d
        .edges()
        .map(|edge| {
            let [p, q] = edge.map(|v| d.point(v));
            (p[0] - q[0]).hypot(p[1] - q[1])
        })
        .collect();
    lengths.sort_unstable_by(f64::total_cmp);
    if let (Some(shortest), Some(longest)) = (lengths.first(), lengths.last()) {
        line(
            "edge lengths",
            format!("{shortest:.6} to {longest:.6}, median {:.6}", lengths[lengths.len() / 2]),
        );
    }
    stats.set("straight_hull_vertices", straight);
    stats.set("cocircular_pairs", ties);
}

pub(crate) fn range(values: impl Iterator<Item = f64>) -> Option<String> {
    let (low, high) =
        values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (x.min(low), x.max(high)));
    (low <= high).then(|| format!("{low:?} to {high:?}"))
}
