//! Rings: common distances at which constraints that meet at a small angle get their vertices.
//!
//! Between two constraints at a small angle the triangles are as sharp as the angle is, or as the vertices are apart. Where they are at the
//! same distances from the corner, only the input is to blame, and refinement leaves them alone. So the vertices are on rings around the
//! corner, up to where the gap is so wide that it does not matter. Constraints that end before have their ends on rings.
//!
//! Source: concentric shells (Ruppert, J. Algorithms 1995), at radii as sizes say.

use std::collections::BTreeMap;

use delone_predicates::lexicographic;

use super::Frontal;
use super::border::{Line, Room};
use super::samples::Samples;
use crate::error::Error;
use crate::ids::Place;
use crate::sorting;

/// The largest cosine of an angle that needs no rings: that of 40 degrees. Up to 60 degrees an angle may be sharp beside it, but seldom is.
const WIDE_COSINE: f64 = 0.766;
/// A gap is wide from so many sizes on.
const WIDE_GAP: f64 = 2.0;
/// A ring nearer to the end of a constraint than this part of the last step is left out there.
const LEAST_STEP: f64 = 0.5;
/// Distances that differ by less than this part are the same, in spite of rounding.
pub(super) const SAME_DISTANCE: f64 = 1e-9;

/// The rings of a corner.
#[derive(Clone, Debug, Default)]
pub(super) struct Rings {
    /// The constraints on which they are, by index, and how far they may be from the corner there: to the other end, or the middle if there
    /// are rings around that.
    lines: Vec<(usize, f64)>,
    /// The least distance of two of the constraints at a distance of one.
    chord: f64,
    /// From the corner outwards; none if sizes are larger than what there is.
    radii: Vec<f64>,
}

impl Rings {
    /// The radii on a constraint that meets the corner, by its index.
    pub(super) fn radii_on(&self, line: usize) -> Vec<f64> {
        let Some(&(_, reach)) = self.lines.iter().find(|own| own.0 == line) else { return Vec::new() };
        let mut on = Vec::new();
        let mut last = 0.0;
        for &radius in &self.radii {
            let rest = reach - radius;
            if rest < -SAME_DISTANCE * reach
                || (rest > SAME_DISTANCE * reach && rest < LEAST_STEP * (radius - last))
            {
                break;
            }
            on.push(radius);
            last = radius;
        }
        on
    }
}

/// The rings of all corners that need some.
pub(super) type Corners = BTreeMap<Place, Rings>;

impl Frontal<'_, '_> {
    /// The corners where constraints meet at a small angle with the mesh between them.
    pub(super) fn corners(&self, lines: &[Line]) -> Corners {
        let mut at: BTreeMap<Place, Vec<usize>> = BTreeMap::new();
        for (k, line) in lines.iter().enumerate() {
            line.ends.into_iter().for_each(|end| at.entry(end).or_default().push(k));
        }
        let mut corners = Corners::new();
        for (corner, own) in at {
            let (sharp, chord) = self.sharp_at(corner);
            let is_sharp = |k: &usize| lines[*k].ends.iter().any(|end| *end != corner && sharp.contains(end));
            let own: Vec<_> = own.into_iter().filter(is_sharp).map(|k| (k, lines[k].length)).collect();
            if own.len() > 1 {
                corners.insert(corner, Rings { lines: own, chord, radii: Vec::new() });
            }
        }
        let both: Vec<usize> = (0..lines.len())
            .filter(|k| {
                let has_rings = |end: &Place| {
                    corners.get(end).is_some_and(|rings| rings.lines.iter().any(|own| own.0 == *k))
                };
                lines[*k].ends.iter().all(has_rings)
            })
            .collect();
        for rings in corners.values_mut() {
            rings
                .lines
                .iter_mut()
                .filter(|own| both.binary_search(&own.0).is_ok())
                .for_each(|own| own.1 *= 0.5);
        }
        corners
    }

