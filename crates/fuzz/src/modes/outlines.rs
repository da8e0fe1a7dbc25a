//! Segments that are welded, against the definition over integers; and their Voronoi cells, against distances.

use std::collections::BTreeSet;

use delone::{LineCells2, Region2, VertexId, Weld2};
use delone_generators::Random;
use num_bigint::BigInt;

use crate::attack::{Attack, Judgement};
use crate::nasty::{self, once_in, pick};
use crate::oracle::exact::{self, Vector, dot, minus, squared};

type Point = [f64; 2];
type Segment = [Point; 2];

/// Welding.
pub(crate) struct Welds;

/// Cells of segments.
pub(crate) struct Cells;

/// Segments between points of a set.
fn segments(random: &mut Random, points: &[Point], most: usize) -> Vec<Segment> {
    if points.is_empty() {
        return Vec::new();
    }
    (0..random.below(most)).map(|_| [(); 2].map(|()| points[random.below(points.len())])).collect()
}

/// The ends of segments by index.
fn parts(segments: &[Segment]) -> (Vec<Point>, Vec<[usize; 2]>) {
    let ends = (0..segments.len()).map(|i| [2 * i, 2 * i + 1]);
    (segments.iter().flatten().copied().collect(), ends.collect())
}

/// The other way around, in another order.
fn turned(segments: &[Segment]) -> Vec<Segment> {
    segments.iter().rev().map(|[a, b]| [*b, *a]).collect()
}

/// Pieces by their places, without direction.
fn places(welded: &Weld2, points: &[Point]) -> Vec<[[u64; 2]; 2]> {
    let bits = |i: usize| points[i].map(|x| (x + 0.0).to_bits());
    let mut pieces: Vec<_> = welded.segments.iter().map(|ends| ends.map(bits)).collect();
    pieces.iter_mut().for_each(|piece| piece.sort_unstable());
    pieces.sort_unstable();
    pieces
}

/// Whether a vertex would be joined to a segment.
fn is_part(v: &Vector, [a, b]: [&Vector; 2], tolerance: &BigInt) -> bool {
    let (d, e) = (minus(b, a), minus(v, a));
    let (length, along) = (dot(&d, &d), dot(&d, &e));
    let area = &d[0] * &e[1] - &d[1] * &e[0];
    along > BigInt::ZERO
        && along < length
        && &area * &area <= tolerance * tolerance * &length
        && squared(v, a) < length
        && squared(v, b) < length
}

impl Attack for Welds {
    type Item = Segment;

    fn make(random: &mut Random) -> Vec<Segment> {
        let points = if once_in(random, 3) { nasty::everyday(random, 30) } else { nasty::points(random, 24) };
        segments(random, &points, 20)
    }

    fn judge(items: &[Segment], seed: u64) -> Judgement {
        let mut random = Random::new(seed);
        let (points, ends) = parts(items);
        let Some(far) = points.iter().flatten().map(|x| x.abs()).max_by(f64::total_cmp) else {
            return Ok(());
        };
        let between = points.iter().map(|p| [0, 1].map(|k| (p[k] - points[0][k]).abs())).collect::<Vec<_>>();
        let lengths: Vec<f64> = between.into_iter().flatten().filter(|x| *x > 0.0).collect();
        let known = if lengths.is_empty() { far } else { pick(&mut random, &lengths) };
        let part = pick(&mut random, &[0.0, 1.0, 0.5, 0.1, 1e-3, 1e-6, 2.0, 4.0]);
        let tolerance = (known * part).min(f64::MAX);
        let weld = |points: &[Point], ends: &[[usize; 2]]| {
            Weld2::new(points, ends, tolerance).map_err(|error| error.to_string())
        };
        let welded = weld(&points, &ends)?;
        let numbers: Vec<f64> = points.iter().flatten().copied().chain([tolerance]).collect();
        let scale = exact::scale(&numbers);
        let integers: Vec<Vector> =
            points.iter().map(|p| p.iter().map(|&x| exact::integer(x, scale)).collect()).collect();
        let limit = exact::integer(tolerance, scale);
        let stay: BTreeSet<&Vector> = welded.stays.iter().map(|&i| &integers[i]).collect();
        for (i, &to) in welded.stays.iter().enumerate() {
            let way = squared(&integers[i], &integers[to]);
            if way > &limit * &limit || welded.stays[to] != to {
                return Err(format!("vertex {i} becomes {to}, farther away than {tolerance:e}"));
            }
            if stay.iter().any(|p| squared(&integers[i], p) < way) {
                return Err(format!("vertex {i} becomes {to}, and another one is nearer"));
            }
        }
        for p in &stay {
            if stay.iter().any(|q| p != q && squared(p, q) <= &limit * &limit) {
                return Err(format!("two vertices within {tolerance:e} stay: {p:?}"));
            }
        }
        for &[v, w] in &welded.segments {
            let both = [&integers[v], &integers[w]];
            if let Some(p) = stay.iter().find(|p| is_part(p, both, &limit)) {
                return Err(format!("the vertex {p:?} is within {tolerance:e} of the piece {v}-{w}"));
            }
        }
        let once = places(&welded, &points);
        let again = weld(&points, &welded.segments)?;
        if places(&again, &points) != once || again.bends != 0 || again.collapsed != 0 {
            return Err("welded once more, there is another result".into());
        }
        let (other, back) = parts(&turned(items));
        if places(&weld(&other, &back)?, &other) != once {
            return Err("in another order there is another result".into());
        }
        Ok(())
    }
}

