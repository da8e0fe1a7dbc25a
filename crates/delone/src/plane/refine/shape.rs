//! Measures of a triangle: its shortest edge, whether the angle across it is too small, and where a new vertex mends it.
//!
//! Numbers here are rounded, and decide nothing about topology. Where an angle is judged the bound of all roundings is on the
//! side of refining: an angle that is called good is at least the bound.
//!
//! Sources: Chew, "Guaranteed-quality mesh generation for curved surfaces", SoCG 1993 (circumcenters); Üngör, "Off-centers: a new
//! type of Steiner points for computing size-optimal quality-guaranteed Delaunay triangulations", LATIN 2004.

use std::ops::Range;

use delone_predicates::lexicographic;

use crate::ids::{EdgeId, TriangleId};
use crate::plane::layer::Layer;

/// The range of squared lengths whose products neither overflow nor lose digits. Outside of it there is no shape, and the caller decides otherwise.
const LEAST_SQUARE: f64 = 1e-280;
const GREATEST_SQUARE: f64 = 1e280;
/// Products of squares, which leave the range of numbers sooner, are trusted here.
const PRODUCTS: Range<f64> = 1e-290..1e290;

/// A triangle from its shortest edge on.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shape {
    /// The shortest edge; of several that whose origin is least.
    pub(super) shortest: EdgeId,
    /// The corners, from its origin on.
    pub(super) points: [[f64; 2]; 3],
    /// The squares of the sides from each corner to the next.
    pub(super) squares: [f64; 3],
}

impl Shape {
    /// A finite triangle. `None` if its squares leave the range of numbers.
    #[inline]
    pub(super) fn of(layer: &Layer, t: TriangleId) -> Option<Self> {
        let points = layer.mesh.places(t).map(|v| layer.points[v.index()]);
        let [a, b, c] = points;
        let [ab, bc, ca] = [squared(a, b), squared(b, c), squared(c, a)];
        let is_before = |p: f64, q: f64, at: [f64; 2], other: [f64; 2]| {
            p < q || (p == q && lexicographic(at, other).is_lt())
        };
        let shape = if is_before(bc, ab, b, a) {
            if is_before(ca, bc, c, b) {
                Self { shortest: t.edge(2), points: [c, a, b], squares: [ca, ab, bc] }
            } else {
                Self { shortest: t.edge(1), points: [b, c, a], squares: [bc, ca, ab] }
            }
        } else if is_before(ca, ab, c, a) {
            Self { shortest: t.edge(2), points: [c, a, b], squares: [ca, ab, bc] }
        } else {
            Self { shortest: t.edge(0), points, squares: [ab, bc, ca] }
        };
        let [least, second, third] = shape.squares;
        (least > LEAST_SQUARE && second < GREATEST_SQUARE && third < GREATEST_SQUARE).then_some(shape)
    }

    /// The scalar and the vector product of the sides at the corner across the shortest edge.
    #[inline]
    fn across(&self) -> (f64, f64) {
        let [a, b, c] = self.points;
        let (u, v) = ([a[0] - c[0], a[1] - c[1]], [b[0] - c[0], b[1] - c[1]]);
        (u[0] * v[0] + u[1] * v[1], u[0] * v[1] - u[1] * v[0])
    }

    /// Whether the smallest angle may be less than one whose squared cosine this is; if not, it is not.
    ///
    /// The product is that of sides with an angle of at most 60 degrees between them, so that its terms do not cancel: all
    /// roundings together are less than 32 units in the last place.
    #[inline]
    pub(super) fn is_sharp(&self, squared_cosine: f64) -> bool {
        let (dot, _) = self.across();
        let bound = squared_cosine * (1.0 - 64.0 * f64::EPSILON);
        let product = self.squares[1] * self.squares[2];
        if PRODUCTS.contains(&product) {
            return dot * dot > bound * product;
        }
        ratio(dot, self.squares[1], self.squares[2]) > bound
    }

