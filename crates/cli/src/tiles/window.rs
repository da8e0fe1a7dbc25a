//! `delone window`: a part of a folder of tiles, or some of its points, as one mesh.
//!
//! Of a box: every triangle that may meet it, from the tiles whose region does and from all seams. They are those of the whole: the
//! triangulation of their corners has all of them, because what is empty of all points is empty of some, and the others are left
//! out. Of an overview: points at equal steps along the curve of each tile, triangulated.
//!
//! Cost: reading the tiles and seams concerned, one at a time, and the triangulation of what is shown.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use delone::tiles::{Node, Region};
use delone::{Delaunay2, TriangleId, Triangulation as _};
use delone_io::{Mesh, Trim, picture, write_mesh};

use super::manifest::{self, Manifest, place};
use super::node::Done;
use super::shards::{self, wrong};
use super::sums::Sums;
use crate::args::WindowArgs;
use crate::files;
use crate::message::{Failure, grouped, say};
use crate::progress::Phase;
use crate::room;
use crate::stats::Stats;

/// The largest number of triangles that become one mesh without a box.
const MAX_TRIANGLES_WITHOUT_BOX: u64 = 20_000_000;
/// In a picture the triangles of a tile have one of so many colors, and those of seams another.
const COLOURS: u32 = 7;

/// A name that is of no point.
const FOREIGN: &str = "a triangle has a corner that is no point";

/// Points by name, with heights if there are some, and triangles.
#[derive(Default)]
struct Part {
    corners: BTreeMap<u64, ([f64; 2], f64)>,
    /// By their sorted corners, with the tile that they are of, if it is one.
    triangles: BTreeMap<[u64; 3], Option<Node>>,
}

pub(crate) fn run(args: &WindowArgs, quiet: bool) -> Result<(), Failure> {
    let mut stats = Stats::start();
    let outputs = args.wkt.of(files::outputs(&args.output, args.to, args.stats.as_deref(), &[])?)?;
    room::check_formats::<Delaunay2>(&outputs)?;
    let paths = outputs.iter().map(|(path, _)| path.as_path());
    super::keep_apart(&args.folder, paths.chain(args.stats.as_deref()))?;
    let (plan, outcome) = manifest::finished(&args.folder)?;
    let known: BTreeMap<Node, Sums> =
        outcome.nodes.iter().filter_map(Done::parse).map(|done| (done.node, done.sums)).collect();
    let nodes: Vec<Node> = outcome.nodes.iter().filter_map(Done::parse).map(|done| done.node).collect();
    let window = window(args)?;
    if args.box_.is_empty() && args.points.is_none() && outcome.triangles() > MAX_TRIANGLES_WITHOUT_BOX {
        let what = format!("{} has {} triangles", args.folder.display(), grouped(outcome.triangles()));
        return Err(Failure::usage(what, "choose a part with --box, or an overview with --points"));
    }
    let of_window = Reader { folder: &args.folder, plan: &plan, known, window, quiet };
    let part = match args.points {
        Some(points) => of_window.overview(&nodes, (outcome.vertices / points.get()).max(1) as usize)?,
        None => of_window.part(&nodes)?,
    };
    stats.phase("read");
    let names: Vec<u64> = part.corners.keys().copied().collect();
    let points: Vec<[f64; 2]> = part.corners.values().map(|corner| corner.0).collect();
    let heights: Vec<f64> = part.corners.values().map(|corner| corner.1).collect();
    let d = Delaunay2::from_points(&points).map_err(|error| Failure::points(&args.folder, &error))?;
    let origin = |t| part.triangles.get(&sorted(d.corners(t).map(|v| names[v.index()])));
    let trim = args.points.is_none().then(|| Trim::keeping(&d, |t| origin(t).is_some()));
    let regions: Option<Vec<f64>> = args.tiles.then(|| colors(&d, |t| origin(t).copied().flatten()));
    stats.phase("build");
    let shown = trim.as_ref().map_or(0, Trim::count);
    stats.set("points", plan.count);
    stats.set("vertices", points.len());
    stats.set("simplices", d.simplices().count() - shown);
    let mesh = Mesh {
        heights: plan.has_heights.then_some(&heights[..]),
        regions: regions.as_deref(),
        trim: trim.as_ref(),
        ..Mesh::new(&d, &points)
    };
    let options = picture::Options {
        size: args.size,
        links: if args.tiles { cut_lines(&plan, &window, &points) } else { Vec::new() },
        window: args.box_.first().map(|_| [window.low, window.high]),
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
        _ => {
            let help = "as in --box 0,0,100,50: the least x and y, then the greatest";
            Err(Failure::usage("--box takes four numbers", help))
        }
    }
}

/// Whoever reads the tiles of a window.
struct Reader<'a> {
    folder: &'a Path,
    plan: &'a Manifest,
    /// The hashes of the files of each node.
    known: BTreeMap<Node, Sums>,
    window: Region,
    quiet: bool,
}

