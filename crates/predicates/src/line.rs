//! Lines, where two of them meet, and on which side of a third one that is: filter, exact.
//!
//! The corners of a clipped Voronoi cell are such meetings: of two bisectors, of a bisector and a side of the region.
//! They are no points of the input and mostly no `f64`s, so they stay what they are, and only what comes out at the end
//! is rounded.
//!
//! A line is where a x + b y + c is zero; two lines meet at the cross product of their coefficients, and the third line
//! there is the determinant of all three, over that of (a, b) of the first two. Degree four in the coordinates.

pub(crate) mod centers;
mod exact;
pub(crate) mod rounded;

use std::cmp::Ordering;

pub use centers::{circumcenter, power_center};

use crate::ball::U;
use crate::{Point2, Sign, Site, compare_distances, compare_powers, lexicographic, orient2d};

/// A directed line, given by what is positive: on its left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Line {
    /// From a point through another one, which differs from it.
    Through(Point2, Point2),
    /// The points as far from a point as from another one; positive where the first is nearer.
    Bisector(Point2, Point2),
    /// The points with the same power to two sites; positive where that to the first is less.
    Radical(Site<2>, Site<2>),
    /// The points whose x (axis 0) or y (any other) is a number; positive where it is larger.
    Above(usize, f64),
    /// The points whose x (axis 0) or y (any other) is a number; positive where it is smaller.
    Below(usize, f64),
}

/// A place that is known exactly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Spot {
    /// A point.
    Point(Point2),
    /// Where two lines meet that are not parallel.
    Meeting(Line, Line),
}

impl Line {
    /// On which side of the line a place is: positive on its left. Zero for lines that do not meet in a point.
    ///
    /// Exact for every finite input. O(1).
    ///
    /// ```
    /// use delone_predicates::{Line, Sign, Spot};
    /// // A circumcenter, and the side of a square that it is on.
    /// let (a, b, c) = ([0.0, 0.0], [0.2, 0.0], [0.0, 0.2]);
    /// let center = Spot::Meeting(Line::Bisector(a, b), Line::Bisector(a, c));
    /// assert_eq!(Line::Below(0, 0.1).side(&center), Sign::Zero);
    /// // Far below what f64 arithmetic can see: 0.3 - 0.2 is not 0.1.
    /// assert_eq!(Line::Above(0, 0.3 - 0.2).side(&center), Sign::Positive);
    /// ```
    pub fn side(&self, spot: &Spot) -> Sign {
        match *spot {
            Spot::Point(p) => match *self {
                Self::Through(a, b) => orient2d(a, b, p),
                Self::Bisector(a, b) => Sign::of(&compare_distances(p, b, a), &Ordering::Equal),
                Self::Radical(a, b) => Sign::of(&compare_powers(p, b, a), &Ordering::Equal),
                Self::Above(axis, at) => Sign::of(&p[usize::from(axis != 0)], &at),
                Self::Below(axis, at) => Sign::of(&at, &p[usize::from(axis != 0)]),
            },
            Spot::Meeting(first, second) => {
                // Where a line is along an axis, the coordinate is known.
                if let Some(axis) = self.axis()
                    && let Some(at) = first.at(axis).or(second.at(axis))
                {
                    let parallel = first.turn(&second).is_zero();
                    return if parallel { Sign::Zero } else { self.side(&Spot::Point([at; 2])) };
                }
                let filtered = side_filter(&first, &second, self);
                filtered.unwrap_or_else(|| exact::side_of_meeting(&first, &second, self))
            }
        }
    }

    /// The order of two places on this line, in its direction. Exact. O(1).
    ///
    /// ```
    /// use delone_predicates::{Line, Spot};
    /// let axis = Line::Above(1, 0.0);
    /// let meeting = Spot::Meeting(Line::Through([0.0, -1.0], [1.0, 2.0]), axis); // at (1/3, 0)
    /// assert!(axis.compare(&meeting, &Spot::Point([1.0 / 3.0, 0.0])).is_gt());
    /// ```
    pub fn compare(&self, p: &Spot, q: &Spot) -> Ordering {
        let order = match (self.across(p), self.across(q)) {
            (Some(across), None) => -(across.side(q) * across.turn(self)),
            (_, Some(across)) => across.side(p) * across.turn(self),
            (None, None) => match (p, q) {
                (Spot::Point(p), Spot::Point(q)) => {
                    let order = Sign::of(&lexicographic(*p, *q), &Ordering::Equal);
                    let [a, b] = self.signs();
                    // The direction is (b, -a).
                    order * if b.is_zero() { -a } else { b }
                }
                _ => Sign::Zero,
            },
        };
        (order as i8).cmp(&0)
    }

    /// The line of a meeting that crosses this one.
    fn across(&self, spot: &Spot) -> Option<Self> {
        match *spot {
            Spot::Point(_) => None,
            Spot::Meeting(first, second) => {
                // Mostly one of them is this line.
                let is_parallel = first == *self || (second != *self && first.turn(self).is_zero());
                Some(if is_parallel { second } else { first })
            }
        }
    }

