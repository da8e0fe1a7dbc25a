//! Construction in bulk: biased randomized insertion order along a Hilbert curve, walks, cavities.
//!
//! Source: Amenta, Choi & Rote, "Incremental constructions con BRIO", SoCG 2003. Points are kept in memory in the order of
//! the curve, so neighbours in space are neighbours in memory.
//!
//! Cost: O(n log n) expected where the triangulation has O(n) tetrahedra, as on evenly spread points; in the worst
//! case the triangulation itself is of size O(n^2).

mod apart;
mod cut;
mod part;

use super::Position3;
use super::arena::Arena;
use super::cavity::Cavity;
use super::layer::Layer;
use crate::ids::{Duplicate, Place};
use crate::locate::tally::Tally;
use crate::mesh::Names;
use crate::order::curve;

/// Tetrahedra a point that room is made for at once: evenly spread points have 6.77.
const ROOM: usize = 7;

/// Triangulates finite points, at most [`crate::MAX_POINTS_IN_SPACE`] of them.
pub(super) fn triangulate<P: Position3, T: Tally + Default + Send>(
    points: &[P],
    seed: u64,
    tally: &mut T,
) -> (Layer, Vec<Duplicate>) {
    let apart = apart::triangulate_apart(points, seed, tally);
    let (layer, mut duplicates) = apart.unwrap_or_else(|| triangulate_whole(points, seed, tally));
    Duplicate::settle(&mut duplicates);
    (layer, duplicates)
}

fn triangulate_whole<P: Position3, T: Tally>(
    points: &[P],
    seed: u64,
    tally: &mut T,
) -> (Layer, Vec<Duplicate>) {
    let order = curve::hilbert(points.len(), &|i| points[i as usize].xyz());
    let kept = order.iter().map(|&i| points[i as usize].xyz()).collect();
    let mut layer = Layer::new(kept);
    layer.mesh.names = Names::along(&order);
    let room = ROOM * points.len();
    layer.mesh.cells.reserve_exact(room);
    layer.mesh.marks.reserve_exact(room);
    drop(order);
    let mut duplicates = Vec::new();
    build(&mut layer, &curve::rounds(points.len(), seed), &mut duplicates, tally);
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
    let mut cavity = std::mem::take(&mut layer.cavity);
    let mut twins = Vec::new();
    let all = insert_all(layer, &mut cavity, &first, order, &mut twins, tally);
    debug_assert!(all.is_some(), "a layer has room");
    layer.cavity = cavity;
    layer.mesh.vertex_count = order.len() - twins.len();
    let names = &mut layer.mesh.names;
    duplicates.extend(twins.into_iter().map(|(v, w)| names.coincide(names.of(v), w)));
}

/// Makes the points at some places vertices where the first of them are vertices already; those that equal a vertex are
/// listed with it. `None` if there is no room.
fn insert_all<A: Arena, T: Tally>(
    arena: &mut A,
    cavity: &mut Cavity,
    first: &[Place],
    order: &[u32],
    twins: &mut Vec<(Place, Place)>,
    tally: &mut T,
) -> Option<()> {
    let Some(&a) = first.first() else { return Some(()) };
    let mut last = arena.memory().incident[a.index()];
    for v in order.iter().map(|&i| Place::new(i as usize)) {
        if first.contains(&v) {
            continue;
        }
        let view = arena.view();
        let q = view.points[v.index()];
        last = view.walk(last, q, tally);
        if let Some(w) = view.vertex_at(last, q) {
            twins.push((v, w));
            continue;
        }
        cavity.insert(arena, v, last, tally)?;
        last = arena.memory().incident[v.index()];
    }
    Some(())
}
