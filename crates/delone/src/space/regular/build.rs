//! Bulk construction: insertion in biased random rounds along a Hilbert curve, in whose order sites are kept; large sets in parts.
//!
//! A hidden site stays hidden, because more sites only lower the hull of the lifted ones: nothing is kept for it.

use super::Regular3;
use crate::hidden::HiddenSites;
use crate::ids::{Place, VertexId};
use crate::mesh::Names;
use crate::space::construct::{self, Rest, flips};
use crate::space::layer::Layer;
use crate::tally::Work;

/// Triangulates sites, all finite and not too many. `None` if there would be too many tetrahedra.
pub(super) fn build(points: &[[f64; 3]], weights: &[f64], seed: u64) -> Option<Regular3> {
    let mut work = Work::default();
    let built = construct::triangulate_sites(points, weights.to_vec(), seed, &mut work)?;
    Some(Regular3 { work, ..assemble(built) })
}

/// Builds by flips in random order.
pub(super) fn by_flips(points: &[[f64; 3]], weights: &[f64], seed: u64) -> Option<Regular3> {
    let mut layer = Layer::with_weights(points.to_vec(), weights.to_vec());
    layer.mesh.names = Names::identical(points.len(), |_| true);
    let mut work = Work::default();
    let rest = flips::build(&mut layer, seed, &mut work)?;
    Some(Regular3 { work, ..assemble((layer, rest)) })
}

/// Names what is no vertex.
pub(in crate::space) fn assemble((mut layer, rest): (Layer<f64>, Rest)) -> Regular3 {
    let names = &mut layer.mesh.names;
    // Of equal sites the first given is the vertex, and the other one is kept where it was.
    let mut equal: Vec<(VertexId, Place, Place)> = Vec::new();
    for (v, w) in rest.equal {
        let duplicate = names.coincide(names.of(v), w);
        equal.push((VertexId::new(duplicate.point), v, w));
    }
    let mut sites: Vec<(VertexId, Place)> = rest.hidden.into_iter().map(|p| (names.of(p), p)).collect();
    sites.iter().for_each(|&(id, _)| names.release(id));
    sites.extend(equal.iter().map(|&(id, place, _)| (id, place)));
    let mut hidden_sites = HiddenSites::new(sites);
    for (id, _, w) in equal {
        hidden_sites.set_equal(id, Some(names.of(w)).filter(|v| !v.is_ghost()));
    }
    Regular3 { hinted: layer.mesh.vertex_count, base: layer, hidden_sites, ..Regular3::default() }
}
