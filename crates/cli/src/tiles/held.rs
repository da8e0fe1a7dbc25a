//! A folder of tiles as a surface: its triangles with heights, as far as they meet some rows of a raster.
//!
//! Memory: one tile at a time, and the triangles of all seams.

use std::path::{Path, PathBuf};

use delone::tiles::Node;
use delone::{Bounds, Hull2};
use delone_io::Cloud;

use super::budget::Budget;
use super::input::Input;
use super::manifest::{Manifest, place};
use super::node::Done;
use super::shards::{self, wrong};
use crate::args::TilesArgs;
use crate::message::Failure;
use crate::progress::Phase;
use crate::stats::Stats;

/// A point with its height.
pub(crate) type Corner = ([f64; 2], f64);

/// Tiles that are done.
pub(crate) struct Held {
    folder: PathBuf,
    /// Each tile that has points, with the box around them and their number.
    tiles: Vec<(Node, Bounds<2>, usize)>,
    seams: Vec<[Corner; 3]>,
    pub(crate) bounds: Bounds<2>,
    /// The corners of the convex hull.
    pub(crate) hull: Vec<Corner>,
}

impl Held {
    /// Makes tiles of the input in an empty folder; tells what the files say besides, and notes what was counted.
    pub(crate) fn make(args: &TilesArgs, stats: &mut Stats, quiet: bool) -> Result<(Self, Cloud), Failure> {
        let folder = &args.output;
        let workers = args.workers.map_or(rayon::current_num_threads(), usize::from);
        let budget = Budget::new(args.memory, workers, args.tile)?;
        let input = Input::new(args)?;
        let (mut plan, about) = super::survey(folder, &input, &budget, quiet)?;
        stats.phase("read");
        super::distribute(folder, &mut plan, &input, (&budget, args.duplicates), quiet)?;
        super::triangulate(folder, &plan, &budget, args.duplicates, quiet)?;
        super::finish(folder, &mut plan, &budget, quiet)?;
        super::clean(folder, &plan);
        if let Some(outcome) = &plan.outcome {
            stats.set("points", plan.count);
            stats.set("duplicates", outcome.duplicates);
            stats.set("vertices", outcome.vertices);
            stats.set("simplices", outcome.triangles());
            stats.set("hull", outcome.hull);
            stats.set("tiles", plan.cuts.tiles().len());
        }
        let held = Self::open(folder, &plan, quiet)?;
        stats.phase("build");
        Ok((held, about))
    }

    fn open(folder: &Path, plan: &Manifest, quiet: bool) -> Result<Self, Failure> {
        let nodes = plan.outcome.iter().flat_map(|outcome| &outcome.nodes).filter_map(Done::parse);
        let (tiles, seams): (Vec<Node>, Vec<Node>) =
            nodes.map(|done| done.node).partition(|&node| plan.cuts.is_tile(node));
        let mut held = Self {
            folder: folder.to_owned(),
            tiles: Vec::new(),
            seams: Vec::new(),
            bounds: Bounds::default(),
            hull: Vec::new(),
        };
        let phase = Phase::count(quiet, "reading tiles", tiles.len() as u64);
        for node in tiles {
            let points = held.points(node)?;
            let bounds = Bounds::of(points.iter().map(|corner| corner.0));
            let hull = Hull2::from_points(&points.iter().map(|corner| corner.0).collect::<Vec<_>>());
            let hull = hull.map_err(|error| Failure::points(folder, &error))?;
            held.hull.extend(hull.corners().iter().map(|&v| points[v]));
            if !points.is_empty() {
                held.bounds.include(bounds.low);
                held.bounds.include(bounds.high);
                held.tiles.push((node, bounds, points.len()));
            }
            phase.advance();
        }
        let of_all = Hull2::from_points(&held.hull.iter().map(|corner| corner.0).collect::<Vec<_>>());
        let of_all = of_all.map_err(|error| Failure::points(folder, &error))?;
        held.hull = of_all.corners().iter().map(|&v| held.hull[v]).collect();
        let mut names = Vec::new();
        for node in seams {
            names.extend(shards::triangles(&place(folder, "seam", node, "npy"))?);
        }
        let known = shards::corners(folder, &plan.cuts, &names, |node| held.points(node))?;
        held.seams = names.into_iter().map(|t| t.map(|name| known[&name])).collect();
        Ok(held)
    }

    /// About how many points there are between two heights along y, if they are evenly spread in each tile.
    pub(crate) fn count_between(&self, [low, high]: [f64; 2]) -> f64 {
        let part = |&(_, bounds, count): &(Node, Bounds<2>, usize)| {
            let size = bounds.high[1] - bounds.low[1];
            let shared = bounds.high[1].min(high) - bounds.low[1].max(low);
            let share = if size > 0.0 { shared / size } else { 1.0 };
            if shared < 0.0 { 0.0 } else { count as f64 * share }
        };
        self.tiles.iter().map(part).sum()
    }

    /// All triangles whose box meets some range along y.
    pub(crate) fn each(&self, range: [f64; 2], mut take: impl FnMut([Corner; 3])) -> Result<(), Failure> {
        let meets = |t: &[Corner; 3]| {
            t.iter().any(|corner| corner.0[1] <= range[1]) && t.iter().any(|corner| corner.0[1] >= range[0])
        };
        for &(node, bounds, _) in &self.tiles {
            if bounds.low[1] > range[1] || bounds.high[1] < range[0] {
                continue;
            }
            let points = self.points(node)?;
            let path = place(&self.folder, "triangles", node, "npy");
            for t in shards::triangles(&path)? {
                let [a, b, c] = t.map(|v| points.get(v as usize).copied());
                let (Some(a), Some(b), Some(c)) = (a, b, c) else {
                    return Err(wrong(&path, "a triangle has a corner that is no point"));
                };
                if meets(&[a, b, c]) {
                    take([a, b, c]);
                }
            }
        }
        self.seams.iter().filter(|t| meets(t)).for_each(|t| take(*t));
        Ok(())
    }

    fn points(&self, node: Node) -> Result<Vec<Corner>, Failure> {
        let cloud = shards::points(&self.folder, node)?;
        let heights = cloud.z.unwrap_or_else(|| vec![0.0; cloud.xy.len()]);
        Ok(cloud.xy.into_iter().zip(heights).collect())
    }
}
