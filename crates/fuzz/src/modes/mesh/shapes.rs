//! Graphs that have made trouble for somebody who refined them.

use std::f64::consts::TAU;

use delone_generators::Random;
use delone_oracle::crossings::crossing_pairs;

use super::super::graphs::Item;
use crate::nasty::{self, integer, nudged, once_in, pick};

type Point = [f64; 2];

/// Points and segments as coordinates.
#[derive(Default)]
struct Shape {
    points: Vec<Point>,
    segments: Vec<[Point; 2]>,
}

impl Shape {
    fn ring(&mut self, corners: &[Point]) {
        for (i, &p) in corners.iter().enumerate() {
            self.segments.push([p, corners[(i + 1) % corners.len()]]);
        }
    }

    /// Random segments, which seldom cross others.
    fn join(&mut self, count: usize, random: &mut Random) {
        if self.points.is_empty() {
            return;
        }
        for _ in 0..count {
            let [a, b] = [(); 2].map(|()| self.points[random.below(self.points.len())]);
            let crosses = |&[c, d]: &[Point; 2]| !crossing_pairs(&[a, b, c, d], &[[0, 1], [2, 3]]).is_empty();
            if once_in(random, 300) || !self.segments.iter().any(crosses) {
                self.segments.push([a, b]);
            }
        }
    }
}

fn polygon(corners: usize, center: Point, radius: f64) -> Vec<Point> {
    let corner = |i: usize| {
        let (sin, cos) = (TAU * i as f64 / corners as f64).sin_cos();
        [center[0] + radius * cos, center[1] + radius * sin]
    };
    (0..corners).map(corner).collect()
}

/// A random shape, of a size about one but for the points that others fear.
fn shape(random: &mut Random) -> Shape {
    let mut shape = Shape::default();
    match random.below(8) {
        // Points that any triangulation fears.
        0 | 1 => {
            shape.points = nasty::points::<2>(random, 40);
            let hub = nasty::query(random, &shape.points);
            shape.points.push(hub);
            let count = random.below(25);
            shape.join(count, random);
        }
        // A lattice.
        2 => {
            let side = 2 + random.below(6);
            shape.points = (0..side * side).map(|i| [(i % side) as f64, (i / side) as f64]).collect();
            let count = random.below(30);
            shape.join(count, random);
        }
        // Polygons in each other, which may touch.
        3 => {
            for _ in 0..=random.below(3) {
                let corners = polygon(
                    3 + random.below(16),
                    [integer(random, 2), 0.0],
                    pick(random, &[1.0, 0.5, 0.25, 2.0]),
                );
                shape.ring(&corners);
            }
        }
        // A hub.
        4 => {
            let spokes = 2 + random.below(40);
            for (i, end) in polygon(spokes, [0.0; 2], 1.0).into_iter().enumerate() {
                let length = 1.0 + 0.3 * ((7 * i) % 5) as f64;
                shape.segments.push([[0.0; 2], end.map(|x| x * length)]);
            }
        }
        // A box with a slit.
        5 => {
            shape.ring(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
            let gap = pick(random, &[f64::EPSILON / 2.0, f64::EPSILON, 1e-12, 1e-6, 1e-3, 0.03]);
            let (low, high) = (random.unit(), random.unit());
            shape.segments.push([[low, 0.5], [high, 0.5]]);
            shape.segments.push([[low, 0.5 + gap], [high, 0.5 + gap]]);
            shape.points.push([random.unit(), gap]);
        }
        // Tips.
        6 => {
            for _ in 0..=random.below(3) {
                let degrees: f64 = pick(random, &[1e-13, 1e-6, 0.01, 1.0, 7.0, 30.0, 59.0]);
                let (sin, cos) = degrees.to_radians().sin_cos();
                let (length, tip) = (random.between(0.1, 2.0), [integer(random, 3), integer(random, 3)]);
                let end = [tip[0] + length * cos, tip[1] + length * sin];
                shape.segments.extend([[tip, [tip[0] + 1.0, tip[1]]], [tip, end]]);
            }
            if once_in(random, 2) {
                shape.ring(&[[-4.0, -4.0], [6.0, -4.0], [6.0, 6.0], [-4.0, 6.0]]);
            }
        }
        // Nearly on a line.
        _ => {
            let count = 3 + random.below(20);
            shape.points = (0..count).map(|i| [0.1 * i as f64, nudged(random, 0.3 * i as f64)]).collect();
            let count = random.below(10);
            shape.join(count, random);
        }
    }
    shape
}

/// A random graph.
pub(super) fn graph(random: &mut Random) -> Vec<Item> {
    let mut shape = shape(random);
    let scale = if once_in(random, 3) { 10f64.powi(integer(random, 100) as i32) } else { 1.0 };
    let from = if once_in(random, 4) { pick(random, &[0.1, 1e3, 1e6, 1e12, 1e15]) } else { 0.0 };
    let moved = |p: Point| {
        let q = p.map(|x| (from + x) * scale);
        if q.iter().all(|x| x.is_finite()) { q } else { p }
    };
    for _ in 0..random.below(4) {
        let ends = shape.segments.iter().flatten().chain(&shape.points).copied().collect::<Vec<_>>();
        let new = nasty::query(random, &ends);
        shape.points.push(new);
    }
    let mut items: Vec<Item> = shape.points.into_iter().map(|p| Item::Point(moved(p))).collect();
    items.extend(shape.segments.into_iter().map(|ends| Item::Segment(ends.map(moved))));
    random.shuffle(&mut items);
    items
}
