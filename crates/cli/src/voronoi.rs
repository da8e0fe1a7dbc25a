//! `delone voronoi`: clipped cells as polygons and pictures; those of space are in `polyhedra`.

use std::path::Path;

use delone::{Delaunay2, Region2, Relaxation2};
use delone_io::{Cloud, Contents, Diagram};

use crate::antimeridian;
use crate::args::{AntimeridianName, OfName, VoronoiArgs};
use crate::clip::{is_polygon, merge, not_merged, polygon_region, refuse_numbers, region};
use crate::files;
use crate::lines;
use crate::medial;
use crate::message::Failure;
use crate::orders;
use crate::polyhedra;
use crate::powers;
use crate::progress::Phase;
use crate::repeated;
use crate::room::{self, Room};
use crate::sites;
use crate::stats::Stats;
use crate::weld;

pub(crate) fn run(args: &VoronoiArgs, quiet: bool) -> Result<(), Failure> {
    refuse(args)?;
    if args.dim.is_space() {
        return polyhedra::run(args, quiet);
    }
    args.space.refuse_in_plane()?;
    let polygon = is_polygon(args);
    let mut inputs = args.input.paths();
    if polygon {
        inputs.push(&args.clip);
    }
    inputs.extend(args.weights.file());
    inputs.extend(args.areas.as_deref().map(Path::new).filter(|path| path.exists()));
    let all: Vec<_> = args.output.iter().chain(&args.sites).cloned().collect();
    files::keep_apart(&inputs, all.iter().map(AsRef::as_ref).chain(args.input.stats.as_deref()))?;
    let outputs =
        args.wkt.of(files::outputs(&args.output, args.to, args.input.stats.as_deref(), &inputs)?)?;
    let content = if args.medial_axis.is_some() { Contents::Edges } else { Contents::Cells };
    files::check_formats(&outputs, &[content])?;
    if let Some(angle) = args.medial_axis {
        files::keep_attributes(content);
        return medial::run(args, angle, &outputs, Stats::start(), quiet);
    }
    if args.order.is_none() {
        files::keep_attributes(Contents::Cells);
    }
    if args.space.periodic.is_some() {
        return repeated::run(args, &outputs, quiet);
    }
    let sites_format = args.sites.as_deref().map(files::format_beside).transpose()?;
    let mut stats = Stats::start();
    if args.of != OfName::Points {
        return lines::run(args, &outputs, sites_format, stats, quiet);
    }
    if args.weights.given().is_some() || args.areas.is_some() {
        return powers::run(args, &outputs, sites_format, stats, quiet);
    }
    let (points, about) = read(args, &mut stats, quiet)?;
    let how = args.antimeridian;
    let rings =
        if polygon { antimeridian::rings_beside(&args.clip, how, &mut stats, quiet)? } else { Vec::new() };
    stats.phase("read");
    let build = |points: &[[f64; 2]]| room::build(points, Delaunay2::FASTEST, &args.input.label(), quiet);
    let mut triangulation: Delaunay2 = build(&points)?;
    drop(points);
    room::remark(&triangulation, quiet);
    let features = sites::features(&about, &triangulation, quiet);
    stats.phase("build");
    let region = if polygon { polygon_region(args, &rings)? } else { region(args, &triangulation)? };
    if let Some(order) = args.order {
        let picture = orders::Clipped {
            order,
            region: &region,
            merge: merge(args, &region, &mut stats),
            crs: about.crs.as_ref(),
            size: args.camera.size,
        };
        orders::write(&picture, &triangulation, &outputs, &mut stats, quiet)?;
        if let (Some(path), Some(format)) = (&args.sites, sites_format) {
            files::write(path, |out| delone_io::write_points(out, format, triangulation.points()))?;
        }
        stats.tell(quiet, ["triangle", "triangles"]);
        return stats.write(args.input.stats.as_deref());
    }
    if args.relax > 0 {
        let points = relaxed(args, &triangulation, &region, &mut stats, quiet)?;
        triangulation = build(&points)?;
        stats.phase("relax");
    }
    let cells = {
        let _phase = Phase::start(quiet, "clipping");
        let cells = triangulation.voronoi().clip(&region);
        match merge(args, &region, &mut stats) {
            Some(length) => cells.merged(length, &region).map_err(not_merged)?,
            None => cells,
        }
    };
    stats.phase("clip");
    stats.triangulation(&triangulation, triangulation.counters());
    stats.set("cells", triangulation.vertices().filter(|&v| cells.rings(v).next().is_some()).count());
    stats.set("area", region.area());
    let _phase = Phase::start(quiet, "writing");
    for (path, format) in &outputs {
        let crs = files::drawn_system(about.crs.as_ref(), *format);
        let diagram = Diagram {
            triangulation: &triangulation,
            cells: &cells,
            crs: crs.as_ref(),
            features: Some(&features),
        };
        files::write(path, |out| delone_io::write_diagram(out, *format, &diagram, args.camera.size))?;
    }
    if let (Some(path), Some(format)) = (&args.sites, sites_format) {
        files::write(path, |out| delone_io::write_points(out, format, triangulation.points()))?;
    }
    stats.phase("write");
    stats.tell(quiet, ["triangle", "triangles"]);
    stats.write(args.input.stats.as_deref())
}