/// Parts of a unit that borders may be off by.
const TOLERANCES: [f64; 3] = [0.3, 0.1, 0.03];

/// By rounding of corners a place within this part of the unit of a border may be in both cells or none.
const ROUNDING: f64 = 1e-9;

/// Places for which owners are compared with distances.
const PLACES: usize = 60;

fn distance(q: Point, [a, b]: Segment) -> f64 {
    let (u, w) = ([b[0] - a[0], b[1] - a[1]], [q[0] - a[0], q[1] - a[1]]);
    let part = ((u[0] * w[0] + u[1] * w[1]) / (u[0] * u[0] + u[1] * u[1])).clamp(0.0, 1.0);
    let part = if part.is_nan() { 0.0 } else { part };
    (q[0] - a[0] - part * u[0]).hypot(q[1] - a[1] - part * u[1])
}

fn holds(made: &LineCells2, line: usize, [x, y]: Point) -> bool {
    let sides = made.cells.rings(VertexId::new(line)).flat_map(|ring| ring.sides());
    let is_right =
        |[p, q]: &Segment| (p[1] > y) != (q[1] > y) && x < p[0] + (y - p[1]) / (q[1] - p[1]) * (q[0] - p[0]);
    sides.filter(is_right).count() % 2 == 1
}

impl Attack for Cells {
    type Item = Segment;

    fn make(random: &mut Random) -> Vec<Segment> {
        let points = (0..2 + random.below(16)).map(|_| {
            [(); 2].map(|()| if once_in(random, 3) { random.below(5) as f64 / 4.0 } else { random.unit() })
        });
        let points: Vec<Point> = points.collect();
        segments(random, &points, 12)
    }

    fn judge(items: &[Segment], seed: u64) -> Judgement {
        let mut random = Random::new(seed);
        let unit = nasty::power(&mut random, -40, 40);
        let items: Vec<Segment> = items.iter().map(|s| s.map(|p| p.map(|x| x * unit))).collect();
        let (points, ends) = parts(&items);
        let lines: Vec<usize> = (0..items.len()).map(|i| i / (1 + random.below(2))).collect();
        let tolerance = pick(&mut random, &TOLERANCES) * unit;
        let (low, high) = (-0.5 * unit, 1.5 * unit);
        let region = Region2::rectangle([low; 2], [high; 2]).map_err(|error| error.to_string())?;
        let made =
            LineCells2::new(&points, &ends, &lines, &region, tolerance).map_err(|error| error.to_string())?;
        let count = lines.iter().max().map_or(0, |last| last + 1);
        if items.is_empty() {
            return Ok(());
        }
        let areas: f64 = (0..count).map(|line| made.cells.area(VertexId::new(line))).sum();
        if (areas / (unit * unit) - 4.0).abs() > ROUNDING {
            return Err(format!("the areas are {} in all", areas / (unit * unit)));
        }
        for _ in 0..PLACES {
            let q = [(); 2].map(|()| low + (high - low) * random.unit());
            let from = |line: usize| {
                let own = items.iter().zip(&lines).filter(|(_, of)| **of == line);
                own.map(|(&segment, _)| distance(q, segment)).fold(f64::INFINITY, f64::min)
            };
            let distances: Vec<f64> = (0..count).map(from).collect();
            let least = distances.iter().copied().fold(f64::INFINITY, f64::min);
            let owners: Vec<usize> = (0..count).filter(|&line| holds(&made, line, q)).collect();
            // Where a border is off by the tolerance, distances differ by at most twice as much.
            let off = owners.iter().map(|&line| distances[line] - least).fold(0.0, f64::max);
            if owners.len() != 1 || off > 2.0 * tolerance + ROUNDING * unit {
                return Err(format!("{q:?} is in {owners:?}, farther by {off:e} of {tolerance:e}"));
            }
        }
        Ok(())
    }
}
