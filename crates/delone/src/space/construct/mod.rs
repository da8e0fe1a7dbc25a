//! Construction in bulk: biased randomized insertion order along a Hilbert curve, walks, cavities.
//!
//! Source: Amenta, Choi & Rote, "Incremental constructions con BRIO", SoCG 2003. Points are kept in memory in the order of
//! the curve, so neighbors in space are neighbors in memory.
//!
//! Large sets are cut in halves by coordinates (`cut`) and triangulated apart in slices of the final arrays (`part`). A tetrahedron
//! stays if its sphere avoids the boxes of all other parts. The rest is a hole, filled with the triangulation of its vertices (`apart`).
//! Cuts depend on the points alone. With weights, spheres must avoid the heaviest site beyond the cut.
//!
//! Cost: O(n log n) expected where the triangulation has O(n) tetrahedra, as on evenly spread points; in the worst
//! case the triangulation itself is of size O(n^2).

mod apart;
mod cut;
pub(super) mod flips;
mod in_order;
mod part;

pub(crate) use in_order::{InOrder3, in_order};

use std::ops::Range;

use cut::{Run, Sites, cut};

use super::layer::Layer;
use super::layer::arena::Arena;
use super::layer::cavity::Cavity;
use super::layer::kernel::{Lift, Region};
use crate::duplicates::settle;
use crate::ids::{Duplicate, Place, TetrahedronId};
use crate::mesh::Names;
use crate::order;
use crate::order::quantize::scaled;
use crate::parallel;
use crate::points::Position3;
use crate::tally::Tally;

/// Tetrahedra that room is made for at once: evenly spread points have 6.77 each.
const fn room(points: usize) -> usize {
    points * 69 / 10 + 64
}

/// Triangulates finite points, at most [`crate::MAX_POINTS_IN_SPACE`] of them. They are kept in another order; what is
/// given is dropped as soon as that is done. `None` if there would be too many tetrahedra.
pub(super) fn triangulate<P: Position3, T: Tally + Default + Send>(
    points: impl AsRef<[P]>,
    seed: u64,
    tally: &mut T,
) -> Option<(Layer, Vec<Duplicate>)> {
    let Some((scaled, scale)) = scaled_points(points.as_ref()) else {
        return Some(with_duplicates(triangulate_sites(points, Vec::new(), seed, tally)?));
    };
    drop(points);
    let (mut layer, duplicates) = with_duplicates(triangulate_sites(scaled, Vec::new(), seed, tally)?);
    layer.scale(1.0 / scale);
    Some((layer, duplicates))
}

/// Points that equal vertices are duplicates of them.
fn with_duplicates((mut layer, rest): (Layer, Rest)) -> (Layer, Vec<Duplicate>) {
    let mut duplicates = Vec::new();
    note_equal(&mut layer, &rest.equal, &mut duplicates);
    settle(&mut duplicates);
    (layer, duplicates)
}

/// Triangulates points with weights, one for each if there are any, and lists the sites that are no vertices. Names are those of all.
pub(super) fn triangulate_sites<P: Position3, W: Lift, T: Tally + Default + Send>(
    points: impl AsRef<[P]>,
    weights: Vec<W>,
    seed: u64,
    tally: &mut T,
) -> Option<(Layer<W>, Rest)> {
    let runs = cut(Sites { points: points.as_ref(), weights: &weights });
    triangulate_runs(points, weights, runs, seed, tally)
}

/// Triangulates by flips in random order.
pub(super) fn by_flips<T: Tally>(
    points: &[[f64; 3]],
    seed: u64,
    tally: &mut T,
) -> Option<(Layer, Vec<Duplicate>)> {
    let mut layer = Layer::new(points.to_vec());
    layer.mesh.names = Names::identical(points.len(), |_| true);
    let rest = flips::build(&mut layer, seed, tally)?;
    Some(with_duplicates((layer, rest)))
}

/// Sizes of sets whose products are in the range of the filters: 2^-130 to 2^90.
const SIZES: Range<f64> = 7.4e-40..1.2e27;

/// The points scaled into that range, if they are out of it. `None` also where what is made up beside points of less than space
/// might be too large when it is scaled back.
fn scaled_points<P: Position3>(points: &[P]) -> Option<(Vec<[f64; 3]>, f64)> {
    let scaled = scaled(points.len(), |i| points[i].xyz(), &SIZES)?;
    points.iter().all(|p| p.xyz().iter().all(|x| (4.0 * x).is_finite())).then_some(scaled)
}

