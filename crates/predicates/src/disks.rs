//! Circles about two of several equal disks: where along the bisector of two centers the others come in the way.
//!
//! Source: the strong and the weak problem of Devillers, "Delaunay triangulation of imprecise points", JoCG 2011, §1, whose
//! predicates are worked out here. The point of the bisector of i and j at s is
//! c(s) = (i + j) / 2 + s / 2 * (j - i turned left). With d its distance from i and from j, d_k that from k, and e the diameter
//! of the disks, the terms of a pencil (`pencil.rs`) give
//!
//! ```text
//! d_k^2 - d^2 = dot - s cross        and        4 d^2 = |j - i|^2 (1 + s^2),
//! ```
//!
//! so that d_k > d + e and d_k < d - e are both of the form a - s b > sqrt(q (1 + s^2)), with a = dot - e^2, b = cross (or
//! both negated) and q = e^2 |j - i|^2: a cap of the half circle of directions (1, s), an open interval. Its ends are roots of
//! (b^2 - q) s^2 - 2 a b s + a^2 - q, whose discriminant is q (a^2 + b^2 - q).
//!
//! Stages: intervals of floating point, rounded outwards (`interval.rs`); big integers, of degree 16 in the coordinates
//! (`exact.rs`). O(1).

mod exact;
mod interval;
#[cfg(test)]
mod tests;

use std::cmp::Ordering;

use crate::{Point2, Sign, angle, compare_with_radius, orient2d};
use interval::Interval;

/// Two different centers of disks of one diameter.
#[derive(Clone, Copy, Debug)]
pub struct DiskPair {
    i: Point2,
    j: Point2,
    diameter: f64,
}

/// An open interval of a bisector; an end that is `None` is at infinity.
#[derive(Clone, Copy, Debug)]
pub struct Stretch {
    /// Where it begins.
    pub low: Option<End>,
    /// Where it ends.
    pub high: Option<End>,
}

/// An end of a [`Stretch`], to be compared with others of the same pair.
#[derive(Clone, Copy, Debug)]
pub struct End {
    k: Point2,
    question: Question,
    is_low: bool,
    value: Interval,
}

/// The question about a third disk.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Question {
    /// Where is d_k > d + e?
    Clear,
    /// Where is d_k < d - e?
    Blocked,
}

/// The arithmetic of both stages. A sign may be unknown.
trait Number: Sized {
    fn plus(&self, other: &Self) -> Self;
    fn minus(&self, other: &Self) -> Self;
    fn times(&self, other: &Self) -> Self;
    fn sign(&self) -> Option<Sign>;
}

/// The numbers of a quadratic; see above. `d` is a^2 + b^2 - q, `m` is b^2 - q.
struct Terms<T> {
    a: T,
    b: T,
    q: T,
    d: T,
    m: T,
}

/// Which ends are finite; `None` if nothing is inside.
type Shape = Option<[bool; 2]>;

impl<T: Number> Terms<T> {
    /// From the coordinates of i, j and k and the diameter.
    fn new([ix, iy, jx, jy, kx, ky, e]: &[T; 7], question: Question) -> Self {
        let dot = |x: &[T; 2], y: &[T; 2]| x[0].times(&y[0]).plus(&x[1].times(&y[1]));
        let cross = |x: &[T; 2], y: &[T; 2]| x[0].times(&y[1]).minus(&x[1].times(&y[0]));
        let (u, v, w) =
            ([jx.minus(ix), jy.minus(iy)], [kx.minus(ix), ky.minus(iy)], [kx.minus(jx), ky.minus(jy)]);
        let ee = e.times(e);
        let (a, b) = match question {
            Question::Clear => (dot(&v, &w).minus(&ee), cross(&v, &w)),
            Question::Blocked => (ee.minus(&dot(&v, &w)), cross(&w, &v)),
        };
        let q = ee.times(&dot(&u, &u));
        let m = b.times(&b).minus(&q);
        Self { d: m.plus(&a.times(&a)), a, b, q, m }
    }

