//! Polygons of the input as regions of its triangulation.

use std::collections::BTreeSet;

use delone::{Constrained2, Domains2};
use delone_io::Graph;

/// Gives each part the polygon that it is in, of several the last, by the row of its attributes; the value of a polygon is the number of its
/// feature in the input, from 1. Seeds of regions go first, and polygons without rows are none. Tells how many there are.
pub(super) fn claim(c: &Constrained2, graph: &Graph, inside: &mut Domains2) -> usize {
    let mut rows = vec![None; graph.segments.len()];
    for ring in &graph.rings {
        rows[ring.segments.clone()].fill(graph.row_of(ring));
    }
    let distinct: BTreeSet<usize> = rows.iter().flatten().copied().collect();
    let Some(last) = distinct.last().filter(|_| graph.regions.is_empty()) else { return 0 };
    let numbers: Vec<f64> = (0..=*last).map(|row| (row + 1) as f64).collect();
    c.claim_polygons(inside, |segment| rows.get(segment.index()).copied().flatten(), &numbers);
    distinct.len()
}
