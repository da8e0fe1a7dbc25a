//! Bulk construction: divide and conquer, and insertion one by one in biased random rounds along a Hilbert curve.
//!
//! A site that is hidden stays hidden while others come, because each of them only lowers the hull of the lifted sites. So its triangle
//! is looked for later, if at all. Sites are stored along a curve.
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
    let Weighted { mesh, mut points, mut weights, indices, coincident, counters } =
        weighted(given, given_weights);
    // A site where a heavier one is has a place of its own after the positions.
    let mut ids = indices;
    let first_coincident = ids.len();
    for &(i, _) in &coincident {
        points.push(given[i as usize]);
        weights.push(given_weights[i as usize]);
        ids.push(i);
    }
    let mut layer: Layer<Power> = Layer::with_weights(mesh, points, weights);
    layer.mesh.incident.resize(ids.len(), crate::ids::EdgeId::NONE);
    layer.mesh.names = Some(Names::along(&ids));
    let is_vertex = |k: usize| layer.mesh.is_vertex(Place::new(k));
    let hidden = (0..ids.len()).filter(|&k| !is_vertex(k));
    let hidden: Vec<(VertexId, Place)> =
        hidden.map(|k| (VertexId::new(ids[k] as usize), Place::new(k))).collect();
    hidden.iter().for_each(|&(id, _)| layer.mesh.names().release(id));
    let mut hidden_sites = HiddenSites::new(hidden);
    for (k, &(i, position)) in coincident.iter().enumerate() {
        let is_equal = layer.weights[first_coincident + k] == layer.weights[position.index()];
        let vertex = Some(layer.mesh.name(position)).filter(|v| is_equal && !v.is_ghost());
        hidden_sites.set_equal(VertexId::new(i as usize), vertex);
    }
    let counters = Counters::DivideAndConquer(counters);
    Regular2 { hinted: layer.mesh.vertex_count, base: layer, hidden_sites, counters, ..Regular2::default() }
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
    let hidden_sites = insert_all(&mut layer, seed, &mut work);
    let counters = Counters::Incremental(work);
    Regular2 { hinted: layer.mesh.vertex_count, base: layer, hidden_sites, counters, ..Regular2::default() }
}

/// Inserts the sites of all places. A site that is hidden gives the name of its place back, and is returned.
fn insert_all<T: Tally>(layer: &mut Layer<Power>, seed: u64, tally: &mut T) -> HiddenSites<TriangleId> {
    let mut hidden = Vec::new();
    // Sites equal to a vertex, each with its place and that of the vertex.
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
    let mut hidden_sites = HiddenSites::new(sites);
    for (id, _, w) in equal {
        // The site there was a vertex then; a later one may have hidden it.
        hidden_sites.set_equal(id, Some(layer.mesh.name(w)).filter(|v| !v.is_ghost()));
    }
    hidden_sites
}
