//! The plane over a triangle, and the worst of what was measured against it.

use std::cmp::Ordering;

use crate::ids::VertexId;
use crate::surface::linear;

/// Below these, areas and slopes, and differences of heights, may have lost more than roundings.
const TINY: f64 = 1e-280;
pub(super) const LOW: f64 = 1e-200;

/// The plane over a triangle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plane {
    origin: [f64; 2],
    height: f64,
    pub(super) slope: [f64; 2],
}

impl Plane {
    /// From the corners in lexicographic order, so that it does not depend on theirs; `None` if its area is not above this part of the square
    /// around its longest side, or beyond what numbers can tell: slopes would amplify roundings.
    #[inline]
    pub(super) fn new(corners: [[f64; 2]; 3], heights: [f64; 3], thinnest: f64) -> Option<Self> {
        let mut c = [(corners[0], heights[0]), (corners[1], heights[1]), (corners[2], heights[2])];
        for (i, j) in [(0, 1), (1, 2), (0, 1)] {
            if c[j].0 < c[i].0 {
                c.swap(i, j);
            }
        }
        Self::of_sorted(c.map(|corner| corner.0), c.map(|corner| corner.1), thinnest)
    }

    /// Makes a plane from corners in any order.
    #[inline]
    pub(super) fn of_sorted([p, q, r]: [[f64; 2]; 3], [z, zq, zr]: [f64; 3], thinnest: f64) -> Option<Self> {
        let [a, b] = [[q[0] - p[0], q[1] - p[1]], [r[0] - p[0], r[1] - p[1]]];
        let (u, v) = (zq - z, zr - z);
        let area = a[0] * b[1] - a[1] * b[0];
        let long = (a[0].abs() + a[1].abs()).max(b[0].abs() + b[1].abs());
        if !(area.abs() > thinnest * long * long && area.abs() > TINY) {
            return None;
        }
        let parts = [u * b[1] - v * a[1], v * a[0] - u * b[0]];
        let slope = parts.map(|part| part / area);
        let is_lost = |k: usize| slope[k].abs() < TINY && parts[k] != 0.0;
        let rise = u.abs().max(v.abs());
        if is_lost(0) || is_lost(1) || (rise < LOW && rise > 0.0) {
            return None;
        }
        slope.iter().all(|x| x.is_finite()).then_some(Self { origin: p, height: z, slope })
    }

    /// The part of the height that a row has.
    #[inline]
    pub(super) fn row(&self, y: f64) -> f64 {
        self.height + self.slope[1] * (y - self.origin[1])
    }

    /// The part of the height that a column has.
    #[inline]
    pub(super) fn along(&self, x: f64) -> f64 {
        self.slope[0] * (x - self.origin[0])
    }

    /// The height at a place.
    #[inline]
    pub(super) fn at(&self, [x, y]: [f64; 2]) -> f64 {
        self.row(y) + self.along(x)
    }

    /// The sum of the sizes of what a height is made of.
    #[inline]
    pub(super) fn size(&self, [x, y]: [f64; 2]) -> f64 {
        self.height.abs() + self.along(x).abs() + (self.slope[1] * (y - self.origin[1])).abs()
    }

    /// A bound of the error of heights in a range, in a box: its middle, and half of its sides.
    #[inline]
    pub(super) fn most(&self, middle: [f64; 2], half: [f64; 2], [least, most]: [f64; 2]) -> f64 {
        let (z, span) = (self.at(middle), self.slope[0].abs() * half[0] + self.slope[1].abs() * half[1]);
        (most - (z - span)).max(z + span - least)
    }
}

/// The height in a triangle that is too thin for a plane, as a mean of those of its corners.
pub(super) fn mean(corners: [[f64; 2]; 3], heights: [f64; 3], q: [f64; 2]) -> f64 {
    let corners = [0, 1, 2].map(|k| (VertexId::new(k), corners[k]));
    let mut weights = Vec::with_capacity(3);
    linear::weigh(q, &corners, &mut weights);
    weights.iter().map(|&(v, share)| share * heights[v.index()]).sum()
}

/// The worst so far: the largest error, of equal ones that of the lexicographically least point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Worst<K> {
    /// Nothing below this is of interest.
    pub(super) error: f64,
    pub(super) sample: Option<K>,
}

impl<K: Copy> Worst<K> {
    /// Nothing yet; errors above the floor are of interest.
    pub(super) fn above(floor: f64) -> Self {
        Self { error: floor, sample: None }
    }

    /// Takes an error that is not less than the worst.
    #[inline]
    pub(super) fn offer(&mut self, error: f64, sample: K, order: impl Fn(K, K) -> Ordering) {
        let is_first = |other: K| order(sample, other).is_lt();
        if error > self.error || self.sample.is_some_and(is_first) {
            *self = Self { error, sample: Some(sample) };
        }
    }
}
