//! Walks along longitudes: the turns around the world between neighbors, and the crossings of the meridian of 180 degrees.
//!
//! A walk is on a line without end, in strips of 360 degrees. A place on it is twice the number of its strip; an odd number is the
//! border between two strips. Longitudes up to 540 are moved by whole turns into [-180, 180], which is exact.

use delone_io::Graph;
use delone_predicates::ordinate;

/// A whole turn around the world, in degrees of longitude.
const TURN_DEGREES: f64 = 360.0;
/// Half of a turn: the meridian where strips meet.
pub(super) const HALF_TURN_DEGREES: f64 = 180.0;
/// The largest longitude that one turn brings into a strip.
pub(super) const LARGEST_LONGITUDE_DEGREES: f64 = 540.0;
/// The latitude of the north pole.
pub(super) const POLE_DEGREES: f64 = 90.0;

/// How many turns to take from a longitude, and what is then left in [-180, 180].
pub(super) fn reduced(x: f64) -> (i32, f64) {
    match x {
        x if x > HALF_TURN_DEGREES => (1, x - TURN_DEGREES),
        x if x < -HALF_TURN_DEGREES => (-1, x + TURN_DEGREES),
        x => (0, x),
    }
}

/// The difference of two numbers, and the error of its rounding.
fn difference(a: f64, b: f64) -> (f64, f64) {
    let rounded = a - b;
    let taken = a - rounded;
    (rounded, (a - (rounded + taken)) + (taken - b))
}

/// Whether the first longitude is more than half a turn above the other.
fn is_far_above(x: f64, other: f64) -> bool {
    let (rounded, error) = difference(x, other);
    rounded > HALF_TURN_DEGREES || rounded == HALF_TURN_DEGREES && error > 0.0
}

/// Whether an edge is longer than half a turn. A whole turn along one parallel is meant as it is.
pub(super) fn jumps(a: [f64; 2], b: [f64; 2]) -> bool {
    let (rounded, error) = difference(a[0], b[0]);
    let is_around = rounded.abs() == TURN_DEGREES && error == 0.0 && a[1] == b[1];
    !is_around && (is_far_above(a[0], b[0]) || is_far_above(b[0], a[0]))
}

/// How many turns an edge adds to what is left of its longitudes.
pub(super) fn turns(a: [f64; 2], b: [f64; 2]) -> i32 {
    let ((before, x), (after, y)) = (reduced(a[0]), reduced(b[0]));
    if jumps(a, b) { i32::from(is_far_above(x, y)) - i32::from(is_far_above(y, x)) } else { after - before }
}

/// A corner of a part.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Corner {
    /// A point of the input.
    Given(usize),
    /// A point that was made.
    Made(usize),
}

/// A point that was made: all of it but its longitude.
#[derive(Clone, Debug)]
pub(super) struct Made {
    pub(super) latitude: f64,
    /// The height, where points have them, and the attributes.
    pub(super) height: Option<f64>,
    pub(super) attributes: Vec<f64>,
}

impl Made {
    /// A point with the height and the attributes of a point of the input.
    pub(super) fn copy(graph: &Graph, i: usize) -> Self {
        Self {
            latitude: graph.cloud.xy[i][1],
            height: graph.cloud.z.as_ref().and_then(|z| z.get(i).copied()),
            attributes: graph.attributes.row(i).to_vec(),
        }
    }

    /// The place of the edge from `ends[0]` to `ends[1]` at longitude `x`, where the second is so many turns farther than it says. Each number
    /// is rounded once.
    fn crossing(graph: &Graph, ends: [usize; 2], x: f64, turns: i32) -> Self {
        let [a, b] = ends.map(|i| reduced(graph.cloud.xy[i][0]).1);
        let at = |p: f64, q: f64| {
            let between = || ordinate(x, [a, p], [b, q], f64::from(turns) * TURN_DEGREES);
            if p.is_finite() && q.is_finite() { between().unwrap_or(f64::NAN) } else { f64::NAN }
        };
        let [first, second] = ends.map(|i| Self::copy(graph, i));
        Self {
            latitude: at(first.latitude, second.latitude),
            height: first.height.zip(second.height).map(|(p, q)| at(p, q)),
            attributes: first.attributes.iter().zip(&second.attributes).map(|(&p, &q)| at(p, q)).collect(),
        }
    }
}

/// On which border of a strip a corner is, if on any.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    Left,
    Right,
    Inside,
}

