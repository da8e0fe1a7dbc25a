//! Rounds of relaxation: each free vertex goes to where the triangles around it are best.
//!
//! For a triangle with squared sides of sum S and area A, S / (4 sqrt 3 A) is one over its quality: 1 if it is equilateral. With a part of
//! A0 / A, where A0 is the area that sizes ask for, the sum over a star is convex where all areas are positive, so steps of Newton's method
//! lead to its least value. A vertex moves only if its triangles stay positive, which is decided exactly; after each round edges are flipped
//! until all is constrained Delaunay again.
//!
//! Source: the measure is that of Bank, "PLTMG: a software package for solving elliptic partial differential equations", SIAM 1998; the
//! even areas are ours.
//!
//! Cost: O(1) for each vertex and round.

use delone_predicates::{lexicographic, orient2d};

use super::Frontal;
use crate::error::Error;
use crate::ids::{EdgeId, Place};
use crate::sorting;

/// How a round weighs triangles.
#[derive(Clone, Copy, Debug)]
pub(super) struct Way {
    /// The weight of areas as sizes ask for.
    pub(super) evenness: f64,
    /// Whether squares are summed, so that the worst triangles count most.
    pub(super) squares: bool,
    /// Whether no smallest angle may fall below what was asked for.
    pub(super) keeps_angles: bool,
}

/// Steps of Newton's method for a vertex and round, and halvings of a step that makes things worse.
const NEWTON_STEPS: usize = 2;
const HALVINGS: usize = 3;
/// A vertex moves at most by this part of its size in a round.
const FARTHEST_MOVE: f64 = 0.3;
/// It keeps this part of its distance from constraints in a round.
const HEIGHT_KEPT: f64 = 0.6;
/// The area of an equilateral triangle with sides of length one.
const EQUILATERAL_AREA: f64 = 0.433;
/// A square of sides, summed, is so many times the area of an equilateral triangle: 4 sqrt 3.
const SQUARES_OF_AREA: f64 = 6.928_203_230_275_509;

/// A triangle of a star: its other corners, and its area as wanted, with its weight.
#[derive(Clone, Copy)]
struct Blade {
    a: [f64; 2],
    b: [f64; 2],
    area: f64,
    is_fixed: bool,
}

/// A sum with its gradient and the entries xx, xy and yy of its Hessian.
#[derive(Clone, Copy, Default)]
struct Sum {
    value: f64,
    slope: [f64; 2],
    curve: [f64; 3],
}

impl Frontal<'_, '_> {
    /// One round, along a curve through the plane.
    pub(super) fn relax(&mut self, way: &Way) -> Result<(), Error> {
        self.mesher.rules.go_on(self.mesher.count)?;
        let mut free: Vec<Place> = self.mesher.alive();
        free.retain(|p| self.mesher.known[p.index()].is_free());
        let key = |p: &Place| self.mesher.queue.along_curve(self.point(*p));
        let mut order: Vec<(u64, Place)> = free.iter().map(|p| (key(p), *p)).collect();
        order.sort_unstable_by_key(|entry| entry.0);
        let ties = order.chunk_by_mut(|one, other| one.0 == other.0).filter(|ties| ties.len() > 1);
        ties.for_each(|ties| sorting::by(ties, |p, q| lexicographic(self.point(p.1), self.point(q.1))));
        let (mut star, mut blades) = (Vec::new(), Vec::new());
        for (_, p) in order {
            self.improve(p, way, &mut star, &mut blades);
        }
        let layer = &mut *self.mesher.layer;
        let edges = layer.mesh.triangles().flat_map(|t| [0, 1, 2].map(|k| t.edge(k)));
        let free = edges.filter(|&e| e < layer.mesh.twin(e)).collect();
        layer.legalize(free);
        Ok(())
    }

    /// Moves a vertex to the best place.
    fn improve(&mut self, p: Place, way: &Way, star: &mut Vec<EdgeId>, blades: &mut Vec<Blade>) {
        let mesh = &self.mesher.layer.mesh;
        star.clear();
        star.extend(mesh.spokes(p));
        self.mesher.turn_to_least(star);
        blades.clear();
        let size = self.sizes.at(p);
        blades.extend(star.iter().map(|&e| {
            let [a, b] = [mesh.head(e), mesh.tip(e)];
            let size = (size + (self.sizes.at(a) + self.sizes.at(b))) / 3.0;
            let area = EQUILATERAL_AREA * size * size * way.evenness;
            Blade { a: self.point(a), b: self.point(b), area, is_fixed: mesh.is_fixed(e.next()) }
        }));
        let own = self.point(p);
        let goal = best(own, blades, way.squares);
        let step = [goal[0] - own[0], goal[1] - own[1]];
        let length = (step[0] * step[0] + step[1] * step[1]).sqrt();
        let part = if length > FARTHEST_MOVE * size { FARTHEST_MOVE * size / length } else { 1.0 };
        let q = [0, 1].map(|k| own[k] + part * step[k]);
        let is_allowed = blades.iter().all(|blade| blade.allows(own, q));
        if q == own || !is_allowed || !self.mesher.keeps_apart(star, q) {
            return;
        }
        if !way.keeps_angles {
            self.mesher.layer.points[p.index()] = q;
            return;
        }
        let before = self.mesher.sharpness(star);
        let worst = before.0.max(self.mesher.rules.squared_cosine.min(1.0));
        self.mesher.layer.points[p.index()] = q;
        if self.mesher.sharpness(star).0 > worst || !self.mesher.is_small(star) {
            self.mesher.layer.points[p.index()] = own;
        }
    }
}

