//! Smoothing: free new vertices move towards where their triangles are best.
//!
//! The goal is the mean of the circumcenters around a vertex, by area: the optimum for the triangles that there are (Chen & Xu,
//! "Optimal Delaunay triangulations", J. Comput. Math. 2004). A vertex goes there, or half of the way, if its star stays strictly
//! positive, which is decided exactly, its smallest angles grow in the mean, none falls below what was asked for or was there before,
//! and nothing becomes too large or too near to a constraint; then edges are flipped until all is constrained Delaunay again, which
//! makes the smallest of all angles no smaller.
//!
//! Cost: O(1) for each vertex and round, as long as degrees are.

use delone_predicates::{circumcenter, orient2d};

use super::mesher::Mesher;
use super::shape::Shape;
use crate::ids::{EdgeId, Place};

impl Mesher<'_> {
    /// One round, in the order in which vertices came.
    pub(super) fn smooth(&mut self) {
        for v in self.alive() {
            if self.known[v.index()].is_free() {
                self.improve(v);
            }
        }
    }

    fn improve(&mut self, v: Place) {
        let own = self.point(v);
        let mut star: Vec<EdgeId> = self.layer.mesh.spokes(v).collect();
        self.turn_to_least(&mut star);
        let Some(goal) = self.goal(&star) else { return };
        let (worst, sum) = self.sharpness(&star);
        let worst = worst.max(self.rules.squared_cosine.min(1.0));
        for part in [1.0, 0.5] {
            let q = [0, 1].map(|k| own[k] + part * (goal[k] - own[k]));
            if q == own || !self.is_room(&star, q) || !self.keeps_apart(&star, q) {
                continue;
            }
            self.layer.points[v.index()] = q;
            let now = self.sharpness(&star);
            if now.0 <= worst && now.1 < sum && self.is_small(&star) {
                let links = star.iter().map(|e| e.next());
                self.layer.legalize(star.iter().copied().chain(links).collect());
                return;
            }
            self.layer.points[v.index()] = own;
        }
    }

    /// The mean of the circumcenters of a star, by area.
    fn goal(&self, star: &[EdgeId]) -> Option<[f64; 2]> {
        let (mut sum, mut areas) = ([0.0; 2], 0.0);
        for e in star {
            let shape = Shape::of(self.layer, e.triangle())?;
            let [a, b, c] = shape.points;
            let (center, area) = (circumcenter(a, b, c)?, shape.area());
            sum = [0, 1].map(|k| sum[k] + area * center[k]);
            areas += area;
        }
        Some(sum.map(|x| x / areas)).filter(|goal| goal.iter().all(|x| x.is_finite()))
    }

    /// Whether a point sees all of the border of a star, strictly, and is not too near to constraints on it.
    fn is_room(&self, star: &[EdgeId], q: [f64; 2]) -> bool {
        let mesh = &self.layer.mesh;
        star.iter().all(|e| {
            let link = e.next();
            let ends = [mesh.tail(link), mesh.head(link)].map(|v| self.point(v));
            orient2d(ends[0], ends[1], q).is_positive()
                && !(self.is_constraint(link) && self.is_too_near(q, ends))
        })
    }

    /// The largest squared cosine of a smallest angle in a star, and the sum of all of them.
    pub(super) fn sharpness(&self, star: &[EdgeId]) -> (f64, f64) {
        let shapes = star.iter().map(|e| Shape::of(self.layer, e.triangle()));
        let squares = shapes.map(|shape| shape.map_or(f64::INFINITY, |shape| shape.squared_cosine()));
        squares.fold((0.0, 0.0), |(most, sum), square| (square.max(most), sum + square))
    }

    /// Whether no triangle of a star is larger than it may be.
    pub(super) fn is_small(&self, star: &[EdgeId]) -> bool {
        let mesh = &self.layer.mesh;
        star.iter().map(|e| e.triangle()).all(|t| {
            Shape::of(self.layer, t).is_some_and(|shape| !self.rules.is_large(&shape, mesh.domain(t)))
        })
    }
}