impl Reader<'_> {
    /// The triangles that may meet the window.
    fn part(&self, nodes: &[Node]) -> Result<Part, Failure> {
        let mut part = Part::default();
        let mut seams: Vec<[u64; 3]> = Vec::new();
        let phase = Phase::count(self.quiet, "reading", nodes.len() as u64);
        for &node in nodes.iter().filter(|&&node| self.plan.cuts.is_tile(node) && self.meets(node)) {
            let points = self.points(node)?;
            let path = self.checked("triangles", node)?;
            for t in shards::triangles(&path)? {
                let Some(corners) = corners(&points, t) else { return Err(wrong(&path, FOREIGN)) };
                if self.shows(corners.map(|corner| corner.0)) {
                    part.add(t.map(|v| node.id(v as u32)), corners, Some(node));
                }
            }
            phase.advance();
        }
        for &node in nodes.iter().filter(|&&node| !self.plan.cuts.is_tile(node)) {
            let path = self.checked("seam", node)?;
            seams.extend(shards::triangles(&path)?);
            phase.advance();
        }
        let known = shards::corners(self.folder, &self.plan.cuts, &seams, |node| self.points(node))?;
        for t in seams {
            let corners = t.map(|id| known[&id]);
            if self.shows(corners.map(|corner| corner.0)) {
                part.add(t, corners, None);
            }
        }
        Ok(part)
    }

    /// Of the points in the window one in so many.
    fn overview(&self, nodes: &[Node], step: usize) -> Result<Part, Failure> {
        let mut part = Part::default();
        let phase = Phase::count(self.quiet, "reading", nodes.len() as u64);
        for &node in nodes.iter().filter(|&&node| self.plan.cuts.is_tile(node) && self.meets(node)) {
            let points = self.points(node)?;
            let chosen =
                points.iter().enumerate().step_by(step).filter(|(_, point)| self.window.contains(point.0));
            part.corners.extend(chosen.map(|(v, &point)| (node.id(v as u32), point)));
            phase.advance();
        }
        Ok(part)
    }

    /// The points of a tile, with heights or zeros.
    fn points(&self, node: Node) -> Result<Vec<([f64; 2], f64)>, Failure> {
        self.checked("points", node)?;
        let cloud = shards::points(self.folder, node)?;
        let heights = cloud.z.unwrap_or_else(|| vec![0.0; cloud.xy.len()]);
        Ok(cloud.xy.into_iter().zip(heights).collect())
    }

    /// Where a file of a node is, if it is what was written.
    fn checked(&self, kind: &str, node: Node) -> Result<PathBuf, Failure> {
        let path = place(self.folder, kind, node, "npy");
        self.known.get(&node).map_or(Ok(()), |sums| sums.check_file(&path))?;
        Ok(path)
    }

    /// Whether the region of a node meets the window.
    fn meets(&self, node: Node) -> bool {
        let region = self.plan.cuts.region(node);
        (0..2).all(|k| region.low[k] <= self.window.high[k] && self.window.low[k] <= region.high[k])
    }

    /// Whether the box of a triangle meets the window.
    fn shows(&self, corners: [[f64; 2]; 3]) -> bool {
        (0..2).all(|k| {
            corners.iter().any(|p| p[k] >= self.window.low[k])
                && corners.iter().any(|p| p[k] <= self.window.high[k])
        })
    }
}

impl Part {
    fn add(&mut self, ids: [u64; 3], corners: [([f64; 2], f64); 3], tile: Option<Node>) {
        self.corners.extend(ids.into_iter().zip(corners));
        self.triangles.insert(sorted(ids), tile);
    }
}

/// The corners of a triangle of a tile, if they are points of it.
fn corners(points: &[([f64; 2], f64)], t: [u64; 3]) -> Option<[([f64; 2], f64); 3]> {
    let [a, b, c] = t.map(|v| points.get(usize::try_from(v).ok()?).copied());
    Some([a?, b?, c?])
}

fn sorted(mut ids: [u64; 3]) -> [u64; 3] {
    ids.sort_unstable();
    ids
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
fn cut_lines(plan: &Manifest, window: &Region, points: &[[f64; 2]]) -> Vec<[[f64; 2]; 2]> {
    let clip = |k: usize, x: f64| {
        let of_points = points.iter().map(|p| p[k]);
        let low = of_points.clone().fold(f64::INFINITY, f64::min).max(window.low[k]);
        let high = of_points.fold(f64::NEG_INFINITY, f64::max).min(window.high[k]);
        x.max(low).min(high)
    };
    let line = |(node, cut): (Node, delone::tiles::Cut)| {
        let region = plan.cuts.region(node);
        let end = |side: [f64; 2]| {
            let mut end = [clip(0, side[0]), clip(1, side[1])];
            end[cut.axis] = cut.at;
            end
        };
        let is_seen = cut.at >= clip(cut.axis, f64::NEG_INFINITY) && cut.at <= clip(cut.axis, f64::INFINITY);
        is_seen.then(|| [end(region.low), end(region.high)])
    };
    plan.cuts.cuts().into_iter().filter_map(line).collect()
}
