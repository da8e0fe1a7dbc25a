//! Other weights for all sites at once: connectivity is kept, and repaired.
//!
//! 1. Edges are flipped until each is regular under the new weights. Where one cannot be flipped, because a corner of its
//!    quadrilateral is reflex or straight, that corner is hidden as soon as nothing is around it but what takes its place.
//! 2. Sites that are no vertices fall again, one by one, if they surface or the triangle is gone that they were above.
//!
//! Every flip lowers what is lifted, so there is an end; but with weights it may be reached too early (Edelsbrunner & Shah,
//! "Incremental topological flipping works for regular triangulations", Algorithmica 1996, §5). Then, and where too much would
//! have to be flipped, all is built anew. Either way leads to the canonical triangulation of the sites.
//!
//! Cost: O(n) tests and the flips, and a short walk for each site that falls again; that of a construction otherwise. The first
//! time each site that is no vertex has to be located.

use delone_predicates::orient2d;

use super::{Regular2, build};
use crate::error::Error;
use crate::hidden::heaviest_first;
use crate::ids::{EdgeId, Place, TriangleId, VertexId};
use crate::locate::{Start, Walk};
use crate::mesh::Mesh2;
use crate::plane::layer::Layer;
use crate::plane::layer::kernel::{Kernel, Power};
use crate::points::check_weights;
use crate::prefetch::prefetch;
use crate::regular::Reweighed;

/// The inverse of the share of edges that may be wrong before building anew is faster.
const WRONG_SHARE: usize = 10;
/// Wrong edges, or sites that fall again, that are repaired however small the set is.
const ALLOWED_EDGES: usize = 16;
/// The inverse of the share of sites that may fall again before building anew is faster, wherever they fall.
const FALLING_SHARE: usize = 16;
/// Flips a vertex, above which building anew is faster.
const FLIPS: usize = 4;
/// Triangles that are tested together.
const BLOCK: usize = 16;
/// Triangles between the one that is tested and the one that is prefetched.
const PREFETCH_DISTANCE: usize = 12;