/// Reads the sites, and joins or moves them as it is asked for.
fn read(args: &VoronoiArgs, stats: &mut Stats, quiet: bool) -> Result<(Vec<[f64; 2]>, Cloud), Failure> {
    let (mut points, about) = room::read::<Delaunay2>(&args.input, quiet)?;
    let (how, crs) = (args.antimeridian, about.crs.as_ref());
    antimeridian::heed_points(&mut points, crs, how, &args.input, stats, quiet)?;
    weld::weld_points(&mut points, args.weld, &args.input.label(), stats, quiet)?;
    Ok((points, about))
}

/// The sites where relaxation moves them.
fn relaxed(
    args: &VoronoiArgs,
    triangulation: &Delaunay2,
    region: &Region2,
    stats: &mut Stats,
    quiet: bool,
) -> Result<Vec<[f64; 2]>, Failure> {
    let _phase = Phase::start(quiet, "relaxing");
    let relaxation = Relaxation2::default().steps(args.relax).tolerance(args.tolerance);
    let mut last = (0, 0.0);
    let failed = |error: delone::Error| Failure::usage(error, "see delone voronoi --help");
    let points = relaxation.run(triangulation, region, |step, moved| last = (step, moved)).map_err(failed)?;
    stats.set("relaxed", last.0);
    stats.set("moved", last.1);
    Ok(points)
}

/// Refuses numbers and options that do not go together.
fn refuse(args: &VoronoiArgs) -> Result<(), Failure> {
    refuse_numbers(args)?;
    if !args.bounds.is_empty() && args.clip != Path::new("box") {
        return Err(Failure::usage("--box is for --clip box", "leave one of them out"));
    }
    if args.of != OfName::Points || args.medial_axis.is_some() {
        if !(args.tolerance >= 0.0 && args.tolerance.is_finite()) {
            let help = "give a length, or 0 for a thousandth of the diagonal";
            return Err(Failure::usage(format!("--tolerance is {}: it is no length", args.tolerance), help));
        }
        let is_more = args.dim.is_space()
            || args.space.periodic.is_some()
            || args.weights.given().is_some()
            || args.areas.is_some()
            || args.order.is_some()
            || args.relax > 0
            || args.merge.is_some();
        if is_more {
            let help = "leave out what is for points: --dim 3, --periodic, --weights, --radii, --areas, --order, --relax, --merge";
            let what = "--of lines, --of areas and --medial-axis are for the plane, without weights";
            return Err(Failure::usage(what, help));
        }
    }
    let is_plain = !args.dim.is_space()
        && args.space.periodic.is_none()
        && args.weights.given().is_none()
        && args.areas.is_none();
    if args.weld.is_some() && !is_plain {
        return Err(Failure::usage("--weld is for points in the plane without weights", "leave it out"));
    }
    if args.antimeridian == Some(AntimeridianName::Cut) && !is_plain {
        let what = "--antimeridian cut is for points in the plane without weights";
        return Err(Failure::usage(what, "leave it out"));
    }
    if args.cut.is_given() && !args.dim.is_space() {
        return Err(Failure::usage("--cut is for space", "add --dim 3, or leave it out"));
    }
    Ok(())
}
