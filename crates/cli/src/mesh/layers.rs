//! Boundary layers: the segments that they are on, and the constraints that are none of theirs.

use std::collections::BTreeSet;

use delone::{Constrained2, Layers2, SegmentId};
use delone_io::Graph;

use crate::message::Failure;

/// Layers on the segments with some markers, or on all of the border if there are no markers.
pub(super) fn on_segments(
    layers: Option<&Layers2>,
    markers: &[i64],
    c: &Constrained2,
    graph: &Graph,
) -> Result<Option<Layers2>, Failure> {
    let Some(layers) = layers.cloned() else { return Ok(None) };
    if markers.is_empty() {
        return Ok(Some(layers));
    }
    let given = graph.markers.as_deref().unwrap_or_default();
    let marker = |s: SegmentId| given.get(s.index()).copied().unwrap_or_default();
    let known: BTreeSet<i64> = c.segments().map(|(s, _)| marker(s)).collect();
    if let Some(unknown) = markers.iter().find(|marker| !known.contains(marker)) {
        let known: Vec<String> = known.iter().map(ToString::to_string).collect();
        return Err(Failure::new(
            format!("no segment has the marker {unknown}, so there is nothing for --layers"),
            format!("the markers of segments are {}", known.join(", ")),
        ));
    }
    let chosen = c.segments().map(|(s, _)| s).filter(|&s| markers.contains(&marker(s)));
    Ok(Some(layers.on(chosen.collect())))
}
