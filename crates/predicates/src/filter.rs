//! Stage one: floating point with a proven error bound.
//!
//! Source of the bounds: forward error analysis with unit roundoff u = 2^-53 (Shewchuk, "Adaptive precision
//! floating-point arithmetic and fast robust geometric predicates", DCG 1997); `tests` below derives every
//! constant again, by running the formulas on magnitudes and errors instead of numbers.
//!
//! Relative error analysis holds while nothing underflows, so every bound carries a floor that covers all
//! underflow, and a ceiling on the operands that makes the floor valid. Overflow gives an infinite or NaN
//! comparison, which no bound passes: the exact stage decides.

mod power;
mod scaled;
mod space;

pub(crate) use power::{in_power_circle_filter, in_power_sphere_filter};
pub(crate) use scaled::{in_circle_scaled, in_sphere_scaled, orient2d_scaled, orient3d_scaled};
pub use space::Filter3;
pub(crate) use space::{in_sphere_filter, orient3d_filter};

use crate::{Point2, Sign};

const U: f64 = f64::EPSILON / 2.0;

/// Orientation from differences: 3u (|l| + |r|) with a little room for the higher orders.
const ORIENT_BOUND: f64 = (3.0 + 16.0 * U) * U;
/// Three-term lifted in-circle determinant: 10u times its permanent.
const IN_CIRCLE_BOUND: f64 = (10.0 + 96.0 * U) * U;

/// The bound from squared lengths: half of 3u, and all of 10u, with room for the rounding of the squares and their products too.
const ORIENT_BOUND_OF_LENGTHS: f64 = (1.5 + 32.0 * U) * U;
const IN_CIRCLE_BOUND_OF_LENGTHS: f64 = (10.0 + 192.0 * U) * U;

/// All errors by underflow in an orientation: two products, each off by at most 2^-1075.
const ORIENT_FLOOR: f64 = f64::MIN_POSITIVE;
/// The largest sum of squared differences for which [`CIRCLE_FLOOR`] is valid: 2^500.
const CIRCLE_CEILING: f64 = f64::from_bits((1023 + 500) << 52);
/// All errors by underflow in an in-circle test whose squared differences stay below 2^500: each of fewer
/// than 32 roundings is off by at most 2^-1075 and is multiplied by at most 2^501.
const CIRCLE_FLOOR: f64 = f64::from_bits((1023 - 560) << 52);

/// Orientation of three points if floating point can tell.
#[inline]
pub(crate) fn orient2d_filter(a: Point2, b: Point2, c: Point2) -> Option<Sign> {
    let (det, permanent) = orient_terms([a[0] - c[0], a[1] - c[1]], [b[0] - c[0], b[1] - c[1]]);
    outside_of(det, ORIENT_BOUND * permanent + ORIENT_FLOOR)
}

/// In-circle test of four points if floating point can tell.
#[inline]
pub(crate) fn in_circle_filter(a: Point2, b: Point2, c: Point2, d: Point2) -> Option<Sign> {
    let rows = [a, b, c].map(|p| [p[0] - d[0], p[1] - d[1]]);
    let lifts @ [la, lb, lc] = rows.map(|[x, y]| x * x + y * y);
    let (det, permanent) = circle_terms(rows, lifts);
    if la + lb + lc < CIRCLE_CEILING {
        outside_of(det, IN_CIRCLE_BOUND * permanent + CIRCLE_FLOOR)
    } else {
        None
    }
}

/// Orientation of two points and one that differences were taken to, by the determinant of the differences and the sum of their squares,
/// which is twice the permanent at least.
#[inline]
pub(crate) fn orient2d_of_lengths(det: f64, squares: f64) -> Option<Sign> {
    outside_of(det, ORIENT_BOUND_OF_LENGTHS * squares + ORIENT_FLOOR)
}

/// In-circle test of three points and one that differences were taken to, by the squared lengths of the differences and the determinants of
/// the other two of them. The permanent is at most the sum of the products of two squares.
#[inline]
pub(crate) fn in_circle_of_lengths([a, b, c]: [f64; 3], [bc, ca, ab]: [f64; 3]) -> Option<Sign> {
    let det = a * bc + b * ca + c * ab;
    let most = a * b + c * (a + b);
    if a + b + c < CIRCLE_CEILING {
        outside_of(det, IN_CIRCLE_BOUND_OF_LENGTHS * most + CIRCLE_FLOOR)
    } else {
        None
    }
}

