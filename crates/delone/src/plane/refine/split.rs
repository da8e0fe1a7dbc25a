//! A constraint is split: where, whether that is possible, and what goes before.
//!
//! In the middle; but where it meets another constraint in its triangle, on a circle around that end whose radius is a power of
//! two, so that the new vertices on both do not come nearer to each other's constraint (Ruppert, "A Delaunay refinement algorithm
//! for quality 2-dimensional mesh generation", J. Algorithms 1995; Shewchuk, CGTA 2002). Free vertices that it sees inside of its
//! diametral circle are removed before (Chew, SoCG 1993).
//!
//! A point is rounded, and may be beside the line by a unit in the last place. It must be strictly inside of the triangle that it is
//! in: so both halves are clear of every vertex, and everything stays positive.

use delone_predicates::{Sign, angle, lexicographic, orient2d};

use super::mesher::{Known, Mesher, shared};
use super::report::Reason;
use super::shape::{squared, squared_height};
use crate::ids::{EdgeId, Place, TriangleId};
use crate::plane::layer::insert::Spot;
use crate::powers::power_below;
use crate::sorting;

impl Mesher<'_> {
    /// Splits a constraint, perhaps because of a size, unless that is refused.
    pub(super) fn split(&mut self, e: EdgeId, is_for_size: bool) {
        let e = if self.ends(e)[0] == self.layer.mesh.tail(e) { e } else { self.layer.mesh.twin(e) };
        if self.refusal(e).is_some() {
            return;
        }
        if self.rules.is_enough(self.count, self.for_sizes, is_for_size) {
            self.refuse(e, Reason::Budget);
            return;
        }
        let meets = self.meets(e);
        let mut e = e;
        if (!self.rules.conforming && meets == [false; 2]) || self.arc(self.ends(e)).is_some() {
            e = self.clear(e);
        }
        let wanted = self.where_to_split(e, meets);
        let e = self.make_way(e, wanted);
        let first = Some(wanted).filter(|&q| self.is_clear(e, q));
        let near = first.or_else(|| around(wanted).into_iter().find(|&q| self.is_clear(e, q)));
        if near.is_none() && self.split_arc_between(e, wanted) {
            return;
        }
        let Some(q) = near.or_else(|| self.under_tip(e)) else {
            self.refuse(e, Reason::Precision);
            return;
        };
        if let Some(v) = self.insert_on(e, q, false) {
            self.for_sizes += usize::from(is_for_size);
            self.look_around(v);
            self.look_at_constraints_around(v);
        }
    }

    /// Splits a constraint at a place for the sake of a size, if that is possible, and looks at nothing.
    pub(super) fn divide(&mut self, e: EdgeId, q: [f64; 2]) -> Option<Place> {
        // The ends of a piece are rounded too: what is beside its input constraint by less than they are is beside the piece by more.
        let ends = self.ends(e);
        let [a, b] = ends.map(|v| self.point(v));
        let (u, w) = ([b[0] - a[0], b[1] - a[1]], [q[0] - a[0], q[1] - a[1]]);
        let part = (u[0] * w[0] + u[1] * w[1]) / squared(a, b);
        let on_piece = self.arc(ends).map_or_else(|| [0, 1].map(|k| a[k] + part * u[k]), |arc| arc.at(part));
        let mut places = std::iter::once(q).chain(around(q)).chain([on_piece]).chain(around(on_piece));
        let q = places.find(|&q| self.is_clear(e, q))?;
        let v = self.insert_on(e, q, true)?;
        self.for_sizes += 1;
        Some(v)
    }

    fn refuse(&mut self, e: EdgeId, reason: Reason) {
        self.refused.insert(self.ends(e), reason);
    }

    /// Whether another constraint meets a constraint at either end in one of its triangles.
    fn meets(&self, e: EdgeId) -> [bool; 2] {
        let mesh = &self.layer.mesh;
        let f = mesh.twin(e);
        let is_other = |side: EdgeId| self.is_inside(side.triangle()) && self.is_constraint(side);
        [is_other(e.previous()) || is_other(f.next()), is_other(e.next()) || is_other(f.previous())]
    }

    /// Removes the new free vertices that a constraint sees inside of its diametral circle. Gives the constraint, whose triangles may
    /// be others then.
    fn clear(&mut self, e: EdgeId) -> EdgeId {
        let mut side = e;
        for _ in 0..2 {
            loop {
                let mesh = &self.layer.mesh;
                let tip = mesh.tip(side);
                let ends = [mesh.tail(side), mesh.head(side)];
                if tip.is_ghost() || !self.is_inside(side.triangle()) || !self.known[tip.index()].may_go() {
                    break;
                }
                let [a, b] = ends.map(|v| self.point(v));
                if !delone_predicates::angle(self.point(tip), a, b).is_negative() {
                    break;
                }
                let outside = mesh.twin(side);
                self.layer.remove(tip, &mut ());
                self.count -= 1;
                side = self.layer.mesh.twin(outside);
                let hole = std::mem::take(&mut self.layer.hole);
                hole.last().0.iter().for_each(|t| self.look_at(*t));
                self.layer.hole = hole;
            }
            side = self.layer.mesh.twin(side);
        }
        side
    }

    /// Where a constraint is best split.
    fn where_to_split(&mut self, e: EdgeId, meets: [bool; 2]) -> [f64; 2] {
        let ends = [self.layer.mesh.tail(e), self.layer.mesh.head(e)];
        let on = self.input_of(ends);
        if let Some(tip) = self.tip_near(on, ends) {
            return self.on_ring(tip, on, ends);
        }
        let [a, b] = ends.map(|v| self.point(v));
        let arc = self.arc(ends);
        if meets[0] == meets[1] {
            return arc.map_or_else(|| [0, 1].map(|k| 0.5 * a[k] + 0.5 * b[k]), |arc| arc.middle());
        }
        let length = squared(a, b).sqrt();
        if let Some(arc) = arc {
            return arc.at_distance(meets[1], shell(length));
        }
        let part = shell(length) / length;
        let (from, to) = if meets[0] { (a, b) } else { (b, a) };
        [0, 1].map(|k| from[k] + part * (to[k] - from[k]))
    }

    /// The nearer end of an input constraint at which another one meets it at a very small angle, if the gap between them is
    /// narrower than this part of the constraint is long.
    fn tip_near(&mut self, on: [Place; 2], ends: [Place; 2]) -> Option<Place> {
        let [p, q] = ends.map(|v| self.point(v));
        let length = squared(p, q).sqrt();
        let mut best: Option<(f64, Place)> = None;
        for tip in on {
            let own = self.point(tip);
            let far = squared(own, p).max(squared(own, q)).sqrt();
            let is_narrow = self.tangent_at(tip) * far < length;
            let is_better = best.is_none_or(|(least, other)| {
                far < least || (far == least && lexicographic(own, self.point(other)).is_lt())
            });
            if is_narrow && is_better {
                best = Some((far, tip));
            }
        }
        best.map(|(_, tip)| tip)
    }

    /// The tangent of the smallest angle between constraints with the mesh between them at an input vertex, if it is very small;
    /// infinite otherwise.
    fn tangent_at(&mut self, v: Place) -> f64 {
        if let Some(&known) = self.tips.get(&v) {
            return known;
        }
        let mesh = &self.layer.mesh;
        let fixed = mesh.spokes(v).filter(|&e| self.is_constraint(e)).collect::<Vec<_>>();
        let own = self.point(v);
        let tangent = |k: usize| {
            let pair = [fixed[k], fixed[(k + 1) % fixed.len()]];
            let [p, q] = pair.map(|e| self.point(mesh.head(e)));
            let (p, q) = ([p[0] - own[0], p[1] - own[1]], [q[0] - own[0], q[1] - own[1]]);
            let (dot, cross) = (p[0] * q[0] + p[1] * q[1], p[0] * q[1] - p[1] * q[0]);
            let is_tip =
                dot > 0.0 && cross >= 0.0 && cross < NARROW * dot && self.is_inside(pair[0].triangle());
            if is_tip { cross / dot } else { f64::INFINITY }
        };
        let pairs = if fixed.len() > 1 { fixed.len() } else { 0 };
        let least = (0..pairs).map(tangent).fold(f64::INFINITY, f64::min);
        self.tips.insert(v, least);
        least
    }

    /// Where a constraint is split near a small angle: at the roundest distance from its tip in the middle third. So the vertices
    /// on both sides are at the same distances, and the triangles between them are left alone; otherwise they would be as small as
    /// the gap is narrow.
    fn on_ring(&self, tip: Place, on: [Place; 2], ends: [Place; 2]) -> [f64; 2] {
        let from = self.point(tip);
        let [mut near, mut far] = ends.map(|v| squared(from, self.point(v)).sqrt());
        if near > far {
            (near, far) = (far, near);
        }
        let third = (far - near) / 3.0;
        let (low, high) = (near + third, far - third);
        let mut step = power_below(far);
        while step > 0.0 && (high / step).floor() * step <= low {
            step *= 0.5;
        }
        let ring = (high / step).floor() * step;
        if let Some(arc) = self.arc(on) {
            return arc.at_distance(on[1] == tip, ring);
        }
        let other = self.point(if on[0] == tip { on[1] } else { on[0] });
        let part = ring / squared(from, other).sqrt();
        [0, 1].map(|k| from[k] + part * (other[k] - from[k]))
    }

    /// Whether a point can split a constraint: it is strictly inside of the triangle that it is in, and seen from the far corner
    /// of the other one where the mesh is there too. Outside of the mesh there may be what is as thin as a rounding error.
    pub(super) fn is_clear(&self, e: EdgeId, q: [f64; 2]) -> bool {
        let mesh = &self.layer.mesh;
        let [a, b] = [mesh.tail(e), mesh.head(e)].map(|v| self.point(v));
        let is_between = |k: usize| q[k] >= a[k].min(b[k]) && q[k] <= a[k].max(b[k]);
        let is_arc = self.arc(self.ends(e)).is_some();
        let is_beside = if is_arc { angle(q, a, b).is_negative() } else { is_between(0) && is_between(1) };
        if !is_beside || q == a || q == b {
            return false;
        }
        let is_left_of =
            |e: EdgeId| orient2d(self.point(mesh.tail(e)), self.point(mesh.head(e)), q).is_positive();
        let is_strict = |side: EdgeId| {
            mesh.is_ghost(side.triangle()) || (is_left_of(side.next()) && is_left_of(side.previous()))
        };
        // Of an arc, the triangle on the other side stays.
        let is_strict_or_outside =
            |side: EdgeId| is_arc || !self.is_inside(side.triangle()) || is_strict(side);
        let f = mesh.twin(e);
        match orient2d(a, b, q) {
            Sign::Positive => is_strict(e) && is_strict_or_outside(f),
            Sign::Zero => is_strict(e) && is_strict(f),
            Sign::Negative => is_strict(f) && is_strict_or_outside(e),
        }
    }

    /// Makes a point the vertex that splits a constraint, unless it is too near to others for a vertex that nobody asked for. Gives
    /// the vertex.
    fn insert_on(&mut self, e: EdgeId, q: [f64; 2], is_asked_for: bool) -> Option<Place> {
        let near = self.tips_near(e).map(|tip| self.known[tip.index()].scale).fold(f64::INFINITY, f64::min);
        let mesh = &mut self.layer.mesh;
        let ends = [mesh.tail(e), mesh.head(e)];
        let domains = [e, mesh.twin(e)].map(|e| mesh.domain(e.triangle()));
        let tips = [e, mesh.twin(e)].map(|e| mesh.tip(e));
        let seed = self.triangle_of(e, q);
        let layer = &mut *self.layer;
        layer.mesh.set_fixed(e, false);
        layer.cavity.dig(&mut layer.mesh, &layer.points, q, seed);
        let on = self.input_of(ends);
        let (nearest, square) = self.nearest(q);
        let wanted = domains.map(|domain| self.rules.size_at(q, domain));
        let scale = wanted.into_iter().fold(self.scale_on(on, nearest, square, q).min(near), f64::min);
        let scale = if is_asked_for { scale.min(square.sqrt()) } else { scale };
        if let Some(reason) = self.why_too_near(square, scale) {
            self.abandon();
            self.layer.mesh.set_fixed(e, true);
            self.refuse(e, reason);
            return None;
        }
        let v = self.layer.place_for(Spot::Triangle(seed), q);
        self.fill(v);
        self.note_vertex(v, Known { on, scale });
        self.known[nearest.index()].scale = self.known[nearest.index()].scale.min(scale);
        debug_assert!(tips.iter().all(|tip| tip.is_ghost() || self.layer.mesh.is_vertex(*tip)));
        self.part(v, ends, domains);
        Some(v)
    }

    /// A triangle that the point beside an edge is in, or beyond the hull edge of.
    pub(super) fn triangle_of(&self, e: EdgeId, q: [f64; 2]) -> TriangleId {
        let mesh = &self.layer.mesh;
        let side = orient2d(self.point(mesh.tail(e)), self.point(mesh.head(e)), q);
        let (left, right) = (e.triangle(), mesh.twin(e).triangle());
        if side.is_positive() || (side.is_zero() && !mesh.is_ghost(left)) { left } else { right }
    }

    /// The input constraint that an edge with these ends is of.
    pub(super) fn input_of(&self, ends: [Place; 2]) -> [Place; 2] {
        let known = ends.map(|v| self.known[v.index()]);
        known.into_iter().find(|known| !known.is_input() && !known.is_free()).map_or(ends, |known| known.on)
    }

    /// The scale of a new vertex on an input constraint; see `mesher`.
    fn scale_on(&self, on: [Place; 2], nearest: Place, square: f64, q: [f64; 2]) -> f64 {
        let known = self.known[nearest.index()];
        if on.contains(&nearest) || known.is_free() {
            return known.scale;
        }
        let is_feature = if known.is_input() {
            true
        } else {
            // Beside a small input angle, but not at its very tip.
            shared(known.on, on).is_some_and(|o| {
                let apart = squared(q, self.point(o));
                !Self::is_cascade(apart, self.known[o.index()].scale)
            })
        };
        if !is_feature {
            return known.scale;
        }
        let height = squared_height(self.point(nearest), on.map(|v| self.point(v)));
        known.scale.min(height.min(square).sqrt())
    }

    /// Makes both halves of a constraint with a new vertex constraints, and puts what is on either side into its domain.
    fn part(&mut self, v: Place, ends: [Place; 2], domains: [usize; 2]) {
        let mesh = &mut self.layer.mesh;
        let towards = |end: Place| mesh.spokes(v).find(|&e| mesh.head(e) == end);
        let (Some(to_a), Some(to_b)) = (towards(ends[0]), towards(ends[1])) else {
            debug_assert!(false, "a new vertex sees both ends");
            return;
        };
        // From the second end counter-clockwise to the first is the left side.
        for (from, to, domain) in [(to_b, to_a, domains[0]), (to_a, to_b, domains[1])] {
            let mut spoke = from;
            while spoke != to {
                let t = spoke.triangle();
                let domain = if mesh.is_ghost(t) { 0 } else { domain };
                mesh.set_domain(t, domain);
                spoke = mesh.spin(spoke);
            }
        }
        mesh.set_fixed(to_a, true);
        mesh.set_fixed(to_b, true);
    }

    /// Looks at the constraints that end at a new vertex, or that it may be too near to.
    fn look_at_constraints_around(&mut self, v: Place) {
        let first = self.layer.mesh.incident[v.index()];
        let mut spoke = first;
        loop {
            for e in [spoke, spoke.next()] {
                if self.is_constraint(e) {
                    self.look_at_constraint(e);
                }
            }
            spoke = self.layer.mesh.spin(spoke);
            if spoke == first {
                return;
            }
        }
    }
}