    /// The sign of a of the first times b of the second minus b times a: zero for parallel lines.
    fn turn(&self, other: &Self) -> Sign {
        if let (Some(_), _) | (_, Some(_)) = (self.axis(), other.axis()) {
            let ([a, b], [c, d]) = (self.signs(), other.signs());
            // One of the four is zero on either side, so that one product is.
            let (left, right) = (a * d, b * c);
            return if left.is_zero() { -right } else { left };
        }
        turn_filter(self, other).unwrap_or_else(|| exact::turn(self, other))
    }

    /// The signs of a and b.
    fn signs(&self) -> [Sign; 2] {
        let unit = |axis: usize, sign: Sign| if axis == 0 { [sign, Sign::Zero] } else { [Sign::Zero, sign] };
        match *self {
            Self::Through(p, q) => [Sign::of(&p[1], &q[1]), Sign::of(&q[0], &p[0])],
            Self::Bisector(p, q) | Self::Radical((p, _), (q, _)) => {
                [Sign::of(&p[0], &q[0]), Sign::of(&p[1], &q[1])]
            }
            Self::Above(axis, _) => unit(axis, Sign::Positive),
            Self::Below(axis, _) => unit(axis, Sign::Negative),
        }
    }

    /// The axis that it fixes, if it is given that way.
    fn axis(&self) -> Option<usize> {
        match *self {
            Self::Above(axis, _) | Self::Below(axis, _) => Some(usize::from(axis != 0)),
            _ => None,
        }
    }

    /// The coordinate on an axis that it fixes.
    fn at(&self, along: usize) -> Option<f64> {
        match *self {
            Self::Above(_, at) | Self::Below(_, at) if self.axis() == Some(along) => Some(at),
            _ => None,
        }
    }

    /// The coordinate of all its points on an axis, correctly rounded, where it is parallel to the other axis.
    pub(crate) fn fixed(&self, along: usize) -> Option<f64> {
        let across = 1 - along;
        match *self {
            Self::Above(..) | Self::Below(..) => self.at(along),
            Self::Through(p, q) => (p[along] == q[along]).then_some(p[along]),
            Self::Radical((_, w), (_, v)) if w != v => None,
            Self::Bisector(p, q) | Self::Radical((p, _), (q, _)) if p[across] == q[across] => {
                middle(p[along], q[along])
            }
            Self::Bisector(..) | Self::Radical(..) => None,
        }
    }

    /// One of the points that it is given by.
    fn point(&self) -> Option<Point2> {
        match *self {
            Self::Through(p, _) | Self::Bisector(p, _) | Self::Radical((p, _), _) => Some(p),
            _ => None,
        }
    }

    /// All coordinates that it is given by.
    pub(crate) fn numbers(&self) -> [f64; 4] {
        match *self {
            Self::Through(p, q) | Self::Bisector(p, q) | Self::Radical((p, _), (q, _)) => {
                [p[0], p[1], q[0], q[1]]
            }
            Self::Above(_, at) | Self::Below(_, at) => [at, 0.0, 0.0, 0.0],
        }
    }

    /// The weights that it is given by, if there are any.
    pub(crate) fn weights(&self) -> Option<[f64; 2]> {
        match *self {
            Self::Radical((_, w), (_, v)) => Some([w, v]),
            _ => None,
        }
    }

    fn equation(&self, from: Point2) -> Equation {
        let [x, y] = from;
        match *self {
            Self::Through(p, q) => {
                let (a, b) = (p[1] - q[1], q[0] - p[0]);
                let (u, v) = (a * (p[0] - x), b * (p[1] - y));
                Equation { a, b, c: -(u + v), size: u.abs() + v.abs() }
            }
            Self::Bisector(p, q) => {
                let (dx, dy) = (p[0] - q[0], p[1] - q[1]);
                let (px, py, qx, qy) = (p[0] - x, p[1] - y, q[0] - x, q[1] - y);
                let c = -(dx * (px + qx) + dy * (py + qy));
                let size = dx.abs() * (px.abs() + qx.abs()) + dy.abs() * (py.abs() + qy.abs());
                Equation { a: 2.0 * dx, b: 2.0 * dy, c, size }
            }
            Self::Radical((p, w), (q, v)) => {
                let plain = Self::Bisector(p, q).equation(from);
                let weight = w - v;
                Equation { c: plain.c + weight, size: plain.size + weight.abs(), ..plain }
            }
            Self::Above(axis, at) | Self::Below(axis, at) => {
                let sign = if matches!(self, Self::Above(..)) { 1.0 } else { -1.0 };
                let (a, b, c) = if axis == 0 { (sign, 0.0, x - at) } else { (0.0, sign, y - at) };
                Equation { a, b, c: sign * c, size: c.abs() }
            }
        }
    }
}

