//! Construction in bulk: biased randomized insertion order along a Hilbert curve, walks, cavities.
//!
//! Source: Amenta, Choi & Rote, "Incremental constructions con BRIO", SoCG 2003. Points are kept in memory in the order of
//! the curve, so neighbours in space are neighbours in memory.
//!
//! Cost: O(n log n) expected where the triangulation has O(n) tetrahedra, as on evenly spread points; in the worst
//! case the triangulation itself is of size O(n^2).

use super::Position3;
use super::layer::Layer;
use crate::ids::{Duplicate, Place};
use crate::locate::tally::Tally;
use crate::mesh::Names;
use crate::order::curve;

/// Tetrahedra a point that room is made for at once: evenly spread points have 6.77.
const USUAL: usize = 7;

/// Triangulates finite points, at most [`crate::MAX_POINTS_IN_SPACE`] of them.
pub(super) fn triangulate<P: Position3, T: Tally>(
    points: &[P],
    seed: u64,
    tally: &mut T,
) -> (Layer, Vec<Duplicate>) {
    let order = curve::hilbert(points.len(), &|i| points[i as usize].xyz());
    let kept = order.iter().map(|&i| points[i as usize].xyz()).collect();
    let mut layer = Layer::new(kept);
    layer.mesh.names = Names::along(&order);
    let room = USUAL * points.len();
    layer.mesh.cells.reserve_exact(room);
    layer.mesh.marks.reserve_exact(room);
    drop(order);
    let mut duplicates = Vec::new();
    build(&mut layer, &curve::rounds(points.len(), seed), &mut duplicates, tally);
    Duplicate::settle(&mut duplicates);
    (layer, duplicates)
}

/// Makes the points at some places vertices, in this order, in an empty mesh. Those that equal others become
/// duplicates.
pub(super) fn build<T: Tally>(
    layer: &mut Layer,
    order: &[u32],
    duplicates: &mut Vec<Duplicate>,
    tally: &mut T,
) {
    let first = layer.begin(order);
    let Some(&a) = first.first() else { return };
    let mut last = layer.mesh.incident[a.index()];
    for v in order.iter().map(|&i| Place::new(i as usize)) {
        if first.contains(&v) {
            continue;
        }
        let q = layer.points[v.index()];
        last = layer.walk(last, q, tally);
        if let Some(w) = layer.vertex_at(last, q) {
            let name = layer.mesh.names.of(v);
            duplicates.push(layer.mesh.names.coincide(name, w));
            continue;
        }
        layer.insert(v, last, tally);
        last = layer.mesh.incident[v.index()];
    }
}
