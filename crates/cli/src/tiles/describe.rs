//! `delone info FOLDER`: the contents of a folder of tiles, and how far it is.

use std::path::Path;

use delone_store::State;

use super::failure;
use crate::message::{Failure, answer};
use crate::stats::Stats;

/// Tells what is known of a folder.
pub(crate) fn describe(folder: &Path, stats_path: Option<&Path>) -> Result<(), Failure> {
    super::keep_apart(folder, stats_path)?;
    let mut stats = Stats::start();
    let found = delone_store::describe(folder).map_err(failure)?;
    let mut text = String::new();
    let mut line = |name: &str, value: String| text += &format!("{name:22} {value}\n");
    line("points", found.points.to_string());
    stats.set("points", found.points);
    line("heights", if found.heights { "kept" } else { "not kept" }.to_owned());
    line("tiles", found.tiles.to_string());
    stats.set("tiles", found.tiles);
    match found.state {
        State::Done(summary) => {
            let share =
                |part: u64, of: u64| format!("{part}, {:.2}% of all", 100.0 * part as f64 / of.max(1) as f64);
            line("state", "done".to_owned());
            line("duplicates", summary.duplicates.to_string());
            line("vertices", summary.vertices.to_string());
            line("triangles", summary.triangles.to_string());
            line("hull", summary.hull.to_string());
            line("points of borders", share(summary.border, summary.points));
            line("triangles of seams", share(summary.of_seams, summary.triangles));
            line("fingerprint", summary.fingerprint.to_string());
            stats.set("duplicates", summary.duplicates);
            stats.set("simplices", summary.triangles);
            stats.set("hull", summary.hull);
            stats.set("fingerprint", summary.fingerprint.to_string());
        }
        State::Distributed { done } => {
            line("state", format!("{done} of {} tiles are done: go on with --resume", found.tiles));
        }
        _ => line("state", "points are not distributed: go on with --resume".to_owned()),
    }
    stats.phase("read");
    stats.write(stats_path)?;
    answer(&text)
}
