//! Where lines meet, by rational arithmetic over big integers.

use num_bigint::BigInt;

use crate::exact::{Point2, integers, sign};

/// A line, and what is positive.
#[derive(Clone, Copy, Debug)]
pub enum Line {
    /// On the left of the way from a point to another one.
    Through(Point2, Point2),
    /// Nearer to the first point.
    Bisector(Point2, Point2),
    /// A coordinate (0 or 1) larger than a number, or smaller.
    Axis(usize, f64, bool),
}

type Vector = [BigInt; 2];

/// Lines on a common scale: the numbers are doubled, so that midpoints are whole.
fn scaled(lines: &[Line]) -> Vec<[Vector; 2]> {
    let points = lines.iter().flat_map(|line| match *line {
        Line::Through(p, q) | Line::Bisector(p, q) => [p, q],
        Line::Axis(_, at, _) => [[at, at], [at, at]],
    });
    let whole = integers(&points.collect::<Vec<_>>());
    let double = |p: &Vector| [&p[0] * 2, &p[1] * 2];
    whole.chunks_exact(2).map(|pair| [double(&pair[0]), double(&pair[1])]).collect()
}

fn less(p: &Vector, q: &Vector) -> Vector {
    [&p[0] - &q[0], &p[1] - &q[1]]
}

fn cross(u: &Vector, v: &Vector) -> BigInt {
    &u[0] * &v[1] - &u[1] * &v[0]
}

/// A point of a line, and where the line goes from there.
fn ray(line: &Line, [p, q]: &[Vector; 2]) -> (Vector, Vector) {
    match line {
        Line::Through(..) => (p.clone(), less(q, p)),
        Line::Bisector(..) => {
            let middle = [(&p[0] + &q[0]) / 2, (&p[1] + &q[1]) / 2];
            let [x, y] = less(q, p);
            (middle, [-y, x])
        }
        Line::Axis(axis, ..) => (p.clone(), [BigInt::from(*axis as i64), BigInt::from(1 - *axis as i64)]),
    }
}

/// The place where two lines meet, as a point and what it is to be divided by; none if they are parallel.
fn meeting(lines: [&Line; 2], points: &[[Vector; 2]]) -> Option<(Vector, BigInt)> {
    let ((p, u), (q, v)) = (ray(lines[0], &points[0]), ray(lines[1], &points[1]));
    let mut below = cross(&u, &v);
    if below == BigInt::ZERO {
        return None;
    }
    let mut along = cross(&less(&q, &p), &v);
    if below < BigInt::ZERO {
        (below, along) = (-below, -along);
    }
    Some(([&p[0] * &below + &along * &u[0], &p[1] * &below + &along * &u[1]], below))
}

/// On which side of the third line the first two meet, by the definition of the side. Zero for parallel lines.
pub fn side(first: Line, second: Line, third: Line) -> i8 {
    let points = scaled(&[first, second, third]);
    let Some((at, below)) = meeting([&first, &second], &points) else { return 0 };
    let times = |p: &Vector| [&p[0] * &below, &p[1] * &below];
    let [p, q] = [times(&points[2][0]), times(&points[2][1])];
    match third {
        Line::Through(..) => sign(&cross(&less(&q, &p), &less(&at, &p))),
        Line::Bisector(..) => {
            let square = |p: &Vector| less(&at, p).iter().map(|x| x * x).sum::<BigInt>();
            sign(&(square(&q) - square(&p)))
        }
        Line::Axis(axis, _, above) => {
            let beyond = sign(&(&at[axis] - &p[axis]));
            if above { beyond } else { -beyond }
        }
    }
}

/// Whether a point is the place where two lines meet up to an error in each coordinate. `None` for parallel lines.
pub fn meet_near(first: Line, second: Line, place: Point2, error: [f64; 2]) -> Option<bool> {
    let asked = Line::Through(place, error);
    let points = scaled(&[first, second, asked]);
    let (at, below) = meeting([&first, &second], &points)?;
    let [place, error] = &points[2];
    let off = |axis: usize| (&at[axis] - &place[axis] * &below).magnitude().clone();
    Some([0, 1].into_iter().all(|axis| BigInt::from(off(axis)) <= &error[axis] * &below))
}

/// Whether each coordinate of a point is the nearest `f64` of where two lines meet, of two at one distance the even one. `None` for
/// parallel lines.
pub fn meet_nearest_to(first: Line, second: Line, place: Point2) -> Option<[bool; 2]> {
    let neighbors = [place.map(f64::next_down), place.map(f64::next_up)];
    // What is beyond the largest number is as far away as another step.
    let steps = Line::Through(neighbors[0].map(|x| x.max(f64::MIN)), neighbors[1].map(|x| x.min(f64::MAX)));
    let points = scaled(&[first, second, Line::Through(place, place), steps]);
    let (at, below) = meeting([&first, &second], &points)?;
    let ([here, _], [low, high]) = (&points[2], &points[3]);
    Some([0, 1].map(|axis| {
        let twice: BigInt = &at[axis] * 2;
        let [least, most] = [low, high].map(|end| (&here[axis] + &end[axis]) * &below);
        let is_even = place[axis].to_bits() & 1 == 0;
        let is_beyond = |end: &Vector| end[axis] == here[axis];
        (twice > least || (is_even && twice == least) || is_beyond(low))
            && (twice < most || (is_even && twice == most) || is_beyond(high))
    }))
}
