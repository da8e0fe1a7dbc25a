//! Vertices on constraints, at distances as sizes say.
//!
//! Sizes depend on the gaps between constraints, and gaps are seen only between vertices on these. So constraints are divided again and
//! again, from the beginning each time, until that changes little.
//!
//! Cost: at most eight constrained triangulations of what was given and the vertices on constraints.

use delone_predicates::lexicographic;

use super::Frontal;
use super::rings::{Corners, SAME_DISTANCE};
use super::samples::Samples;
use crate::error::Error;
use crate::ids::{EdgeId, Place};
use crate::plane::arc::Arc2;
use crate::sorting;

/// Rounds at most, and at least.
const DIVISION_ROUNDS: std::ops::RangeInclusive<usize> = 4..=8;
/// The division is settled if the number of vertices changes by at most one in so many.
const SETTLED_PART: usize = 50;
/// A part of a constraint is at most so many times as long as its size: one of 1.28 sizes stays whole. With 1.12 or 1.2 such ones are halved, and a
/// ring with 100 sides has 2.5 times as large steps inside.
const LONGEST_PART: f64 = 1.3;
/// Vertices on constraints, from which on the lengths that are asked for are an error: two gigabytes of memory.
const MOST_ON_CONSTRAINTS: f64 = (1_u64 << 26) as f64;

/// A constraint edge as it was given.
#[derive(Clone, Debug)]
pub(super) struct Line {
    /// The lexicographically lesser end first.
    pub(super) ends: [Place; 2],
    pub(super) length: f64,
    /// The length that is wanted of edges in the regions beside it.
    pub(super) wanted: f64,
    /// The arc that it is the chord of.
    arc: Option<Arc2>,
    /// Where it is divided, as parts of its length.
    parts: Vec<f64>,
    /// The vertices there, as far as there is room for them.
    vertices: Vec<(f64, Place)>,
}

impl Frontal<'_, '_> {
    /// Divides all constraints in the mesh.
    pub(super) fn divide_constraints(&mut self) -> Result<(), Error> {
        let mut lines = self.lines();
        let mut corners = self.corners(&lines);
        let (layer, known) = (self.mesher.layer.clone(), self.mesher.known.clone());
        let mut last = 0;
        for round in 1..=*DIVISION_ROUNDS.end() {
            if round > 1 {
                self.mesher.layer.clone_from(&layer);
                self.mesher.known.clone_from(&known);
                self.mesher.restart();
            }
            for line in &mut lines {
                self.divide(line);
            }
            self.mesher.rules.go_on(self.mesher.count)?;
            self.find_sizes(|frontal, p, q| frontal.is_joined(&corners, p, q));
            // Pieces of an earlier refinement are as short as they are for reasons of their own.
            let is_whole =
                |line: &&Line| line.ends.iter().all(|end| self.mesher.known[end.index()].is_input());
            for line in lines.iter().filter(is_whole) {
                for end in line.ends {
                    self.sizes.set(end, self.sizes.at(end).min(line.length));
                }
            }
            for &(p, size) in &self.limits {
                self.sizes.set(p, self.sizes.at(p).min(size));
            }
            self.limit_growth();
            let count = self.mesher.count;
            let is_settled = count.abs_diff(last) <= last / SETTLED_PART;
            if round == *DIVISION_ROUNDS.end() || (DIVISION_ROUNDS.contains(&round) && is_settled) {
                break;
            }
            last = count;
            let mut room = Room::new(self.mesher.rules.most());
            self.find_rings(&mut corners, &lines, &mut room)?;
            for (k, line) in lines.iter_mut().enumerate() {
                line.parts = self.parts_of(line, &rings_on(k, line, &corners), &mut room)?;
            }
        }
        // Where there was no room for a vertex now, refinement may find some.
        self.mesher.refused.clear();
        Ok(())
    }

    /// The constraints that may be divided, in an order of geometry.
    fn lines(&self) -> Vec<Line> {
        let mesh = &self.mesher.layer.mesh;
        let is_line = |e: &EdgeId| {
            [*e, mesh.twin(*e)].iter().any(|e| self.mesher.is_inside(e.triangle()))
                && self.mesher.refusal(*e).is_none()
        };
        let line = |e: EdgeId| {
            let ends = self.mesher.ends(e);
            let length = self.distance(ends[0], ends[1]);
            let beside = [e, mesh.twin(e)].map(|e| self.mesher.rules.length_in(mesh.domain(e.triangle())));
            let (wanted, arc) = (beside[0].min(beside[1]), self.mesher.arc(ends));
            Line { ends, length, wanted, arc, parts: Vec::new(), vertices: Vec::new() }
        };
        let mut lines: Vec<Line> = mesh.fixed_edges().filter(is_line).map(line).collect();
        // Squares of lengths leave the range of numbers sooner than coordinates.
        lines.retain(|line| line.length > 0.0 && line.length.is_finite());
        sorting::by(&mut lines, |one, other| {
            let order = |k: usize| lexicographic(self.point(one.ends[k]), self.point(other.ends[k]));
            order(0).then_with(|| order(1))
        });
        lines
    }

