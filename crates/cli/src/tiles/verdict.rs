//! `delone check FOLDER`: whether tiles and seams are the canonical triangulation of their points.

use std::path::Path;

use delone_store::Store;

use super::{Watched, failure};
use crate::message::{Failure, answer};
use crate::stats::Stats;

/// Judges a folder.
pub(crate) fn check(folder: &Path, stats_path: Option<&Path>, quiet: bool) -> Result<(), Failure> {
    let mut stats = Stats::start();
    super::keep_apart(folder, stats_path)?;
    let store = Store::open(folder).map_err(failure)?;
    store.verify(&Watched::new(folder, quiet)).map_err(failure)?;
    let summary = store.summary();
    stats.phase("check");
    stats.set("points", summary.points);
    stats.set("duplicates", summary.duplicates);
    stats.set("simplices", summary.triangles);
    stats.set("hull", summary.hull);
    stats.set("fingerprint", summary.fingerprint.to_string());
    stats.write(stats_path)?;
    answer(&format!(
        "Delaunay, and the canonical triangulation: {} triangles of {} vertices in {}\nfingerprint {}\n",
        summary.triangles,
        summary.vertices,
        super::in_tiles(summary.tiles),
        summary.fingerprint
    ))
}
