//! Features of the input in its triangulation: rings with their holes, lines as edges.

use std::collections::HashSet;

use delone::{Constrained2, Domains2, EdgeId, Location2, SegmentId};
use delone_io::Graph;

use super::regions::Regions;
use crate::files::Unshown;
use crate::message::note;

/// Leaves out seeds outside of the hull, which are in no part, and tells how many.
pub(super) fn leave_far_seeds(c: &Constrained2, graph: &mut Graph, quiet: bool) {
    let is_far = |at: [f64; 2]| matches!(c.locate(at), Ok(Location2::Outside(_)));
    let before = [graph.holes.len(), graph.regions.len()];
    graph.holes.retain(|&at| !is_far(at));
    graph.regions.retain(|region| !is_far(region.at));
    let left = [before[0] - graph.holes.len(), before[1] - graph.regions.len()];
    for (count, what) in left.into_iter().zip(["holes", "regions"]) {
        if count > 0 {
            note(quiet, format_args!("seeds of {what} outside of the convex hull: {count}, left out"));
        }
    }
}

/// The shell of each ring: of a shell, itself.
pub(crate) fn shells_of(graph: &Graph) -> Vec<usize> {
    let mut shells: Vec<usize> = Vec::with_capacity(graph.rings.len());
    for (number, ring) in graph.rings.iter().enumerate() {
        let is_hole = ring.ring > 0 && number > 0;
        shells.push(if is_hole { shells[number - 1] } else { number });
    }
    shells
}

/// Rings as the library has them: which one a segment is of, and the shell of each.
pub(super) struct Shells {
    ring_of: Vec<Option<usize>>,
    shells: Vec<usize>,
}

impl Shells {
    pub(super) fn of(graph: &Graph) -> Self {
        let mut ring_of = vec![None; graph.segments.len()];
        for (number, ring) in graph.rings.iter().enumerate() {
            ring_of[ring.segments.clone()].fill(Some(number));
        }
        Self { ring_of, shells: shells_of(graph) }
    }

    /// The ring of a segment.
    pub(super) fn ring(&self, s: SegmentId) -> Option<usize> {
        self.ring_of.get(s.index()).copied().flatten()
    }

    /// The shell of each ring.
    pub(super) fn shells(&self) -> &[usize] {
        &self.shells
    }

    /// Places in shells and in none of their holes.
    pub(super) fn minus_holes(&self, c: &Constrained2) -> Domains2 {
        c.shells_minus_holes(|s| self.ring(s), &self.shells)
    }

    /// A remark on holes that are filled at least in part, if there are any.
    pub(super) fn remark(&self, c: &Constrained2, graph: &Graph, inside: &Domains2) -> Option<String> {
        let filled = c.filled_holes(inside, |s| self.ring(s), &self.shells);
        let first = &graph.rings[*filled.first()?];
        Some(filled_holes(filled.len(), first.polygon, first.ring))
    }
}

/// A remark on so many holes that are filled at least in part.
pub(crate) fn filled_holes(count: usize, polygon: usize, ring: usize) -> String {
    format!(
        "holes that are filled at least in part: {count} (polygon {polygon}, ring {ring}); --fill shells-minus-holes leaves them out"
    )
}

/// The row of the attributes of each constraint, in the order of these: of the first line on it that has any. Nothing if no line has.
pub(crate) fn of_lines(c: &Constrained2, graph: &Graph) -> Option<Vec<Option<usize>>> {
    let rows = rows_of_lines(graph);
    let of = |e| c.covering(e).iter().find_map(|one| rows.get(one.segment.index()).copied().flatten());
    rows.iter().any(Option::is_some).then(|| c.constraint_edges().map(of).collect())
}

/// The row of each segment that is no side of a polygon.
pub(crate) fn rows_of_lines(graph: &Graph) -> Vec<Option<usize>> {
    let mut rows: Vec<Option<usize>> =
        (0..graph.segments.len()).map(|segment| graph.row_of_segment(segment)).collect();
    graph.rings.iter().for_each(|ring| rows[ring.segments.clone()].fill(None));
    rows
}

/// The attributes that triangles inside do not have: those of lines, of points that no segment ends at, and of what has neither an edge nor
/// a triangle to itself.
pub(crate) fn unshown(c: &Constrained2, graph: &Graph, inside: &Domains2, regions: &Regions) -> Unshown {
    let lines: HashSet<usize> = rows_of_lines(graph).into_iter().flatten().collect();
    let polygons: HashSet<usize> = graph.rings.iter().filter_map(|ring| graph.row_of(ring)).collect();
    let is_inside =
        |e: EdgeId| inside.is_inside(e.triangle()) || inside.is_inside(c.mesh().twin(e).triangle());
    let rows = of_lines(c, graph).unwrap_or_default();
    let edges = c.constraint_edges().zip(rows).filter(|edge| is_inside(edge.0));
    let shown: HashSet<usize> = edges.filter_map(|(_, row)| row).collect();
    let triangles = c.triangle_ids().filter(|&t| inside.is_inside(t));
    let filled: HashSet<usize> = triangles.filter_map(|t| inside.region(t)).map(|r| regions.row(r)).collect();
    let is_lone = graph.lone_points();
    Unshown {
        lines: (!lines.is_empty()).then(|| !lines.is_subset(&shown)),
        hidden_polygons: !polygons.is_subset(&filled),
        points: (0..is_lone.len()).any(|i| is_lone[i] && graph.cloud.features.row(i).is_some()),
    }
}
