//! Operations on segments and outlines, for the table.

use delone::{Constrained2, Crossings, Fill, Hull2, LineCells2, MedialAxis2, Region2, VertexId, Weld2};

use super::{Outcome, Set, meshes::segments};

/// Segments after welding, with the ways of the points that moved.
pub(super) fn welded(set: &Set<2>) -> Outcome<2> {
    let welded = Weld2::new(&set.points, &segments(set), set.unit / 64.0).expect("finite");
    let mut outcome = Outcome::default();
    for &[v, w] in &welded.segments {
        outcome.set(vec![set.points[v], set.points[w]]);
    }
    outcome.measure(&[], welded.largest_move, 1);
    outcome.measure(&[], welded.bends as f64, 0);
    outcome
}

/// The clipped cells of segments.
pub(super) fn cells(set: &Set<2>) -> Outcome<2> {
    let (segments, unit) = (segments(set), set.unit);
    let lines: Vec<usize> = (0..segments.len()).collect();
    let region = Region2::rectangle([-0.25 * unit; 2], [1.25 * unit; 2]).expect("a box");
    let made = LineCells2::new(&set.points, &segments, &lines, &region, unit / 16.0).expect("cells");
    let mut outcome = Outcome::default();
    for (line, ends) in segments.iter().enumerate() {
        let cell = VertexId::new(line);
        made.cells.rings(cell).for_each(|ring| outcome.ring(ring.points().collect()));
        outcome.measure(&ends.map(|i| set.points[i]), made.cells.area(cell), 2);
    }
    outcome.measure(&[], made.deviation, 1);
    outcome
}

/// The medial axis of the hull without a polygon in it, and the narrowest gap between their sides.
pub(super) fn axis(set: &Set<2>) -> Outcome<2> {
    let hull = Hull2::from_points(&set.points).expect("finite");
    let mut corners: Vec<[f64; 2]> = hull.corners().iter().map(|&i| set.points[i]).collect();
    let ring =
        |first: usize, end: usize| (first..end).map(move |i| [i, if i + 1 < end { i + 1 } else { first }]);
    let count = corners.len();
    // Some sets are larger than their unit.
    let width = corners.iter().map(|p| p[0].abs()).fold(0.0, f64::max);
    corners.extend(&set.queries[..5]);
    let sides: Vec<[usize; 2]> = ring(0, count).chain(ring(count, count + 5)).collect();
    let c = Constrained2::with_crossings(&corners, &sides, Crossings::Split).expect("segments");
    let domains = c.domains(&Fill::EvenOdd).expect("areas");
    let axis = MedialAxis2::new(&c, &domains, width / 32.0, 30.0).expect("an axis");
    let mut outcome = Outcome::default();
    for (edge, &width) in axis.edges.iter().zip(&axis.widths) {
        outcome.measure(&edge.map(|i| axis.points[i]), width, 1);
    }
    let gap = c.narrowest_gap(&domains).map_or(0.0, |gap| gap.width);
    outcome.measure(&[], gap, 1);
    outcome
}
