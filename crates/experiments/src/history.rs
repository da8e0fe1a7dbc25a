//! `delone experiment history`: how what ever appears in randomized incremental construction grows with the points, and what
//! locating costs (Guibas, Knuth & Sharir 1992, §2 and §3); and the work of conflict lists.

use delone::{Algorithm2, Counters, Delaunay2, Locate};
use delone_generators::Kind;

use super::appear;
use super::plot::Plot;
use super::table::{Table, short};
use super::{Error, Findings, Options, sizes};

pub(crate) fn run(options: &Options<'_>) -> Result<Findings, Error> {
    let seed = options.seed;
    let mut table = Table::new(
        "history-growth",
        "Per point, uniform points in random order (bounds of the paper: 22 triangles, 65 edges)",
        &[
            "points",
            "triangles",
            "edges",
            "with intermediate",
            "traced",
            "traced / ln n",
            "moved in lists",
            "moved / ln n",
            "bound 12 (H_n - 1)",
        ],
    );
    let mut plot = Plot::new(
        "history-growth",
        "Randomized incremental construction: work per point",
        ["points", "per point"],
    );
    let mut curves = [const { Vec::new() }; 4];
    for n in sizes(100, options.largest.min(200_000)) {
        let points = Kind::Uniform.points(n, seed);
        let order: Vec<usize> = (0..n).collect(); // the generator's order is random
        let [triangles, edges] = appear::totals(&points, &order)?;
        let history =
            Delaunay2::with_algorithm(&points, Algorithm2::Located { locate: Locate::History, seed })?;
        let traced = match history.counters() {
            Counters::Incremental(work) => work.visited,
            _ => 0,
        };
        let lists = Delaunay2::with_algorithm(&points, Algorithm2::ConflictLists { seed })?;
        let moved = match lists.counters() {
            Counters::ConflictLists { moved, .. } => moved,
            _ => 0,
        };
        let per = |total: u64| total as f64 / n as f64;
        let log = (n as f64).ln();
        let harmonic: f64 = (1..=n).map(|i| 1.0 / i as f64).sum();
        let versions = history.footprint().versions as u64;
        table.row([
            n.to_string(),
            short(per(triangles)),
            short(per(edges)),
            short(per(versions)),
            short(per(traced)),
            short(per(traced) / log),
            short(per(moved)),
            short(per(moved) / log),
            short(12.0 * (harmonic - 1.0)),
        ]);
        for (curve, total) in curves.iter_mut().zip([triangles, versions, traced, moved]) {
            curve.push((n as f64, per(total)));
        }
    }
    let names = ["triangles that appear", "with intermediate ones", "traced by history", "moved in lists"];
    let logarithm: Vec<_> = curves[2].iter().map(|&(n, _): &(f64, f64)| (n, n.ln())).collect();
    for (name, curve) in names.into_iter().zip(curves) {
        plot.curve(name, curve);
    }
    plot.curve("ln n", logarithm);
    Ok(Findings { tables: vec![table], plots: vec![plot] })
}
