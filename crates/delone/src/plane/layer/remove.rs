//! Removal of a vertex: its star becomes a hole, and the hole gets the triangles that the other vertices have.
//!
//! Source: Devillers, "On deletion in Delaunay triangulations", IJCGA 2002 (SoCG 1999); "Vertex removal in two
//! dimensional Delaunay triangulation: speed-up by low degrees optimization", CGTA 2011. Only the vertices on the
//! border of the hole matter, because whatever was empty of them stays empty of the others.
//!
//! Cost, for degree d: up to [`SMALL`], a search for the apex of each side among the rest of the border, at
//! most d^2 / 2 tests and hardly more than d for the usual six, in buffers that are kept; above that, O(d log d) by
//! dividing and conquering the border. The ghost vertex is a vertex of the border like others, so the hull is no
//! special case.

use delone_predicates::orient2d;

use super::Layer;
use super::cavity::conflicts;
use super::line;
use crate::ids::{EdgeId, Place, TriangleId};
use crate::mesh::Mesh2;
use crate::plane::construct;
use crate::tally::Tally;

/// The largest degree at which looking at all candidates is cheaper than building.
const SMALL: usize = 24;

/// The border of the hole, counter-clockwise, and the triangles to fill it with. Kept between removals.
#[derive(Clone, Debug, Default)]
pub(in crate::plane) struct Hole {
    /// Where each edge of the border starts, and its twin outside.
    border: Vec<(Place, EdgeId)>,
    /// The points where they start; that of the ghost means nothing.
    points: Vec<[f64; 2]>,
    triangles: Vec<TriangleId>,
    /// How many of these, the first ones, are not used yet.
    unused: usize,
    spokes: Vec<EdgeId>,
    /// Parts of the hole still to be filled: first and last vertex of a run of the border, and the edge that
    /// closes it, seen from outside.
    pending: Vec<(usize, usize, EdgeId)>,
}

impl Layer {
    /// Removes the vertex at a place and gives the place back.
    pub(in crate::plane) fn remove<T: Tally>(&mut self, v: Place, tally: &mut T) {
        if self.mesh.lone == Some(v) {
            self.mesh.lone = None;
            self.mesh.vertex_count = 0;
        } else if self.spanned {
            self.remove_from_plane(v, tally);
        } else {
            line::remove(&mut self.mesh, v);
        }
        self.free_place(v);
    }

    fn remove_from_plane<T: Tally>(&mut self, v: Place, tally: &mut T) {
        self.prefetch_window::<4, 2>(v.index());
        let mut hole = std::mem::take(&mut self.hole);
        hole.dig(&self.mesh, v);
        let degree = hole.border.len();
        tally.destroyed(degree);
        if let Some(chain) = self.line_without(&hole) {
            tally.created(2 * chain.len() - 2);
            hole.triangles.clear();
            for place in self.mesh.inhabited().collect::<Vec<_>>() {
                self.mesh.incident[place.index()] = EdgeId::NONE;
            }
            self.mesh.edges.clear();
            self.mesh.free = crate::mesh::Slots::default();
            self.mesh.ghost_edge = EdgeId::NONE;
            line::build(&mut self.mesh, chain);
            self.spanned = false;
        } else {
            tally.created(degree - 2);
            if degree <= SMALL {
                let point =
                    |&(v, _): &(Place, EdgeId)| self.points.get(v.index()).copied().unwrap_or_default();
                hole.points.clear();
                hole.points.extend(hole.border.iter().map(point));
                hole.fill(&mut self.mesh, tally);
            } else {
                hole.fill_large(&mut self.mesh, &self.points);
            }
            hole.triangles.drain(..hole.unused).for_each(|t| self.mesh.free_triangle(t));
            self.mesh.vertex_count -= 1;
        }
        self.hole = hole;
    }

    /// The other vertices from end to end, if they are all on one line: they are all on the border then.
    fn line_without(&self, hole: &Hole) -> Option<Vec<Place>> {
        let ghost = hole.border.iter().position(|(v, _)| v.is_ghost())?;
        if hole.border.len() != self.mesh.vertex_count {
            return None; // the others, and the ghost instead of the vertex itself
        }
        let (before, after) = (&hole.border[..ghost], &hole.border[ghost + 1..]);
        let chain: Vec<Place> = after.iter().chain(before).map(|&(v, _)| v).collect();
        let point = |i: usize| self.points[chain[i].index()];
        (2..chain.len()).all(|i| orient2d(point(0), point(1), point(i)).is_zero()).then_some(chain)
    }
}

impl Hole {
    /// What the last removal from the plane did: the triangles that fill the hole, and for each edge of its border where it
    /// starts, and its twin outside.
    pub(in crate::plane) fn last(&self) -> (&[TriangleId], &[(Place, EdgeId)]) {
        (&self.triangles, &self.border)
    }

    /// A triangle of the star that was, to be used again.
    fn take(&mut self) -> Option<TriangleId> {
        self.unused = self.unused.checked_sub(1)?;
        Some(self.triangles[self.unused])
    }

