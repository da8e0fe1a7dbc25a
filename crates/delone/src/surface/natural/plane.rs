//! The plane: an edge has of its dual, in a triangle, half of the cotangent of the angle opposite to it.
//!
//! Neighbors are numbered counter-clockwise from the lexicographically least one on, so that everything is summed in an order that
//! depends on the points alone.

use super::super::real::{Double, Real};
use super::{GOOD, Measure, apart, normalize, scale};
use crate::around::Ring;
use crate::ids::VertexId;

/// The neighbors of a point, in buffers that are kept.
#[derive(Clone, Debug, Default)]
pub(super) struct Cell {
    /// Which corner of the ring each neighbor is.
    order: Vec<u32>,
    /// The number of each corner of the ring.
    numbers: Vec<u32>,
    /// The triangles of the cavity, counter-clockwise from their least numbers on. They are in the order of their middle ones: between
    /// the first and the last neighbor there is a triangle for each, which has it in the middle.
    cavity: Vec<[u32; 3]>,
    plain: Local<f64>,
    double: Local<Double>,
}

/// Coordinates relative to the point, and what was summed for each neighbor.
#[derive(Clone, Debug, Default)]
struct Local<R> {
    /// The first neighbor once more at the end.
    at: Vec<[R; 2]>,
    shares: Vec<R>,
    /// A bound of the errors of all sums, in units of the last place.
    doubt: f64,
}

impl Cell {
    /// As [`super::Cell::weigh`].
    pub(super) fn weigh(
        &mut self,
        ring: &Ring,
        q: [f64; 2],
        measure: Measure,
        weights: &mut Vec<(VertexId, f64)>,
    ) -> bool {
        let size = self.number(ring);
        if measure == Measure::Sibson {
            self.sort(ring);
        }
        let Self { order, cavity, plain, double, .. } = self;
        let points = order.iter().map(|&i| ring.corners_seen[i as usize].end());
        // Mostly nothing has to be scaled.
        let scale = if size > 2f64.powi(-60) && size < 2f64.powi(60) {
            [1.0; 2]
        } else {
            scale_of(points.clone(), q)
        };
        plain.sum(q, points.clone(), scale, cavity, measure);
        weights.clear();
        let vertices = order.iter().map(|&i| ring.vertices[i as usize]);
        let total: f64 = plain.shares.iter().sum();
        // In units of the last place of f64, whose half is 2^-53.
        if total > 0.0 && plain.doubt * f64::EPSILON <= GOOD * total {
            weights.extend(vertices.zip(plain.shares.iter().copied()));
        } else {
            double.sum(q, points, scale, cavity, measure);
            let shares = double.shares.iter().map(|share| share.value());
            let total: f64 = shares.clone().sum();
            let is_good = double.doubt * f64::EPSILON * f64::EPSILON <= GOOD * total;
            if !is_good {
                return false;
            }
            weights.extend(vertices.zip(shares));
        }
        normalize(weights)
    }

    /// Numbers neighbors; says how far the furthest is, about.
    fn number(&mut self, ring: &Ring) -> f64 {
        let Self { order, numbers, .. } = self;
        let (mut start, mut least) = (0, [f64::INFINITY; 2]);
        for (k, &i) in ring.order.iter().enumerate() {
            let p = ring.corners_seen[i as usize].end();
            if p[0] < least[0] || (p[0] == least[0] && p[1] < least[1]) {
                (start, least) = (k, p);
            }
        }
        let (after, before) = ring.order.split_at(start);
        order.clear();
        order.extend_from_slice(before);
        order.extend_from_slice(after);
        numbers.resize(order.len().max(numbers.len()), 0);
        let mut size = 0.0f64;
        for (number, &i) in order.iter().enumerate() {
            numbers[i as usize] = number as u32;
            let [x, y] = ring.corners_seen[i as usize].from_center();
            size = size.max(x.abs()).max(y.abs());
        }
        size
    }

    /// Sorts the cavity.
    fn sort(&mut self, ring: &Ring) {
        let Self { numbers, cavity, .. } = self;
        cavity.resize(ring.triangles.len(), [0; 3]);
        for t in &ring.triangles {
            let [i, j, k] = t.map(|i| numbers[i as usize]);
            let (low, high) = (i.min(j).min(k), i.max(j).max(k));
            let middle = (i ^ j ^ k) ^ (low ^ high);
            cavity[middle as usize - 1] = [low, middle, high];
        }
    }
}

#[cold]
fn scale_of(points: impl Iterator<Item = [f64; 2]>, q: [f64; 2]) -> [f64; 2] {
    scale(points.fold(0.0, |most, p| most.max(apart(p[0], q[0])).max(apart(p[1], q[1]))))
}