    /// `None` if a sign is unknown that matters.
    fn shape(&self) -> Option<Shape> {
        if self.d.sign()? != Sign::Positive {
            return Some(None);
        }
        let m = self.m.sign()?;
        if m != Sign::Positive && self.a.sign()?.is_negative() {
            return Some(None);
        }
        if m == Sign::Negative {
            return Some(Some([true, true]));
        }
        let b = self.b.sign()?;
        Some(Some([b.is_negative(), b.is_positive()]))
    }
}

impl DiskPair {
    /// The pair of the disks around `i` and `j`, which differ.
    pub fn new(i: Point2, j: Point2, diameter: f64) -> Self {
        Self { i, j, diameter }
    }

    /// Where the smallest disk around both has all of the disk around `k` outside: d_k > d + e. `None` if nowhere.
    ///
    /// ```
    /// use delone_predicates::DiskPair;
    ///
    /// let pair = DiskPair::new([0.0, 0.0], [4.0, 0.0], 1.0);
    /// // A disk on the left ends the stretch; one between both leaves none.
    /// let stretch = pair.clear_of([2.0, 9.0]).unwrap();
    /// assert!(stretch.low.is_none() && stretch.high.is_some());
    /// assert!(pair.clear_of([2.0, 0.5]).is_none());
    /// ```
    pub fn clear_of(&self, k: Point2) -> Option<Stretch> {
        self.stretch(k, Question::Clear)
    }

    /// Where the smallest disk that meets both has all of the disk around `k` inside: d_k < d - e. `None` if nowhere.
    pub fn blocked_by(&self, k: Point2) -> Option<Stretch> {
        // For nearer centers squares would also tell where d_k < e - d.
        let is_apart = |p: Point2| compare_with_radius(p, k, self.diameter).is_gt();
        (is_apart(self.i) && is_apart(self.j)).then(|| self.stretch(k, Question::Blocked)).flatten()
    }

    /// The order of two ends along the bisector.
    pub fn compare(&self, first: &End, second: &End) -> Ordering {
        first.value.compare(&second.value).unwrap_or_else(|| exact::compare(self, first, second))
    }

    /// Whether the circle through i and j about some place from `low` to `high` has `k` inside or on it. Perhaps true where
    /// it is not; never false where it is.
    pub fn may_hold(&self, k: Point2, low: Option<&End>, high: Option<&End>) -> bool {
        let through = || {
            let Terms { a, b, .. } = Terms::new(&self.intervals(k, 0.0), Question::Clear);
            a.over(&b)
        };
        let is_before = |x: &Interval, y: &Interval| x.compare(y) == Some(Ordering::Less);
        match orient2d(self.i, self.j, k) {
            Sign::Zero => !angle(k, self.i, self.j).is_positive(),
            Sign::Positive => high.is_none_or(|high| !is_before(&high.value, &through())),
            Sign::Negative => low.is_none_or(|low| !is_before(&through(), &low.value)),
        }
    }

    fn intervals(&self, k: Point2, diameter: f64) -> [Interval; 7] {
        self.numbers(k, diameter).map(Interval::from)
    }

    fn numbers(&self, k: Point2, diameter: f64) -> [f64; 7] {
        [self.i[0], self.i[1], self.j[0], self.j[1], k[0], k[1], diameter]
    }

    fn stretch(&self, k: Point2, question: Question) -> Option<Stretch> {
        let terms = Terms::new(&self.intervals(k, self.diameter), question);
        let [low, high] = terms.shape().unwrap_or_else(|| exact::shape(self, k, question))?;
        let end = |is_low: bool| End { k, question, is_low, value: terms.root(is_low) };
        Some(Stretch { low: low.then(|| end(true)), high: high.then(|| end(false)) })
    }
}
