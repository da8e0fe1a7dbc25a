//! Comparisons of distances and angles: filter, exact. Degree two, without perturbation: equal is an answer.

use std::cmp::Ordering;

use crate::{Point2, Point3, Sign, exact};

/// Relative error of a squared distance or a scalar product of two rounded differences, doubled for safety:
/// two roundings of differences, one of a product, one of a sum.
pub(crate) const ERROR: f64 = 8.0 * (f64::EPSILON / 2.0);
/// Below this magnitude an underflow could be as large as the error bound.
pub(crate) const SMALLEST: f64 = 1e-290;

/// Compares the distances of `a` and of `b` from `q`: `Less` if `a` is nearer.
///
/// Exact for every finite input. O(1).
///
/// ```
/// use std::cmp::Ordering;
/// use delone_predicates::compare_distances;
/// assert_eq!(compare_distances([0.0, 0.0], [3.0, 4.0], [5.0, 0.0]), Ordering::Equal);
/// assert_eq!(compare_distances([1e-300, 0.0], [3.0, 4.0], [5.0, 0.0]), Ordering::Greater);
/// ```
#[inline]
pub fn compare_distances(q: Point2, a: Point2, b: Point2) -> Ordering {
    let (to_a, to_b) = (squared(q, a), squared(q, b));
    compared(to_a, to_b).unwrap_or_else(|| exact_comparison(q, a, b))
}

#[cold]
#[inline(never)]
fn exact_comparison(q: Point2, a: Point2, b: Point2) -> Ordering {
    exact::compare_distances(q, a, b)
}

/// Compares the distance of `a` from `q` with `radius`: `Less` if `a` is strictly inside the circle. A negative
/// radius is smaller than every distance.
///
/// Exact for every finite input. O(1).
///
/// ```
/// use std::cmp::Ordering;
/// use delone_predicates::compare_with_radius;
/// assert_eq!(compare_with_radius([0.0, 0.0], [3.0, 4.0], 5.0), Ordering::Equal);
/// ```
#[inline]
pub fn compare_with_radius(q: Point2, a: Point2, radius: f64) -> Ordering {
    if radius < 0.0 {
        return Ordering::Greater;
    }
    compared(squared(q, a), radius * radius).unwrap_or_else(|| exact::compare_with_radius(q, a, radius))
}

/// Whether a segment surely has no point nearer to `q` than `p`, or at most `radius` away: floating point with a proven bound,
/// after which `false` is no answer. For searches that pass by what they need not look at.
///
/// O(1).
#[inline]
pub fn segment_keeps_away(q: Point2, [a, b]: [Point2; 2], reach: SearchLimit) -> bool {
    let limit = match reach {
        SearchLimit::To(p) => squared(q, p),
        SearchLimit::Radius(radius) => radius * radius,
    };
    // The nearest point is an end, or on the line.
    if !angle(a, q, b).is_positive() {
        return reach.is_short_of(q, a);
    }
    if !angle(b, q, a).is_positive() {
        return reach.is_short_of(q, b);
    }
    let (dx, dy, ex, ey) = (b[0] - a[0], b[1] - a[1], q[0] - a[0], q[1] - a[1]);
    let (left, right) = (dx * ey, dy * ex);
    let height = (left - right).abs() - ERROR * (left.abs() + right.abs());
    let length = dx * dx + dy * dy;
    // Products below could underflow, and overflow gives no answer.
    height > SMALLEST
        && limit > SMALLEST
        && length > SMALLEST
        && height * height > SMALLEST
        && limit * length < f64::INFINITY
        && height * height * (1.0 - 4.0 * ERROR) > limit * length
}

/// The limit of a search around a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SearchLimit {
    /// Points nearer than this one.
    To(Point2),
    /// Points up to this distance, which is included.
    Radius(f64),
}

