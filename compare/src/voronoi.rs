//! Voronoi cells of random sites, clipped to their bounding box: Delone beside voronoice and spade.
//!
//! Every engine gives the corners of all cells as an array for each cell, or slices of one array. Spade clips
//! nothing: of its cells the bounded ones are taken as they are. Judged by what the areas add up to.

use std::time::Instant;

use delone::{Delaunay2, Region2};
use delone_generators::Kind;
use spade::{DelaunayTriangulation, Point2, Triangulation as _};
use voronoice::{BoundingBox, Point, VoronoiBuilder};

type Points = [[f64; 2]];

/// Seconds for all, seconds for the cells alone, and the sum of the areas.
type Run = (f64, Option<f64>, f64);

type Engine = (&'static str, fn(&Points, [[f64; 2]; 2]) -> Run);

const ENGINES: &[Engine] = &[("delone", delone), ("voronoice", voronoice), ("spade (not clipped)", spade)];

/// Times all engines and prints the minimum over the runs. False if our areas do not add up.
pub fn run(kind: Kind, size: usize, runs: usize) -> bool {
    let points = kind.points(size, 1);
    let low = [0, 1].map(|axis| points.iter().map(|p| p[axis]).fold(f64::INFINITY, f64::min));
    let high = [0, 1].map(|axis| points.iter().map(|p| p[axis]).fold(f64::NEG_INFINITY, f64::max));
    let area = (high[0] - low[0]) * (high[1] - low[1]);
    let mut best = vec![(f64::INFINITY, f64::INFINITY, 0.0); ENGINES.len()];
    for _ in 0..runs {
        for ((_, engine), best) in ENGINES.iter().zip(&mut best) {
            let (all, cells, sum) = engine(&points, [low, high]);
            *best = (best.0.min(all), best.1.min(cells.unwrap_or(f64::INFINITY)), sum);
        }
    }
    println!("\n{} {size}, cells clipped to the bounding box, ns per site", kind.name());
    println!("  {:20} {:>10} {:>8} {:>10} {:>8}  areas", "", "all", "", "cells", "");
    for ((name, _), (all, cells, sum)) in ENGINES.iter().zip(&best) {
        let ns = |seconds: f64| seconds * 1e9 / size as f64;
        let cell = if cells.is_finite() { format!("{:.0}", ns(*cells)) } else { "-".to_owned() };
        let ratio = if cells.is_finite() { format!("{:.2} x", cells / best[0].1) } else { String::new() };
        let error = (sum - area).abs() / area;
        println!(
            "  {name:20} {:>10.0} {:>6.2} x {cell:>10} {ratio:>8}  {error:.1e} off",
            ns(*all),
            all / best[0].0
        );
    }
    (best[0].2 - area).abs() <= 1e-12 * area
}

fn area<'a>(ring: impl Iterator<Item = [f64; 2]> + Clone + 'a) -> f64 {
    let Some([x, y]) = ring.clone().next() else { return 0.0 };
    let next = ring.clone().skip(1);
    ring.zip(next).map(|(p, q)| (p[0] - x) * (q[1] - y) - (p[1] - y) * (q[0] - x)).sum::<f64>() / 2.0
}

fn delone(points: &Points, [low, high]: [[f64; 2]; 2]) -> Run {
    let start = Instant::now();
    let d = Delaunay2::from_points(points).expect("finite");
    let built = Instant::now();
    let cells = d.voronoi().clip(&Region2::rectangle(low, high).expect("a box"));
    let (all, alone) = (start.elapsed(), built.elapsed());
    let sum = d.vertices().map(|v| cells.area(v)).sum();
    (all.as_secs_f64(), Some(alone.as_secs_f64()), sum)
}

fn voronoice(points: &Points, [low, high]: [[f64; 2]; 2]) -> Run {
    let sites: Vec<Point> = points.iter().map(|&[x, y]| Point { x, y }).collect();
    let middle = Point { x: f64::midpoint(low[0], high[0]), y: f64::midpoint(low[1], high[1]) };
    let start = Instant::now();
    let bounds = BoundingBox::new(middle, high[0] - low[0], high[1] - low[1]);
    let Some(diagram) = VoronoiBuilder::default().set_sites(sites).set_bounding_box(bounds).build() else {
        return (f64::INFINITY, None, 0.0);
    };
    let all = start.elapsed();
    let cells = diagram.iter_cells();
    let sum: f64 = cells
        .map(|cell| area(cell.iter_vertices().map(|p| [p.x, p.y]).collect::<Vec<_>>().into_iter()).abs())
        .sum();
    (all.as_secs_f64(), None, sum)
}

fn spade(points: &Points, _: [[f64; 2]; 2]) -> Run {
    let sites: Vec<Point2<f64>> = points.iter().map(|&[x, y]| Point2::new(x, y)).collect();
    let start = Instant::now();
    let d: DelaunayTriangulation<Point2<f64>> = DelaunayTriangulation::bulk_load(sites).expect("finite");
    let built = Instant::now();
    let mut corners: Vec<[f64; 2]> = Vec::with_capacity(6 * points.len());
    let mut starts = vec![0];
    for face in d.voronoi_faces() {
        let first = corners.len();
        for edge in face.adjacent_edges() {
            match edge.from().position() {
                Some(p) => corners.push([p.x, p.y]),
                None => {
                    corners.truncate(first);
                    break;
                }
            }
        }
        starts.push(corners.len());
    }
    let (all, alone) = (start.elapsed(), built.elapsed());
    let sum = starts.windows(2).map(|w| area(corners[w[0]..w[1]].iter().copied()).abs()).sum();
    (all.as_secs_f64(), Some(alone.as_secs_f64()), sum)
}
