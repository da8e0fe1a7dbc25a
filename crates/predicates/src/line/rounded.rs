//! Where two lines meet, correctly rounded: by floating point with a bound, then by balls of a hundred bits.
//!
//! Values half way between two numbers pass neither: who asks knows the usual ones, which are middles of two numbers.

use super::{FLOOR, Line, TURN_BOUND};
use crate::Point2;
use crate::ball::{Ball, Number, U};

/// A product of a difference and a last coefficient, less another one.
pub(crate) const MEETING_BOUND: f64 = 10.0 * U;

/// Where two lines meet; coordinates that are known are not computed. `None` where this is not enough to tell.
pub(crate) fn meeting(first: &Line, second: &Line, known: [Option<f64>; 2]) -> Option<Point2> {
    if let [Some(x), Some(y)] = known {
        return Some([x, y]);
    }
    let from = second.point().or(first.point())?;
    in_floating_point(first, second, from, known).or_else(|| in_balls(first, second, from, known))
}

pub(super) fn in_floating_point(
    first: &Line,
    second: &Line,
    from: Point2,
    known: [Option<f64>; 2],
) -> Option<Point2> {
    let (e, f) = (first.equation(from), second.equation(from));
    let (left, right) = (e.a * f.b, e.b * f.a);
    let (denominator, size) = (left - right, left.abs() + right.abs());
    // Half of the denominator is left after all errors, which is what the factors of two below are for.
    if !(e.in_range() && f.in_range() && denominator.abs() > 2.0 * TURN_BOUND * size + f64::MIN_POSITIVE) {
        return None;
    }
    let nearest = |axis: usize, numerator: f64, terms: f64| {
        known[axis].or_else(|| {
            let quotient = numerator / denominator;
            let of_terms = MEETING_BOUND * terms + FLOOR;
            let of_denominator = quotient.abs() * (TURN_BOUND * size + f64::MIN_POSITIVE);
            let off = 2.0 * (of_terms + of_denominator) / denominator.abs() + 2.0 * U * quotient.abs();
            Ball::around_sum(from[axis], quotient, off).nearest()
        })
    };
    let x = nearest(0, e.b * f.c - f.b * e.c, e.b.abs() * f.size + f.b.abs() * e.size)?;
    let y = nearest(1, e.c * f.a - f.c * e.a, e.size * f.a.abs() + f.size * e.a.abs())?;
    Some([x, y])
}

/// a, b and c of a x + b y + c, relative to a point.
fn equation(line: &Line, from: Point2) -> [Ball<f64>; 3] {
    let zero = Ball::exactly(0.0);
    let bisector = |p: Point2, q: Point2| {
        let [a, b] = [0, 1].map(|k| Ball::difference(p[k], q[k]));
        let [x, y] = [0, 1].map(|k| Ball::difference(p[k], from[k]).plus(&Ball::difference(q[k], from[k])));
        let c = zero.minus(&a.times(&x).plus(&b.times(&y)));
        [a.scaled(2.0), b.scaled(2.0), c]
    };
    match *line {
        Line::Through(p, q) => {
            let (a, b) = (Ball::difference(p[1], q[1]), Ball::difference(q[0], p[0]));
            let [x, y] = [0, 1].map(|k| Ball::difference(p[k], from[k]));
            [a, b, zero.minus(&a.times(&x).plus(&b.times(&y)))]
        }
        Line::Bisector(p, q) => bisector(p, q),
        Line::Radical((p, w), (q, v)) => {
            let [a, b, c] = bisector(p, q);
            [a, b, c.plus(&Ball::difference(w, v))]
        }
        Line::Above(0, at) | Line::Below(0, at) => [Ball::exactly(1.0), zero, Ball::difference(from[0], at)],
        Line::Above(_, at) | Line::Below(_, at) => [zero, Ball::exactly(1.0), Ball::difference(from[1], at)],
    }
}

/// Some 200 nanoseconds, where big integers take two microseconds.
#[inline(never)]
fn in_balls(first: &Line, second: &Line, from: Point2, known: [Option<f64>; 2]) -> Option<Point2> {
    let (e, f) = (equation(first, from), equation(second, from));
    let minor = |i: usize, j: usize| e[i].times(&f[j]).minus(&e[j].times(&f[i]));
    let turn = minor(0, 1);
    // A quotient is by a number that is not negative.
    let is_negative = turn.high < 0.0;
    let less = |x: Ball<f64>| if is_negative { Ball::exactly(0.0).minus(&x) } else { x };
    let denominator = less(turn);
    let nearest = |axis: usize, numerator: Ball<f64>| {
        known[axis].or_else(|| Ball::exactly(from[axis]).plus(&less(numerator).over(&denominator)).nearest())
    };
    Some([nearest(0, minor(1, 2))?, nearest(1, minor(2, 0))?])
}
