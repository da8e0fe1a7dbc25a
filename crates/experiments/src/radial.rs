//! Nearest sites by the history of radial triangles: Guibas, Knuth & Sharir 1992, §5.

use std::hint::black_box;

use delone::{Delaunay2, Hierarchy, Locate, NearestSites2, Work};
use delone_generators::Kind;
use kiddo::SquaredEuclidean;
use kiddo::immutable::float::kdtree::ImmutableKdTree;

use super::plot::Plot;
use super::table::{Table, short};
use super::{Error, Findings, Options, timed};

const QUERIES: usize = 20_000;

pub(crate) fn run(options: &Options<'_>) -> Result<Findings, Error> {
    let (largest, seed) = (options.largest, options.seed);
    let queries = Kind::Uniform.points(QUERIES, seed + 1);
    let mut counts = Table::new(
        "radial-counts",
        "Radial triangles that ever were, and the work of a nearest-site query",
        &["points", "triangles / n", "planes", "planes / ln n", "comparisons", "comparisons / ln^2 n"],
    );
    let mut times = Table::new(
        "radial-times",
        "Nanoseconds of a query for the nearest of n uniform sites",
        &["points", "radial", "hierarchy", "hint tree", "kiddo's k-d tree"],
    );
    let (mut planes, mut comparisons) = (Vec::new(), Vec::new());
    let mut curves: [Vec<(f64, f64)>; 4] = Default::default();
    let mut n = 100;
    while n <= largest {
        let points = Kind::Uniform.points(n, seed);
        let sites = NearestSites2::from_points(&points, seed)?;
        let mut work = Work::default();
        queries.iter().try_for_each(|&q| sites.nearest_observed(q, &mut work).map(drop))?;
        let mean = |total: u64| total as f64 / QUERIES as f64;
        let (visited, compared) = (mean(work.visited), mean(work.compared + work.orientations));
        let log = (n as f64).ln();
        let row = [sites.size() as f64 / n as f64, visited, visited / log, compared, compared / log / log];
        counts.row([vec![n.to_string()], row.map(short).to_vec()].concat());
        planes.push((n as f64, visited));
        comparisons.push((n as f64, compared));

        let mut d = Delaunay2::from_points(&points)?;
        let tree: ImmutableKdTree<f64, u32, 2, 32> = ImmutableKdTree::new_from_slice(&points);
        let each =
            |ask: &dyn Fn([f64; 2])| timed(|| queries.iter().for_each(|&q| ask(q))).1 * 1e9 / QUERIES as f64;
        let ask = |d: &Delaunay2, q| _ = black_box(d.nearest(q));
        d.nearest([0.5, 0.5])?;
        let by_tree = each(&|q| ask(&d, q));
        d.set_strategy(Locate::Hierarchy(Hierarchy { seed, ..Hierarchy::default() }))?;
        d.nearest([0.5, 0.5])?;
        let row = [
            each(&|q| _ = black_box(sites.nearest(q))),
            each(&|q| ask(&d, q)),
            by_tree,
            each(&|q| _ = black_box(tree.nearest_one::<SquaredEuclidean>(&q))),
        ];
        times.row([vec![n.to_string()], row.map(short).to_vec()].concat());
        for (curve, ns) in curves.iter_mut().zip(row) {
            curve.push((n as f64, ns));
        }
        n *= 10;
    }
    let mut work_plot = Plot::new(
        "radial-counts",
        "Nearest sites by radial triangles: work of a query",
        ["sites n", "mean of 20,000 queries"],
    );
    let (first, last) = (planes[0], comparisons[0]);
    let logs = |power: i32, (n0, y0): (f64, f64)| {
        planes.iter().map(move |&(n, _)| (n, y0 * (n.ln() / n0.ln()).powi(power))).collect::<Vec<_>>()
    };
    let (by_log, by_square) = (logs(1, first), logs(2, last));
    work_plot.curve("planes visited", planes.iter().copied());
    work_plot.curve("proportional to ln n", by_log);
    work_plot.curve("comparisons and rays", comparisons);
    work_plot.curve("proportional to ln^2 n", by_square);
    let mut time_plot =
        Plot::new("radial-times", "Nearest of n uniform sites", ["sites n", "nanoseconds a query"]);
    for (name, curve) in
        ["radial triangles", "hierarchy", "hint tree", "kiddo's k-d tree"].into_iter().zip(curves)
    {
        time_plot.curve(name, curve);
    }
    Ok(Findings { tables: vec![counts, times], plots: vec![work_plot, time_plot] })
}
