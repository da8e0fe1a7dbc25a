//! `delone window`: a part of a folder of tiles, or some of its points, as one mesh.
//!
//! The corners of what is shown are triangulated, which gives all triangles that were chosen; the others are left out.

use delone::tiles::{Cuts, Node, Region};
use delone::{Delaunay2, TriangleId, Triangulation as _};
use delone_io::{Mesh, Trim, picture, write_mesh};
use delone_store::Store;

use super::{Watched, failure};
use crate::args::WindowArgs;
use crate::files;
use crate::message::{Failure, grouped, note, say};
use crate::room;
use crate::stats::Stats;

/// The largest number of triangles that become one mesh without a box.
const MAX_TRIANGLES_WITHOUT_BOX: u64 = 20_000_000;
/// In a picture the triangles of a tile have one of so many colors, and those of seams another.
const COLOURS: u32 = 7;

pub(crate) fn run(args: &WindowArgs, quiet: bool) -> Result<(), Failure> {
    let mut stats = Stats::start();
    let outputs = args.wkt.of(files::outputs(&args.output, args.to, args.stats.as_deref(), &[])?)?;
    room::check_formats::<Delaunay2>(&outputs)?;
    let paths = outputs.iter().map(|(path, _)| path.as_path());
    super::keep_apart(&args.folder, paths.chain(args.stats.as_deref()))?;
    let store = Store::open(&args.folder).map_err(failure)?;
    let summary = store.summary();
    let window = window(args)?;
    if args.box_.is_empty() && args.points.is_none() && summary.triangles > MAX_TRIANGLES_WITHOUT_BOX {
        let what = format!("{} has {} triangles", args.folder.display(), grouped(summary.triangles));
        return Err(Failure::usage(what, "choose a part with --box, or an overview with --points"));
    }
    let watch = Watched::new(&args.folder, quiet);
    let part = match args.points {
        Some(points) => store.overview(&window, (summary.vertices / points.get()).max(1) as usize, &watch),
        None => store.window(&window, &watch),
    };
    let part = part.map_err(failure)?;
    stats.phase("read");
    let (names, points, heights) = (part.names(), part.points(), part.heights());
    let d = Delaunay2::from_points(&points).map_err(|error| Failure::points(&args.folder, &error))?;
    let origin = |t| part.tile_of(d.corners(t).map(|v| names[v.index()]));
    let trim = args.points.is_none().then(|| Trim::keeping(&d, |t| origin(t).is_some()));
    let regions: Option<Vec<f64>> = args.tiles.then(|| colors(&d, |t| origin(t).flatten()));
    stats.phase("build");
    if points.is_empty() && summary.points > 0 && !args.box_.is_empty() {
        let folder = args.folder.display();
        let what = if args.points.is_some() { "point of" } else { "triangle of" };
        note(quiet, format_args!("no {what} {folder} is in the box: the output is empty"));
    }
    let shown = trim.as_ref().map_or(0, Trim::count);
    stats.set("points", summary.points);
    stats.set("vertices", points.len());
    stats.set("simplices", d.simplices().count() - shown);
    let crs = store.crs();
    files::keep_system(crs.as_ref(), &args.folder);
    let mesh = Mesh {
        crs: crs.as_ref(),
        heights: store.has_heights().then_some(&heights[..]),
        regions: regions.as_deref(),
        trim: trim.as_ref(),
        ..Mesh::new(&d, &points)
    };
    let options = picture::Options {
        size: args.size,
        links: if args.tiles { cut_lines(store.cuts(), &window, &points) } else { Vec::new() },
        // The border of the box, as far as the picture goes beyond it.
        faint: if args.box_.is_empty() { Vec::new() } else { sides(&window) },
        window: if args.box_.is_empty() { None } else { shown_window(&window, &points) },
        legend: !args.tiles,
        ..picture::Options::default()
    };
    for (path, format) in &outputs {
        files::write(path, |out| write_mesh(out, *format, &mesh, &options))?;
    }
    stats.phase("write");
    let triangles = grouped((d.simplices().count() - shown) as u64);
    let vertices = grouped(points.len() as u64);
    say(quiet, format_args!("{vertices} points, {triangles} triangles ({:.2} s)", stats.total()));
    stats.write(args.stats.as_deref())
}

/// The box that was asked for; all if none was.
fn window(args: &WindowArgs) -> Result<Region, Failure> {
    match args.box_[..] {
        [] => Ok(Region::ALL),
        [a, b, c, d] if a <= c && b <= d => Ok(Region { low: [a, b], high: [c, d] }),
        [a, b, c, d] if a > c || b > d => {
            let what =
                format!("--box goes from {a:?},{b:?} to {c:?},{d:?}: its first corner is not the least");
            let [x, y] = [[a.min(c), a.max(c)], [b.min(d), b.max(d)]];
            let help = format!("--box {:?},{:?},{:?},{:?} is that box", x[0], y[0], x[1], y[1]);
            Err(Failure::usage(what, help))
        }
        _ => {
            let help = "as in --box 0,0,100,50: the least x and y, then the greatest";
            Err(Failure::usage("--box takes four numbers", help))
        }
    }
}

/// The sides of a box.
fn sides(window: &Region) -> Vec<[[f64; 2]; 2]> {
    let ([a, b], [c, d]) = (window.low, window.high);
    vec![[[a, b], [c, b]], [[c, b], [c, d]], [[c, d], [a, d]], [[a, d], [a, b]]]
}

/// The part of the plane that a picture of a box shows: triangles across its border too, as far from it as it is wide or high.
fn shown_window(window: &Region, points: &[[f64; 2]]) -> Option<[[f64; 2]; 2]> {
    let ends = |k: usize| {
        let (low, high) = (window.low[k], window.high[k]);
        let side = high - low;
        let of_points = || points.iter().map(|p| p[k]);
        [of_points().fold(low, f64::min).max(low - side), of_points().fold(high, f64::max).min(high + side)]
    };
    let [x, y] = [ends(0), ends(1)];
    let is_finite = x.iter().chain(&y).all(|end| end.is_finite());
    is_finite.then_some([[x[0], y[0]], [x[1], y[1]]])
}

/// For each triangle, by its index, a number for its tile; that of seams is another one.
fn colors(d: &Delaunay2, tile: impl Fn(TriangleId) -> Option<Node>) -> Vec<f64> {
    let mut colors = vec![0.0; d.slot_count()];
    for t in d.simplices() {
        colors[d.index(t)] = tile(t).map_or(0.0, |node| f64::from(1 + node.number() % COLOURS));
    }
    colors
}

/// The cuts as far as they are in the window and the box of the points.
fn cut_lines(cuts: &Cuts, window: &Region, points: &[[f64; 2]]) -> Vec<[[f64; 2]; 2]> {
    let clip = |k: usize, x: f64| {
        let of_points = points.iter().map(|p| p[k]);
        let low = of_points.clone().fold(f64::INFINITY, f64::min).max(window.low[k]);
        let high = of_points.fold(f64::NEG_INFINITY, f64::max).min(window.high[k]);
        x.max(low).min(high)
    };
    let line = |(node, cut): (Node, delone::tiles::Cut)| {
        let region = cuts.region(node);
        let end = |side: [f64; 2]| {
            let mut end = [clip(0, side[0]), clip(1, side[1])];
            end[cut.axis] = cut.at;
            end
        };
        let is_seen = cut.at >= clip(cut.axis, f64::NEG_INFINITY) && cut.at <= clip(cut.axis, f64::INFINITY);
        is_seen.then(|| [end(region.low), end(region.high)])
    };
    cuts.cuts().into_iter().filter_map(line).collect()
}
