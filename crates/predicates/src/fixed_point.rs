//! In-circle tests of many triangles against one fixed point, with differences and cross products cached.
//!
//! With everything relative to the point, and the cross product of each edge known from the triangle before it, a triangle more takes two
//! cross products and three products for its circle. Distances bound the permanents of the determinants: half of the sum of the squared
//! lengths of two rows is at least what their products are together.

use crate::counters::{Predicate, Stage, count};
use crate::filter::{in_circle_of_lengths, orient2d_of_lengths};
use crate::in_circle::in_circle_exact;
use crate::orient::orient2d_exact;
use crate::{Point2, Sign};

/// The fixed point of many decisions.
#[derive(Clone, Copy, Debug)]
pub struct FixedPoint {
    center: Point2,
}

/// Another point, relative to the fixed one.
#[derive(Clone, Copy, Debug, Default)]
pub struct SeenCorner {
    end: Point2,
    from_center: Point2,
    square: f64,
}

impl SeenCorner {
    /// The point.
    #[inline]
    pub fn end(&self) -> Point2 {
        self.end
    }

    /// The differences of its coordinates to those of the center, rounded.
    #[inline]
    pub fn from_center(&self) -> Point2 {
        self.from_center
    }

    /// The cross product with another one, rounded: about twice the area of both and the center. Exchanged they give the same with the
    /// other sign.
    #[inline]
    pub fn cross(&self, other: &Self) -> f64 {
        let ([ax, ay], [bx, by]) = (self.from_center, other.from_center);
        ax * by - bx * ay
    }
}

impl FixedPoint {
    /// Around this point.
    #[inline]
    pub fn new(center: Point2) -> Self {
        Self { center }
    }

    /// The point.
    #[inline]
    pub fn center(&self) -> Point2 {
        self.center
    }

    /// The cached differences of another point.
    #[inline]
    pub fn corner(&self, end: Point2) -> SeenCorner {
        let [x, y] = [end[0] - self.center[0], end[1] - self.center[1]];
        SeenCorner { end, from_center: [x, y], square: x * x + y * y }
    }

    /// `orient2d(a, b, center)`, given `a.cross(b)`.
    #[inline]
    pub fn side(&self, a: &SeenCorner, b: &SeenCorner, cross: f64) -> Sign {
        if let Some(sign) = orient2d_of_lengths(cross, a.square + b.square) {
            count(Predicate::Orient2d, Stage::Filter);
            return sign;
        }
        orient2d_exact(a.end, b.end, self.center)
    }

    /// `in_circle(a, b, c, center)`, given the cross products of b and c, of c and a, and of a and b.
    #[inline]
    pub fn in_circle(&self, [a, b, c]: [&SeenCorner; 3], crosses: [f64; 3]) -> Sign {
        if let Some(sign) = in_circle_of_lengths([a.square, b.square, c.square], crosses) {
            count(Predicate::InCircle, Stage::Filter);
            return sign;
        }
        in_circle_exact(a.end, b.end, c.end, self.center)
    }
}