/// A corner, and its place on the line without end.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stop {
    pub(super) corner: Corner,
    pub(super) place: i32,
}

impl Stop {
    /// The border of a strip that it is on.
    pub(super) fn side(self, strip: i32) -> Side {
        match self.place - strip {
            1 => Side::Right,
            -1 => Side::Left,
            _ => Side::Inside,
        }
    }
}

/// A piece of an edge, in one strip.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    pub(super) from: Stop,
    pub(super) to: Stop,
    /// The place of the strip; nothing along a border.
    pub(super) strip: Option<i32>,
    /// The segment that it is a piece of.
    pub(super) segment: usize,
}

/// A walk along segments, one after another.
pub(super) struct Walk<'a> {
    graph: &'a Graph,
    pub(super) pieces: Vec<Piece>,
    /// The turns at the end of it, in what is left of its longitude.
    turn: i32,
}

impl<'a> Walk<'a> {
    pub(super) fn from(graph: &'a Graph, start: usize) -> Self {
        Self { graph, pieces: Vec::new(), turn: reduced(graph.cloud.xy[start][0]).0 }
    }

    /// Goes along all segments of a ring. Returns how often the ring goes around the world, to the east.
    pub(super) fn around(&mut self, ring: std::ops::Range<usize>, made: &mut Vec<Made>) -> i32 {
        let start = self.turn;
        ring.for_each(|segment| self.go(segment, made));
        self.turn - start
    }

    /// Goes along a segment that starts where the last one ended.
    pub(super) fn go(&mut self, segment: usize, made: &mut Vec<Made>) {
        let ends = self.graph.segments[segment];
        let [a, b] = ends.map(|i| self.graph.cloud.xy[i]);
        let (turn, turns) = (self.turn, turns(a, b));
        self.turn += turns;
        let mut from = Stop { corner: Corner::Given(ends[0]), place: place(turn, a[0]) };
        let end = Stop { corner: Corner::Given(ends[1]), place: place(self.turn, b[0]) };
        let step = (end.place - from.place).signum();
        loop {
            // The next border after the place, which is odd.
            let border = from.place + if from.place % 2 == 0 { step } else { 2 * step };
            let is_last = step == 0 || (end.place - border) * step <= 0;
            let to = if is_last {
                end
            } else {
                let x = HALF_TURN_DEGREES + f64::from((border - 1) / 2 - turn) * TURN_DEGREES;
                made.push(Made::crossing(self.graph, ends, x, turns));
                Stop { corner: Corner::Made(made.len() - 1), place: border }
            };
            let strip = match (from.place % 2 == 0, to.place % 2 == 0) {
                (true, _) => Some(from.place),
                (_, true) => Some(to.place),
                _ if from.place == to.place => None,
                _ => Some(i32::midpoint(from.place, to.place)),
            };
            self.pieces.push(Piece { from, to, strip, segment });
            if is_last {
                return;
            }
            from = to;
        }
    }
}

/// The place of a longitude of which so many turns were taken.
fn place(turn: i32, x: f64) -> i32 {
    let left = reduced(x).1;
    2 * turn + i32::from(left == HALF_TURN_DEGREES) - i32::from(left == -HALF_TURN_DEGREES)
}

#[cfg(test)]
mod tests {
    use super::{jumps, turns};

    #[test]
    fn half_a_turn_is_decided_exactly() {
        let at = |x: f64| [x, 1.0];
        assert!(!jumps(at(-90.0), at(90.0)) && !jumps(at(-180.0), at(180.0)));
        assert!(!jumps(at(-1e-20), at(180.0 - f64::EPSILON * 128.0)));
        // The difference is rounded to 180.
        assert!(jumps(at(-1e-20), at(180.0)) && jumps(at(180.0), at(-1e-20)));
        assert!(!jumps(at(1e-20), at(180.0)));
        assert!(jumps([-180.0, 1.0], [180.0, 2.0]), "along the meridian");
        let of = |a: f64, b: f64| turns(at(a), at(b));
        assert_eq!([of(179.0, -179.0), of(-179.0, 179.0), of(10.0, 20.0)], [1, -1, 0]);
        assert_eq!([of(170.0, 190.0), of(190.0, 170.0), of(190.0, -175.0)], [1, -1, 0]);
        assert_eq!([of(-180.0, 180.0), of(0.0, 360.0), of(540.0, 180.0), of(540.0, -180.0)], [0, 1, -1, 1]);
    }
}
