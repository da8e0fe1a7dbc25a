//! `delone voronoi` of sites with weights, or with the weights for which their cells have prescribed areas.

use std::path::PathBuf;

use delone::{Delaunay2, Error, Region2, Regular2};
use delone_io::{Diagram, Format};

use crate::antimeridian;
use crate::args::VoronoiArgs;
use crate::clip::{is_polygon, merge, not_merged, polygon_region, region};
use crate::message::{Failure, note};
use crate::progress::Phase;
use crate::room::{self, Room};
use crate::stats::Stats;
use crate::weighted::{Weighted, beside};
use crate::{files, sites, weighted};

/// The part of itself by which an area may be wrong, where rounding allows; and by which none may be.
const TOLERANCE: f64 = 1e-9;
const TOO_WRONG: f64 = 1e-3;

pub(crate) fn run(
    args: &VoronoiArgs,
    outputs: &[(PathBuf, Format)],
    sites_format: Option<Format>,
    mut stats: Stats,
    quiet: bool,
) -> Result<(), Failure> {
    if args.relax > 0 {
        return Err(Failure::usage(
            "--relax is for sites without weights",
            "leave --weights, --radii, --areas or --relax out",
        ));
    }
    let (sites, region) = if let Some(said) = &args.areas {
        with_areas(args, said, &mut stats, quiet)?
    } else {
        let sites = Weighted::read(&args.input, &args.weights, &mut stats, quiet)?;
        let region = clip(args, &sites.points, &mut stats, quiet)?;
        (sites, region)
    };
    let Weighted { triangulation: r, points, about } = sites;
    let features = sites::features(&about, &r, quiet);
    let cells = {
        let _phase = Phase::start(quiet, "clipping");
        let cells = r.power().clip(&region);
        match merge(args, &region, &mut stats) {
            Some(length) => cells.merged(length, &region).map_err(not_merged)?,
            None => cells,
        }
    };
    stats.phase("clip");
    stats.set("cells", r.vertices().filter(|&v| cells.rings(v).next().is_some()).count());
    stats.set("area", region.area());
    let _phase = Phase::start(quiet, "writing");
    let diagram =
        Diagram { triangulation: &r, cells: &cells, crs: about.crs.as_ref(), features: Some(&features) };
    for (path, format) in outputs {
        let crs = files::drawn_system(diagram.crs, *format);
        let diagram = Diagram { crs: crs.as_ref(), ..diagram };
        files::write(path, |out| delone_io::write_diagram(out, *format, &diagram, args.camera.size))?;
    }
    if let (Some(path), Some(format)) = (&args.sites, sites_format) {
        files::write(path, |out| delone_io::write_points(out, format, &points))?;
    }
    stats.phase("write");
    stats.tell(quiet, ["triangle", "triangles"]);
    stats.write(args.input.stats.as_deref())
}

/// The region to clip to.
fn clip(args: &VoronoiArgs, points: &[[f64; 2]], stats: &mut Stats, quiet: bool) -> Result<Region2, Failure> {
    if is_polygon(args) {
        polygon_region(args, &antimeridian::rings_beside(&args.clip, args.antimeridian, stats, quiet)?)
    } else {
        // The hull of the points, whatever they weigh.
        region(args, &room::build(points, Delaunay2::FASTEST, &args.input.label(), quiet)?)
    }
}

/// Sites with the weights for which their cells have the areas that were asked for.
fn with_areas(
    args: &VoronoiArgs,
    said: &str,
    stats: &mut Stats,
    quiet: bool,
) -> Result<(Weighted<Delaunay2>, Region2), Failure> {
    let is_equal = said == "equal";
    if !is_equal {
        weighted::check_beside(&args.input, said)?;
    }
    let (points, about) = room::read::<Delaunay2>(&args.input, quiet)?;
    let (shares, label) = if is_equal {
        (vec![1.0; points.len()], args.input.label())
    } else {
        beside(&args.input, said, points.len(), "areas", quiet)?
    };
    let region = clip(args, &points, stats, quiet)?;
    stats.phase("read");
    let phase = Phase::start(quiet, "weighing");
    let (r, prescribed) =
        Regular2::with_areas(&points, &shares, &region, TOLERANCE).map_err(|error| match error {
            Error::Area { .. } => Failure::points(&label, &error),
            error => Failure::points(&args.input.label(), &error),
        })?;
    drop(phase);
    stats.phase("build");
    if prescribed.error > TOO_WRONG {
        let found = format!(
            "no weights were found for these areas: one is still wrong by {:.1e} of itself",
            prescribed.error
        );
        return Err(Failure::new(
            found,
            "cells are rounded to 1e-16 of the whole: ask for no smaller ones, and clip to a region in one piece",
        ));
    }
    note(
        quiet,
        format_args!("areas to {:.0e} of themselves in {} steps", prescribed.error, prescribed.steps),
    );
    stats.triangulation(&r, r.counters());
    stats.set("steps", prescribed.steps);
    Ok((Weighted { triangulation: r, points, about }, region))
}
