//! Arcs of circles: the shorter way around a center from one point to another.
//!
//! Points are found from the chord: how far they are along it, and how high over it. So of flat arcs, with centers far away, no digits are lost.
//! All is done by sums, products and square roots, which are the same on every machine.
//!
//! Cost: O(1) a point.

use delone_predicates::{Sign, orient2d};

use crate::error::{ArcProblem, Error};
use crate::sorting;

/// Halvings of an arc until it is divided along its chord: half a turn is in pieces of less than three degrees then, and parts of their angles are
/// those of their chords up to one in ten thousand.
const HALVINGS: usize = 6;
/// The distances of both ends from the center differ by at most this factor: what rounding to four digits in a file makes of them.
const RADII_FACTOR: f64 = 1.001;
/// The largest rise of a piece over its chord, as a part of the chord: that of an arc of 11.25 degrees, 32 of which make a circle. Their
/// chords are within half a percent of the radius.
const PIECE_RISE: f64 = 0.0246;

/// An arc of a circle, of less than half a turn.
///
/// ```
/// use delone::Arc2;
///
/// let quarter = Arc2::new([[2.0, 0.0], [0.0, 2.0]], [0.0, 0.0])?;
/// let [x, y] = quarter.middle();
/// assert!(x == y && (x * x + y * y - 4.0).abs() < 1e-12);
/// assert_eq!(quarter.inner_points().len(), 7); // chords of 11.25 degrees
/// # Ok::<(), delone::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arc2 {
    ends: [[f64; 2]; 2],
    center: [f64; 2],
}

/// A chord: its middle, its direction, the one across it to where the arc is, half of its length, and the distance of the center from it.
struct Chord {
    middle: [f64; 2],
    along: [f64; 2],
    across: [f64; 2],
    half: f64,
    depth: f64,
}

impl Arc2 {
    /// The shorter arc around a center from the first end to the second.
    ///
    /// # Errors
    /// [`Error::Arc`] if a coordinate is not finite, the ends are half a turn apart or equal, or their distances from the center differ by more
    /// than a thousandth. The segment is 0.
    pub fn new(ends: [[f64; 2]; 2], center: [f64; 2]) -> Result<Self, Error> {
        let arc = Self { ends, center };
        let flawed = |problem| Err(Error::Arc { segment: 0, problem });
        if !ends.as_flattened().iter().chain(&center).all(|x| x.is_finite()) {
            return flawed(ArcProblem::NotFinite);
        }
        if orient2d(ends[0], ends[1], center) == Sign::Zero {
            return flawed(ArcProblem::HalfTurn);
        }
        let [r, s] = ends.map(|end| length(from(center, end)));
        let factor = r.max(s) / r.min(s);
        if factor > RADII_FACTOR {
            return flawed(ArcProblem::Radii(factor));
        }
        Ok(arc)
    }

    /// An arc whose ends need not be at equal distances from the center.
    pub(super) fn of(ends: [[f64; 2]; 2], center: [f64; 2]) -> Self {
        Self { ends, center }
    }

    /// The center of the circle.
    pub fn center(&self) -> [f64; 2] {
        self.center
    }

    fn chord(&self) -> Chord {
        let [a, b] = self.ends;
        let whole = length(from(a, b));
        let along = from(a, b).map(|x| x / whole);
        let middle = [a[0].midpoint(b[0]), a[1].midpoint(b[1])];
        let left = [-along[1], along[0]];
        let deep = from(middle, self.center);
        let depth = (deep[0] * left[0] + deep[1] * left[1]).abs();
        let across = if orient2d(a, b, self.center).is_positive() { left.map(|x| -x) } else { left };
        Chord { middle, along, across, half: 0.5 * whole, depth }
    }

    /// The middle of the arc, rounded; the same from both sides.
    pub fn middle(&self) -> [f64; 2] {
        self.chord().at(0.0)
    }

    /// The point at this part of the angle from the first end, from 0 to 1, rounded.
    pub fn at(&self, part: f64) -> [f64; 2] {
        let (mut piece, mut part) = (*self, part);
        for _ in 0..HALVINGS {
            if part == 0.0 || part == 1.0 {
                return piece.ends[usize::from(part == 1.0)];
            }
            let middle = piece.middle();
            if part < 0.5 {
                (piece.ends[1], part) = (middle, 2.0 * part);
            } else {
                (piece.ends[0], part) = (middle, 2.0 * part - 1.0);
            }
        }
        let chord = piece.chord();
        chord.at((2.0 * part - 1.0) * chord.half)
    }

    /// The point at a distance from the first end, or the second, rounded.
    pub(super) fn at_distance(&self, from_second: bool, distance: f64) -> [f64; 2] {
        let [end, other] = if from_second { [self.ends[1], self.ends[0]] } else { self.ends };
        let outwards = from(self.center, end);
        let radius = length(outwards);
        let u = outwards.map(|x| x / radius);
        // Across the direction of the end, towards the other one.
        let turns_left = orient2d(self.center, end, other).is_positive();
        let across = if turns_left { [-u[1], u[0]] } else { [u[1], -u[0]] };
        let half = 0.5 * (distance / radius);
        let (inwards, along) = (distance * half, distance * (1.0 - half * half).max(0.0).sqrt());
        [0, 1].map(|k| end[k] + (along * across[k] - inwards * u[k]))
    }