/// The error of a quotient in units of the last place of what it is made of, of a triangle with these squared sides and one over twice its
/// area: some rounded operations, and what cancels in the area.
#[inline]
fn doubt(squares: f64, over: f64) -> f64 {
    8.0 + 4.0 * squares * over.abs()
}

/// A sum of two parts, and the sum of their sizes.
#[inline]
fn both<R: Real>(a: R, b: R) -> (R, f64) {
    (a + b, a.value().abs() + b.value().abs())
}

impl<R: Real> Local<R> {
    fn sum(
        &mut self,
        q: [f64; 2],
        points: impl Iterator<Item = [f64; 2]>,
        [before, after]: [f64; 2],
        cavity: &[[u32; 3]],
        measure: Measure,
    ) {
        let relative = |p: [f64; 2]| [0, 1].map(|k| R::difference(p[k] * before, q[k] * before, after));
        self.at.clear();
        self.at.extend(points.map(relative));
        self.at.extend(self.at.first().copied());
        self.doubt = 0.0;
        match measure {
            Measure::Laplace => self.around(facets),
            Measure::Sibson => {
                self.around(new_areas);
                self.old_areas(cavity);
            }
        }
    }

    /// Adds what each triangle at the point, between two neighbors, has for both.
    #[inline]
    fn around(&mut self, of_edge: impl Fn([R; 2], [R; 2]) -> ([R; 2], f64)) {
        let Self { at, shares, doubt } = self;
        let mut carried = R::default();
        shares.clear();
        shares.extend(at.windows(2).map(|pair| {
            let ([of_a, of_b], error) = of_edge(pair[0], pair[1]);
            *doubt += error;
            std::mem::replace(&mut carried, of_b) + of_a
        }));
        if let Some(first) = shares.first_mut() {
            *first += carried;
        }
    }

    /// Adds what the corners of the triangles of the cavity have of them.
    #[inline]
    fn old_areas(&mut self, cavity: &[[u32; 3]]) {
        for &corners in cavity {
            let [a, b, c] = corners.map(|k| self.at[k as usize]);
            // Each side is opposite to its corner.
            let sides = [[c[0] - b[0], c[1] - b[1]], [a[0] - c[0], a[1] - c[1]], [b[0] - a[0], b[1] - a[1]]];
            let over = R::one() / (sides[0][0] * sides[1][1] - sides[0][1] * sides[1][0]);
            let squares = sides.map(|s| s[0] * s[0] + s[1] * s[1]);
            let dot = |s: [R; 2], t: [R; 2]| s[0] * t[0] + s[1] * t[1];
            let [p, q, r] = [(0, 1, 2), (1, 2, 0), (2, 0, 1)]
                .map(|(own, one, other)| R::default() - squares[own] * dot(sides[one], sides[other]));
            for (k, part) in corners.into_iter().zip([q + r, r + p, p + q]) {
                self.shares[k as usize] += part * over;
            }
            // Each of the three is part of two sums.
            let size = 2.0 * (p.value().abs() + q.value().abs() + r.value().abs());
            self.doubt += size * over.value().abs() * doubt((squares[0] + squares[1]).value(), over.value());
        }
    }
}

/// The cotangents opposite to the sides at the point of a triangle between it and two neighbors, and a bound of their errors.
#[inline]
fn facets<R: Real>([ax, ay]: [R; 2], [bx, by]: [R; 2]) -> ([R; 2], f64) {
    let (dx, dy) = (bx - ax, by - ay);
    let over = R::one() / (ax * by - ay * bx);
    // Times the area, at each end.
    let (at_a, at_b) = (R::default() - (ax * dx + ay * dy), bx * dx + by * dy);
    let squares = ((ax * ax + ay * ay) + (bx * bx + by * by)).value();
    let size = at_a.value().abs() + at_b.value().abs();
    ([at_b * over, at_a * over], size * over.value().abs() * doubt(squares, over.value()))
}

/// The parts of the triangle between two neighbors and the point, to be subtracted, and a bound of their errors.
#[inline]
fn new_areas<R: Real>([ax, ay]: [R; 2], [bx, by]: [R; 2]) -> ([R; 2], f64) {
    let (dx, dy) = (bx - ax, by - ay);
    let over = R::one() / (ax * by - ay * bx);
    let (at_a, at_b) = (R::default() - (ax * dx + ay * dy), bx * dx + by * dy);
    let (aa, bb) = (ax * ax + ay * ay, bx * bx + by * by);
    let between = R::default() - (dx * dx + dy * dy) * (ax * bx + ay * by);
    let (of_a, size_a) = both(between, R::default() - aa * at_b);
    let (of_b, size_b) = both(between, R::default() - bb * at_a);
    let error = (size_a + size_b) * over.value().abs() * doubt((aa + bb).value(), over.value());
    ([of_a * over, of_b * over], error)
}
