//! Regions that cells are clipped to: a box, the hull, or polygons from a file.

use std::path::Path;

use delone::{Bounds, Delaunay2, Error, Region2};

use crate::args::VoronoiArgs;
use crate::message::Failure;
use crate::stats::Stats;

/// Whether a file says what to clip to.
pub(crate) fn is_polygon(args: &VoronoiArgs) -> bool {
    !["box", "hull"].map(Path::new).contains(&args.clip.as_path())
}

/// Refuses a box in the place of the name of a file.
pub(crate) fn refuse_numbers(args: &VoronoiArgs) -> Result<(), Failure> {
    let Some(text) = args.clip.to_str() else { return Ok(()) };
    if text.contains(',') && text.split(',').all(|number| number.trim().parse::<f64>().is_ok()) {
        return Err(Failure::usage(
            format!("--clip takes box, hull or a file, not the numbers {text}"),
            format!("give the box as --box {text}"),
        ));
    }
    Ok(())
}

/// The polygons to clip to.
pub(crate) fn polygon_region(args: &VoronoiArgs, rings: &[Vec<[f64; 2]>]) -> Result<Region2, Failure> {
    Region2::polygon(rings).map_err(|error| {
        let help = "clip to a polygon whose rings cross nowhere and touch each other only at corners of both";
        Failure::new(format!("{}: {error}", args.clip.display()), help)
    })
}

/// The length up to which sides of cells are contracted, if any are.
pub(crate) fn merge(args: &VoronoiArgs, region: &Region2, stats: &mut Stats) -> Option<f64> {
    let length = args.merge?.of(region.bounds().into_iter().flatten());
    stats.set("merge", length);
    Some(length)
}

/// Why sides of a length are not contracted.
pub(crate) fn not_merged(error: Error) -> Failure {
    Failure::usage(error, "give --merge a length that is not negative, or auto")
}

/// The box or the hull to clip to.
pub(crate) fn region(args: &VoronoiArgs, triangulation: &Delaunay2) -> Result<Region2, Failure> {
    if args.clip == Path::new("hull") {
        return Region2::hull(triangulation)
            .map_err(|_| Failure::new("the sites span no area, so their hull has none", "clip to a --box"));
    }
    let (low, high) = match args.bounds[..] {
        [] => {
            let bounds = Bounds::of(triangulation.points().iter().copied());
            (bounds.low, bounds.high)
        }
        [x0, y0, x1, y1] => ([x0, y0], [x1, y1]),
        _ => {
            return Err(Failure::usage("--box needs four numbers", "give it as --box x0,y0,x1,y1"));
        }
    };
    Region2::rectangle(low, high).map_err(|error| {
        if args.bounds.is_empty() {
            Failure::new("the bounding box of the sites has no area", "give one with --box x0,y0,x1,y1")
        } else {
            Failure::usage(format!("--box: {error}"), "give it as --box x0,y0,x1,y1 with x0 < x1 and y0 < y1")
        }
    })
}