/// The place of least sum, as far as steps lead there.
fn best(own: [f64; 2], blades: &[Blade], squares: bool) -> [f64; 2] {
    let Some(mut sum) = sum_at(own, blades, squares) else { return own };
    let mut q = own;
    for _ in 0..NEWTON_STEPS {
        let [xx, xy, yy] = sum.curve;
        let determinant = xx * yy - xy * xy;
        if determinant.is_nan() || determinant <= 0.0 {
            break;
        }
        let [x, y] = sum.slope;
        let step = [(xy * y - yy * x) / determinant, (xy * x - xx * y) / determinant];
        let mut part = 1.0;
        let better = (0..=HALVINGS).find_map(|_| {
            let at = [0, 1].map(|k| q[k] + part * step[k]);
            part *= 0.5;
            sum_at(at, blades, squares).filter(|next| next.value < sum.value).map(|next| (at, next))
        });
        let Some(next) = better else { break };
        (q, sum) = next;
    }
    q
}

fn sum_at(q: [f64; 2], blades: &[Blade], squares: bool) -> Option<Sum> {
    let mut sum = Sum::default();
    for blade in blades {
        sum.add(&blade.measure(q)?, squares);
    }
    Some(sum)
}

impl Sum {
    /// Adds a term, or its square.
    fn add(&mut self, term: &Self, squares: bool) {
        let Self { value, slope: [x, y], curve: [xx, xy, yy] } = *term;
        if squares {
            self.value += value * value;
            self.slope = [self.slope[0] + 2.0 * value * x, self.slope[1] + 2.0 * value * y];
            let more = [x * x + value * xx, x * y + value * xy, y * y + value * yy];
            self.curve = [0, 1, 2].map(|k| self.curve[k] + 2.0 * more[k]);
        } else {
            self.value += value;
            self.slope = [self.slope[0] + x, self.slope[1] + y];
            self.curve = [self.curve[0] + xx, self.curve[1] + xy, self.curve[2] + yy];
        }
    }
}

impl Blade {
    /// One over the quality of the triangle with a third corner, and the wanted area over its own; nothing if it is not positive.
    fn measure(&self, q: [f64; 2]) -> Option<Sum> {
        let (u, v) = ([self.a[0] - q[0], self.a[1] - q[1]], [self.b[0] - q[0], self.b[1] - q[1]]);
        let w = [self.b[0] - self.a[0], self.b[1] - self.a[1]];
        let area = 0.5 * (u[0] * v[1] - u[1] * v[0]);
        if area.is_nan() || area <= 0.0 {
            return None;
        }
        let dot = |v: [f64; 2]| v[0] * v[0] + v[1] * v[1];
        let inverse = 1.0 / area;
        let value = ((dot(u) + dot(v) + dot(w)) / SQUARES_OF_AREA + self.area) * inverse;
        // Gradients of the numerator and of the area.
        let n = [0, 1].map(|k| -2.0 * (u[k] + v[k]) / SQUARES_OF_AREA);
        let d = [-0.5 * w[1], 0.5 * w[0]];
        let slope = [0, 1].map(|k| (n[k] - value * d[k]) * inverse);
        let curve = |j: usize, k: usize| {
            let own = if j == k { 4.0 / SQUARES_OF_AREA } else { 0.0 };
            (own - (slope[j] * d[k] + slope[k] * d[j])) * inverse
        };
        Some(Sum { value, slope, curve: [curve(0, 0), curve(0, 1), curve(1, 1)] })
    }

    /// Whether a vertex may move: the triangle stays positive, and if its far side is a constraint, most of its height is left.
    fn allows(&self, own: [f64; 2], q: [f64; 2]) -> bool {
        let height = |p: [f64; 2]| {
            let (u, w) =
                ([self.b[0] - self.a[0], self.b[1] - self.a[1]], [p[0] - self.a[0], p[1] - self.a[1]]);
            u[0] * w[1] - u[1] * w[0]
        };
        orient2d(self.a, self.b, q).is_positive() && (!self.is_fixed || height(q) > HEIGHT_KEPT * height(own))
    }
}