    /// The point that is seen from the center in the direction of another one, rounded; none if that is beyond an end.
    pub(super) fn towards(&self, p: [f64; 2]) -> Option<[f64; 2]> {
        let chord = self.chord();
        let w = from(chord.middle, p);
        let [x, y] = [chord.along, chord.across].map(|u| w[0] * u[0] + w[1] * u[1]);
        let x = x * (length([chord.half, chord.depth]) / length([x, y + chord.depth]));
        (y > 0.0 && x.abs() < chord.half).then(|| chord.at(x))
    }

    /// The height of the arc over its chord, rounded.
    pub fn sagitta(&self) -> f64 {
        self.chord().height(0.0)
    }

    /// Whether another arc over the same chord is as high on the same side, but for what rounding its center may do.
    pub(super) fn is_nearly(&self, other: &Self) -> bool {
        let [a, b] = self.ends;
        let (heights, is_left) = ([self, other].map(Self::sagitta), orient2d(a, b, self.center));
        let factor = heights[0].max(heights[1]) / heights[0].min(heights[1]);
        self.center == other.center || (is_left == orient2d(a, b, other.center) && factor <= RADII_FACTOR)
    }

    /// Points that divide the arc into equal ones of at most 11.25 degrees, without the ends; they are 2^k - 1.
    pub fn inner_points(&self) -> Vec<[f64; 2]> {
        let mut points = Vec::new();
        self.divide(&mut points);
        points
    }

    fn divide(&self, points: &mut Vec<[f64; 2]>) {
        let ([a, b], middle, chord) = (self.ends, self.middle(), self.chord());
        let is_flat = chord.height(0.0) <= PIECE_RISE * (2.0 * chord.half);
        if is_flat || middle == a || middle == b || !middle.iter().all(|x| x.is_finite()) {
            return;
        }
        Self { ends: [a, middle], ..*self }.divide(points);
        points.push(middle);
        Self { ends: [middle, b], ..*self }.divide(points);
    }
}

/// Which arcs, by their number in the list, have their chord in common with another segment that is not the same arc. Such an arc must be
/// divided, or one edge would be both. Arcs are segments by their index, with the centers of their circles.
///
/// Cost: O(m log m) for m segments.
///
/// # Panics
///
/// If there is no such point or segment.
///
/// ```
/// use delone::arcs_over_shared_chords;
///
/// // A cap: a flat arc, and the straight line below.
/// let points = [[0.0, 0.0], [1.0, 0.0]];
/// let arcs = [(0, [0.5, 9.0])];
/// assert_eq!(arcs_over_shared_chords(&points, &[[0, 1], [1, 0]], &arcs), [0]);
/// assert!(arcs_over_shared_chords(&points, &[[0, 1]], &arcs).is_empty());
/// ```
pub fn arcs_over_shared_chords(
    points: &[[f64; 2]],
    segments: &[[usize; 2]],
    arcs: &[(usize, [f64; 2])],
) -> Vec<usize> {
    let mut of_segment: Vec<Option<usize>> = vec![None; segments.len()];
    arcs.iter().enumerate().for_each(|(k, arc)| of_segment[arc.0] = Some(k));
    // Zero has no sign here.
    let place = |i: usize| points[i].map(|x| (x + 0.0).to_bits());
    let chord = |(ends, arc): (&[usize; 2], Option<usize>)| {
        let [a, b] = ends.map(place);
        ([a.min(b), a.max(b)], arc)
    };
    let mut chords: Vec<_> = segments.iter().zip(of_segment).map(chord).collect();
    sorting::by_key(&mut chords, |chord| *chord);
    let arc = |k: usize| Arc2::of(segments[arcs[k].0].map(|i| points[i]), arcs[k].1);
    let mut shared = Vec::new();
    for same in chords.chunk_by(|one, other| one.0 == other.0) {
        let own: Vec<usize> = same.iter().filter_map(|chord| chord.1).collect();
        let Some(&first) = own.first() else { continue };
        if own.len() < same.len() || own.iter().any(|&k| !arc(first).is_nearly(&arc(k))) {
            shared.extend(own);
        }
    }
    sorting::by_key(&mut shared, |k| *k);
    shared
}

impl Chord {
    /// The height of the arc over a place on the chord, by its distance from the middle.
    fn height(&self, x: f64) -> f64 {
        let (half, depth) = (self.half, self.depth);
        // Of radius squared minus x squared, without the digits that the difference would lose.
        let rest = (half - x) * (half + x);
        rest / ((rest + depth * depth).sqrt() + depth)
    }

    /// The point of the arc over a place on the chord.
    fn at(&self, x: f64) -> [f64; 2] {
        let y = self.height(x);
        [0, 1].map(|k| self.middle[k] + (x * self.along[k] + y * self.across[k]))
    }
}

fn from(p: [f64; 2], q: [f64; 2]) -> [f64; 2] {
    [q[0] - p[0], q[1] - p[1]]
}

fn length(v: [f64; 2]) -> f64 {
    (v[0] * v[0] + v[1] * v[1]).sqrt()
}
