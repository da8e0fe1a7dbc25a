//! The state of a refinement, and its loop: the first task, until there is none.
//!
//! *It always ends.* Every vertex has a scale: of an input vertex the distance to the nearest that it sees; of a new one the
//! scale of its nearest neighbor or of the vertices that made it necessary, or its distance from an input vertex or from the other
//! side of a small input angle, or the size that is wanted there, where that is less. A vertex nearer to its nearest neighbor than
//! 1/64 of that one's scale is refused. So scales come from a finite set, and what is accepted keeps a distance: inside of a
//! triangle of the first triangulation all vertices see each other, hence there are finitely many. Vertices are removed only where
//! a constraint is split, and there are finitely many of these splits.

use std::collections::{BTreeMap, BTreeSet};

use delone_predicates::angle;

use super::arcs::Centers;
use super::queue::{Fault, Queue, Task};
use super::report::Reason;
use super::rules::Rules;
use super::shape::{Shape, squared, squared_height, squared_obtuseness};
use crate::error::Error;
use crate::ids::{EdgeId, Place, TriangleId, VertexId};
use crate::mesh::Mesh2;
use crate::plane::constrained::{Origin, sorted};
use crate::plane::layer::Layer;
use crate::prefetch::prefetch;

/// After so many tasks it is asked whether to go on.
const PAUSE: usize = 1024;
/// A vertex nearer than this part of a scale is refused.
const PART: f64 = 1.0 / 64.0;

/// A vertex during refinement.
#[derive(Clone, Copy, Debug)]
pub(super) struct Known {
    /// The ends of the input constraint that it lies on; twice itself for an input vertex, the ghost for a free one, and then
    /// itself if it is one of an earlier refinement, which stays.
    pub(super) on: [Place; 2],
    /// See the module.
    pub(super) scale: f64,
}

impl Known {
    /// Of a new vertex on no constraint.
    pub(super) fn free(scale: f64) -> Self {
        Self { on: [Place::GHOST; 2], scale }
    }

    /// Of a vertex as the last refinement left it, if all that it tells of is still there.
    fn of(origin: &Origin, p: Place, mesh: &Mesh2) -> Option<Self> {
        let scale = origin.scale;
        if origin.on[0].is_ghost() {
            return Some(Self { on: [Place::GHOST, p], scale });
        }
        let [a, b] = origin.on.map(|v| mesh.place(v));
        Some(Self { on: [a?, b?], scale })
    }

    /// The origin of the vertex, for the next refinement.
    pub(super) fn origin(&self, mesh: &Mesh2) -> Origin {
        let name = |p: Place| if p.is_ghost() { VertexId::GHOST } else { mesh.name(p) };
        Origin { on: self.on.map(name), scale: self.scale }
    }

    pub(super) fn may_go(&self) -> bool {
        self.on == [Place::GHOST; 2]
    }

    pub(super) fn is_free(&self) -> bool {
        self.on[0].is_ghost()
    }

    pub(super) fn is_input(&self) -> bool {
        self.on[0] == self.on[1] && !self.is_free()
    }
}

/// See the module.
#[derive(Debug)]
pub(super) struct Mesher<'a> {
    pub(super) layer: &'a mut Layer,
    pub(super) rules: &'a Rules<'a>,
    pub(super) queue: Queue,
    /// By place.
    pub(super) known: Vec<Known>,
    /// New vertices in the order in which they came, those that went since and were others' places too.
    pub(super) born: Vec<Place>,
    /// The number of new vertices.
    pub(super) count: usize,
    /// How many of them are there because something was too large.
    pub(super) for_sizes: usize,
    /// How small the smallest angles between constraints are at input vertices, as far as that was asked.
    pub(super) tips: BTreeMap<Place, f64>,
    /// Constraints that cannot be split.
    pub(super) refused: BTreeMap<[Place; 2], Reason>,
    /// Triangles that cannot be mended.
    pub(super) left: Vec<([Place; 3], Reason)>,
    /// Fixed edges that are no constraints: they keep triangles that were given, until a vertex comes into the circle of one.
    pub(super) kept: BTreeSet<[Place; 2]>,
    /// The centers of the arcs that input constraints are chords of.
    pub(super) arcs: Centers<Place>,
    /// Chords that were noted again once, behind another one.
    pub(super) waiting: BTreeSet<[Place; 2]>,
}

