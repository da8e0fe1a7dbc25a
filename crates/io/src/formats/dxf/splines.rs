//! Splines and ellipses, as arcs of circles: two for each piece, with common tangents.
//!
//! A piece is halved until the arcs are within a part of the extent of the whole curve. Arcs have the points and the tangents of the curve at
//! the ends of pieces.
//!
//! Source: Bolton, "Biarc curves", Computer-Aided Design 1975; points of splines by de Boor's algorithm ("On calculating with B-splines", J.
//! Approx. Theory 1972).

use delone_predicates::hypotenuse;

/// The largest distance of arcs from a curve, as a part of its extent: a quarter of an ellipse is eight arcs or fewer.
const FARTHEST_ARC: f64 = 1e-4;
/// The least bulge of an arc: what rises over its chord by less than half of a hundred-millionth of it is a line.
const LEAST_BULGE: f64 = 1e-8;
/// Halvings of a piece at most, so that memory stays in proportion to the file: 128 pieces are within a millionth of any smooth curve, and what is
/// still far has a corner, or coordinates without digits for it.
const HALVINGS: usize = 7;

/// Parameters of an ellipse that differ from a whole turn by less are one: files have six digits and more.
pub(super) const WHOLE_TURN: std::ops::Range<f64> = std::f64::consts::TAU - 1e-5..f64::INFINITY;

/// A vertex, and the bulge of the arc to the next one.
pub(super) type Vertex = ([f64; 2], f64);

/// Points of a curve, with directions along it, by a parameter.
type Curve<'a> = &'a dyn Fn(f64) -> ([f64; 2], [f64; 2]);

/// An ellipse: the center, half of the longer axis, half of the shorter one.
pub(super) struct Ellipse {
    pub(super) center: [f64; 2],
    pub(super) axes: [[f64; 2]; 2],
}

impl Ellipse {
    /// The arcs between two parameters in radians; the last vertex has no arc.
    pub(super) fn arcs(&self, [first, last]: [f64; 2]) -> Vec<Vertex> {
        let [a, b] = self.axes;
        let at = |t: f64| {
            let (sine, cosine) = libm::sincos(t);
            let sum = |p: f64, q: f64| [0, 1].map(|k| p * a[k] + q * b[k]);
            let around = sum(cosine, sine);
            ([self.center[0] + around[0], self.center[1] + around[1]], sum(-sine, cosine))
        };
        let extent = hypotenuse(a[0], a[1]);
        let mut vertices = Vec::new();
        for k in 0..4 {
            let part = |k: i32| first + (last - first) * (f64::from(k) / 4.0);
            halve(&at, [part(k), part(k + 1)], FARTHEST_ARC * extent, HALVINGS, &mut vertices);
        }
        vertices.push((at(last).0, 0.0));
        vertices
    }
}

/// A rational B-spline in the plane.
pub(super) struct Spline {
    pub(super) degree: usize,
    pub(super) knots: Vec<f64>,
    /// Control points, each with its weight.
    pub(super) points: Vec<([f64; 2], f64)>,
}

impl Spline {
    /// Its arcs; the last vertex has no arc. What is wrong, if it is no spline.
    pub(super) fn arcs(&self) -> Result<Vec<Vertex>, &'static str> {
        let Self { degree, knots, points } = self;
        let is_finite =
            knots.iter().chain(points.iter().flat_map(|(p, w)| p.iter().chain([w]))).all(|x| x.is_finite());
        if !(1..=25).contains(degree) || points.len() <= *degree || knots.len() != points.len() + degree + 1 {
            return Err("whose knots do not fit");
        }
        if !is_finite
            || knots.windows(2).any(|pair| pair[0] > pair[1])
            || points.iter().any(|(_, w)| *w <= 0.0)
        {
            return Err("of numbers that are none");
        }
        let range = |k: usize| {
            let all = points.iter().map(|(p, _)| p[k]);
            all.clone().fold(f64::NEG_INFINITY, f64::max) - all.fold(f64::INFINITY, f64::min)
        };
        let extent = range(0).max(range(1));
        let mut vertices = Vec::new();
        let mut end = points[0].0;
        for span in *degree..points.len() {
            let ends = [knots[span], knots[span + 1]];
            if ends[0] < ends[1] {
                let at = |t: f64| self.at(span, t);
                halve(&at, ends, FARTHEST_ARC * extent, HALVINGS, &mut vertices);
                end = at(ends[1]).0;
            }
        }
        vertices.push((end, 0.0));
        // With knots that are there often enough it ends in control points, which other lines may meet.
        let (last, count) = (vertices.len() - 1, degree + 1);
        let are_equal = |knots: &[f64]| knots.iter().all(|knot| *knot == knots[0]);
        if are_equal(&knots[..count]) {
            vertices[0].0 = points[0].0;
        }
        if are_equal(&knots[knots.len() - count..]) {
            vertices[last].0 = points[points.len() - 1].0;
        }
        Ok(vertices)
    }

    /// The point at a parameter between two knots, ends included, and the direction there.
    fn at(&self, span: usize, t: f64) -> ([f64; 2], [f64; 2]) {
        let (degree, knots) = (self.degree, &self.knots);
        let mut d: Vec<[f64; 3]> =
            self.points[span - degree..=span].iter().map(|(p, w)| [w * p[0], w * p[1], *w]).collect();
        let mut slope = [0.0; 3];
        for level in 1..=degree {
            for j in (level..=degree).rev() {
                let i = j + span - degree;
                let (low, high) = (knots[i], knots[i + 1 + degree - level]);
                let part = (t - low) / (high - low);
                if level == degree {
                    slope = [0, 1, 2].map(|k| d[j][k] - d[j - 1][k]);
                }
                d[j] = [0, 1, 2].map(|k| (1.0 - part) * d[j - 1][k] + part * d[j][k]);
            }
        }
        let [x, y, w] = d[degree];
        let point = [x / w, y / w];
        // Of a quotient, times its divisor.
        (point, [0, 1].map(|k| slope[k] - slope[2] * point[k]))
    }
}

