//! Nearest sites by the history of radial triangles: Guibas, Knuth & Sharir 1992, §5.
//!
//! Theorem 5.2: O(n) triangles; 5.3: O(n log n) to build; 5.4: O(log n) planes a query, at most 4 H_n by its proof, and
//! O(log^2 n) comparisons. The law c ln^2 n is fitted to the sizes up to [`FITTED`]; what larger ones take beside it shows whether
//! it holds.

use std::hint::black_box;

use delone::{Delaunay2, Hierarchy, Locate, NearestSites2, Neighbors2, Work};
use delone_generators::{Kind, Random, in_ball};

use super::plot::Plot;
use super::table::short;
use super::trials::Trials;
use super::{Error, Findings, Options, decades, timed};

const QUERIES: usize = 20_000;
/// The law is fitted to sizes up to this one.
const FITTED: usize = 10_000;
/// Makes `n` points from a seed.
type Make = fn(usize, u64) -> Vec<[f64; 2]>;
/// Sets, and queries among them.
const SETS: [(&str, Make, Make); 3] = [
    ("uniform", uniform, uniform),
    ("ellipse2", |n, seed| Kind::Ellipse2.points(n, seed), uniform),
    ("hub", hub, near_hub),
];
/// The largest set of which each site is asked for before it is added.
const ADDED: usize = 100_000;

fn uniform(n: usize, seed: u64) -> Vec<[f64; 2]> {
    Kind::Uniform.points(n, seed)
}

/// Sites on a circle, and one in its middle that has all others for neighbors: here a plane is not searched in O(1).
fn hub(n: usize, seed: u64) -> Vec<[f64; 2]> {
    let mut points = Kind::UnitCircle.points(n - 1, seed);
    points.push([0.0, 0.0]);
    points
}

/// In the cell of the hub.
fn near_hub(n: usize, seed: u64) -> Vec<[f64; 2]> {
    let mut random = Random::new(seed);
    (0..n).map(|_| in_ball(&mut random).map(|x: f64| 0.4 * x)).collect()
}

pub(crate) fn run(options: &Options<'_>) -> Result<Findings, Error> {
    let mut findings = Findings::default();
    counts(options, &mut findings)?;
    building(options, &mut findings)?;
    times(options, &mut findings)?;
    Ok(findings)
}

fn square(n: usize) -> f64 {
    (n as f64).ln().powi(2)
}

fn counts(options: &Options<'_>, findings: &mut Findings) -> Result<(), Error> {
    let mut table = options.table(
        "radial-counts",
        "Radial triangles that ever were, and the work of a query for the nearest site (the paper: O(n) triangles, at most \
         4 H_n planes, O(log^2 n) comparisons)",
        &[
            "set",
            "points",
            "triangles / n",
            "planes",
            "planes / ln n",
            "4 H_n",
            "comparisons",
            "rays",
            "work",
            "work / ln^2 n",
            "work / fitted c ln^2 n",
        ],
    );
    let mut plot = Plot::new(
        "radial-counts",
        "Nearest sites by radial triangles: work of a query",
        ["sites n", "mean of 20,000 queries"],
    );
    for (name, points, queries) in SETS {
        let mut rows = Vec::new();
        for n in decades(100, options.largest) {
            let mut trials: [Trials; 5] = Default::default();
            for seed in options.seeds() {
                let sites = NearestSites2::from_points(&points(n, seed), seed)?;
                let mut work = Work::default();
                for q in queries(QUERIES, seed + 1000) {
                    sites.nearest_observed(q, &mut work)?;
                }
                let [planes, compared, rays] = [work.visited, work.compared, work.orientations]
                    .map(|total| total as f64 / QUERIES as f64);
                let size = sites.size() as f64 / n as f64;
                for (trials, value) in trials.iter_mut().zip([size, planes, compared, rays, compared + rays])
                {
                    trials.add(value);
                }
            }
            rows.push((n, trials));
        }
        // The least squares of work - c ln^2 n.
        let fitted = rows.iter().filter(|row| row.0 <= FITTED);
        let (above, below) = fitted.fold((0.0, 0.0), |(above, below), (n, trials)| {
            (above + trials[4].mean() * square(*n), below + square(*n).powi(2))
        });
        let c = above / below;
        for (n, [size, planes, compared, rays, work]) in &rows {
            let harmonic: f64 = (1..=*n).map(|i| 1.0 / i as f64).sum();
            table.row([
                name.to_owned(),
                n.to_string(),
                size.to_string(),
                planes.to_string(),
                planes.over((*n as f64).ln()).to_string(),
                short(4.0 * harmonic),
                compared.to_string(),
                rays.to_string(),
                work.to_string(),
                work.over(square(*n)).to_string(),
                work.over(c * square(*n)).to_string(),
            ]);
        }
        let means = |k: usize| rows.iter().map(move |(n, trials)| (*n as f64, trials[k].mean()));
        plot.curve(&format!("{name}: planes visited"), means(1));
        plot.curve(&format!("{name}: comparisons and rays"), means(4));
        let law = rows.iter().map(|(n, _)| (*n as f64, c * square(*n)));
        plot.curve(&format!("{name}: {} ln^2 n", short(c)), law);
    }
    findings.tables.push(table);
    findings.plots.push(plot);
    Ok(())
}

