//! Arcs: of circles, and between vertices of polylines, as chords with the centers of their circles.
//!
//! Quarters of a turn or less are divided as [`Arc2`] says; larger arcs are cut before. A bulge is the tangent of a quarter of the angle of an
//! arc, positive if the arc turns to the left.

use std::f64::consts::SQRT_2;

use delone::Arc2;

/// Positions along a line, with the centers of those of its segments that are chords: the number of a segment is that of its first position.
#[derive(Clone, Debug, Default)]
pub(super) struct Path {
    pub(super) points: Vec<[f64; 3]>,
    pub(super) centers: Vec<(usize, [f64; 3])>,
    /// How many ellipses and splines these are.
    pub(super) curves: usize,
    /// How many arcs these are.
    pub(super) arcs: usize,
    /// How many are chords alone, because the numbers of their circles are too large or too small.
    pub(super) lost: usize,
}

/// The bulge of a quarter of a turn.
const QUARTER_BULGE: f64 = SQRT_2 - 1.0;

impl Path {
    /// A line through positions.
    pub(super) fn straight(points: Vec<[f64; 3]>) -> Self {
        Self { points, ..Self::default() }
    }

    /// A line through positions, each with the bulge of the arc to the next one. The last has one if the line is closed.
    pub(super) fn with_bulges(vertices: &[([f64; 3], f64)], is_closed: bool) -> Self {
        let mut path = Self::default();
        for (i, &(from, bulge)) in vertices.iter().enumerate() {
            path.points.push(from);
            let next = vertices.get(i + 1).or(vertices.first().filter(|_| is_closed));
            // One that is almost nothing is a straight line.
            let is_bulge = bulge.is_nan() || bulge.abs() >= f64::MIN_POSITIVE;
            if let Some(&(to, _)) = next.filter(|next| is_bulge && next.0 != from) {
                let before = path.centers.len();
                if bulge.is_finite() {
                    path.bulge(from, to, bulge);
                }
                let is_arc = path.centers.len() > before;
                path.arcs += usize::from(is_arc);
                path.lost += usize::from(!is_arc);
            }
        }
        path
    }

    /// The arc of a circle, counter-clockwise between two angles in degrees; all of it if there are none.
    pub(super) fn around(center: [f64; 3], radius: f64, angles: Option<[f64; 2]>) -> Self {
        let [first, last] = angles.unwrap_or([0.0, 360.0]);
        let turn = (last - first).rem_euclid(360.0);
        let turn = if turn > 0.0 { turn } else { 360.0 };
        let count = (turn / 90.0).ceil().max(1.0);
        let mut path = Self { arcs: 1, ..Self::default() };
        let at = |k: f64| {
            // The end as it was given, not as it is found from the beginning.
            let angle = if k < count || angles.is_none() { first + turn * (k / count) } else { last };
            let [cosine, sine] = cosine_and_sine(angle);
            [center[0] + radius * cosine, center[1] + radius * sine, center[2]]
        };
        let mut k = 0.0;
        while k < count {
            path.points.push(at(k));
            path.chords(at(k), at(k + 1.0), center);
            k += 1.0;
        }
        if angles.is_some() {
            path.points.push(at(count));
        }
        if path.centers.is_empty() {
            (path.arcs, path.lost) = (0, 1);
        }
        path
    }

    /// Adds the positions between two, of which the first is there.
    fn bulge(&mut self, from: [f64; 3], to: [f64; 3], bulge: f64) {
        let middle = [0, 1, 2].map(|k| from[k].midpoint(to[k]));
        // To the left of the way.
        let across = [from[1] - to[1], to[0] - from[0]];
        let beside = |times: f64| [middle[0] + times * across[0], middle[1] + times * across[1], middle[2]];
        if bulge.abs() > QUARTER_BULGE {
            let apex = beside(-0.5 * bulge);
            let half = bulge / (1.0 + (1.0 + bulge * bulge).sqrt());
            self.bulge(from, apex, half);
            self.points.push(apex);
            self.bulge(apex, to, half);
        } else {
            self.chords(from, to, beside((1.0 / bulge - bulge) / 4.0));
        }
    }

    /// Adds the positions between the ends of an arc, of which the first is there. An arc that is none is straight.
    fn chords(&mut self, from: [f64; 3], to: [f64; 3], center: [f64; 3]) {
        let flat = |[x, y, _]: [f64; 3]| [x, y];
        let Ok(arc) = Arc2::new([from, to].map(flat), flat(center)) else { return };
        if !arc.middle().iter().all(|x| x.is_finite()) {
            return;
        }
        let start = self.points.len() - 1;
        self.points.extend(arc.inner_points().into_iter().map(|[x, y]| [x, y, from[2]]));
        self.centers.extend((start..self.points.len()).map(|segment| (segment, center)));
    }
}

/// Of an angle in degrees; exact at right angles.
pub(super) fn cosine_and_sine(degrees: f64) -> [f64; 2] {
    match degrees.rem_euclid(360.0) {
        0.0 => [1.0, 0.0],
        90.0 => [0.0, 1.0],
        180.0 => [-1.0, 0.0],
        270.0 => [0.0, -1.0],
        angle => [libm::cos(angle.to_radians()), libm::sin(angle.to_radians())],
    }
}
