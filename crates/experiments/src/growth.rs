//! How the cost of a construction grows with the number of points.

use std::hint::black_box;

use delone::{Delaunay2, Delaunay3};
use delone_generators::{Kind, Kind3};

use super::plot::Plot;
use super::table::short;
use super::{Error, Findings, Options, timed};

/// Small sets are built so often that this many points are built in all.
const POINTS: usize = 3_000_000;
/// The fewest runs, of which the fastest counts.
const RUNS: usize = 3;
/// Points, from which on one run is made.
const SINGLE_RUN_POINTS: usize = 20_000_000;

/// `delone-lab experiment growth`: from a thousand points on, in space up to a tenth as many as in the plane.
pub(crate) fn run(options: &Options<'_>) -> Result<Findings, Error> {
    let (largest, seed, all_threads) = (options.largest, options.seed, options.threads);
    let threads = all_threads.current_num_threads();
    let many = format!("{threads} threads");
    let names = ["uniform", "uniform", "clusters", "grid", "cube", "cube"];
    let on_many = ["uniform", "cube, in space"].map(|name| format!("{name}, {many}"));
    let heads = ["points", "uniform", &on_many[0], "clusters", "grid", "cube, in space", &on_many[1]];
    let title = "Nanoseconds a point for a construction";
    let mut table = options.table("growth", title, &heads);
    let mut curves: Vec<Vec<(f64, f64)>> = vec![Vec::new(); names.len()];
    // The processor takes a while to come up to speed.
    let some = Kind::Uniform.points(POINTS / 3, seed);
    fastest(some.len(), || Delaunay2::from_points(&some).map(|d| _ = black_box(d.vertex_count())))?;
    drop(some);
    // A third of a decade at a time.
    let sizes = (0..).map(|k| (1000.0 * 10f64.powf(f64::from(k) / 3.0)).round() as usize);
    for n in sizes.take_while(|&n| n <= largest) {
        let mut cells = vec![n.to_string()];
        for (k, name) in names.into_iter().enumerate() {
            let in_plane = |points: &[[f64; 2]]| {
                fastest(n, || Delaunay2::from_points(points).map(|d| _ = black_box(d.vertex_count())))
            };
            let ns = match (k, Kind::named(name)) {
                (1, Some(kind)) => {
                    let points = kind.points(n, seed);
                    Some(all_threads.install(|| in_plane(&points))?)
                }
                (_, Some(kind)) => Some(in_plane(&kind.points(n, seed))?),
                (_, None) if n <= largest / 10 => {
                    let points = Kind3::Cube.points(n, seed);
                    let build = || Delaunay3::from_points(&points).map(|d| _ = black_box(d.vertex_count()));
                    Some(if k == 5 { all_threads.install(|| fastest(n, build)) } else { fastest(n, build) }?)
                }
                _ => None,
            };
            cells.push(ns.map_or("-".to_owned(), short));
            curves[k].extend(ns.map(|ns| (n as f64, ns)));
        }
        table.row(cells);
    }
    let mut plot = Plot::new("growth", title, ["points n", "nanoseconds a point"]);
    let first = curves[0].first().copied();
    let logarithm: Vec<(f64, f64)> = curves[0]
        .iter()
        .filter_map(|&(n, _)| first.map(|(start, ns)| (n, ns * n.ln() / start.ln())))
        .collect();
    for (name, curve) in heads[1..].iter().zip(curves) {
        plot.curve(name, curve);
    }
    plot.curve("n log n", logarithm);
    Ok(Findings { tables: vec![table], plots: vec![plot] })
}

/// Nanoseconds a point of the fastest of some runs.
fn fastest(n: usize, build: impl Fn() -> Result<(), delone::Error>) -> Result<f64, Error> {
    let runs = if n < SINGLE_RUN_POINTS { (POINTS / n).clamp(RUNS, 300) } else { 1 };
    let mut least = f64::INFINITY;
    for _ in 0..runs {
        let (done, seconds) = timed(&build);
        done?;
        least = least.min(seconds);
    }
    Ok(least * 1e9 / n as f64)
}
