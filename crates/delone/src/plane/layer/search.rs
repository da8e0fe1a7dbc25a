//! The vertex nearest to a point, from a start near it: phases two and three of the Delaunay hierarchy, in the plane.
//!
//! Source: Devillers, "Improved incremental randomized Delaunay triangulation", SoCG 1998, §3 and §4.3.
//! Cost: the walk, and O(1) expected on random points.

use std::cmp::Ordering;

use super::Layer;
use super::kernel::Kernel;
use super::walk::walk;
use crate::ids::{EdgeId, Place, TriangleId};
use crate::locate::{Ground, Start};
use crate::tally::Tally;

/// Walks to `q`; then the nearest corner of the triangle found or, exactly, the nearest vertex.
pub(in crate::plane) fn near<K: Kernel, T: Tally>(
    layer: &Layer<K>,
    start: Start,
    q: [f64; 2],
    exactly: bool,
    tally: &mut T,
) -> Place {
    let triangle = walk(layer, start, q, tally).triangle;
    let corners = layer.mesh.places(triangle).into_iter().filter(|v| !v.is_ghost());
    let nearer = |a: Place, b: Place| if layer.compare_distances(q, b, a) == Ordering::Less { b } else { a };
    let best = corners.reduce(nearer).expect("a triangle has a finite corner");
    (0..3).for_each(|_| tally.compared());
    if exactly { search(layer, triangle, best, q, tally) } else { best }
}

/// Phase 3, exactly: outwards from the triangle that contains `q`, across the edges at the nearest vertex known
/// and across those whose nearer end sees the query and the other end at an acute angle.
fn search<K: Kernel, T: Tally>(
    layer: &Layer<K>,
    triangle: TriangleId,
    corner: Place,
    q: [f64; 2],
    tally: &mut T,
) -> Place {
    let mesh = &layer.mesh;
    let mut best = corner;
    let mut pending: Vec<EdgeId> = [0, 1, 2]
        .map(|k| triangle.edge(k))
        .into_iter()
        .filter(|&e| mesh.tail(e) == corner || mesh.head(e) == corner)
        .collect();
    while let Some(e) = pending.pop() {
        let entered = mesh.twin(e);
        let tip = mesh.tip(entered);
        if tip.is_ghost() || mesh.tail(e).is_ghost() || mesh.head(e).is_ghost() {
            continue;
        }
        tally.visited();
        tally.compared();
        if layer.compare_distances(q, tip, best) == Ordering::Less {
            best = tip;
        }
        let corners = mesh.places(entered.triangle());
        let nearest = corners
            .into_iter()
            .reduce(|a, b| if layer.compare_distances(q, b, a) == Ordering::Less { b } else { a })
            .unwrap_or(tip);
        for side in [entered.next(), entered.previous()] {
            let (a, b) = (mesh.tail(side), mesh.head(side));
            let other = match nearest {
                w if w == a => b,
                w if w == b => a,
                _ => continue,
            };
            if layer.is_acute(nearest, q, other) {
                pending.push(side);
            }
        }
    }
    best
}
