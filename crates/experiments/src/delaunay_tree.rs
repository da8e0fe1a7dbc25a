//! The Delaunay tree, which Guibas, Knuth & Sharir 1992 name as the first history, in the plane and in space: its size, its
//! searches, and both again when the older half of the vertices has been removed.

use delone::{Change, Delaunay2, Delaunay3, Locate, VertexId, Work};
use delone_generators::{Kind, Kind3};

use super::table::Table;
use super::trials::Trials;
use super::{Error, Findings, Options, decades};

const QUERIES: usize = 2_000;

pub(crate) fn run(options: &Options<'_>) -> Result<Findings, Error> {
    let mut table = options.table(
        "delaunay-tree",
        "The Delaunay tree: what ever was, tests of a search, and both after half of the points were removed (expected over \
         random orders in the plane: O(n) triangles, O(log n) tests)",
        &[
            "set",
            "points",
            "ever / n",
            "tests",
            "tests / ln n",
            "found after",
            "ever / n left",
            "tests left",
            "tests left / ln n",
        ],
    );
    for kind in [Kind::Uniform, Kind::Ellipse2] {
        for n in decades(100, options.largest.min(100_000)) {
            let trial = |seed: u64| {
                let queries = kind.points(QUERIES, seed + 1000);
                follow::<Delaunay2>(kind.points(n, seed), |d| d.footprint().versions, &queries)
            };
            row(&mut table, kind.name(), n, options, trial)?;
        }
    }
    for n in decades(100, options.largest.min(10_000)) {
        let trial = |seed: u64| {
            let queries = Kind3::Ball.points(QUERIES, seed + 1000);
            follow::<Delaunay3>(Kind3::Ball.points(n, seed), |d| d.footprint().versions, &queries)
        };
        row(&mut table, "ball, in space", n, options, trial)?;
    }
    Ok(Findings { tables: vec![table], plots: Vec::new() })
}

/// Counts all simplices ever made, tests and triangles visited a query; then the rest, and tests after a half has gone.
fn follow<D: Change>(
    points: Vec<D::Point>,
    ever: impl Fn(&D) -> usize,
    queries: &[D::Point],
) -> Result<[f64; 5], Error> {
    let mut d = D::from_vec(points)?;
    d.set_strategy(Locate::DelaunayTree)?;
    let ask = |d: &D| -> Result<[f64; 2], Error> {
        let mut work = Work::default();
        queries.iter().try_for_each(|&q| d.find_observed(q, &mut work).map(drop))?;
        Ok([work.in_circles, work.visited].map(|total| total as f64 / queries.len() as f64))
    };
    let [tests, visited] = ask(&d)?;
    let n = d.vertex_count();
    let all = ever(&d) as f64 / n as f64;
    let first: Vec<VertexId> = d.vertices().take(n / 2).collect();
    first.into_iter().try_for_each(|v| d.remove_observed(v, &mut ()))?;
    let left = ever(&d) as f64 / d.vertex_count() as f64;
    let [tests_left, _] = ask(&d)?;
    Ok([all, tests, visited, left, tests_left])
}

fn row(
    table: &mut Table,
    set: &str,
    n: usize,
    options: &Options<'_>,
    trial: impl Fn(u64) -> Result<[f64; 5], Error>,
) -> Result<(), Error> {
    let mut trials: [Trials; 5] = Default::default();
    for seed in options.seeds() {
        for (trials, value) in trials.iter_mut().zip(trial(seed)?) {
            trials.add(value);
        }
    }
    let [all, tests, visited, left, tests_left] = trials;
    table.row([
        set.to_owned(),
        n.to_string(),
        all.to_string(),
        tests.to_string(),
        tests.over((n as f64).ln()).to_string(),
        visited.to_string(),
        left.to_string(),
        tests_left.to_string(),
        tests_left.over((n as f64 / 2.0).ln()).to_string(),
    ]);
    Ok(())
}
