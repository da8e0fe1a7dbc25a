//! Triangles that are none of the canonical triangulation are given, and stay where no vertex comes.

use std::collections::BTreeSet;

use delone::{Constrained2, EdgeId, Fill, Refined2, Refinement, Triangulation, VertexId};
use delone_generators::Random;

use super::judge::{Case, Lines};
use super::wish::Wish;
use crate::attack::Judgement;
use delone_oracle::exact;

type Corners = [VertexId; 3];

/// The triangles of a triangulation, after flips of random edges that are no constraints.
fn flipped(c: &Constrained2, random: &mut Random) -> Vec<Corners> {
    let mesh = c.mesh();
    let mut triangles: BTreeSet<Corners> = c.triangles().map(turned).collect();
    let edges: Vec<EdgeId> = mesh.undirected_edges().filter(|&e| !c.is_constraint(e)).collect();
    for _ in 0..edges.len() {
        let e = edges[random.below(edges.len())];
        let twin = mesh.twin(e);
        let [a, b, p, q] = [mesh.origin(e), mesh.destination(e), mesh.apex(e), mesh.apex(twin)];
        if [p, q].iter().any(|v| v.is_ghost()) {
            continue;
        }
        let (old, new) = ([[a, b, p], [b, a, q]], [[a, q, p], [b, p, q]]);
        let is_positive = |corners: Corners| {
            let [x, y, z] = corners.map(|v| c.point(v));
            exact::orient2d(x, y, z) > 0
        };
        if old.iter().all(|&t| triangles.contains(&turned(t))) && new.iter().all(|&t| is_positive(t)) {
            old.iter().for_each(|&t| _ = triangles.remove(&turned(t)));
            triangles.extend(new.map(turned));
        }
    }
    triangles.into_iter().collect()
}

/// A triangle from its least corner on.
fn turned(mut corners: Corners) -> Corners {
    let least = (0..3).min_by_key(|&k| corners[k]).unwrap_or(0);
    corners.rotate_left(least);
    corners
}

/// The triangles inside.
fn inside(c: &Constrained2, refined: &Refined2) -> BTreeSet<Corners> {
    c.triangle_ids().filter(|&t| refined.domains.is_inside(t)).map(|t| turned(c.corners(t))).collect()
}

/// Refines triangles that are no Delaunay triangulation, twice.
pub(super) fn attack(before: &Constrained2, wish: &Wish, again: &Wish, random: &mut Random) -> Judgement {
    let given = flipped(before, random);
    let mut c = before.clone();
    let bare = Refinement::new().min_angle(0.0).triangles(&given);
    if let Ok(refined) = bare.run(&mut c) {
        let known: BTreeSet<Corners> = given.iter().copied().collect();
        if !inside(&c, &refined).is_subset(&known) {
            return Err("triangles are others, and nothing is wanted".to_owned());
        }
    }
    let wish = wish.clone().keeping(given);
    let mut c = before.clone();
    let answer = wish.run(&mut c, wish.fill());
    let nothing = Lines::new();
    let lines = Case { before, after: &c, wish: &wish, fill: wish.fill(), lines: &nothing, kept: &[] }
        .judge(&answer)?;
    let Ok(refined) = answer else { return Ok(()) };
    let (first, fill) = (c.clone(), Fill::Parts(&refined.domains));
    let more = again.clone().inside_of(&wish);
    let answer = more.run(&mut c, fill);
    Case { before: &first, after: &c, wish: &more, fill, lines: &lines, kept: &refined.kept }
        .judge(&answer)
        .map(|_| ())
}
