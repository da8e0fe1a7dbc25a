//! Constraints that are chords of arcs: new vertices on them are on the arcs.
//!
//! A constraint is split beside its line then, in the triangle that is there: its domain ends at both new chords. So the middle of the arc must be strictly
//! inside of that triangle, and it is where triangles are not much smaller than arcs are high. Free vertices between chord and arc go before.
//!
//! When all else is done, arcs are split that are high beside their triangles. Then the nodes of elements of second order can be on the arcs
//! ([`super::Refined2::arc_middles`]).
//!
//! Cost: O(log a) for a look at one of a arcs; another round for each time that arcs are halved.

use std::collections::{BTreeMap, BTreeSet};

use delone_predicates::{lexicographic, orient2d};

use super::free::Met;
use super::mesher::Mesher;
use super::queue::Fault;
use super::shape::{Shape, squared};
use crate::error::{ArcProblem, Error};
use crate::ids::{EdgeId, Place, VertexId};
use crate::plane::arc::Arc2;
use crate::plane::constrained::{Constrained2, Origin, SegmentId, sorted};

/// The smallest height of a triangle is at least so many times that of an arc over its side. From 12 on all three sides may be arcs, and
/// elements of second order are still not inverted: 4 for the derivative of a shape function, times 3 sides.
const HEIGHTS: f64 = 13.0;
/// Arcs lower than this part of their chord are not split for that: they turn by less than a degree. Where an arc touches another line
/// triangles are as flat as it is.
const FLATTEST_ARC: f64 = 1.0 / 512.0;

/// The centers of arcs, by the ends of the input constraints that are their chords.
pub(super) type Centers<T> = BTreeMap<[T; 2], [f64; 2]>;

/// The chords among the constraints of the input: segments may go through vertices.
pub(super) fn chords(
    c: &Constrained2,
    arcs: &[(SegmentId, [f64; 2])],
    origins: &[Origin],
) -> Result<Centers<VertexId>, Error> {
    let mut chords = Centers::new();
    let curved: BTreeSet<SegmentId> = arcs.iter().map(|arc| arc.0).collect();
    for &(s, center) in arcs {
        let flawed = |problem| Error::Arc { segment: s.index(), problem };
        let chain = c.chain(s).ok_or(flawed(ArcProblem::NoSegment))?;
        let ends = [chain[0], chain[chain.len() - 1]].map(|v| c.point(v));
        Arc2::new(ends, center).map_err(|error| match error {
            Error::Arc { problem, .. } => flawed(problem),
            other => other,
        })?;
        let is_straight = |e: EdgeId| c.covering(e).iter().any(|one| !curved.contains(&one.segment));
        let edge = |v: VertexId, w: VertexId| c.mesh().star(v).find(|&e| c.mesh().destination(e) == w);
        if chain.windows(2).filter_map(|link| edge(link[0], link[1])).any(is_straight) {
            return Err(flawed(ArcProblem::Straight));
        }
        let is_input = |v: &VertexId| origins.get(v.index()).is_none_or(|origin| origin.on == [*v; 2]);
        let chain: Vec<VertexId> = chain.into_iter().filter(is_input).collect();
        for link in chain.windows(2) {
            let ends = [link[0].min(link[1]), link[0].max(link[1])];
            let known = chords.entry(ends).or_insert(center);
            let [one, other] = [*known, center].map(|center| Arc2::of(ends.map(|v| c.point(v)), center));
            if !one.is_nearly(&other) {
                return Err(flawed(ArcProblem::Repeated));
            }
            if lexicographic(center, *known).is_lt() {
                *known = center;
            }
        }
    }
    Ok(chords)
}

impl Mesher<'_> {
    /// With constraints that are chords of arcs.
    pub(super) fn along(self, chords: &Centers<VertexId>) -> Self {
        let place = |v: VertexId| self.layer.mesh.place(v);
        let chord = |(ends, center): (&[VertexId; 2], &[f64; 2])| {
            Some((sorted([place(ends[0])?, place(ends[1])?]), *center))
        };
        let arcs = chords.iter().filter_map(chord).collect();
        Self { arcs, ..self }
    }

    /// The arc over a constraint, if there is one.
    pub(super) fn arc(&self, ends: [Place; 2]) -> Option<Arc2> {
        if self.arcs.is_empty() {
            return None;
        }
        let center = *self.arcs.get(&sorted(self.input_of(ends)))?;
        Some(Arc2::of(ends.map(|v| self.point(v)), center))
    }

    /// The point of an arc that is under the far corner of the triangle there: between two arcs the middle may be in another triangle.
    pub(super) fn under_tip(&self, e: EdgeId) -> Option<[f64; 2]> {
        let arc = self.arc(self.ends(e))?;
        let mesh = &self.layer.mesh;
        let [a, b] = [mesh.tail(e), mesh.head(e)].map(|v| self.point(v));
        let side = if orient2d(a, b, arc.center()).is_positive() { mesh.twin(e) } else { e };
        let tip = Some(mesh.tip(side)).filter(|tip| !tip.is_ghost())?;
        arc.towards(self.point(tip)).filter(|&q| self.is_clear(e, q))
    }

    /// Where the chord of another arc is between a constraint and its arc, notes that this one is split first, once.
    pub(super) fn split_arc_between(&mut self, e: EdgeId, q: [f64; 2]) -> bool {
        let ends = self.ends(e);
        if self.arc(ends).is_none() || !self.waiting.insert(ends) {
            return false;
        }
        let sides = [e, self.layer.mesh.twin(e)].into_iter().filter(|e| !self.layer.mesh.tip(*e).is_ghost());
        let other =
            sides.filter(|e| self.is_inside(e.triangle())).find_map(|side| match self.walk(side, q) {
                Met::Constraint(other) if self.arc(self.ends(other)).is_some() => Some(other),
                _ => None,
            });
        let Some(other) = other.filter(|&other| self.refusal(other).is_none()) else { return false };
        self.note_constraint(other, Fault::Constraint);
        self.note_constraint(e, Fault::LargeConstraint);
        true
    }

    /// Splits arcs that are high beside their triangles, until none is.
    pub(super) fn flatten_arcs(&mut self) -> Result<(), Error> {
        while self.note_high_arcs() {
            self.run()?;
        }
        Ok(())
    }

    /// Notes them; whether there are any.
    fn note_high_arcs(&mut self) -> bool {
        if self.arcs.is_empty() {
            return false;
        }
        let mesh = &self.layer.mesh;
        let is_high = |e: &EdgeId| self.is_constraint(*e) && self.refusal(*e).is_none() && self.is_high(*e);
        let high: Vec<EdgeId> = mesh.fixed_edges().filter(is_high).collect();
        high.iter().for_each(|&e| self.note_constraint(e, Fault::Constraint));
        !high.is_empty()
    }

    fn is_high(&self, e: EdgeId) -> bool {
        let mesh = &self.layer.mesh;
        let ends = self.ends(e);
        let Some(arc) = self.arc(ends) else { return false };
        let [a, b] = ends.map(|v| self.point(v));
        let rise = arc.sagitta();
        let is_higher = |e: EdgeId| {
            let shape = Shape::of(self.layer, e.triangle());
            shape.is_some_and(|shape| HEIGHTS * rise > 2.0 * shape.area() / shape.longest().sqrt())
        };
        let mut sides = [e, mesh.twin(e)].into_iter().filter(|e| self.is_inside(e.triangle()));
        rise > FLATTEST_ARC * squared(a, b).sqrt() && sides.any(is_higher)
    }
}