/// The result of a refinement.
#[derive(Debug)]
pub(super) struct Done {
    /// The new vertices that there are, in the order in which they came.
    pub(super) new: Vec<Place>,
    /// All vertices, by place.
    pub(super) known: Vec<Known>,
    /// Why triangles were left, by their corners from the shortest edge on.
    pub(super) left: Vec<([Place; 3], Reason)>,
    /// Why constraints were not split.
    pub(super) refused: BTreeMap<[Place; 2], Reason>,
    /// Edges that keep triangles.
    pub(super) kept: BTreeSet<[Place; 2]>,
}

impl<'a> Mesher<'a> {
    /// For triangles in domains, all of whose borders are fixed. If they were refined before it is known where vertices come from.
    pub(super) fn new(layer: &'a mut Layer, rules: &'a Rules<'a>, queue: Queue, origins: &[Origin]) -> Self {
        let scale = |p: Place| {
            let own = layer.points[p.index()];
            let others = layer.mesh.spokes(p).map(|e| layer.mesh.head(e)).filter(|w| !w.is_ghost());
            others.map(|w| squared(own, layer.points[w.index()])).fold(f64::INFINITY, f64::min).sqrt()
        };
        let known = |i: usize| {
            let p = Place::new(i);
            if !layer.mesh.is_vertex(p) {
                return Known { on: [p; 2], scale: 0.0 };
            }
            let origin = origins.get(layer.mesh.name(p).index());
            let known = origin.and_then(|origin| Known::of(origin, p, &layer.mesh));
            known.unwrap_or_else(|| Known { on: [p; 2], scale: scale(p) })
        };
        let known = (0..layer.points.len()).map(known).collect();
        Self {
            layer,
            rules,
            queue,
            known,
            born: Vec::new(),
            count: 0,
            for_sizes: 0,
            tips: BTreeMap::new(),
            refused: BTreeMap::new(),
            left: Vec::new(),
            kept: BTreeSet::new(),
            arcs: Centers::new(),
            waiting: BTreeSet::new(),
        }
    }

    /// With fixed edges that only keep triangles.
    pub(super) fn keeping(self, kept: BTreeSet<[Place; 2]>) -> Self {
        Self { kept, ..self }
    }

    /// Forgets all new vertices, when the triangulation and what is known of its vertices are as they were.
    pub(super) fn restart(&mut self) {
        self.queue.clear();
        self.born.clear();
        (self.count, self.for_sizes) = (0, 0);
        self.refused.clear();
        self.waiting.clear();
    }

    /// Mends all that can be mended.
    pub(super) fn run(&mut self) -> Result<(), Error> {
        let constraints: Vec<EdgeId> = {
            let mesh = &self.layer.mesh;
            mesh.fixed_edges().filter(|&e| self.is_constraint(e)).collect()
        };
        constraints.into_iter().for_each(|e| self.look_at_constraint(e));
        for t in self.layer.mesh.triangles().collect::<Vec<_>>() {
            self.look_at(t);
        }
        let mut steps = 0_usize;
        while let Some(task) =
            self.queue.pop(&self.layer.points, |e| prefetch(&self.layer.mesh.edges, e.index()))
        {
            steps += 1;
            if steps.is_multiple_of(PAUSE) {
                self.rules.go_on(self.count)?;
            }
            if task.fault() <= Fault::LargeConstraint {
                if let Some(e) = self.constraint(&task) {
                    self.split(e, task.fault() == Fault::LargeConstraint);
                }
                continue;
            }
            if let Some(shape) = self.shape_of(&task) {
                self.mend(&task, &shape);
            }
        }
        self.rules.go_on(self.count)
    }

    /// Gives back what memory the work has taken.
    pub(super) fn finish(self) -> Done {
        Done { new: self.alive(), known: self.known, left: self.left, refused: self.refused, kept: self.kept }
    }