/// A determinant of two rows, and its permanent.
#[inline]
fn orient_terms(a: Point2, b: Point2) -> (f64, f64) {
    let (left, right) = (a[0] * b[1], a[1] * b[0]);
    (left - right, left.abs() + right.abs())
}

/// The in-circle determinant of three rows and their squared lengths, and its permanent.
#[inline]
fn circle_terms([[ax, ay], [bx, by], [cx, cy]]: [Point2; 3], [la, lb, lc]: [f64; 3]) -> (f64, f64) {
    let (bc, cb) = (bx * cy, cx * by);
    let (ca, ac) = (cx * ay, ax * cy);
    let (ab, ba) = (ax * by, bx * ay);
    let det = la * (bc - cb) + lb * (ca - ac) + lc * (ab - ba);
    let permanent = la * (bc.abs() + cb.abs()) + lb * (ca.abs() + ac.abs()) + lc * (ab.abs() + ba.abs());
    (det, permanent)
}

/// The sign of a value known up to `bound`, unless the bound covers zero (or anything is NaN).
#[inline]
pub(crate) fn outside_of(value: f64, bound: f64) -> Option<Sign> {
    if value > bound {
        Some(Sign::Positive)
    } else if value < -bound {
        Some(Sign::Negative)
    } else {
        None
    }
}

/// In-circle determinants, in steps of a grid, up to which plain arithmetic is exact: less than 2^53, with room for the
/// rounding of the bound itself.
const EXACT_BELOW: f64 = 4e15;

/// A lattice of the form 2^e Z x 2^e Z on which all points of a set lie. On a small enough box of it plain
/// `f64` arithmetic is exact and no error bound is needed: grids, integers, 24-bit data.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    step: f64,
}

impl Grid {
    /// The coarsest such lattice holding every coordinate, or `None` where it is finer than 2^-200 or a
    /// coordinate is larger than 2^53 steps, so that differences would round. O(n), and it gives up at once
    /// on coordinates that use their whole mantissa over differing exponents.
    pub fn of(coordinates: &[f64]) -> Option<Self> {
        Self::coarser_than(0.0, coordinates)
    }

    /// The lattice that coordinates are on, or `None` if it is finer than a step (rounded down to a power of two): the first
    /// coordinate may tell.
    pub fn coarser_than(least: f64, coordinates: &[f64]) -> Option<Self> {
        let least = ((least.to_bits() >> 52) as i32 - 1023).max(-200);
        let (mut lowest, mut largest) = (i32::MAX, 0.0_f64);
        // Mostly the lattice of the first few holds all others.
        for some in coordinates.chunks(512) {
            if lowest <= 200 && on_lattice(power_of_two(lowest), largest, some) {
                continue;
            }
            for &x in some {
                let bits = x.to_bits();
                let biased = (bits >> 52) as i32 & 0x7ff;
                let mantissa = bits & ((1 << 52) - 1) | u64::from(biased != 0) << 52;
                let step = biased.max(1) - 1075 + mantissa.trailing_zeros() as i32;
                if x != 0.0 && (step < lowest || x.abs() > largest) {
                    lowest = lowest.min(step);
                    largest = largest.max(x.abs());
                    if lowest < least || largest > power_of_two(lowest.min(200) + 53) {
                        return None;
                    }
                }
            }
        }
        (lowest <= 200 || largest == 0.0).then(|| Self { step: power_of_two(lowest.min(200)) })
    }

    /// Whether all coordinates are on the lattice too.
    pub fn holds_all(&self, coordinates: &[f64]) -> bool {
        on_lattice(self.step, ROUNDING / 3.0 * self.step, coordinates)
            || coordinates.iter().all(|&x| self.holds(x))
    }