    /// Collects the star of a vertex, in both directions at once: the next triangle on one side is fetched from
    /// memory while that on the other is waited for.
    fn dig(&mut self, mesh: &Mesh2, v: Place) {
        self.spokes.clear();
        self.border.clear();
        self.triangles.clear();
        let mut left = mesh.incident[v.index()];
        let mut right = mesh.twin(left).next();
        self.spokes.push(left);
        while left != right {
            left = mesh.spin(left);
            self.spokes.push(left);
            if left == right {
                break;
            }
            self.triangles.push(right.triangle());
            self.border.push((mesh.tail(right.next()), mesh.twin(right.next())));
            right = mesh.twin(right).next();
        }
        // So far clockwise, from the right of the first spoke on: turned, it goes before the rest.
        self.border.reverse();
        for &spoke in &self.spokes {
            let side = spoke.next();
            self.border.push((mesh.tail(side), mesh.twin(side)));
            self.triangles.push(spoke.triangle());
        }
        self.unused = self.triangles.len();
    }

    /// Fills the hole side by side. The apex of a side is the vertex whose circle with it contains no other: a
    /// linear search, because the circles through two points are ordered.
    fn fill<T: Tally>(&mut self, mesh: &mut Mesh2, tally: &mut T) {
        let end = self.border.len() - 1;
        self.pending.push((0, end, self.border[end].1));
        while let Some((first, last, outside)) = self.pending.pop() {
            if last == first + 1 {
                mesh.link(outside, self.border[first].1);
                mesh.remember(outside);
                continue;
            }
            let k = self.apex(first, last, tally);
            let t = self.take().expect("a hole of degree d takes d - 2 triangles");
            let [a, b, c] = [last, first, k].map(|i| self.border[i].0);
            mesh.set_corners(t, [a, b, c]);
            mesh.link(t.edge(0), outside);
            if last == end && first == 0 {
                mesh.remember(t.edge(0));
            }
            self.pending.push((first, k, t.edge(1)));
            self.pending.push((k, last, t.edge(2)));
        }
    }

    /// The apex of the side from `last` to `first` among the vertices between them.
    fn apex<T: Tally>(&self, first: usize, last: usize, tally: &mut T) -> usize {
        if last == first + 2 {
            return first + 1;
        }
        let (a, b) = (self.border[last].0, self.border[first].0);
        let is_finite = !a.is_ghost() && !b.is_ghost();
        let mut best = None;
        let mut ghost = first + 1;
        for k in first + 1..last {
            if self.border[k].0.is_ghost() {
                ghost = k; // where nothing finite is in front of the side
                continue;
            }
            let q = self.points[k];
            if is_finite {
                tally.orientation();
                if !orient2d(self.points[last], self.points[first], q).is_positive() {
                    continue;
                }
            }
            let better = best.is_none_or(|apex: usize| {
                tally.in_circle();
                let at = [last, first, apex];
                conflicts::<false>([a, b, self.border[apex].0], |i| self.points[at[i]], q)
            });
            if better {
                best = Some(k);
            }
        }
        best.unwrap_or(ghost)
    }

    /// Fills the hole with those triangles of its border's own triangulation that are inside.
    fn fill_large(&mut self, mesh: &mut Mesh2, points: &[[f64; 2]]) {
        let degree = self.border.len();
        let finite: Vec<usize> = (0..degree).filter(|&i| !self.border[i].0.is_ghost()).collect();
        let local: Vec<[f64; 2]> = finite.iter().map(|&i| points[self.border[i].0.index()]).collect();
        let construct::InOrder { mesh: patch, indices, .. } = construct::in_order(&local);
        // The place in the patch of each vertex of the border, and back.
        let mut place = vec![Place::GHOST; degree];
        for (position, &index) in indices.iter().enumerate() {
            place[finite[index as usize]] = Place::new(position);
        }
        // For each edge of the patch that is a side of the hole, which one.
        let mut side = vec![usize::MAX; patch.edges.len()];
        for i in 0..degree {
            let (from, to) = (place[i], place[(i + 1) % degree]);
            let e = if from.is_ghost() {
                patch.spokes(to).map(|e| patch.twin(e)).find(|&e| patch.tail(e).is_ghost())
            } else {
                patch.spokes(from).find(|&e| patch.head(e) == to)
            };
            side[e.expect("the border of a hole is Delaunay").index()] = i;
        }
        let root = side.iter().position(|&i| i != usize::MAX).expect("a hole has sides");
        let mut image = vec![None; patch.slot_count()];
        let mut found = vec![EdgeId::new(root).triangle()];
        image[found[0].index()] = self.take();
        let mut next = 0;
        while next < found.len() {
            let t = found[next];
            next += 1;
            for e in [0, 1, 2].map(|k| t.edge(k)) {
                let across = patch.twin(e).triangle();
                if side[e.index()] == usize::MAX && image[across.index()].is_none() {
                    image[across.index()] = self.take();
                    found.push(across);
                }
            }
        }
        let border_of = |p: Place| match p {
            Place::GHOST => Place::GHOST,
            p => self.border[finite[indices[p.index()] as usize]].0,
        };
        let image = |t: TriangleId| image[t.index()].expect("inside the hole");
        for &t in &found {
            let new = image(t);
            mesh.set_corners(new, patch.places(t).map(border_of));
            for k in 0..3 {
                let (e, f) = (t.edge(k), patch.twin(t.edge(k)));
                match side[e.index()] {
                    usize::MAX => mesh.link(new.edge(k), image(f.triangle()).edge(f.corner())),
                    i => mesh.link(new.edge(k), self.border[i].1),
                }
                mesh.remember(new.edge(k));
            }
        }
    }
}