    /// The length that is wanted of edges on a constraint.
    pub(super) fn wanted_on(&self, line: &Line, part: f64) -> f64 {
        line.wanted.min(self.mesher.rules.length_at(self.on(line, part)))
    }

    /// A place on a constraint.
    fn on(&self, line: &Line, part: f64) -> [f64; 2] {
        if let Some(arc) = line.arc {
            return arc.at(part);
        }
        let [a, b] = line.ends.map(|end| self.point(end));
        [0, 1].map(|k| a[k] + part * (b[k] - a[k]))
    }

    /// Puts vertices where a constraint is to be divided: in the middle first, because what sees a long rest is triangulated anew each time.
    fn divide(&mut self, line: &mut Line) {
        line.vertices.clear();
        let [a, b] = line.ends;
        let mut rest = vec![(0, line.parts.len(), a, b)];
        while let Some((low, high, a, b)) = rest.pop() {
            if low == high || self.mesher.rules.is_enough(self.mesher.count, self.mesher.for_sizes, true) {
                continue;
            }
            let Some(e) = self.mesher.layer.mesh.edge_between(a, b) else { continue };
            let middle = low + (high - low) / 2;
            // There may be no room for one of them.
            let mut candidates = (middle..high).chain((low..middle).rev());
            let made =
                candidates.find_map(|k| Some((k, self.mesher.divide(e, self.on(line, line.parts[k]))?)));
            let Some((k, v)) = made else { continue };
            line.vertices.push((line.parts[k], v));
            rest.extend([(k + 1, high, v, b), (low, k, a, v)]);
        }
        sorting::by(&mut line.vertices, |one, other| one.0.total_cmp(&other.0));
    }

    /// The sizes at the vertices along a constraint, its ends included.
    pub(super) fn sizes_along(&self, line: &Line) -> Vec<(f64, f64)> {
        let [a, b] = line.ends.map(|end| self.sizes.at(end));
        let inner = line.vertices.iter().map(|&(part, v)| (part, self.sizes.at(v)));
        std::iter::once((0.0, a)).chain(inner).chain([(1.0, b)]).collect()
    }

    /// Where a constraint is to be divided: on the rings of its ends, and between them.
    fn parts_of(&self, line: &Line, radii: &[Vec<f64>; 2], room: &mut Room) -> Result<Vec<f64>, Error> {
        let [first, last] = [0, 1].map(|k| radii[k].last().copied().unwrap_or(0.0));
        let known =
            self.sizes_along(line).into_iter().map(|(part, size)| (part * line.length, size)).collect();
        let wanted = |from: f64| self.wanted_on(line, from / line.length);
        let samples = Samples::along(line.length, room.left(), known, wanted, self.sizes.slope);
        let (from, to) = (first, line.length - last);
        let sum = if to > from { samples.sizes_between(from, to) } else { 0.0 };
        let count = room.take(sum.round().max((sum / LONGEST_PART).ceil()).max(1.0), line.length / sum)?;
        let between = samples.divided(from, to, count);
        let opposite = radii[1].iter().rev().map(|radius| line.length - radius);
        let all = radii[0].iter().copied().chain(between).chain(opposite);
        let inner = SAME_DISTANCE..1.0 - SAME_DISTANCE;
        let mut parts: Vec<f64> =
            all.map(|from| from / line.length).filter(|part| inner.contains(part)).collect();
        // Rings of both ends may meet.
        parts.dedup_by(|next, part| *next <= *part + SAME_DISTANCE);
        Ok(parts)
    }
}

/// How many more parts constraints may be divided into.
pub(super) struct Room {
    left: f64,
    is_limited: bool,
}

impl Room {
    /// For so many new vertices at most.
    fn new(most: usize) -> Self {
        let most = most as f64;
        Self { left: most.min(MOST_ON_CONSTRAINTS), is_limited: most < MOST_ON_CONSTRAINTS }
    }

    /// The number of parts.
    pub(super) fn left(&self) -> f64 {
        self.left
    }

    /// Takes a number of parts of some length; fewer, but one, if vertices are limited.
    pub(super) fn take(&mut self, count: f64, length: f64) -> Result<usize, Error> {
        if count > self.left && !self.is_limited {
            let range = "large enough for at most 2^26 vertices on constraints";
            return Err(Error::Parameter { name: "edge", value: length, range });
        }
        let count = count.min(self.left).max(1.0);
        self.left = (self.left - (count - 1.0)).max(0.0);
        Ok(count as usize)
    }
}

/// The radii of the rings on a constraint, at both of its ends.
fn rings_on(index: usize, line: &Line, corners: &Corners) -> [Vec<f64>; 2] {
    line.ends.map(|end| corners.get(&end).map_or_else(Vec::new, |rings| rings.radii_on(index)))
}
