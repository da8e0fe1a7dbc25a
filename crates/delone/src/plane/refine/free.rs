//! A new vertex for a triangle: found by a walk, checked, inserted; or a constraint in its way is to be split first.
//!
//! Source: Chew, SoCG 1993; the walk is Shewchuk's (CGTA 2002): from the triangle towards the point, until a constraint is met.
//! Circles shrink on the way, because no constraint is crossed, so it ends.
//!
//! Cost: the walk, a few steps, and the cavity.

use delone_predicates::{Sign, orient2d};

use super::criteria::Placement;
use super::mesher::{Known, Mesher};
use super::queue::{Fault, Task};
use super::report::Reason;
use super::shape::{Shape, squared_obtuseness};
use crate::ids::{EdgeId, Place, TriangleId};
use crate::locate::walk;
use crate::plane::layer::insert::Spot;

/// The end of a walk.
pub(super) enum Met {
    /// The triangle that the point is in.
    Triangle(TriangleId),
    /// A constraint that it is behind, or on.
    Constraint(EdgeId),
    /// A vertex at the point, or nothing that can be told for want of precision.
    Nothing,
}

impl Mesher<'_> {
    /// Mends a triangle: with a new vertex, by noting constraints that must be split first, or not at all.
    pub(super) fn mend(&mut self, task: &Task, shape: &Shape) {
        let is_for_size = task.fault() == Fault::Size;
        if self.rules.is_enough(self.count, self.for_sizes, is_for_size) {
            self.leave(task.corners, Reason::Budget);
            return;
        }
        let is_far = is_for_size || self.rules.placement == Placement::Circumcenter;
        let reach = if is_far { f64::INFINITY } else { self.rules.reach };
        let center = shape.center(reach);
        let q = if center.iter().all(|x| x.is_finite()) { center } else { shape.center(self.rules.reach) };
        self.mend_at(task, shape, q);
    }

    /// Mends a triangle with a vertex at a point, if that can be.
    fn mend_at(&mut self, task: &Task, shape: &Shape, q: [f64; 2]) {
        match self.reach(shape.shortest, q) {
            Some(Met::Triangle(t)) => self.place(task, q, t, false),
            Some(Met::Constraint(e)) => self.split_first(task, &[e], false),
            Some(Met::Nothing) => self.leave(task.corners, Reason::Precision),
            None => {}
        }
    }

    /// From a triangle, by an edge that `q` is not behind, to what is in the way.
    pub(super) fn walk(&self, start: EdgeId, q: [f64; 2]) -> Met {
        let mesh = &self.layer.mesh;
        let side = |e: EdgeId| orient2d(self.point(mesh.tail(e)), self.point(mesh.head(e)), q);
        if !q.iter().all(|x| x.is_finite()) || side(start).is_negative() {
            return Met::Nothing;
        }
        let mut constraint = None;
        let end = walk::walk(start, usize::MAX, |from| {
            let crossed = walk::exit(from, false, |e| side(e).is_negative())?;
            constraint = Some(crossed).filter(|&e| mesh.is_fixed(e));
            constraint.is_none().then(|| mesh.twin(crossed))
        });
        if let Some(e) = constraint {
            return Met::Constraint(e);
        }
        let t = end.at.triangle();
        if mesh.places(t).iter().any(|v| self.point(*v) == q) {
            return Met::Nothing;
        }
        let on =
            [0, 1, 2].map(|k| t.edge(k)).into_iter().find(|&e| mesh.is_fixed(e) && side(e) == Sign::Zero);
        on.map_or(Met::Triangle(t), Met::Constraint)
    }

    /// Notes constraints to be split, and the triangle to be looked at again then. What is too large beside constraints that are
    /// to be kept gets its centroid, if that was not tried.
    fn split_first(&mut self, task: &Task, constraints: &[EdgeId], is_last: bool) {
        if let Some(reason) = constraints.iter().map(|&e| self.refusal(e)).min().flatten() {
            let t = task.edge.triangle();
            match Shape::of(self.layer, t) {
                Some(shape) if reason == Reason::Kept && !is_last && self.is_large(&shape, t) => {
                    self.place(task, shape.centroid(), t, true);
                }
                _ => self.leave(task.corners, reason),
            }
            return;
        }
        let fault = if task.fault() == Fault::Size { Fault::LargeConstraint } else { Fault::Constraint };
        for &e in constraints {
            if self.refusal(e).is_none() {
                self.note_constraint(e, fault);
            }
        }
        self.queue.push(*task, &self.layer.points);
    }

    /// Makes a point in a triangle a vertex, unless it is too near to constraints or to others.
    fn place(&mut self, task: &Task, q: [f64; 2], t: TriangleId, is_last: bool) {
        if is_last && !self.is_strictly_in(t, q) {
            self.leave(task.corners, Reason::Precision);
            return;
        }
        self.dig(q, t);
        let mesh = &self.layer.mesh;
        let near: Vec<EdgeId> = self
            .layer
            .cavity
            .border()
            .iter()
            .map(|edge| edge.1)
            .filter(|&e| self.is_constraint(e))
            .filter(|&e| {
                let ends = [mesh.tail(e), mesh.head(e)].map(|v| self.point(v));
                if is_last { is_flat(q, ends) } else { self.is_too_near(q, ends) }
            })
            .collect();
        // Rounded, a point may be outside of the circle that it is to be the center of, and one far away is behind a constraint that the walk went
        // around: it would mend nothing.
        let mends = mesh.is_marked(task.edge.triangle());
        let (nearest, square) = self.nearest(q);
        // The ends of the shortest edge made it necessary.
        let [v, w] = [task.corners[0], task.corners[1]];
        let mut scale =
            [nearest, v, w].map(|v| self.known[v.index()].scale).into_iter().fold(f64::INFINITY, f64::min);
        if task.fault() == Fault::Size {
            scale = scale.min(square.sqrt());
        }
        let too_near = self.why_too_near(square, scale);
        if !near.is_empty() || !mends || too_near.is_some() {
            self.abandon();
            if near.is_empty() {
                let shape = Shape::of(self.layer, task.edge.triangle()).filter(|_| !mends && !is_last);
                match shape.map(|shape| (shape.center(self.rules.reach), shape)) {
                    Some((nearer, shape)) if nearer != q => self.mend_at(task, &shape, nearer),
                    _ => self.leave(task.corners, too_near.unwrap_or(Reason::Precision)),
                }
            } else {
                self.split_first(task, &near, is_last);
            }
            return;
        }
        let v = self.layer.place_for(Spot::Triangle(t), q);
        self.fill(v);
        self.note_vertex(v, Known::free(scale));
        self.for_sizes += usize::from(task.fault() == Fault::Size);
        self.look_around(v);
    }

    fn is_large(&self, shape: &Shape, t: TriangleId) -> bool {
        self.rules.is_large(shape, self.layer.mesh.domain(t))
    }

    pub(super) fn is_strictly_in(&self, t: TriangleId, q: [f64; 2]) -> bool {
        let [a, b, c] = self.layer.mesh.places(t).map(|v| self.point(v));
        [[a, b], [b, c], [c, a]].into_iter().all(|[p, r]| orient2d(p, r, q).is_positive())
    }

    /// Digs the cavity of a point in a triangle.
    pub(super) fn dig(&mut self, q: [f64; 2], t: TriangleId) {
        let layer = &mut *self.layer;
        layer.cavity.dig(&mut layer.mesh, &layer.points, q, t);
    }

    /// Leaves the cavity that was dug as it is.
    pub(super) fn abandon(&mut self) {
        let layer = &mut *self.layer;
        layer.cavity.abandon(&mut layer.mesh);
    }

    /// Fills the cavity that was dug.
    pub(super) fn fill(&mut self, v: Place) {
        let layer = &mut *self.layer;
        layer.cavity.fill(&mut layer.mesh, v);
    }
}

/// Whether a point sees the ends of a constraint that is kept under more than 170 degrees.
fn is_flat(q: [f64; 2], ends: [[f64; 2]; 2]) -> bool {
    const FLAT: f64 = 0.9698;
    squared_obtuseness(q, ends).is_some_and(|square| square > FLAT)
}