impl SearchLimit {
    /// Whether point `a` is beyond the limit.
    fn is_short_of(self, q: Point2, a: Point2) -> bool {
        match self {
            Self::To(p) => compare_distances(q, a, p).is_ge(),
            Self::Radius(radius) => compare_with_radius(q, a, radius).is_gt(),
        }
    }
}

/// [`compare_distances`] in space.
#[inline]
pub fn compare_distances3(q: Point3, a: Point3, b: Point3) -> Ordering {
    let (to_a, to_b) = (squared3(q, a), squared3(q, b));
    compared(to_a, to_b).unwrap_or_else(|| exact::compare_distances3(q, a, b))
}

/// [`compare_with_radius`] in space.
#[inline]
pub fn compare_with_radius3(q: Point3, a: Point3, radius: f64) -> Ordering {
    if radius < 0.0 {
        return Ordering::Greater;
    }
    compared(squared3(q, a), radius * radius).unwrap_or_else(|| exact::compare_with_radius3(q, a, radius))
}

/// Whether one squared distance is surely larger than another, both sums of the squares of up to three differences, rounded at each
/// step: floating point with a proven bound, after which `false` is no answer. For searches that pass by what they need not
/// look at.
#[inline]
pub fn is_surely_further(squared: f64, limit: f64) -> bool {
    squared * (1.0 - 2.0 * ERROR) > limit && squared > 2.0 * SMALLEST && squared < f64::INFINITY
}

/// The sign of the scalar product (a - o) . (b - o): positive if the angle at `o` is acute, zero if it is right.
///
/// Exact for every finite input. O(1).
///
/// ```
/// use delone_predicates::{Sign, angle};
/// assert_eq!(angle([0.0, 0.0], [1.0, 0.0], [0.0, 1.0]), Sign::Zero);
/// assert_eq!(angle([0.0, 0.0], [1.0, 0.0], [1.0, 1.0]), Sign::Positive);
/// ```
#[inline]
pub fn angle(o: Point2, a: Point2, b: Point2) -> Sign {
    let x = (a[0] - o[0]) * (b[0] - o[0]);
    let y = (a[1] - o[1]) * (b[1] - o[1]);
    told(x + y, x.abs() + y.abs()).unwrap_or_else(|| exact::angle(o, a, b))
}

/// The sign of the angle at `o` between `a` and `b`, in space.
///
/// ```
/// use delone_predicates::{Sign, angle3};
/// assert_eq!(angle3([0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 1.0]), Sign::Zero);
/// ```
pub fn angle3(o: Point3, a: Point3, b: Point3) -> Sign {
    angle_at(o, a, b)
}

/// The sign of the angle in any dimension.
#[inline]
pub(crate) fn angle_at<const D: usize>(o: [f64; D], a: [f64; D], b: [f64; D]) -> Sign {
    let (mut dot, mut size) = (0.0, 0.0);
    for k in 0..D {
        let product = (a[k] - o[k]) * (b[k] - o[k]);
        dot += product;
        size += product.abs();
    }
    told(dot, size).unwrap_or_else(|| exact::lengths::angle(o, a, b))
}

/// The order of two squared distances, if floating point can tell.
#[inline]
pub(crate) fn compared(left: f64, right: f64) -> Option<Ordering> {
    told(left - right, left + right).map(|sign| sign.cmp(&Sign::Zero))
}

/// The sign of a sum of two or three products of rounded differences, if floating point can tell. `size` is the sum of
/// their magnitudes.
#[inline]
pub(crate) fn told(value: f64, size: f64) -> Option<Sign> {
    (value.abs() > ERROR * size && size >= SMALLEST && size.is_finite()).then(|| Sign::of(&value, &0.0))
}

#[inline]
fn squared(q: Point2, a: Point2) -> f64 {
    let (x, y) = (a[0] - q[0], a[1] - q[1]);
    x * x + y * y
}

#[inline]
fn squared3(q: Point3, a: Point3) -> f64 {
    let (x, y, z) = (a[0] - q[0], a[1] - q[1], a[2] - q[2]);
    x * x + y * y + z * z
}