/// The tangent of what counts as a very small angle: five degrees.
const NARROW: f64 = 0.0875;

/// The power of two that splits a length most evenly.
fn shell(length: f64) -> f64 {
    let power = power_below(length);
    if length < 1.5 * power { 0.5 * power } else { power }
}

/// The neighbors of a point among the numbers, in lexicographic order.
#[cold]
fn around(q: [f64; 2]) -> Vec<[f64; 2]> {
    let near = |x: f64| [x.next_down(), x, x.next_up()];
    let mut others: Vec<[f64; 2]> = near(q[0]).into_iter().flat_map(|x| near(q[1]).map(|y| [x, y])).collect();
    others.retain(|&p| p != q);
    sorting::by(&mut others, |&p, &r| lexicographic(p, r));
    others
}

#[cfg(test)]
mod tests {
    use super::shell;

    /// Of all lengths, those below the least number with all its digits too.
    #[test]
    fn shells_part_lengths_evenly() {
        for unit in [1.0, f64::MIN_POSITIVE, f64::from_bits(1 << 20), 2.0_f64.powi(1000)] {
            for (length, expected) in
                [(1.0, 0.5), (1.25, 0.5), (1.5, 1.0), (2.0, 1.0), (2.5, 1.0), (3.0, 2.0)]
            {
                assert_eq!(shell(length * unit), expected * unit, "{length} of {unit:e}");
            }
        }
    }
}
