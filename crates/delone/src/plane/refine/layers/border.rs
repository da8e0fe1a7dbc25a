//! The chosen constraints, and vertices on them: at the distances that a mesh without layers would have there.
//!
//! So the last line of the layers has edges as long as the mesh around it asks for. The distances are found in a copy, whose constraints are
//! all divided; here only the chosen ones are, because other constraints may get the ends of rows.

use delone_predicates::lexicographic;

use crate::error::Error;
use crate::ids::{EdgeId, Place, VertexId};
use crate::mesh::Mesh2;
use crate::plane::constrained::{Constrained2, Domains2};
use crate::points::survey as bounds;
use crate::sorting;

use super::super::Refinement;
use super::super::arcs::Centers;
use super::super::frontal::Frontal;
use super::super::mesher::Mesher;
use super::super::queue::Queue;
use super::super::rules::Rules;
use super::chains::Chains;
use super::wanted::Layers2;

/// A chosen constraint: its ends, and where it is divided from the first end to the second.
pub(super) struct Side {
    pub(super) ends: [VertexId; 2],
    pub(super) at: Vec<[f64; 2]>,
}

/// The chosen constraints, not divided yet.
pub(super) fn chosen(c: &Constrained2, domains: &Domains2, wanted: &Layers2) -> Result<Vec<Side>, Error> {
    let mesh = c.mesh();
    let mut ends: Vec<[VertexId; 2]> = Vec::new();
    if let Some(segments) = &wanted.segments {
        for &segment in segments {
            let chain = c.chain(segment).ok_or(Error::NoSuchSegment { segment: segment.index() })?;
            ends.extend(chain.windows(2).map(|pair| [pair[0].min(pair[1]), pair[0].max(pair[1])]));
        }
    } else {
        let is_border =
            |e: &EdgeId| domains.is_inside(e.triangle()) != domains.is_inside(mesh.twin(*e).triangle());
        let border = c.constraint_edges().filter(is_border).map(|e| [mesh.origin(e), mesh.destination(e)]);
        ends.extend(border.map(|[v, w]| [v.min(w), v.max(w)]));
    }
    ends.sort_unstable();
    ends.dedup();
    // New vertices come in an order of geometry.
    let order = |v: VertexId, w: VertexId| lexicographic(c.point(v), c.point(w));
    ends.iter_mut().filter(|ends| order(ends[0], ends[1]).is_gt()).for_each(|ends| ends.reverse());
    sorting::by(&mut ends, |p, q| order(p[0], q[0]).then_with(|| order(p[1], q[1])));
    Ok(ends.into_iter().map(|ends| Side { ends, at: Vec::new() }).collect())
}

/// The last line around a fan has edges so many times as long as all rows are high; with sectors from 30 to 50 degrees that is 0.5 to 0.8.
const EDGE_OF_FAN: f64 = 0.75;

/// Finds where the chosen constraints are to be divided, under rows of some height in all: at fans as finely as these are.
pub(super) fn divide_sides(
    (wanted, chords): (&Refinement, &Centers<VertexId>),
    c: &Constrained2,
    domains: &Domains2,
    sides: &mut [Side],
    height: f64,
) -> Result<(), Error> {
    let (mut copy, mut parts) = (c.clone(), domains.clone());
    let before = copy.begin_refinement(&mut parts);
    let rules = Rules::new(wanted, &parts, &before);
    let layer = copy.layer();
    let bounds = bounds(&layer.points).0;
    let mut mesher = Mesher::new(layer, &rules, Queue::new(&bounds, false), &parts.origins).along(chords);
    let place = |v: VertexId| mesher.layer.mesh.place(v);
    let whole = sides.iter().filter_map(|side| Some([place(side.ends[0])?, place(side.ends[1])?]));
    let chains = Chains::of(&mesher, &whole.collect::<Vec<_>>());
    let fans = chains.wedges.iter().filter(|wedge| wedge.has_fan());
    let limits = fans.map(|wedge| (wedge.base, EDGE_OF_FAN * height)).collect();
    Frontal::new(&mut mesher, &bounds, wanted.growth).only_divide(limits)?;
    let done = mesher.finish();
    copy.end_refinement(&before, &done.new)?;
    for side in sides {
        let chain = chain_between(copy.mesh(), side.ends, before.given);
        side.at = chain.into_iter().map(|v| copy.point(v)).collect();
    }
    Ok(())
}

/// The new vertices on a constraint from one vertex to another that were there before; ids of new ones are from `given` on.
fn chain_between(mesh: &Mesh2, [from, to]: [VertexId; 2], given: usize) -> Vec<VertexId> {
    let is_new = |v: VertexId| !v.is_ghost() && v.index() >= given;
    let fixed = |at: VertexId| mesh.star(at).filter(|&e| mesh.is_fixed(e)).map(|e| mesh.destination(e));
    for first in fixed(from).filter(|&v| is_new(v)) {
        let (mut last, mut at, mut chain) = (from, first, Vec::new());
        while is_new(at) {
            chain.push(at);
            let Some(next) = fixed(at).find(|&next| next != last) else { break };
            (last, at) = (at, next);
        }
        if at == to {
            return chain;
        }
    }
    Vec::new()
}

/// Puts the vertices on a chosen constraint, and gives its pieces. In the middle first, as what sees a long rest is triangulated anew.
pub(super) fn put_on(mesher: &mut Mesher, side: &Side) -> Vec<[Place; 2]> {
    let mesh = &mesher.layer.mesh;
    let [Some(a), Some(b)] = side.ends.map(|v| mesh.place(v)) else { return Vec::new() };
    let mut rest = vec![(0, side.at.len(), a, b)];
    let mut pieces = Vec::new();
    while let Some((low, high, a, b)) = rest.pop() {
        let middle = low + (high - low) / 2;
        let mut candidates = (middle..high).chain((low..middle).rev());
        let made = candidates.find_map(|k| {
            let e = mesher.layer.mesh.edge_between(a, b)?;
            Some((k, mesher.divide(e, side.at[k])?))
        });
        match made {
            Some((k, v)) => rest.extend([(k + 1, high, v, b), (low, k, a, v)]),
            None => pieces.push([a, b]),
        }
    }
    pieces
}