/// Triangulates sites that are cut already.
fn triangulate_runs<P: Position3, W: Lift, T: Tally + Default + Send>(
    points: impl AsRef<[P]>,
    weights: Vec<W>,
    runs: Vec<Run<W>>,
    seed: u64,
    tally: &mut T,
) -> Option<(Layer<W>, Rest)> {
    let order: Vec<u32> = runs.iter().flat_map(|run| run.order.iter().copied()).collect();
    let parts: Vec<(usize, Vec<Region<W>>)> =
        runs.into_iter().map(|run| (run.order.len(), run.others)).collect();
    let given = points.as_ref();
    let along = parallel::collect(order.len(), |k| given[order[k] as usize].xyz());
    drop(points);
    let of_all = order.iter().map(|&i| W::at(&weights, Place::new(i as usize))).collect();
    drop(weights);
    let mut layer = Layer::with_weights(along, of_all);
    layer.mesh.names = Names::along(&order);
    drop(order);
    let apart = if parts.len() > 1 { apart::triangulate(&mut layer, &parts, seed, tally) } else { None };
    let rest = apart.or_else(|| triangulate_whole(&mut layer, seed, tally))?;
    if 2 * rest.hidden.len() > layer.points.len() {
        // Room was made for the tetrahedra of all.
        layer.mesh.cells.shrink_to_fit();
        layer.mesh.marks.shrink_to_fit();
    }
    Some((layer, rest))
}

/// Makes all sites vertices, or says which are none; they must be in an order that is short in space. `None` if there is no room.
fn triangulate_whole<W: Lift, T: Tally>(layer: &mut Layer<W>, seed: u64, tally: &mut T) -> Option<Rest> {
    let count = layer.points.len();
    layer.clear_mesh();
    layer.mesh.incident.fill(TetrahedronId::NONE);
    layer.mesh.cells.reserve_exact(room(count));
    layer.mesh.marks.reserve_exact(room(count));
    begin_and_insert(layer, &order::space::rounds(count, seed), tally)
}

/// Makes the points at some places vertices, in this order, in an empty mesh. Those that equal others become
/// duplicates. `None` if there is no room.
pub(super) fn build<W: Lift, T: Tally>(
    layer: &mut Layer<W>,
    order: &[u32],
    duplicates: &mut Vec<Duplicate>,
    tally: &mut T,
) -> Option<()> {
    let rest = begin_and_insert(layer, order, tally)?;
    note_equal(layer, &rest.equal, duplicates);
    Some(())
}

/// Inserts sites of which some may be hidden. Names are left alone.
fn begin_and_insert<W: Lift, T: Tally>(layer: &mut Layer<W>, order: &[u32], tally: &mut T) -> Option<Rest> {
    let first = layer.begin(order)?;
    let mut rest = Rest::default();
    let Some(&a) = first.first() else { return Some(rest) };
    let start = layer.mesh.incident[a.index()];
    let others = order.iter().map(|&i| Place::new(i as usize)).filter(|v| !first.contains(v));
    let mut cavity = std::mem::take(&mut layer.cavity);
    let all = insert_all(layer, &mut cavity, start, others, &mut rest, tally);
    layer.cavity = cavity;
    all?;
    layer.mesh.vertex_count = order.len() - rest.equal.len() - rest.hidden.len();
    Some(rest)
}

/// The places whose sites are no vertices.
#[derive(Debug, Default)]
pub(super) struct Rest {
    /// Sites that equal a vertex, with that vertex.
    pub(super) equal: Vec<(Place, Place)>,
    /// Sites that others hide.
    pub(super) hidden: Vec<Place>,
}

/// Points that equal vertices are duplicates of them.
fn note_equal<W: Lift>(layer: &mut Layer<W>, equal: &[(Place, Place)], duplicates: &mut Vec<Duplicate>) {
    let names = &mut layer.mesh.names;
    duplicates.extend(equal.iter().map(|&(v, w)| names.coincide(names.of(v), w)));
}

/// Makes the sites at some places vertices, the first located from a tetrahedron near it; those that are none are listed. `None`
/// if there is no room.
fn insert_all<A: Arena, T: Tally>(
    arena: &mut A,
    cavity: &mut Cavity,
    start: TetrahedronId,
    places: impl Iterator<Item = Place>,
    rest: &mut Rest,
    tally: &mut T,
) -> Option<()> {
    let mut last = start;
    for v in places {
        let view = arena.view();
        let q = view.points[v.index()];
        last = view.walk(last, q, tally);
        let hides = A::Weight::HIDES;
        if let Some(w) = view.vertex_at(last, q)
            && !(hides && view.site(v).1 != view.site(w).1)
        {
            rest.equal.push((v, w));
            continue;
        }
        if hides && !view.conflicts(last, view.site(v)) {
            rest.hidden.push(v);
            continue;
        }
        cavity.insert(arena, v, last, tally)?;
        if hides {
            rest.hidden.extend(cavity.hidden());
        }
        last = arena.memory().incident[v.index()];
    }
    Some(())
}
