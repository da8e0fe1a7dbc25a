//! The attributes of sites, for their cells.

use delone::Triangulation;
use delone_io::{Cloud, Features};

use crate::files;
use crate::message::lost;

/// The attributes of all sites, their heights too. Sites that equal an earlier one have no cell of their own.
pub(crate) fn features(about: &Cloud, sites: &impl Triangulation, quiet: bool) -> Features {
    if !files::are_attributes_kept() {
        return Features::default();
    }
    let features = match &about.z {
        Some(heights) => about.features.with_heights(heights),
        None => about.features.clone(),
    };
    let has_any =
        |point: usize| features.row(point).is_some_and(|row| features.table.row(row).next().is_some());
    let dropped = sites.duplicates().filter(|duplicate| has_any(duplicate.point)).count();
    if dropped > 0 {
        lost(
            quiet,
            format_args!("the attributes of sites that equal an earlier one are left out: {dropped}"),
        );
    }
    features
}
