//! Inputs of every nasty kind, small enough for a debug build.

use delone_generators::{Graph, Kind};
use delone_oracle::all_cases;

use super::judge::{Points, Segments};

pub(crate) fn wedge(degrees: f64, length: f64, in_box: bool) -> (Points, Segments) {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let mut points = vec![[0.0, 0.0], [1.0, 0.0], [length * cos, length * sin]];
    let mut segments = vec![[0, 1], [0, 2]];
    if in_box {
        points.extend([[-2.0, -2.0], [2.0, -2.0], [2.0, 2.0], [-2.0, 2.0]]);
        segments.extend([[3, 4], [4, 5], [5, 6], [6, 3]]);
    } else {
        segments.push([1, 2]);
    }
    (points, segments)
}

pub(crate) fn hub(spokes: usize) -> (Points, Segments) {
    let end = |i: usize| {
        let (sin, cos) = (std::f64::consts::TAU * i as f64 / spokes as f64).sin_cos();
        let length = 1.0 + 0.3 * ((7 * i) % 5) as f64;
        [length * cos, length * sin]
    };
    let points = std::iter::once([0.0; 2]).chain((0..spokes).map(end)).collect();
    (points, (1..=spokes).map(|i| [0, i]).collect())
}

/// A square with two parallel slits, or a vertex, so near to each other.
pub(crate) fn slit(gap: f64) -> (Points, Segments) {
    let points = vec![
        [0.0, 0.0],
        [1.0, 0.0],
        [1.0, 1.0],
        [0.0, 1.0],
        [0.3, 0.5],
        [0.7, 0.5],
        [0.7, 0.5 + gap],
        [0.3, 0.5 + gap],
        [0.432, gap],
    ];
    (points, vec![[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [6, 7]])
}

/// Two circles that touch.
pub(crate) fn cusp(n: usize) -> (Points, Segments) {
    let mut parts: (Points, Segments) = Default::default();
    for (x, radius) in [(0.0, 1.0), (0.5, 0.5)] {
        let first = parts.0.len();
        for i in 0..n {
            let (sin, cos) = (std::f64::consts::TAU * i as f64 / n as f64).sin_cos();
            parts.0.push([x + radius * cos, radius * sin]);
            parts.1.push([first + i, first + (i + 1) % n]);
        }
    }
    parts
}

/// All of them, with names.
pub(crate) fn nasty() -> Vec<(String, Points, Segments)> {
    let mut all = Vec::new();
    for graph in Graph::ALL {
        let (points, segments) = graph.parts(60, 3);
        all.push((graph.name().to_owned(), points, segments));
    }
    for degrees in [1e-6, 1e-3, 0.1, 2.0, 7.0, 30.0, 59.0] {
        for (length, in_box) in [(1.0, false), (0.7, true), (0.31, false), (0.99999, true)] {
            let (points, segments) = wedge(degrees, length, in_box);
            all.push((format!("wedge of {degrees}, {length}"), points, segments));
        }
    }
    for spokes in [5, 30, 200] {
        let (points, segments) = hub(spokes);
        all.push((format!("hub of {spokes}"), points, segments));
    }
    for gap in [0.01, 0.001] {
        let (points, segments) = slit(gap);
        all.push((format!("slit of {gap}"), points, segments));
    }
    let (points, segments) = cusp(if all_cases() { 32 } else { 12 });
    all.push(("cusp".to_owned(), points, segments));
    for kind in [Kind::Uniform, Kind::Grid, Kind::Circle, Kind::Line] {
        all.push((kind.name().to_owned(), kind.points(40, 5), Vec::new()));
    }
    all
}
