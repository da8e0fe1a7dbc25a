//! Other weights for all sites at once: connectivity is kept, and repaired.
//!
//! 1. Edges are flipped until each is regular under the new weights. Where one cannot be flipped, because a corner of its
//!    quadrilateral is reflex or straight, that corner is hidden as soon as nothing is around it but what takes its place.
//! 2. The sites that are no vertices fall again, one by one, and become vertices where they surface.
//!
//! Every flip lowers what is lifted, so there is an end; but with weights it may be reached too early (Edelsbrunner & Shah,
//! "Incremental topological flipping works for regular triangulations", Algorithmica 1996, §5). Then, and where too much would
//! have to be flipped, all is built anew. Either way leads to the canonical triangulation of the sites.
//!
//! Cost: O(n) tests and the flips, and a walk for each site that was no vertex; that of a construction otherwise.

use delone_predicates::orient2d;

use super::{Regular2, build};
use crate::error::Error;
use crate::ids::{EdgeId, Place, TriangleId, VertexId};
use crate::mesh::Mesh2;
use crate::plane::layer::Layer;
use crate::plane::layer::kernel::{Kernel, Power};
use crate::points::check_weights;
use crate::prefetch::prefetch;
use crate::regular::Reweighed;

/// One edge in so many may be wrong before building anew is faster; the first so many always may.
const WRONG: usize = 10;
const FEW: usize = 16;
/// So many flips a vertex may be needed before building anew is faster.
const FLIPS: usize = 4;
/// How many triangles ahead memory is asked.
const AHEAD: usize = 12;

impl Regular2 {
    /// Gives all sites other weights, by id; those of sites that were removed mean nothing. O(n) where little changes.
    ///
    /// # Errors
    /// [`Error::Length`] unless there is a weight for each id given, [`Error::Weight`] for one that is not finite, by index; then
    /// nothing changes.
    pub fn set_weights(&mut self, weights: &[f64]) -> Result<Reweighed, Error> {
        if weights.len() != self.ids_given() {
            return Err(Error::Length { expected: self.ids_given(), found: weights.len() });
        }
        check_weights(weights)?;
        let mut loose = Vec::new();
        self.under.take_all(&mut loose);
        let vertices = self.mesh().vertices().filter_map(|v| Some((v, self.mesh().place(v)?)));
        let all: Vec<(VertexId, Place)> = vertices.chain(loose.iter().copied()).collect();
        all.into_iter().for_each(|(v, place)| self.base.weights[place.index()] = weights[v.index()]);
        let Some(flips) = self.flip_all(&mut loose) else {
            self.build_anew(loose);
            return Ok(Reweighed::Rebuilt);
        };
        self.under.are_known = true;
        loose.sort_unstable();
        let settled = loose.len();
        loose.into_iter().for_each(|(v, place)| self.settle_again(v, place));
        Ok(Reweighed::Repaired { flips, settled })
    }

    /// Flips edges until all are regular, and counts. Vertices that have to go are loose then. None if it gets stuck, or there would
    /// be too many.
    fn flip_all(&mut self, loose: &mut Vec<(VertexId, Place)>) -> Option<usize> {
        if !self.base.spanned {
            return None;
        }
        let mut wrong = wrong_edges(&self.base)?;
        let most = FLIPS * self.vertex_count();
        let mut stuck = Vec::new();
        let mut flips = 0;
        while let Some(e) = wrong.pop() {
            if !self.mesh().is_triangle(e.triangle()) || !is_wrong(&self.base, e) {
                continue;
            }
            flips += 1;
            if flips > most {
                return None;
            }
            match obstacle(&self.base, e) {
                None => {
                    let f = self.mesh().twin(e);
                    self.base.mesh.flip(e);
                    wrong.extend([e.next(), e.previous(), f.next(), f.previous()]);
                }
                Some(obstacle) if obstacle.may_go(self.mesh()) => {
                    if obstacle.is_straight {
                        let f = self.mesh().twin(e);
                        // Flat for the moment, and then part of the star that goes.
                        self.base.mesh.flip(e);
                        wrong.extend([e, e.next(), e.previous(), f.next(), f.previous()]);
                    }
                    loose.push(self.hide(obstacle.corner));
                    let (filling, _) = self.base.hole.last();
                    wrong.extend(filling.iter().flat_map(|t| [0, 1, 2].map(|k| t.edge(k))));
                }
                Some(_) => stuck.push(e),
            }
        }
        let is_over = |&e: &EdgeId| !self.mesh().is_triangle(e.triangle()) || !is_wrong(&self.base, e);
        stuck.iter().all(is_over).then_some(flips)
    }