    /// The new vertices that there are, in the order in which they came.
    pub(super) fn alive(&self) -> Vec<Place> {
        let mut is_known = vec![false; self.layer.points.len()];
        let mut alive: Vec<Place> = self.born.iter().rev().copied().collect();
        // Of a place that was used again the last vertex counts.
        let mesh = &self.layer.mesh;
        alive.retain(|p| mesh.is_vertex(*p) && !std::mem::replace(&mut is_known[p.index()], true));
        alive.reverse();
        alive
    }

    /// The triangle of a task, if it is still there and not as it should be. What has the same corners may be another one: places
    /// are used again.
    fn shape_of(&self, task: &Task) -> Option<Shape> {
        let (mesh, e) = (&self.layer.mesh, task.edge);
        let is_there =
            mesh.is_triangle(e.triangle()) && [mesh.tail(e), mesh.head(e), mesh.tip(e)] == task.corners;
        let (now, shape) = if is_there { self.task_of(e.triangle())? } else { return None };
        now.is(task).then_some(shape)
    }

    /// The constraint of a task, if it was not split since.
    fn constraint(&self, task: &Task) -> Option<EdgeId> {
        let (mesh, [a, b, _]) = (&self.layer.mesh, task.corners);
        let is_there = |&e: &EdgeId| {
            mesh.is_triangle(e.triangle()) && mesh.tail(e) == a && mesh.head(e) == b && mesh.is_fixed(e)
        };
        // Its triangle may be another one by now.
        Some(task.edge).filter(is_there).or_else(|| mesh.edge_between(a, b).filter(is_there))
    }

    /// Whether an edge is a constraint: fixed, and not only there to keep triangles.
    #[inline]
    pub(super) fn is_constraint(&self, e: EdgeId) -> bool {
        self.layer.mesh.is_fixed(e) && !self.is_kept(e)
    }

    /// Whether a fixed edge is only there to keep triangles.
    #[inline]
    pub(super) fn is_kept(&self, e: EdgeId) -> bool {
        let mesh = &self.layer.mesh;
        !self.kept.is_empty() && self.kept.contains(&sorted([mesh.tail(e), mesh.head(e)]))
    }

    /// Whether a triangle is in a domain.
    #[inline]
    pub(super) fn is_inside(&self, t: TriangleId) -> bool {
        self.rules.is_inside(self.layer.mesh.domain(t))
    }

    #[inline]
    pub(super) fn point(&self, p: Place) -> [f64; 2] {
        self.layer.points[p.index()]
    }

    /// The ends of an edge, the lexicographically lesser first: so it is the same from both sides.
    pub(super) fn ends(&self, e: EdgeId) -> [Place; 2] {
        let mesh = &self.layer.mesh;
        let (a, b) = (mesh.tail(e), mesh.head(e));
        let order = delone_predicates::lexicographic(self.point(a), self.point(b));
        if order.is_lt() { [a, b] } else { [b, a] }
    }

    /// Notes a triangle if something is wrong with it.
    #[inline]
    pub(super) fn look_at(&mut self, t: TriangleId) {
        if let Some((task, _)) = self.task_of(t) {
            self.queue.push(task, &self.layer.points);
        }
    }

    /// The fault of a triangle.
    #[inline]
    fn task_of(&self, t: TriangleId) -> Option<(Task, Shape)> {
        let mesh = &self.layer.mesh;
        let domain = mesh.domain(t);
        if !self.rules.is_inside(domain) {
            return None;
        }
        let shape = Shape::of(self.layer, t)?;
        let e = shape.shortest;
        let corners = || [mesh.tail(e), mesh.head(e), mesh.tip(e)];
        let fault = if shape.is_sharp(self.rules.squared_cosine) && !self.is_forced(&corners()) {
            Fault::Angle
        } else if self.rules.is_large(&shape, domain) {
            Fault::Size
        } else {
            return None;
        };
        Some((self.queue.task(fault, shape.squares[0], shape.points[0], e, corners()), shape))
    }