impl Spot {
    /// The place in coordinate units, correctly rounded: each coordinate is the nearest `f64` of the exact one, so the same bits
    /// whatever the order and the directions of the lines. `None` for lines that do not meet, and if it is too far away for an
    /// `f64`.
    ///
    /// Two bisectors that share a site meet at [`crate::circumcenter`]. O(1).
    ///
    /// ```
    /// use delone_predicates::{Line, Spot};
    /// let meeting = Spot::Meeting(Line::Through([0.0, 0.0], [1.0, 1.0]), Line::Bisector([0.0, 0.0], [3.0, 0.0]));
    /// assert_eq!(meeting.rounded(), Some([1.5, 1.5]));
    /// ```
    pub fn rounded(&self) -> Option<Point2> {
        match *self {
            Self::Point(p) => Some(p),
            Self::Meeting(Line::Bisector(a, b), Line::Bisector(c, d)) if a == c || b == c => {
                circumcenter(a, b, d)
            }
            Self::Meeting(Line::Bisector(a, b), Line::Bisector(c, d)) if a == d || b == d => {
                circumcenter(a, b, c)
            }
            Self::Meeting(Line::Radical(a, b), Line::Radical(c, d)) if a == c || b == c => {
                power_center(a, b, d)
            }
            Self::Meeting(Line::Radical(a, b), Line::Radical(c, d)) if a == d || b == d => {
                power_center(a, b, c)
            }
            Self::Meeting(first, second) => {
                let known = [0, 1].map(|axis| first.fixed(axis).or(second.fixed(axis)));
                rounded::meeting(&first, &second, known)
                    .or_else(|| exact::meeting(&first, &second).filter(|p| p.iter().all(|x| x.is_finite())))
            }
        }
    }
}

/// The determinant, relative to its permanent: 12 roundings, and room for those of the permanent.
pub(crate) const SIDE_BOUND: f64 = 16.0 * U;
/// Two products of two differences each.
pub(crate) const TURN_BOUND: f64 = 5.0 * U;
/// The largest a and b for which [`FLOOR`] is valid, 2^200; c and its size may be as large as the square.
const CEILING: f64 = f64::from_bits((1023 + 200) << 52);
/// All errors by underflow: each of fewer than 32 products is off by at most 2^-1075, times at most 2^402.
const FLOOR: f64 = f64::from_bits((1023 - 660) << 52);

/// Half of the sum, correctly rounded; `None` if the sum is too large for an `f64`.
pub(crate) fn middle(a: f64, b: f64) -> Option<f64> {
    // A sum that is rounded is not subnormal, so halving it is exact. No negative zero.
    Some(0.5 * (a + b) + 0.0).filter(|x| x.is_finite())
}

/// a x + b y + c in floating point, relative to a point near by: a and b with one rounding each.
#[derive(Clone, Copy)]
struct Equation {
    a: f64,
    b: f64,
    c: f64,
    /// c is at most this and off by at most six roundings of this.
    size: f64,
}

impl Equation {
    fn in_range(&self) -> bool {
        self.a.abs() <= CEILING && self.b.abs() <= CEILING && self.size <= CEILING * CEILING
    }
}

fn outside_of(value: f64, bound: f64) -> Option<Sign> {
    (value.abs() > bound).then(|| Sign::of(&value, &0.0))
}

fn turn_filter(first: &Line, second: &Line) -> Option<Sign> {
    let (e, f) = (first.equation([0.0; 2]), second.equation([0.0; 2]));
    let (left, right) = (e.a * f.b, e.b * f.a);
    outside_of(left - right, TURN_BOUND * (left.abs() + right.abs()) + f64::MIN_POSITIVE)
}

/// The side of the third line that the meeting of the first two is on, if floating point can tell.
fn side_filter(first: &Line, second: &Line, third: &Line) -> Option<Sign> {
    let from = first.point().or(second.point()).or(third.point())?;
    let [e, f, g] = [first, second, third].map(|line| line.equation(from));
    let (left, right) = (e.a * f.b, e.b * f.a);
    let (denominator, size) = (left - right, left.abs() + right.abs());
    let turn = outside_of(denominator, TURN_BOUND * size + f64::MIN_POSITIVE)?;
    let value = g.a * (e.b * f.c - f.b * e.c) + g.b * (e.c * f.a - f.c * e.a) + g.c * denominator;
    let permanent = g.a.abs() * (e.b.abs() * f.size + f.b.abs() * e.size)
        + g.b.abs() * (e.size * f.a.abs() + f.size * e.a.abs())
        + g.size * size;
    if !(e.in_range() && f.in_range() && g.in_range()) {
        return None;
    }
    Some(outside_of(value, SIDE_BOUND * permanent + FLOOR)? * turn)
}

/// Tests of the share that floating point decides by itself: an answer that is right but late is seen by no comparison
/// with the exact one.
#[cfg(test)]
mod tests;