/// Theorem 5.3: a new site is a random one, and the nearest before it has O(1) neighbors on average, so its search in each of
/// O(log n) planes takes O(1).
fn building(options: &Options<'_>, findings: &mut Findings) -> Result<(), Error> {
    let title = "Sites added in random order to the history of radial triangles: comparisons and rays to locate one (O(log n))";
    let heads = ["set", "points", "planes", "comparisons", "rays", "tests", "tests / ln n"];
    let mut table = options.table("radial-building", title, &heads);
    for (name, points, _) in SETS {
        for n in decades(100, options.largest.min(ADDED)) {
            let mut trials: [Trials; 4] = Default::default();
            for seed in options.seeds() {
                let mut points = points(n, seed);
                Random::new(seed).shuffle(&mut points);
                let mut sites = NearestSites2::new();
                let mut work = Work::default();
                for p in points {
                    sites.nearest_observed(p, &mut work)?;
                    sites.insert(p)?;
                }
                let counts =
                    [work.visited, work.compared, work.orientations, work.compared + work.orientations];
                trials.iter_mut().zip(counts).for_each(|(trial, count)| trial.add(count as f64 / n as f64));
            }
            let per_log = trials[3].over((n as f64).ln()).to_string();
            let cells = trials.map(|trial| trial.to_string()).into_iter().chain([per_log]);
            table.row([name.to_owned(), n.to_string()].into_iter().chain(cells));
        }
    }
    findings.tables.push(table);
    Ok(())
}

fn times(options: &Options<'_>, findings: &mut Findings) -> Result<(), Error> {
    let seed = options.seed;
    let queries = Kind::Uniform.points(QUERIES, seed + 1);
    let mut table = options.table(
        "radial-times",
        "Nanoseconds of a query for the nearest of n uniform sites",
        &["points", "radial", "hierarchy", "hint tree", "k-d tree"],
    );
    let mut curves: [Vec<(f64, f64)>; 4] = Default::default();
    for n in decades(100, options.largest) {
        let points = Kind::Uniform.points(n, seed);
        let sites = NearestSites2::from_points(&points, seed)?;
        let mut d = Delaunay2::from_points(&points)?;
        let tree = Neighbors2::from_points(&points)?;
        let each =
            |ask: &dyn Fn([f64; 2])| timed(|| queries.iter().for_each(|&q| ask(q))).1 * 1e9 / QUERIES as f64;
        let ask = |d: &Delaunay2, q| _ = black_box(d.nearest(q));
        d.nearest([0.5, 0.5])?;
        let by_tree = each(&|q| ask(&d, q));
        d.set_strategy(Locate::Hierarchy(Hierarchy::default().seed(seed)))?;
        d.nearest([0.5, 0.5])?;
        let row = [
            each(&|q| _ = black_box(sites.nearest(q))),
            each(&|q| ask(&d, q)),
            by_tree,
            each(&|q| _ = black_box(tree.nearest(q))),
        ];
        table.row([vec![n.to_string()], row.map(short).to_vec()].concat());
        for (curve, ns) in curves.iter_mut().zip(row) {
            curve.push((n as f64, ns));
        }
    }
    let mut plot =
        Plot::new("radial-times", "Nearest of n uniform sites", ["sites n", "nanoseconds a query"]);
    for (name, curve) in ["radial triangles", "hierarchy", "hint tree", "k-d tree"].into_iter().zip(curves) {
        plot.curve(name, curve);
    }
    findings.tables.push(table);
    findings.plots.push(plot);
    Ok(())
}