/// Adds the arcs of a piece, halved where they are too far from the curve.
fn halve(at: Curve, [from, to]: [f64; 2], farthest: f64, halvings: usize, vertices: &mut Vec<Vertex>) {
    let middle = from.midpoint(to);
    let is_near = |arcs: &[Vertex]| {
        let quarters = [from.midpoint(middle), middle, middle.midpoint(to)];
        quarters.into_iter().all(|t| distance(at(t).0, arcs, at(to).0) <= farthest)
    };
    let arcs = biarc(at(from), at(to));
    if halvings > 0 && middle > from && middle < to && !is_near(&arcs) {
        halve(at, [from, middle], farthest, halvings - 1, vertices);
        halve(at, [middle, to], farthest, halvings - 1, vertices);
    } else {
        vertices.extend(arcs);
    }
}

/// Two arcs with these ends and tangents there; a line if there are none.
fn biarc((p, u): ([f64; 2], [f64; 2]), (q, v): ([f64; 2], [f64; 2])) -> Vec<Vertex> {
    let unit = |w: [f64; 2]| w.map(|x| x / hypotenuse(w[0], w[1]));
    let (u, v, w) = (unit(u), unit(v), [q[0] - p[0], q[1] - p[1]]);
    let dot = |a: [f64; 2], b: [f64; 2]| a[0] * b[0] + a[1] * b[1];
    let cross = |a: [f64; 2], b: [f64; 2]| a[0] * b[1] - a[1] * b[0];
    // Both ends are as far from the corners of the tangents.
    let (along, turn) = (dot(w, u) + dot(w, v), 2.0 * (1.0 - dot(u, v)));
    let reach = dot(w, w) / (along + (along * along + turn * dot(w, w)).sqrt());
    let joint = [0, 1].map(|k| p[k].midpoint(q[k]) + 0.5 * reach * (u[k] - v[k]));
    let [first, second] = [[joint[0] - p[0], joint[1] - p[1]], [q[0] - joint[0], q[1] - joint[1]]];
    let bulges = [(u, first), (second, v)].map(|(a, b)| {
        let lengths = hypotenuse(a[0], a[1]) * hypotenuse(b[0], b[1]);
        let bulge = cross(a, b) / (lengths + dot(a, b));
        if bulge.abs() < LEAST_BULGE { 0.0 } else { bulge }
    });
    if joint.iter().chain(&bulges).all(|x| x.is_finite()) {
        vec![(p, bulges[0]), (joint, bulges[1])]
    } else {
        vec![(p, 0.0)]
    }
}

/// The distance of a point from the circle of the nearest of some arcs, the last of which ends at a point.
fn distance(p: [f64; 2], arcs: &[Vertex], end: [f64; 2]) -> f64 {
    let ends = arcs.iter().skip(1).map(|arc| arc.0).chain([end]);
    let from_arc = |(&(a, bulge), b): (&Vertex, [f64; 2])| {
        let (chord, own) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
        let length = hypotenuse(chord[0], chord[1]);
        // Along the chord and to its left, as parts of it.
        let x = (own[0] * chord[0] + own[1] * chord[1]) / (length * length) - 0.5;
        let y = (chord[0] * own[1] - chord[1] * own[0]) / (length * length);
        if !(-0.51..=0.51).contains(&x) {
            return f64::INFINITY;
        }
        // The circle through both ends has its center (1/bulge - bulge) / 4 to the left.
        let off = bulge * (x * x + y * y - 0.25) - y * 0.5 * (1.0 - bulge * bulge);
        length * (2.0 * off / (1.0 + bulge * bulge)).abs()
    };
    arcs.iter().zip(ends).map(from_arc).fold(f64::INFINITY, f64::min)
}
