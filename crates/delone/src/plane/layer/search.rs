//! The vertex nearest to a point, from a start near it: phases two and three of the Delaunay hierarchy, in the plane.
//!
//! Source: Devillers, "Improved incremental randomized Delaunay triangulation", SoCG 1998, §3 and §4.3.
//! Cost: the walk, and O(1) expected on random points; O(log n) expected on a line (see `line`).

use std::cmp::Ordering;

use super::Layer;
use super::kernel::Kernel;
use super::walk::walk;
use crate::ids::{EdgeId, Place, TriangleId};
use crate::locate::conflict::{Beyond, search as search_region};
use crate::locate::{Ground, Nearest, Start};
use crate::tally::{Phase, Tally};

/// Walks to `q`; then the nearest corner of the triangle found or, exactly, the nearest vertex. Returns that triangle too.
/// While all vertices are on one line the nearest of them is found whichever is wanted.
pub(in crate::plane) fn near<K: Kernel, T: Tally>(
    layer: &Layer<K>,
    start: Start,
    q: [f64; 2],
    nearest: Nearest,
    tally: &mut T,
) -> (Place, EdgeId) {
    if !layer.spanned {
        return layer.near_on_line(q, tally);
    }
    let triangle = walk(layer, start, q, tally).triangle;
    tally.phase(Phase::Nearest);
    let is_outside = layer.mesh.is_ghost(triangle);
    // Beyond the hull, at the edge of it that is nearest.
    let triangle = if is_outside {
        layer.mesh.twin(layer.hull_edge_nearest_to(q, triangle, tally)).triangle()
    } else {
        triangle
    };
    let corners = layer.mesh.places(triangle).into_iter().filter(|v| !v.is_ghost());
    let nearer = |a: Place, b: Place| if layer.compare_distances(q, b, a) == Ordering::Less { b } else { a };
    let best = corners.reduce(nearer).expect("a triangle has a finite corner");
    (0..3).for_each(|_| tally.compared());
    let nearest = match nearest {
        Nearest::Corner => best,
        // Beyond the hull no triangle contains `q`.
        Nearest::Exact if is_outside => descend(layer, best, q, tally),
        Nearest::Exact => search(layer, triangle, best, q, tally),
        Nearest::InCircle => search_conflicts(layer, triangle, best, q, tally),
    };
    (nearest, triangle.edge(0))
}

/// Phase 3, exactly: outwards from the triangle that contains `q`, across edges behind which the circle contains it. The
/// corners of these triangles would be the neighbors of `q`, and the nearest vertex is one of them.
fn search_conflicts<K: Kernel, T: Tally>(
    layer: &Layer<K>,
    triangle: TriangleId,
    corner: Place,
    q: [f64; 2],
    tally: &mut T,
) -> Place {
    let mesh = &layer.mesh;
    if layer.points[corner.index()] == q {
        return corner;
    }
    let mut best = corner;
    // No vertex is inside of their union: none is met twice.
    let mut pending: Vec<EdgeId> = [0, 1, 2].map(|k| triangle.edge(k)).to_vec();
    search_region(&mut pending, |&e| {
        let entered = mesh.twin(e);
        let tip = mesh.tip(entered);
        let corners = [mesh.tail(entered), mesh.head(entered), tip];
        tally.in_circle();
        if !K::conflicts(corners, |k| layer.site(corners[k]), (q, K::Weight::default())) {
            return Beyond::Outside;
        }
        tally.visited();
        if !tip.is_ghost() {
            tally.compared();
            if layer.compare_distances(q, tip, best) == Ordering::Less {
                best = tip;
            }
        }
        Beyond::Inside(entered.previous(), [entered.next()])
    });
    best
}

/// Phase 3, exactly: outwards from the triangle that contains `q`, across the edges at the nearest vertex known
/// and across those whose nearer end sees the query and the other end at an acute angle. At a vertex of large degree these may
/// be many: the triangles there need no corner in the disk in which the proof of Lemma 5 counts them.
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

/// The nearest vertex, down along edges from another one.
fn descend<K: Kernel, T: Tally>(layer: &Layer<K>, from: Place, q: [f64; 2], tally: &mut T) -> Place {
    let mut best = from;
    loop {
        let before = best;
        for w in layer.mesh.spokes(before).map(|e| layer.mesh.head(e)).filter(|w| !w.is_ghost()) {
            tally.compared();
            if layer.compare_distances(q, w, best) == Ordering::Less {
                best = w;
            }
        }
        if best == before {
            return best;
        }
    }
}
