//! Arcs of circles: the shorter way around a center from one point to another.
//!
//! All points are found by square roots and sums, which are the same on every machine: directions are halved, and where they are nearly
//! parallel they are divided along their chord.
//!
//! Cost: O(1) a point.

use delone_predicates::{Sign, orient2d};

use crate::error::{ArcProblem, Error};

/// Halvings of the directions until these are divided along their chord: half a turn is in pieces of less than three degrees then, and parts of their
/// angles are those of their chords up to one in ten thousand.
const HALVINGS: usize = 6;
/// The distances of both ends from the center differ by at most this factor: what rounding to four digits in a file makes of them. Between the ends
/// the distance changes evenly.
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

/// A direction with its length.
type Spoke = ([f64; 2], f64);

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
        let [(_, r), (_, s)] = arc.spokes();
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

    fn spokes(&self) -> [Spoke; 2] {
        self.ends.map(|end| {
            let u = [end[0] - self.center[0], end[1] - self.center[1]];
            (u, (u[0] * u[0] + u[1] * u[1]).sqrt())
        })
    }

    fn at_spoke(&self, spoke: Spoke) -> [f64; 2] {
        [0, 1].map(|k| self.center[k] + spoke.0[k])
    }

    /// The middle of the arc, rounded; the same from both sides.
    pub fn middle(&self) -> [f64; 2] {
        self.at_spoke(halfway(self.spokes()))
    }

    /// The point at this part of the angle from the first end, from 0 to 1, rounded.
    pub fn at(&self, part: f64) -> [f64; 2] {
        if part == 0.0 || part == 1.0 {
            return self.ends[usize::from(part == 1.0)];
        }
        let ([mut from, mut to], mut part) = (self.spokes(), part);
        for _ in 0..HALVINGS {
            let half = halfway([from, to]);
            if part < 0.5 {
                (to, part) = (half, 2.0 * part);
            } else {
                (from, part) = (half, 2.0 * part - 1.0);
            }
            if part == 0.0 {
                return self.at_spoke(from);
            }
        }
        let chord = [0, 1].map(|k| from.0[k] + part * (to.0[k] - from.0[k]));
        self.at_spoke(of_length(chord, from.1 + part * (to.1 - from.1)))
    }

    /// The point at a distance from the first end, or the second, rounded.
    pub(super) fn at_distance(&self, from_second: bool, distance: f64) -> [f64; 2] {
        let [mut own, mut other] = self.spokes();
        let mut end = self.ends[0];
        if from_second {
            (own, other, end) = (other, own, self.ends[1]);
        }
        let (u, r) = own;
        // Across the direction of the end, towards the other one.
        let turns_left = u[0] * other.0[1] - u[1] * other.0[0] > 0.0;
        let across = if turns_left { [-u[1], u[0]] } else { [u[1], -u[0]] };
        let half = 0.5 * (distance / r);
        let (inwards, along) = (2.0 * half * half, 2.0 * half * (1.0 - half * half).max(0.0).sqrt());
        [0, 1].map(|k| end[k] + (along * across[k] - inwards * u[k]))
    }

    /// The height of the arc over its chord, rounded.
    pub fn sagitta(&self) -> f64 {
        let (middle, [a, b]) = (self.middle(), self.ends);
        let apart = [0, 1].map(|k| middle[k] - a[k].midpoint(b[k]));
        (apart[0] * apart[0] + apart[1] * apart[1]).sqrt()
    }

    /// Points that divide the arc into equal ones of at most 11.25 degrees, without the ends; they are 2^k - 1.
    pub fn inner_points(&self) -> Vec<[f64; 2]> {
        let mut points = Vec::new();
        self.divide(&mut points);
        points
    }

    fn divide(&self, points: &mut Vec<[f64; 2]>) {
        let ([a, b], middle) = (self.ends, self.middle());
        let chord = [b[0] - a[0], b[1] - a[1]];
        let is_short = self.sagitta() <= PIECE_RISE * (chord[0] * chord[0] + chord[1] * chord[1]).sqrt();
        if is_short || middle == a || middle == b || !middle.iter().all(|x| x.is_finite()) {
            return;
        }
        Self { ends: [a, middle], ..*self }.divide(points);
        points.push(middle);
        Self { ends: [middle, b], ..*self }.divide(points);
    }
}

/// The direction in the middle of two.
fn halfway([(u, r), (v, s)]: [Spoke; 2]) -> Spoke {
    of_length([u[0] / r + v[0] / s, u[1] / r + v[1] / s], r.midpoint(s))
}

/// A direction, with a length.
fn of_length(u: [f64; 2], length: f64) -> Spoke {
    let own = (u[0] * u[0] + u[1] * u[1]).sqrt();
    (u.map(|x| x * (length / own)), length)
}
