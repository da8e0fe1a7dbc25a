//! Follows lines from triangle to triangle.
//!
//! For each level and each triangle that it crosses there is one *crossing*: in through the edge that goes down, out through the one
//! that goes up, so the higher ground is on the left. Crossings are numbered by triangle, the levels of each in order, which is all
//! the memory that following takes.

use super::sheet::{Edge, Sheet, edge};
use crate::error::Error;
use delone_predicates::lexicographic;

/// The largest number of points of all contours. More are refused before memory is taken.
const MAX_CONTOUR_POINTS: u64 = 1 << 31;

/// A surface cut at levels.
#[derive(Debug)]
pub(super) struct Cut<'a> {
    pub(super) sheet: &'a Sheet,
    heights: &'a [f64],
    pub(super) levels: &'a [f64],
    /// For each vertex the number of levels that it is not below: its band.
    pub(super) band: Vec<u32>,
    /// For each triangle the number of its first crossing, and that of all.
    first: Vec<u64>,
}

/// A line as it is followed: all of its points, equal ones too.
#[derive(Debug)]
pub(super) struct Chain {
    /// The number of its level.
    pub(super) level: usize,
    pub(super) is_closed: bool,
    /// The edges that it comes in and goes out through, on the border where it is open.
    pub(super) ends: [Edge; 2],
    pub(super) points: Vec<[f64; 2]>,
}

impl<'a> Cut<'a> {
    pub(super) fn new(sheet: &'a Sheet, heights: &'a [f64], levels: &'a [f64]) -> Result<Self, Error> {
        let band = heights.iter().map(|z| levels.partition_point(|level| level <= z) as u32).collect();
        let mut cut = Self { sheet, heights, levels, band, first: Vec::new() };
        let mut count = 0;
        cut.first.reserve(sheet.corners.len() + 1);
        cut.first.push(0);
        for t in 0..sheet.corners.len() as u32 {
            let [low, high] = cut.bands_of(t);
            count += u64::from(high - low);
            cut.first.push(count);
        }
        if count > MAX_CONTOUR_POINTS {
            return Err(Error::Parameter {
                name: "the number of points of the contours",
                value: count as f64,
                range: "at most 2^31: choose fewer levels",
            });
        }
        Ok(cut)
    }

    /// The lowest and the highest band of a triangle's corners.
    pub(super) fn bands_of(&self, t: u32) -> [u32; 2] {
        let [a, b, c] = self.sheet.corners[t as usize].map(|v| self.band[v as usize]);
        [a.min(b).min(c), a.max(b).max(c)]
    }

    /// The number of a crossing; levels that do not cross the triangle have none.
    fn crossing(&self, t: u32, level: usize) -> usize {
        (self.first[t as usize] + level as u64 - u64::from(self.bands_of(t)[0])) as usize
    }

    /// Whether a vertex is above a level or at it.
    fn is_above(&self, v: u32, level: usize) -> bool {
        self.band[v as usize] as usize > level
    }

    /// The edges of a triangle that a level which crosses it comes in and goes out through: down, and up.
    fn gates(&self, t: u32, level: usize) -> [Edge; 2] {
        let above = self.sheet.corners[t as usize].map(|v| self.is_above(v, level));
        let gate =
            |up: bool| (0..3).find(|k| above[(k + 1) % 3] != up && above[(k + 2) % 3] == up).unwrap_or(0);
        [edge(t, gate(false)), edge(t, gate(true))]
    }

    /// Where a level crosses an edge: from its ends in lexicographic order, monotone in the level along each axis, and an end where
    /// that is at the level.
    pub(super) fn point(&self, e: Edge, level: usize) -> [f64; 2] {
        let [v, w] = self.sheet.ends(e).map(|v| v as usize);
        let (p, q) = (self.sheet.points[v], self.sheet.points[w]);
        let ((p, low), (q, high)) = if lexicographic(p, q).is_lt() {
            ((p, self.heights[v]), (q, self.heights[w]))
        } else {
            ((q, self.heights[w]), (p, self.heights[v]))
        };
        let level = self.levels[level];
        if level == low {
            return p;
        }
        if level == high {
            return q;
        }
        // Half of each number, where the difference would be beyond all numbers.
        let scale = if (high - low).is_finite() { 1.0 } else { 0.5 };
        let [from_low, from_high] = [level * scale - low * scale, high * scale - level * scale];
        let part = from_low.abs().min(from_high.abs()) / (high * scale - low * scale).abs();
        // From the end that is nearer: beside it nothing is lost.
        let (near, far) = if from_low.abs() <= from_high.abs() { (p, q) } else { (q, p) };
        [0, 1].map(|k| {
            let middle = near[k] / 2.0 + far[k] / 2.0;
            let span = far[k] - near[k];
            let at = if span.is_finite() {
                near[k] + part * span
            } else {
                near[k] + 2.0 * part * (middle - near[k])
            };
            at.clamp(near[k].min(middle), near[k].max(middle))
        })
    }

    /// All lines: open ones by level, then closed ones by level, as they are found.
    pub(super) fn chains(&self) -> Vec<Chain> {
        let triangles = 0..self.sheet.corners.len() as u32;
        let mut seen = vec![false; self.first.last().map_or(0, |&count| count as usize)];
        let mut chains = Vec::new();
        for closed in [false, true] {
            for t in triangles.clone() {
                let [low, high] = self.bands_of(t);
                for level in low as usize..high as usize {
                    if seen[self.crossing(t, level)] {
                        continue;
                    }
                    let start = self.gates(t, level)[0];
                    if closed || self.sheet.beyond(start).is_none() {
                        chains.push(self.follow(start, level, &mut seen));
                    }
                }
            }
        }
        chains
    }

    /// The line that comes in through an edge.
    fn follow(&self, start: Edge, level: usize, seen: &mut [bool]) -> Chain {
        let mut points = vec![self.point(start, level)];
        let mut t = start / 3;
        loop {
            seen[self.crossing(t, level)] = true;
            let out = self.gates(t, level)[1];
            let next = self.sheet.beyond(out);
            let is_closed = next == Some(start / 3);
            if !is_closed {
                points.push(self.point(out, level));
            }
            match next {
                Some(next) if !is_closed => t = next,
                _ => return Chain { level, is_closed, ends: [start, out], points },
            }
        }
    }
}
