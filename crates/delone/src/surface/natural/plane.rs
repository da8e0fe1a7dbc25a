//! The plane: an edge has of its dual, in a triangle, half of the cotangent of the angle opposite to it.
//!
//! Neighbours are numbered counter-clockwise from the lexicographically least one on, so that everything is summed in an order that
//! depends on the points alone.

use super::super::real::{Double, Real};
use super::{GOOD, Measure, apart, normalize, scale};
use crate::around::Ring;
use crate::ids::VertexId;

/// The neighbours of a point, in buffers that are kept.
#[derive(Clone, Debug, Default)]
pub(super) struct Cell {
    corners: Vec<(VertexId, [f64; 2])>,
    /// The number of each corner of the ring.
    numbers: Vec<u32>,
    /// Each triangle of the cavity from its least number on.
    cavity: Vec<[u32; 3]>,
    plain: Local<f64>,
    double: Local<Double>,
}

/// Coordinates relative to the point, and what was summed for each neighbour.
#[derive(Clone, Debug, Default)]
struct Local<R> {
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
        self.number(ring, measure);
        let Self { corners, cavity, plain, double, .. } = self;
        let size = |p: [f64; 2]| apart(p[0], q[0]).max(apart(p[1], q[1]));
        let size = corners.iter().fold(0.0, |most, corner| size(corner.1).max(most));
        let scale = scale(size);
        plain.sum(q, corners, scale, cavity, measure);
        weights.clear();
        let total: f64 = plain.shares.iter().sum();
        // In units of the last place of f64, whose half is 2^-53.
        if total > 0.0 && plain.doubt * f64::EPSILON <= GOOD * total {
            weights.extend(corners.iter().zip(&plain.shares).map(|(corner, &share)| (corner.0, share)));
        } else {
            double.sum(q, corners, scale, cavity, measure);
            let shares = double.shares.iter().map(|share| share.value());
            let total: f64 = shares.clone().sum();
            let is_good = double.doubt * f64::EPSILON * f64::EPSILON <= GOOD * total;
            if !is_good {
                return false;
            }
            weights.extend(corners.iter().zip(shares).map(|(corner, share)| (corner.0, share)));
        }
        normalize(weights)
    }

    /// Numbers neighbours, and sorts the cavity.
    fn number(&mut self, ring: &Ring, measure: Measure) {
        let Self { corners, numbers, cavity, .. } = self;
        let (mut start, mut least) = (0, [f64::INFINITY; 2]);
        for (k, &i) in ring.order.iter().enumerate() {
            let (_, p) = ring.corners[i as usize];
            if p[0] < least[0] || (p[0] == least[0] && p[1] < least[1]) {
                (start, least) = (k, p);
            }
        }
        let (after, before) = ring.order.split_at(start);
        corners.clear();
        numbers.resize(ring.corners.len().max(numbers.len()), 0);
        for &i in before.iter().chain(after) {
            numbers[i as usize] = corners.len() as u32;
            corners.push(ring.corners[i as usize]);
        }
        cavity.clear();
        if measure == Measure::Laplace {
            return;
        }
        cavity.extend(ring.triangles.iter().map(|t| {
            let [i, j, k] = t.map(|i| numbers[i as usize]);
            if i < j && i < k {
                [i, j, k]
            } else if j < k {
                [j, k, i]
            } else {
                [k, i, j]
            }
        }));
        // No other triangle has the same first edge.
        cavity.sort_unstable_by_key(|&[i, j, _]| u64::from(i) << 32 | u64::from(j));
    }
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
        corners: &[(VertexId, [f64; 2])],
        [before, after]: [f64; 2],
        cavity: &[[u32; 3]],
        measure: Measure,
    ) {
        let relative = |p: [f64; 2]| [0, 1].map(|k| R::difference(p[k] * before, q[k] * before, after));
        self.at.clear();
        self.at.extend(corners.iter().map(|corner| relative(corner.1)));
        self.shares.clear();
        self.doubt = 0.0;
        match measure {
            Measure::Laplace => self.around(|local, a, b| local.facets(a, b)),
            Measure::Sibson => {
                self.around(|local, a, b| local.new_areas(a, b));
                cavity.iter().for_each(|&corners| self.old_areas(corners));
            }
        }
    }

    /// Adds what each triangle at the point, between two neighbours, has for both.
    #[inline]
    fn around(&mut self, of_edge: impl Fn(&mut Self, [R; 2], [R; 2]) -> [R; 2]) {
        let at = std::mem::take(&mut self.at);
        if let (Some(&first), Some(&last)) = (at.first(), at.last()) {
            let [of_last, of_first] = of_edge(self, last, first);
            let (mut carried, mut before) = (of_first, first);
            for &after in &at[1..] {
                let [of_before, of_after] = of_edge(self, before, after);
                self.shares.push(carried + of_before);
                (carried, before) = (of_after, after);
            }
            self.shares.push(carried + of_last);
        }
        self.at = at;
    }

    /// The cotangents opposite to the sides at the point.
    #[inline]
    fn facets(&mut self, a: [R; 2], b: [R; 2]) -> [R; 2] {
        let ([ax, ay], [bx, by]) = (a, b);
        let (dx, dy) = (bx - ax, by - ay);
        let over = R::one() / (ax * by - ay * bx);
        // Times the area, at each end.
        let (at_a, at_b) = (R::default() - (ax * dx + ay * dy), bx * dx + by * dy);
        let squares = ((ax * ax + ay * ay) + (bx * bx + by * by)).value();
        let size = at_a.value().abs() + at_b.value().abs();
        self.doubt += size * over.value().abs() * doubt(squares, over.value());
        [at_b * over, at_a * over]
    }

    /// What neighbours have of the triangle between two of them and the point: to be taken away.
    #[inline]
    fn new_areas(&mut self, a: [R; 2], b: [R; 2]) -> [R; 2] {
        let ([ax, ay], [bx, by]) = (a, b);
        let (dx, dy) = (bx - ax, by - ay);
        let over = R::one() / (ax * by - ay * bx);
        let (at_a, at_b) = (R::default() - (ax * dx + ay * dy), bx * dx + by * dy);
        let (aa, bb) = (ax * ax + ay * ay, bx * bx + by * by);
        let between = R::default() - (dx * dx + dy * dy) * (ax * bx + ay * by);
        let (of_a, size_a) = both(between, R::default() - aa * at_b);
        let (of_b, size_b) = both(between, R::default() - bb * at_a);
        self.doubt += (size_a + size_b) * over.value().abs() * doubt((aa + bb).value(), over.value());
        [of_a * over, of_b * over]
    }

    /// Adds what the corners of a triangle of the cavity have of it.
    #[inline]
    fn old_areas(&mut self, corners: [u32; 3]) {
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
