//! Bulk construction: divide and conquer, and insertion one by one in biased random rounds along a Hilbert curve.
//!
//! A hidden site stays hidden, because more sites only lower the hull of the lifted ones: nothing is kept for it. Sites are kept
//! in the order of a curve.
//!
//! Sources: `construct/divide_and_conquer.rs`; Amenta, Choi & Rote, "Incremental constructions con BRIO", SoCG 2003. Cost: O(n log
//! n), expected for insertion.

use super::Regular2;
use super::settle::Settled;
use crate::hidden::HiddenSites;
use crate::ids::{Place, TriangleId, VertexId};
use crate::locate::{Start, Walk};
use crate::mesh::{Mesh2, Names};
use crate::order;
use crate::plane::construct::{Weighted, weighted};
use crate::plane::layer::Layer;
use crate::plane::layer::kernel::Power;
use crate::tally::{Counters, Tally, Work};

/// Triangulates sites, all finite and not too many, by divide and conquer.
pub(super) fn divide_and_conquer(given: &[[f64; 2]], given_weights: &[f64]) -> Regular2 {
    let Weighted { mesh, mut points, mut weights, indices, others, counters } =
        weighted(given, given_weights);
    // Each other site has a place of its own after the positions.
    let mut ids = indices;
    for &(i, _) in &others {
        points.push(given[i as usize]);
        weights.push(given_weights[i as usize]);
        ids.push(i);
    }
    let first_other = ids.len() - others.len();
    let mut layer: Layer<Power> = Layer::with_weights(mesh, points, weights);
    layer.mesh.incident.resize(ids.len(), crate::ids::EdgeId::NONE);
    layer.mesh.names = Some(Names::along(&ids));
    let is_vertex = |k: usize| layer.mesh.is_vertex(Place::new(k));
    let below = (0..ids.len()).filter(|&k| !is_vertex(k));
    let below: Vec<(VertexId, Place)> =
        below.map(|k| (VertexId::new(ids[k] as usize), Place::new(k))).collect();
    below.iter().for_each(|&(id, _)| layer.mesh.names().release(id));
    let mut under = HiddenSites::new(below);
    for (k, &(i, position)) in others.iter().enumerate() {
        let is_equal = layer.weights[first_other + k] == layer.weights[position.index()];
        let vertex = Some(layer.mesh.name(position)).filter(|v| is_equal && !v.is_ghost());
        under.set_equal(VertexId::new(i as usize), vertex);
    }
    let counters = Counters::DivideAndConquer(counters);
    Regular2 { hinted: layer.mesh.vertex_count, base: layer, under, counters, ..Regular2::default() }
}

/// Builds by insertion.
pub(super) fn incremental(points: &[[f64; 2]], weights: &[f64], seed: u64) -> Regular2 {
    let along = order::plane::curve(points);
    let sorted = along.iter().map(|&i| points[i as usize]).collect();
    let weights = along.iter().map(|&i| weights[i as usize]).collect();
    let mut layer: Layer<Power> = Layer::with_weights(Mesh2::empty(points.len()), sorted, weights);
    layer.mesh.names = Some(Names::along(&along));
    layer.mesh.edges.reserve_exact(8 * points.len().saturating_sub(1));
    let mut work = Work::default();
    let under = insert_all(&mut layer, seed, &mut work);
    let counters = Counters::Incremental(work);
    Regular2 { hinted: layer.mesh.vertex_count, base: layer, under, counters, ..Regular2::default() }
}

/// Inserts what is at every place. Those that are no vertices lose their place's name.
fn insert_all<T: Tally>(layer: &mut Layer<Power>, seed: u64, tally: &mut T) -> HiddenSites<TriangleId> {
    let mut hidden = Vec::new();
    // Those that equal a vertex, with its place.
    let mut equal: Vec<(VertexId, Place, Place)> = Vec::new();
    let mut start = Start::Anywhere;
    for i in order::plane::rounds(layer.points.len(), seed) {
        let v = Place::new(i as usize);
        let (spot, _) = layer.spot(start, layer.points[v.index()], tally);
        let near = match layer.settle(v, spot, &mut hidden, tally) {
            Settled::Vertex => v,
            Settled::Equal(w) => {
                let names = layer.mesh.names();
                let duplicate = names.coincide(names.of(v), w);
                equal.push((VertexId::new(duplicate.point), v, w));
                w
            }
            Settled::Hidden => {
                hidden.push(v);
                continue;
            }
        };
        if layer.mesh.lone.is_none() {
            start = Start::At(layer.mesh.incident[near.index()], Walk::Visibility);
        }
    }
    let names = layer.mesh.names();
    let mut sites: Vec<(VertexId, Place)> = hidden.into_iter().map(|p| (names.of(p), p)).collect();
    sites.iter().for_each(|&(id, _)| names.release(id));
    sites.extend(equal.iter().map(|&(id, place, _)| (id, place)));
    let mut under = HiddenSites::new(sites);
    for (id, _, w) in equal {
        // A vertex once, which may be hidden since.
        under.set_equal(id, Some(layer.mesh.name(w)).filter(|v| !v.is_ghost()));
    }
    under
}
