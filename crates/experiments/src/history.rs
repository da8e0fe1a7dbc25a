//! `delone-lab experiment history`: how what ever appears in randomized incremental construction grows with the points, and what
//! locating costs (Guibas, Knuth & Sharir 1992, §2 and §3); and the work of conflict lists.

use delone::{Algorithm2, Ask, Counters, Delaunay2, Locate, Work};
use delone_generators::{Kind, Random};

use super::appear;
use super::plot::Plot;
use super::table::short;
use super::trials::Trials;
use super::{Error, Findings, Options, sizes};

/// Queries in each size.
const QUERIES: usize = 2_000;
/// The theorems are of any set. Points on curves need exact arithmetic, so that their sets are smaller.
const KINDS: [(Kind, usize); 5] = [
    (Kind::Uniform, 200_000),
    (Kind::Ellipse2, 10_000),
    (Kind::Ellipse, 10_000),
    (Kind::Parabola, 10_000),
    (Kind::Circle, 10_000),
];

pub(crate) fn run(options: &Options<'_>) -> Result<Findings, Error> {
    let mut findings = Findings::default();
    growth(options, &mut findings)?;
    unlucky(options, &mut findings)?;
    Ok(findings)
}

/// How the totals grow.
fn growth(options: &Options<'_>, findings: &mut Findings) -> Result<(), Error> {
    let seed = options.seed;
    let mut table = options.table(
        "history-growth",
        "Per point, in random order (bounds of the paper: 22 triangles, 65 edges)",
        &[
            "set",
            "points",
            "triangles",
            "edges",
            "with intermediate",
            "traced",
            "traced / ln n",
            "orientations / traced",
            "stars searched",
            "orientations there",
            "moved in lists",
            "moved / ln n",
            "bound 12 (H_n - 1)",
        ],
    );
    let mut plot = Plot::new(
        "history-growth",
        "Randomized incremental construction: work per point",
        ["uniform points", "per point"],
    );
    let mut curves = [const { Vec::new() }; 4];
    let sets = KINDS
        .into_iter()
        .flat_map(|(kind, most)| sizes(100, options.largest.min(most)).map(move |n| (kind, n)));
    for (kind, n) in sets {
        let points = kind.points(n, seed);
        let mut order: Vec<usize> = (0..n).collect();
        Random::new(seed).shuffle(&mut order);
        let [triangles, edges] = appear::totals(&points, &order)?;
        let history =
            Delaunay2::with_algorithm(&points, Algorithm2::Located { locate: Locate::History, seed })?;
        let work = history.counters().work().unwrap_or_default();
        let traced = work.visited;
        let stars = {
            let mut d = Delaunay2::from_points(&points)?;
            d.set_strategy(Locate::Stars)?;
            let mut work = Work::default();
            // Queries, not sites: what is located is as far from what is there.
            let queries = kind.points(QUERIES, seed + 1);
            queries.iter().try_for_each(|&q| d.find_observed(q, &mut work).map(drop))?;
            [work.visited, work.orientations].map(|total| total as f64 / QUERIES as f64)
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
            kind.name().to_owned(),
            n.to_string(),
            short(per(triangles)),
            short(per(edges)),
            short(per(versions)),
            short(per(traced)),
            short(per(traced) / log),
            short(work.orientations as f64 / traced as f64),
            short(stars[0]),
            short(stars[1]),
            short(per(moved)),
            short(per(moved) / log),
            short(12.0 * (harmonic - 1.0)),
        ]);
        let shown = curves.iter_mut().filter(|_| kind == Kind::Uniform);
        for (curve, total) in shown.zip([triangles, versions, traced, moved]) {
            curve.push((n as f64, per(total)));
        }
    }
    let names = ["triangles that appear", "with intermediate ones", "traced by history", "moved in lists"];
    let logarithm: Vec<_> = curves[2].iter().map(|&(n, _): &(f64, f64)| (n, n.ln())).collect();
    for (name, curve) in names.into_iter().zip(curves) {
        plot.curve(name, curve);
    }
    plot.curve("ln n", logarithm);
    findings.tables.push(table);
    findings.plots.push(plot);
    Ok(())
}

/// The unlucky site of §3: n sites on a line in random order, one high above them before, one after; then a site in between,
/// close to those two, is located.
fn unlucky(options: &Options<'_>, findings: &mut Findings) -> Result<(), Error> {
    let mut table = options.table(
        "history-unlucky",
        "Steps and tests to locate the unlucky site of §3 (the paper: a trace linear in n; by binary search in the versions not, \
         as it hopes)",
        &[
            "points",
            "traced",
            "traced / n",
            "traced, with orientations",
            "stars searched",
            "stars, with orientations",
            "by circles",
            "by circles, with tests",
        ],
    );
    for n in sizes(100, options.largest.min(10_000)) {
        let mut trials: [Trials; 6] = Default::default();
        for trial in 0..options.trials as u64 {
            let located = |locate: Locate| -> Result<[f64; 2], Error> {
                let mut d = Delaunay2::with_strategy(locate)?;
                d.locate([0.0, 0.0])?;
                let mut bottom: Vec<f64> = (1..=n).map(|i| -(i as f64)).collect();
                Random::new(options.seed + trial).shuffle(&mut bottom);
                d.insert([1.0, 1.0])?;
                bottom.into_iter().try_for_each(|x| d.insert([x, 0.0]).map(drop))?;
                d.insert([0.0, 1.0])?;
                let mut work = Work::default();
                d.find_observed([0.5, 1.0 - 1e-9], &mut work)?;
                Ok([work.visited as f64, (work.visited + work.orientations + work.in_circles) as f64])
            };
            let all = [located(Locate::History)?, located(Locate::Stars)?, located(Locate::DelaunayTree)?];
            for (trials, value) in trials.iter_mut().zip(all.into_iter().flatten()) {
                trials.add(value);
            }
        }
        let [traced, with, stars, with_stars, circles, with_circles] = &trials;
        let share = short(traced.mean() / n as f64);
        let cells = [with, stars, with_stars, circles, with_circles].map(ToString::to_string);
        table.row([vec![n.to_string(), traced.to_string(), share], cells.to_vec()].concat());
    }
    findings.tables.push(table);
    Ok(())
}
