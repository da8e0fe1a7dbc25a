//! `--weld`: points and segments of a graph that nearly touch become one, and what that did is told.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use delone::Weld2;
use delone_io::{Graph, GraphRing};
use serde_json::{Value, json};

use crate::message::{Failure, grouped, note};
use crate::stats::Stats;

/// Rings and groups that are named; more are counted.
const NAMED: usize = 10;

/// Welds a graph, if that is asked for. Points keep their indices: those that became another one are where that one is.
pub(crate) fn weld(
    graph: &mut Graph,
    tolerance: Option<f64>,
    label: &Path,
    stats: &mut Stats,
    quiet: bool,
) -> Result<(), Failure> {
    let Some(tolerance) = tolerance else { return Ok(()) };
    let welded = Weld2::new(&graph.cloud.xy, &graph.segments, tolerance)
        .map_err(|error| Failure::graph(label, &error))?;
    let given = graph.cloud.xy.clone();
    graph.lone = Some(graph.lone_points());
    for (p, &to) in graph.cloud.xy.iter_mut().zip(&welded.stays) {
        *p = given[to];
    }
    let straight = replace_segments(graph, &welded, &given);
    if straight > 0 {
        note(
            quiet,
            format_args!("arcs with an end or a vertex that was welded are straight now: {straight}"),
        );
    }
    let mut groups: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for (i, &to) in welded.stays.iter().enumerate().filter(|&(i, &to)| given[i] != given[to]) {
        groups.entry(to).or_insert_with(|| vec![to]).push(i);
    }
    let counts = [("moved", welded.moved), ("bends", welded.bends), ("collapsed", welded.collapsed)];
    let mut report =
        json!({ "largest_move": welded.largest_move, "groups": groups.values().collect::<Vec<_>>() });
    counts.iter().for_each(|(name, count)| report[*name] = Value::from(*count));
    stats.set("weld", report);
    if welded.moved + welded.bends > 0 {
        let [moved, bends, collapsed] = counts.map(|(_, count)| grouped(count as u64));
        let (count, largest) = (grouped(groups.len() as u64), welded.largest_move);
        note(
            quiet,
            format_args!(
                "welded: points moved by up to {largest}: {moved}, groups: {count}, vertices that joined a segment: {bends}, segments that became a point: {collapsed}"
            ),
        );
    }
    tell_gone(graph, quiet);
    Ok(())
}

/// Welds points without segments, if that is asked for.
pub(crate) fn weld_points(
    points: &mut Vec<[f64; 2]>,
    tolerance: Option<f64>,
    label: &Path,
    stats: &mut Stats,
    quiet: bool,
) -> Result<(), Failure> {
    let mut graph = Graph::default();
    std::mem::swap(&mut graph.cloud.xy, points);
    weld(&mut graph, tolerance, label, stats, quiet)?;
    *points = graph.cloud.xy;
    Ok(())
}

/// Gives segments their pieces. Returns how many arcs could not stay.
fn replace_segments(graph: &mut Graph, welded: &Weld2, given: &[[f64; 2]]) -> usize {
    let start = |segment: usize| welded.origins.partition_point(|&origin| origin < segment);
    for GraphRing { segments, .. } in &mut graph.rings {
        *segments = start(segments.start)..start(segments.end);
    }
    let arcs = graph.arcs.len();
    let stayed = |&(segment, center): &(usize, [f64; 2])| {
        let is_whole = start(segment + 1) - start(segment) == 1;
        let is_still = graph.segments[segment].iter().all(|&i| given[i] == graph.cloud.xy[i]);
        (is_whole && is_still).then(|| (start(segment), center))
    };
    graph.arcs = graph.arcs.iter().filter_map(stayed).collect();
    let of_origins = |values: &[i64]| welded.origins.iter().filter_map(|&s| values.get(s).copied()).collect();
    graph.markers = graph.markers.as_deref().map(of_origins);
    graph.is_border =
        welded.origins.iter().map(|&s| graph.is_border.get(s).copied().unwrap_or(true)).collect();
    // Pieces start at vertices of other features, too.
    graph.rows = Some(welded.origins.iter().map(|&segment| graph.row_of_segment(segment)).collect());
    graph.segments.clone_from(&welded.segments);
    arcs - graph.arcs.len()
}

/// Tells which rings have no area left: each of their edges is there an even number of times.
fn tell_gone(graph: &Graph, quiet: bool) {
    let is_gone = |ring: &&GraphRing| {
        let mut odd = BTreeSet::new();
        for &[v, w] in &graph.segments[ring.segments.clone()] {
            let edge = [v.min(w), v.max(w)];
            if !odd.remove(&edge) {
                odd.insert(edge);
            }
        }
        odd.is_empty()
    };
    let gone: Vec<&GraphRing> = graph.rings.iter().filter(is_gone).collect();
    for ring in gone.iter().take(NAMED) {
        let what = if ring.ring == 0 { "has no area left" } else { "is a hole that closed" };
        note(quiet, format_args!("polygon {}, ring {} {what}", ring.polygon, ring.ring));
    }
    if gone.len() > NAMED {
        note(quiet, format_args!("{} more rings have no area left", gone.len() - NAMED));
    }
}