    /// Whether the shortest edge of a triangle joins two constraints that meet at less than 60 degrees, at the same distance from where they do: its angle
    /// is that of the input (Miller, Pav & Walkington, "When and why Ruppert's algorithm works", IMR 2003).
    pub(super) fn is_forced(&self, corners: &[Place; 3]) -> bool {
        let [p, q] = [corners[0], corners[1]].map(|v| self.known[v.index()]);
        if p.is_free() || q.is_free() || p.is_input() || q.is_input() {
            return false;
        }
        let Some(o) = shared(p.on, q.on) else { return false };
        let apart = squared(self.point(corners[0]), self.point(corners[1]));
        let [p, q] = [corners[0], corners[1]].map(|v| squared(self.point(v), self.point(o)));
        (0.999 * p..1.001 * p).contains(&q) && apart < p
    }

    /// Notes a constraint if a vertex is too near to it, or it is too long.
    pub(super) fn look_at_constraint(&mut self, e: EdgeId) {
        if self.is_encroached(e) {
            self.note_constraint(e, Fault::Constraint);
        } else if self.is_long(e) {
            self.note_constraint(e, Fault::LargeConstraint);
        }
    }

    pub(super) fn note_constraint(&mut self, e: EdgeId, fault: Fault) {
        let [a, b] = self.ends(e);
        let (p, q) = (self.point(a), self.point(b));
        let e = if self.layer.mesh.tail(e) == a { e } else { self.layer.mesh.twin(e) };
        let task = self.queue.task(fault, squared(p, q), p, e, [a, b, Place::GHOST]);
        self.queue.push(task, &self.layer.points);
    }

    fn is_encroached(&self, e: EdgeId) -> bool {
        self.rules.clears_constraints() && self.tips_near(e).next().is_some()
    }

