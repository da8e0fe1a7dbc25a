//! `delone info FOLDER`: what a folder of tiles has, and how far it is.

use std::path::Path;

use super::manifest::{self, Manifest};
use super::node::Done;
use crate::message::{Failure, answer};
use crate::stats::Stats;

/// Tells what is known of a folder.
pub(crate) fn describe(folder: &Path, stats_path: Option<&Path>) -> Result<(), Failure> {
    super::keep_apart(folder, stats_path)?;
    let mut stats = Stats::start();
    let plan = Manifest::read(folder)?.ok_or_else(|| manifest::no_tiles(folder))?;
    let tiles = plan.cuts.tiles();
    let mut text = String::new();
    let mut line = |name: &str, value: String| text += &format!("{name:22} {value}\n");
    line("points", plan.count.to_string());
    stats.set("points", plan.count);
    line("heights", if plan.has_heights { "kept" } else { "not kept" }.to_owned());
    line("tiles", tiles.len().to_string());
    stats.set("tiles", tiles.len());
    match (&plan.outcome, &plan.buckets) {
        (Some(outcome), _) => {
            let nodes: Vec<Done> = outcome.nodes.iter().filter_map(Done::parse).collect();
            let of_tiles = || nodes.iter().filter(|done| plan.cuts.halves(done.node).is_none());
            let border: u64 = of_tiles().map(|done| done.border).sum();
            let between: u64 =
                outcome.triangles() - of_tiles().map(|done| done.fingerprint.count()).sum::<u64>();
            let share =
                |part: u64, of: u64| format!("{part}, {:.2}% of all", 100.0 * part as f64 / of.max(1) as f64);
            line("state", "done".to_owned());
            line("duplicates", outcome.duplicates.to_string());
            line("vertices", outcome.vertices.to_string());
            line("triangles", outcome.triangles().to_string());
            line("hull", outcome.hull.to_string());
            line("points of borders", share(border, plan.count));
            line("triangles of seams", share(between, outcome.triangles()));
            line("fingerprint", outcome.fingerprint.to_string());
            stats.set("duplicates", outcome.duplicates);
            stats.set("simplices", outcome.triangles());
            stats.set("hull", outcome.hull);
            stats.set("fingerprint", outcome.fingerprint.to_string());
        }
        (None, Some(_)) => {
            let mut done = 0;
            for &tile in &tiles {
                done += usize::from(Done::find(folder, tile)?.is_some());
            }
            line("state", format!("{done} of {} tiles are done: go on with --resume", tiles.len()));
        }
        (None, None) => line("state", "points are not distributed: go on with --resume".to_owned()),
    }
    stats.phase("read");
    stats.write(stats_path)?;
    answer(&text)
}