    /// The squared cosine of the smallest angle, rounded.
    pub(super) fn squared_cosine(&self) -> f64 {
        let (dot, _) = self.across();
        ratio(dot, self.squares[1], self.squares[2])
    }

    /// The cotangents of the angles, rounded.
    pub(super) fn cotangents(&self) -> [f64; 3] {
        let (dot, cross) = self.across();
        let half = 0.5 / cross.abs();
        let [a, b, c] = self.squares;
        // The sum of two squares less the third is twice a scalar product; across the shortest side nothing cancels that way.
        [dot / cross.abs(), half * (a + b - c), half * (a + c - b)]
    }

    /// The area, rounded.
    #[inline]
    pub(super) fn area(&self) -> f64 {
        let (_, cross) = self.across();
        0.5 * cross.abs()
    }

    /// The radius of the circumcircle, rounded.
    pub(super) fn radius(&self) -> f64 {
        let (_, cross) = self.across();
        let [a, b, c] = self.squares.map(f64::sqrt);
        // In an order that leaves the range of numbers for no triangle that there is a shape of.
        0.5 * b * (a * (c / cross.abs()))
    }

    /// The square of the longest side.
    #[inline]
    pub(super) fn longest(&self) -> f64 {
        self.squares[1].max(self.squares[2])
    }

    /// The centroid.
    pub(super) fn centroid(&self) -> [f64; 2] {
        let [a, b, c] = self.points;
        [0, 1].map(|k| a[k] + ((b[k] - a[k]) + (c[k] - a[k])) / 3.0)
    }

    /// Where a new vertex is best: the circumcenter, or a point on the bisector of the shortest edge, as many times its length
    /// from its middle, if that is nearer.
    #[inline]
    pub(super) fn center(&self, reach: f64) -> [f64; 2] {
        let [a, b, c] = self.points;
        let (d, f) = ([b[0] - a[0], b[1] - a[1]], [c[0] - a[0], c[1] - a[1]]);
        let scale = 0.5 / (d[0] * f[1] - d[1] * f[0]);
        let (dd, ff) = (self.squares[0], self.squares[2]);
        let center = [(f[1] * dd - d[1] * ff) * scale, (d[0] * ff - f[0] * dd) * scale];
        let off = [0.5 * d[0] - reach * d[1], 0.5 * d[1] + reach * d[0]];
        let square = |v: [f64; 2]| v[0] * v[0] + v[1] * v[1];
        let step = if square(center) <= square(off) { center } else { off };
        [a[0] + step[0], a[1] + step[1]]
    }
}

/// The square of a scalar product, as a part of the product of two squares.
#[inline]
fn ratio(dot: f64, p: f64, q: f64) -> f64 {
    let product = p * q;
    if PRODUCTS.contains(&product) { dot * dot / product } else { (dot / p) * (dot / q) }
}

/// The square of a distance.
#[inline]
pub(super) fn squared(p: [f64; 2], q: [f64; 2]) -> f64 {
    let d = [q[0] - p[0], q[1] - p[1]];
    d[0] * d[0] + d[1] * d[1]
}

/// The square of the distance from a point to the line through two others.
pub(super) fn squared_height(q: [f64; 2], [a, b]: [[f64; 2]; 2]) -> f64 {
    let (u, v) = ([b[0] - a[0], b[1] - a[1]], [q[0] - a[0], q[1] - a[1]]);
    let cross = u[0] * v[1] - u[1] * v[0];
    let height = cross / squared(a, b).sqrt();
    height * height
}

/// How much the angle between q-a and q-b exceeds a right angle: its cosine, squared, if it does.
#[inline]
pub(super) fn squared_obtuseness(q: [f64; 2], [a, b]: [[f64; 2]; 2]) -> Option<f64> {
    let (u, v) = ([a[0] - q[0], a[1] - q[1]], [b[0] - q[0], b[1] - q[1]]);
    let dot = u[0] * v[0] + u[1] * v[1];
    (dot < 0.0).then(|| ratio(dot, squared(a, q), squared(b, q)))
}