/// A site that falls again, and an edge near it.
#[derive(Clone, Copy, Debug)]
struct Loose {
    id: VertexId,
    place: Place,
    near: EdgeId,
}

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
        self.locate_hidden();
        let Self { base, hidden_sites, .. } = self;
        let vertices = base.mesh.vertices().filter_map(|v| Some((v, base.mesh.place(v)?)));
        for (v, place) in vertices.chain(hidden_sites.all()) {
            base.weights[place.index()] = weights[v.index()];
        }
        let mut loose = Vec::new();
        let Some(flips) = self.flip_all(&mut loose) else {
            self.build_anew(loose);
            return Ok(Reweighed::Rebuilt);
        };
        self.take_surfacing(&mut loose);
        if loose.len() > (self.vertex_count() + loose.len()) / FALLING_SHARE + ALLOWED_EDGES {
            self.build_anew(loose);
            return Ok(Reweighed::Rebuilt);
        }
        heaviest_first(&mut loose, &self.base.weights, |site| (site.id, site.place));
        for &Loose { id, place, near } in &loose {
            let is_known = near != EdgeId::NONE && self.mesh().is_triangle(near.triangle());
            let start = if is_known { Start::At(near, Walk::Visibility) } else { Start::Anywhere };
            let (spot, _) = self.base.spot(start, self.base.points[place.index()], &mut ());
            self.settle(id, place, spot);
        }
        Ok(Reweighed::Repaired { flips, settled: loose.len() })
    }

    /// Flips edges until all are regular, and counts. What was above a triangle that is gone is loose then, and vertices that had to
    /// go. None if it gets stuck, or there would be too many.
    fn flip_all(&mut self, loose: &mut Vec<Loose>) -> Option<usize> {
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
            let f = self.mesh().twin(e);
            let obstacle = obstacle(&self.base, e);
            if obstacle.as_ref().is_some_and(|obstacle| !obstacle.may_go(self.mesh())) {
                stuck.push(e);
                continue;
            }
            if obstacle.as_ref().is_none_or(|obstacle| obstacle.is_straight) {
                // At a straight corner one triangle is flat then, and part of the star that goes.
                self.loosen([e, f], e.next(), loose);
                self.base.mesh.flip(e);
                wrong.extend([e.next(), e.previous(), f.next(), f.previous()]);
            }
            if let Some(Obstacle { corner, .. }) = obstacle {
                let star: Vec<EdgeId> = self.mesh().spokes(corner).collect();
                let outside = self.mesh().twin(star[0].next());
                self.loosen(star, outside, loose);
                let (id, place) = self.hide(corner);
                loose.push(Loose { id, place, near: outside });
                let (filling, _) = self.base.hole.last();
                wrong.extend(filling.iter().flat_map(|t| [0, 1, 2].map(|k| t.edge(k))));
            }
        }
        let is_over = |&e: &EdgeId| !self.mesh().is_triangle(e.triangle()) || !is_wrong(&self.base, e);
        stuck.iter().all(is_over).then_some(flips)
    }

    /// Loosens what is above the triangles of some edges.
    fn loosen(&mut self, edges: impl IntoIterator<Item = EdgeId>, near: EdgeId, loose: &mut Vec<Loose>) {
        let mut taken = Vec::new();
        edges.into_iter().for_each(|e| self.hidden_sites.take_from(e.triangle(), &mut taken));
        loose.extend(taken.into_iter().map(|(id, place)| Loose { id, place, near }));
    }

    /// Loosens what is below its triangle now, and what is at the point of a vertex.
    fn take_surfacing(&mut self, loose: &mut Vec<Loose>) {
        let Self { base, hidden_sites, .. } = self;
        let is_above = |place: Place, t: TriangleId| {
            let (corners, q) = (base.mesh.places(t), base.site(place));
            let is_corner = |p: &Place| !p.is_ghost() && base.points[p.index()] == q.0;
            !corners.iter().any(is_corner) && !Power::conflicts(corners, |k| base.site(corners[k]), q)
        };
        let surfacing =
            hidden_sites.all_above().filter(|&(_, place, t)| t.is_none_or(|t| !is_above(place, t)));
        let surfacing: Vec<_> = surfacing.collect();
        for (id, place, t) in surfacing {
            hidden_sites.take(id);
            loose.push(Loose { id, place, near: t.map_or(EdgeId::NONE, |t| t.edge(0)) });
        }
    }

    /// Takes a vertex with three neighbors out. Its site keeps a place.
    fn hide(&mut self, u: Place) -> (VertexId, Place) {
        let v = self.mesh().name(u);
        self.base.mesh.names().release(v);
        let site = self.base.site(u);
        self.base.remove(u, &mut ());
        let kept = self.base.new_place(u.index(), site.0);
        self.base.weights[kept.index()] = site.1;
        (v, kept)
    }

    /// Builds all anew.
    fn build_anew(&mut self, loose: Vec<Loose>) {
        let vertices = self.mesh().vertices().filter_map(|v| Some((v, self.mesh().place(v)?)));
        let loose = loose.into_iter().map(|site| (site.id, site.place));
        let mut sites: Vec<(VertexId, Place)> =
            vertices.chain(self.hidden_sites.all()).chain(loose).collect();
        sites.sort_unstable();
        let (points, weights): (Vec<_>, Vec<_>) = sites.iter().map(|&(_, p)| self.base.site(p)).unzip();
        let given = self.ids_given();
        *self = build::divide_and_conquer(&points, &weights);
        if sites.len() < given {
            let ids: Vec<VertexId> = sites.into_iter().map(|(v, _)| v).collect();
            self.base.mesh.names().rename(&ids, given);
            self.hidden_sites.rename(&ids);
        }
    }
}

/// The edges that are not regular, each once. None if they are too many.
///
/// Which edges are tested is decided without branches, which would go the wrong way half of the time.
fn wrong_edges(layer: &Layer<Power>) -> Option<Vec<EdgeId>> {
    let mesh = &layer.mesh;
    let most = 3 * mesh.vertex_count() / WRONG_SHARE + ALLOWED_EDGES;
    let mut wrong = Vec::new();
    let mut edges = [EdgeId::NONE; 3 * BLOCK];
    let slots = mesh.slot_count();
    for first in (0..slots).step_by(BLOCK) {
        let mut count = 0;
        for t in (first..slots.min(first + BLOCK)).map(TriangleId::new) {
            let ahead = mesh.edges.get(4 * (t.index() + PREFETCH_DISTANCE)..).into_iter().flatten().take(3);
            for record in ahead.filter(|record| record.twin != EdgeId::NONE) {
                prefetch(&mesh.edges, record.twin.index());
            }
            for e in [0, 1, 2].map(|k| t.edge(k)) {
                edges[count] = e;
                let twin = mesh.twin(e);
                count += usize::from(e < twin && twin != EdgeId::NONE);
            }
        }
        wrong.extend(edges[..count].iter().filter(|&&e| is_wrong(layer, e)));
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

/// The obstacle to the flip of an edge.
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