    /// The vertices across a constraint in the mesh that are too near to it.
    pub(super) fn tips_near(&self, e: EdgeId) -> impl Iterator<Item = Place> + '_ {
        let mesh = &self.layer.mesh;
        let ends = [mesh.tail(e), mesh.head(e)].map(|v| self.point(v));
        let sides = [e, mesh.twin(e)].into_iter().filter(|e| self.is_inside(e.triangle()));
        sides.map(|e| mesh.tip(e)).filter(move |&tip| self.is_too_near(self.point(tip), ends))
    }

    /// Whether a constraint of the mesh is longer than it may be.
    fn is_long(&self, e: EdgeId) -> bool {
        let mesh = &self.layer.mesh;
        let domains = [e, mesh.twin(e)].map(|e| mesh.domain(e.triangle()));
        squared(self.point(mesh.tail(e)), self.point(mesh.head(e))) > self.rules.longest_between(domains)
            && (self.is_inside(e.triangle()) || self.is_inside(mesh.twin(e).triangle()))
    }

    /// Whether a point is too near to a constraint: in its diametral circle, or in its diametral lens, where sides have half of
    /// the smallest angle that there is to be.
    #[inline]
    pub(super) fn is_too_near(&self, q: [f64; 2], ends: [[f64; 2]; 2]) -> bool {
        if self.rules.conforming {
            return delone_predicates::angle(q, ends[0], ends[1]).is_negative();
        }
        squared_obtuseness(q, ends).is_some_and(|square| square >= self.rules.lens)
    }

    /// Why a constraint cannot be split, if it cannot.
    pub(super) fn refusal(&self, e: EdgeId) -> Option<Reason> {
        let mesh = &self.layer.mesh;
        let sides = [e, mesh.twin(e)].map(|e| e.triangle());
        let inside = sides.map(|t| self.is_inside(t));
        if sides.into_iter().any(|t| self.rules.is_layer(mesh.domain(t))) {
            return Some(Reason::Kept);
        }
        if self.rules.keeps(inside[0] && inside[1]) {
            return Some(Reason::Kept);
        }
        if self.refused.is_empty() {
            return None;
        }
        self.refused.get(&self.ends(e)).copied()
    }

    /// Leaves a triangle as it is.
    pub(super) fn leave(&mut self, corners: [Place; 3], reason: Reason) {
        self.left.push((corners, reason));
    }

    /// The vertex nearest to a point among those on the border of the cavity that was dug, and the square of its distance; of
    /// several the one of least scale.
    pub(super) fn nearest(&self, q: [f64; 2]) -> (Place, f64) {
        let border = self.layer.cavity.border().iter().map(|edge| edge.0).filter(|v| !v.is_ghost());
        let mut best = (Place::GHOST, f64::INFINITY);
        for v in border {
            let square = squared(q, self.point(v));
            // The square of what is far may be infinite.
            let is_first = best.0.is_ghost();
            if is_first || square < best.1 || (square == best.1 && self.is_finer(v, best.0)) {
                best = (v, square);
            }
        }
        best
    }

    /// Whether a vertex has a lesser scale than another one, or the same and comes first.
    fn is_finer(&self, v: Place, w: Place) -> bool {
        let [one, other] = [v, w].map(|v| self.known[v.index()].scale);
        let order = one.total_cmp(&other);
        order.then_with(|| delone_predicates::lexicographic(self.point(v), self.point(w))).is_lt()
    }

    /// Whether a vertex may be so near to another one of some scale.
    pub(super) fn is_cascade(square: f64, scale: f64) -> bool {
        square < (PART * scale) * (PART * scale)
    }

    /// Why there may be no vertex so near to another one of some scale.
    pub(super) fn why_too_near(&self, square: f64, scale: f64) -> Option<Reason> {
        let is_short = square < self.rules.squared_least;
        is_short
            .then_some(Reason::Short)
            .or_else(|| Self::is_cascade(square, scale).then_some(Reason::Cascade))
    }

    /// Whether a vertex with this star may move to a point without coming too near to any vertex that it sees: its disk is in the star.
    pub(super) fn keeps_apart(&self, star: &[EdgeId], q: [f64; 2]) -> bool {
        let least = self.rules.squared_least;
        let mesh = &self.layer.mesh;
        least == 0.0
            || star.iter().all(|e| {
                let link = e.next();
                let [a, b] = [mesh.tail(link), mesh.head(link)].map(|v| self.point(v));
                let is_beside = !angle(a, b, q).is_negative() && !angle(b, a, q).is_negative();
                let is_behind = is_beside && !mesh.is_fixed(link) && squared_height(q, [a, b]) < least;
                squared(q, a) >= least && !is_behind
            })
    }

    /// The point of a new vertex is at this place.
    pub(super) fn note_vertex(&mut self, place: Place, known: Known) {
        if self.known.len() <= place.index() {
            self.known.resize(place.index() + 1, Known::free(0.0));
        }
        self.known[place.index()] = known;
        self.born.push(place);
        self.count += 1;
    }

    /// Turns the edges around a vertex so that the one with the lexicographically least head is first: sums are rounded in an order that does
    /// not depend on where a star is said to begin.
    pub(super) fn turn_to_least(&self, star: &mut [EdgeId]) {
        let head = |e: &EdgeId| self.layer.mesh.head(*e);
        let order = |p: Place, q: Place| {
            p.is_ghost()
                .cmp(&q.is_ghost())
                .then_with(|| delone_predicates::lexicographic(self.point(p), self.point(q)))
        };
        let least = (0..star.len()).min_by(|&i, &j| order(head(&star[i]), head(&star[j])));
        star.rotate_left(least.unwrap_or(0));
    }

    /// Looks at what is new around a vertex.
    pub(super) fn look_around(&mut self, v: Place) {
        let first = self.layer.mesh.incident[v.index()];
        let mut spoke = first;
        loop {
            self.look_at(spoke.triangle());
            spoke = self.layer.mesh.spin(spoke);
            if spoke == first {
                return;
            }
        }
    }
}

/// The end that two constraints share, if they share one and are not the same.
pub(super) fn shared(p: [Place; 2], q: [Place; 2]) -> Option<Place> {
    let common = p.into_iter().find(|v| q.contains(v))?;
    let is_same = p == q || p == [q[1], q[0]];
    (!is_same).then_some(common)
}