    /// The other ends of the constraints at a vertex that make a small angle with the next one, and the least distance of two of these at a
    /// distance of one.
    fn sharp_at(&self, corner: Place) -> (Vec<Place>, f64) {
        let mesh = &self.mesher.layer.mesh;
        let fixed: Vec<_> = mesh.spokes(corner).filter(|&e| mesh.is_fixed(e)).collect();
        let own = self.point(corner);
        let (mut sharp, mut chord) = (Vec::new(), f64::INFINITY);
        for k in 0..fixed.len() {
            let pair = [fixed[k], fixed[(k + 1) % fixed.len()]];
            let ends = pair.map(|e| mesh.head(e));
            let [p, q] = ends.map(|end| self.point(end)).map(|p| [p[0] - own[0], p[1] - own[1]]);
            let (dot, cross) = (p[0] * q[0] + p[1] * q[1], p[0] * q[1] - p[1] * q[0]);
            let lengths = (p[0] * p[0] + p[1] * p[1]).sqrt() * (q[0] * q[0] + q[1] * q[1]).sqrt();
            if fixed.len() > 1
                && self.mesher.is_inside(pair[0].triangle())
                && cross >= 0.0
                && dot > WIDE_COSINE * lengths
            {
                sharp.extend(ends);
                // Twice the sine of half of the angle; of a small one the sine itself, which keeps its digits.
                chord = chord.min((cross / lengths) / (0.5 + 0.5 * dot / lengths).sqrt());
            }
        }
        (sharp, chord)
    }

    /// Finds the radii of all rings, from the sizes along the constraints.
    pub(super) fn find_rings(
        &self,
        corners: &mut Corners,
        lines: &[Line],
        room: &mut Room,
    ) -> Result<(), Error> {
        // In an order of geometry: where vertices are limited the first corners have them.
        let mut order: Vec<Place> = corners.keys().copied().collect();
        sorting::by(&mut order, |p, q| lexicographic(self.point(*p), self.point(*q)));
        for corner in order {
            let radii = self.radii_around(corner, &corners[&corner], lines, room)?;
            corners.entry(corner).or_default().radii = radii;
        }
        Ok(())
    }

    fn radii_around(
        &self,
        corner: Place,
        rings: &Rings,
        lines: &[Line],
        room: &mut Room,
    ) -> Result<Vec<f64>, Error> {
        let mut ends: Vec<f64> = rings.lines.iter().map(|own| own.1).collect();
        sorting::by(&mut ends, f64::total_cmp);
        // Beyond the last but one there is nothing to match.
        let reach = ends[ends.len() - 2];
        let along: Vec<(&Line, bool)> =
            rings.lines.iter().map(|own| &lines[own.0]).map(|line| (line, line.ends[0] == corner)).collect();
        let turned = |is_first: bool, part: f64| if is_first { part } else { 1.0 - part };
        let known = along.iter().flat_map(|&(line, is_first)| {
            let sizes = self.sizes_along(line).into_iter();
            sizes.map(move |(part, size)| (line.length * turned(is_first, part), size))
        });
        let wanted = |from: f64| {
            let there = along.iter().filter(|(line, _)| from <= line.length);
            let lengths =
                there.map(|&(line, is_first)| self.wanted_on(line, turned(is_first, from / line.length)));
            lengths.fold(f64::INFINITY, f64::min)
        };
        let samples = Samples::along(reach, room.left(), known.collect(), wanted, self.sizes.slope);
        let reach = samples.first(|from, size| rings.chord * from >= WIDE_GAP * size).unwrap_or(reach);
        ends.retain(|&end| end < (1.0 - SAME_DISTANCE) * reach);
        ends.push(reach);
        let mut radii = Vec::new();
        let mut from = 0.0;
        for end in ends {
            let sum = samples.sizes_between(from, end);
            if sum >= 0.5 {
                let count = room.take(sum.round(), (end - from) / sum)?;
                radii.extend(samples.divided(from, end, count));
                radii.push(end);
                from = end;
            }
        }
        Ok(radii)
    }

    /// Whether what is between two vertices is no gap: both are on one constraint, or on two that meet, not beyond the rings of their corner;
    /// or one is of an earlier refinement, whose edges are as they were to be.
    pub(super) fn is_joined(&self, corners: &Corners, p: Place, q: Place) -> bool {
        let [one, other] = [p, q].map(|v| self.mesher.known[v.index()]);
        if one.is_free() || other.is_free() {
            return true;
        }
        let is_same = one.on.iter().all(|end| other.on.contains(end));
        one.on.into_iter().any(|o| {
            let is_near = |rings: &Rings| {
                let within =
                    |last: &f64| [p, q].iter().all(|v| self.distance(*v, o) <= last * (1.0 + SAME_DISTANCE));
                rings.radii.last().is_none_or(within)
            };
            other.on.contains(&o) && (is_same || corners.get(&o).is_none_or(is_near))
        })
    }
}
