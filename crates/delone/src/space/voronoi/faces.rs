//! Which cells share a face, and which are bounded; exactly, and without a coordinate.
//!
//! The corners of a face are the centers of the tetrahedra around an edge. Two that follow one another are one place if the five corners are
//! on one sphere. An unbounded face is between two rays, which leave two facets of the hull. It is a line if these are one flat
//! polygon on one circle.
//!
//! Cost: O(d log d) for a site with d tetrahedra.

use super::centers::Cellular;
use crate::ids::{FacetId, Place, TetrahedronId, VertexId};
use crate::mesh::Dimension;
use crate::mesh::tetrahedra::first_around;
use crate::space::layer::Layer;

use delone_predicates::orient3d;

pub(in crate::space) fn is_bounded<W: Cellular>(layer: &Layer<W>, site: VertexId) -> bool {
    let mut star = Vec::new();
    if let Some(place) = layer.mesh.place(site) {
        layer.mesh.star(place, &mut star);
    }
    layer.scaffold.is_empty() && !star.is_empty() && !star.iter().any(|&t| layer.mesh.is_ghost(t))
}

pub(in crate::space) fn neighbors<W: Cellular>(layer: &Layer<W>, site: VertexId) -> Vec<VertexId> {
    let Some(place) = layer.mesh.place(site) else { return Vec::new() };
    let mut star = Vec::new();
    let joined = layer.joined_to(place, &mut star);
    let mut found: Vec<VertexId> = Vec::with_capacity(joined.len());
    for other in joined {
        let at = star.iter().find_map(|&t| {
            let corners = layer.mesh.cells[t.index()].corners;
            let corner = |p: Place| corners.iter().position(|&corner| corner == p);
            Some((t, [corner(place)?, corner(other)?]))
        });
        if at.is_some_and(|(t, edge)| has_area(layer, t, edge)) {
            found.push(layer.mesh.name(other));
        }
    }
    found.sort_unstable();
    found
}

/// Whether the face of an edge is more than a point or a line.
fn has_area<W: Cellular>(layer: &Layer<W>, t: TetrahedronId, edge: [usize; 2]) -> bool {
    let mesh = &layer.mesh;
    let ends = edge.map(|k| mesh.cells[t.index()].corners[k]);
    let mut around: Vec<FacetId> = Vec::new();
    let mut f = first_around(t, edge);
    loop {
        let entered = mesh.twin(f);
        around.push(entered);
        if entered.tetrahedron() == t {
            break;
        }
        f = mesh.next_around(entered, ends);
    }
    let is_real = |p: Place| !p.is_ghost() && !layer.is_scaffold(p);
    let link: Vec<Place> =
        around.iter().map(|f| mesh.cells[f.tetrahedron().index()].corners[f.corner()]).collect();
    let open = link.iter().position(|&p| p.is_ghost());
    let Some(open) = open else {
        // Bounded: from each tetrahedron to the next.
        let moves = around.iter().filter(|f| {
            let last = mesh.twin(**f).tetrahedron();
            let fresh = mesh.cells[f.tetrahedron().index()].corners[f.corner()];
            let corners = mesh.cells[last.index()].corners.map(|p| layer.site(p));
            !W::in_sphere_with_ties(corners, layer.site(fresh)).is_zero()
        });
        return moves.take(3).count() == 3;
    };
    let finite: Vec<Place> =
        link[open..].iter().chain(&link[..open]).copied().filter(|&p| is_real(p)).collect();
    // From one side to the other, with something off the plane between them if that is one.
    let (Some(&first), Some(&last)) = (finite.first(), finite.last()) else { return true };
    let between = match layer.dimension() {
        Dimension::Space => finite.get(1).copied().filter(|&p| p != last),
        _ => layer.scaffold.first().copied().filter(|_| finite.len() == 2),
    };
    let Some(between) = between else { return true };
    let [a, b, c, d, e] = [ends[0], ends[1], first, between, last].map(|p| layer.site(p));
    let is_flat = orient3d(a.0, b.0, c.0, e.0).is_zero();
    !is_flat || !W::in_sphere_with_ties([a, b, c, d], e).is_zero()
}