    /// Whether a coordinate is on the lattice too, and not beyond 2^53 steps.
    pub fn holds(&self, x: f64) -> bool {
        // What is smaller than a step is no multiple of it, but its number of steps may be rounded to zero.
        let steps = x / self.step;
        x == 0.0 || (x.abs() >= self.step && steps.abs() <= 9_007_199_254_740_992.0 && steps.fract() == 0.0)
    }
}

impl Grid {
    /// Whether a weight is a multiple of the square of the step, and not beyond 2^53 of them: lengths of the lattice and such weights are
    /// told apart by plain arithmetic.
    pub fn holds_square(&self, weight: f64) -> bool {
        Self { step: self.step * self.step }.holds(weight)
    }
}

/// 3/2 2^52.
const ROUNDING: f64 = 6_755_399_441_055_744.0;

/// Whether coordinates surely are multiples of a step and no larger than a limit, which may be too large to tell. Several at
/// once: to add and subtract [`ROUNDING`] steps rounds to whole steps, because sums are between 2^52 and 2^53 steps.
fn on_lattice(step: f64, limit: f64, coordinates: &[f64]) -> bool {
    let whole = |x: f64| (x + ROUNDING * step) - ROUNDING * step == x;
    limit <= ROUNDING / 3.0 * step
        && coordinates.iter().fold(true, |all, &x| all & (x.abs() <= limit) & whole(x))
}

fn power_of_two(exponent: i32) -> f64 {
    debug_assert!((-1022..=1023).contains(&exponent), "2^{exponent} is no normal number");
    f64::from_bits(((1023 + exponent) as u64) << 52)
}

/// A static filter: error bounds that hold for all points of one box, computed once.
///
/// Divide and conquer keeps one for each level of its cells: points of a cell are close together, so the
/// bound shrinks with the level and nearly nothing reaches the exact stage.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Filter {
    orient: f64,
    circle: f64,
    /// Arithmetic inside the box is exact: what the bound (zero) does not decide is zero.
    exact: bool,
}

impl Filter {
    /// For points whose x coordinates differ by at most `width` and y coordinates by at most `height`,
    /// all of them on `grid` if one is known.
    ///
    /// The base-and-apex expressions of [`crate::Pencil`] are wrong by at most 8u w h (orientation) and
    /// 28u w h (w^2 + h^2) (in-circle); 9u and 32u leave room for computing the bounds themselves.
    pub fn for_box(width: f64, height: f64, grid: Option<Grid>) -> Self {
        let area = width * height;
        let square = width * width + height * height;
        if let Some(Grid { step }) = grid {
            let (w, h) = (width / step, height / step);
            if 2.0 * w * h * (w * w + h * h) < EXACT_BELOW {
                return Self { orient: 0.0, circle: 0.0, exact: true };
            }
        }
        let circle =
            if square < CIRCLE_CEILING { 32.0 * U * area * square + CIRCLE_FLOOR } else { f64::INFINITY };
        Self { orient: 9.0 * U * area + ORIENT_FLOOR, circle, exact: false }
    }

    /// The finest step of a grid on which arithmetic in such a box is exact, about.
    pub fn finest_step(width: f64, height: f64) -> f64 {
        (2.0 * width * height * (width * width + height * height) / EXACT_BELOW).sqrt().sqrt()
    }

    /// Whether the sign of a computed orientation is sure, and not zero.
    #[inline]
    pub(crate) fn tells_orient(&self, value: f64) -> bool {
        value.abs() > self.orient
    }

    /// Whether the sign of a computed in-circle determinant is sure, and not zero.
    #[inline]
    pub(crate) fn tells_circle(&self, value: f64) -> bool {
        value.abs() > self.circle
    }

    /// The sign of a computed orientation, or `None` where the exact stage must be asked.
    #[inline]
    pub(crate) fn orient(&self, value: f64) -> Option<Sign> {
        outside_of(value, self.orient).or(if self.exact { Some(Sign::Zero) } else { None })
    }

    /// The sign of a computed in-circle determinant, or `None` where the exact stage must be asked.
    #[inline]
    pub(crate) fn circle(&self, value: f64) -> Option<Sign> {
        outside_of(value, self.circle).or(if self.exact { Some(Sign::Zero) } else { None })
    }
}

#[cfg(test)]
mod tests;