    /// Takes a vertex with three neighbours out. Its site keeps a place.
    fn hide(&mut self, u: Place) -> (VertexId, Place) {
        let v = self.mesh().name(u);
        self.base.mesh.names().release(v);
        let site = self.base.site(u);
        self.base.remove(u, &mut ());
        let kept = self.base.new_place(u.index(), site.0);
        self.base.weights[kept.index()] = site.1;
        (v, kept)
    }

    /// Builds all anew of its vertices, and of the sites that are none.
    fn build_anew(&mut self, mut sites: Vec<(VertexId, Place)>) {
        sites.extend(self.mesh().vertices().filter_map(|v| Some((v, self.mesh().place(v)?))));
        sites.sort_unstable();
        let (points, weights): (Vec<_>, Vec<_>) = sites.iter().map(|&(_, p)| self.base.site(p)).unzip();
        let given = self.ids_given();
        *self = build::divide_and_conquer(&points, &weights);
        if sites.len() < given {
            let ids: Vec<VertexId> = sites.into_iter().map(|(v, _)| v).collect();
            self.base.mesh.names().rename(&ids, given);
            self.under.rename(&ids);
        }
    }
}

/// The edges that are not regular, each once. None if they are too many.
fn wrong_edges(layer: &Layer<Power>) -> Option<Vec<EdgeId>> {
    let mesh = &layer.mesh;
    let most = 3 * mesh.vertex_count() / WRONG + FEW;
    let mut wrong = Vec::new();
    for t in (0..mesh.slot_count()).map(TriangleId::new) {
        let ahead = mesh.edges.get(4 * (t.index() + AHEAD)..).into_iter().flatten().take(3);
        for record in ahead.filter(|record| record.twin != EdgeId::NONE) {
            prefetch(&mesh.edges, record.twin.index());
        }
        if !mesh.is_triangle(t) {
            continue;
        }
        let edges = [0, 1, 2].map(|k| t.edge(k)).into_iter();
        wrong.extend(edges.filter(|&e| e < mesh.twin(e) && is_wrong(layer, e)));
        if wrong.len() > most {
            return None;
        }
    }
    Some(wrong)
}

/// The ends of an edge, and the apexes on its left and on its right.
#[inline]
fn corners_around(mesh: &Mesh2, e: EdgeId) -> [Place; 4] {
    [mesh.tail(e), mesh.head(e), mesh.tip(e), mesh.tip(mesh.twin(e))]
}

/// Whether the site beyond an edge is in conflict with its triangle. What is beyond a hull edge is none.
#[inline]
fn is_wrong(layer: &Layer<Power>, e: EdgeId) -> bool {
    let corners @ [_, _, c, d] = corners_around(&layer.mesh, e);
    let site = |k: usize| layer.site(corners[k]);
    !c.is_ghost() && !d.is_ghost() && Power::conflicts([corners[0], corners[1], c], site, site(3))
}

/// An end of an edge at which its quadrilateral is not strictly convex.
struct Obstacle {
    corner: Place,
    is_straight: bool,
}

impl Obstacle {
    /// Whether nothing is around the corner but what takes its place: a triangle, or two that share the edge through it.
    fn may_go(&self, mesh: &Mesh2) -> bool {
        let most = if self.is_straight { 4 } else { 3 };
        mesh.spokes(self.corner).take(most + 1).count() == most
    }
}

/// What prevents the flip of an edge.
fn obstacle(layer: &Layer<Power>, e: EdgeId) -> Option<Obstacle> {
    let [a, b, c, d] = corners_around(&layer.mesh, e);
    // The hull is straight at the other end, or no site would be in conflict.
    if a.is_ghost() || b.is_ghost() {
        return Some(Obstacle { corner: if a.is_ghost() { b } else { a }, is_straight: true });
    }
    [[d, c, a], [c, d, b]].into_iter().find_map(|side| {
        let [p, q, r] = side.map(|p| layer.points[p.index()]);
        let turn = orient2d(p, q, r);
        (!turn.is_positive()).then_some(Obstacle { corner: side[2], is_straight: turn.is_zero() })
    })
}
