//! `delone-lab experiment order`: what the order of insertion does to randomized incremental construction.
//!
//! Source: Guibas, Knuth & Sharir 1992: the bad order of Figure 1 and the question of the variance (§2.1), adding to a set
//! (Theorem 2.6), sorting on a parabola (§3). The unlucky site is with `history`.

use delone::{Change, Delaunay2, Error as Refusal, Locate, Work};
use delone_generators::{Kind, Random};

use super::appear;
use super::plot::Plot;
use super::table::short;
use super::trials::Trials;
use super::{Error, Findings, Options, sizes};

/// Random orders of which the variance is taken, at least.
const ORDERS: usize = 100;
/// Orders in which points are added, at least: of two rows they differ much.
const ADDED: usize = 30;
/// The largest set of which quadratically many triangles appear.
const QUADRATIC: usize = 2_000;

pub(crate) fn run(options: &Options<'_>) -> Result<Findings, Error> {
    let mut findings = Findings::default();
    bad_order(options, &mut findings)?;
    variance(options, &mut findings)?;
    adding(options, &mut findings)?;
    sorting(options, &mut findings)?;
    Ok(findings)
}

/// Points (-1, 0), (-2, 0), ... on the axis and (1, 1), (2, 1), ... above it: Figure 1.
fn two_rows(below: usize, above: usize) -> Vec<[f64; 2]> {
    let below = (1..=below).map(|i| [-(i as f64), 0.0]);
    below.chain((1..=above).map(|i| [i as f64, 1.0])).collect()
}

/// Figure 1: all below, then all above from right to left.
fn bad_order(options: &Options<'_>, findings: &mut Findings) -> Result<(), Error> {
    let mut table = options.table(
        "order-bad",
        "Triangles that appear of m points below and m above: the order of Figure 1 and random orders",
        &["points 2m", "bad order", "in m^2", "random orders", "a point"],
    );
    let mut plot =
        Plot::new("order-bad", "Triangles that appear, two rows of points", ["points", "triangles"]);
    let mut curves: [Vec<(f64, f64)>; 2] = Default::default();
    for n in sizes(100, options.largest.min(QUADRATIC)) {
        let mut random = Random::new(options.seed);
        let m = n / 2;
        let points = two_rows(m, m);
        let bad: Vec<usize> = (0..m).chain((m..2 * m).rev()).collect();
        let [in_bad, _] = appear::totals(&points, &bad)?;
        let mut order = bad.clone();
        let mut by_chance = Trials::default();
        for _ in 0..options.trials {
            random.shuffle(&mut order);
            by_chance.add(appear::totals(&points, &order)?[0] as f64);
        }
        table.row([
            n.to_string(),
            in_bad.to_string(),
            short(in_bad as f64 / (m * m) as f64),
            by_chance.to_string(),
            by_chance.over(n as f64).to_string(),
        ]);
        for (curve, y) in curves.iter_mut().zip([in_bad as f64, by_chance.mean()]) {
            curve.push((n as f64, y));
        }
    }
    for (name, curve) in ["the order of Figure 1", "random orders"].into_iter().zip(curves) {
        plot.curve(name, curve);
    }
    findings.tables.push(table);
    findings.plots.push(plot);
    Ok(())
}

/// How far the total strays from its mean, which the paper would like to know.
fn variance(options: &Options<'_>, findings: &mut Findings) -> Result<(), Error> {
    let orders = ORDERS.max(options.trials);
    let mut table = options.table(
        "order-variance",
        &format!("Triangles that appear in {orders} random orders: mean, variance, most"),
        &["set", "points", "triangles", "variance / n", "most / mean"],
    );
    for kind in [Kind::Uniform, Kind::Ellipse2, Kind::Parabola] {
        for n in sizes(100, options.largest.min(3_000)) {
            let points = kind.points(n, options.seed);
            let mut random = Random::new(options.seed);
            let mut order: Vec<usize> = (0..n).collect();
            let mut totals = Trials::default();
            for _ in 0..orders {
                random.shuffle(&mut order);
                totals.add(appear::totals(&points, &order)?[0] as f64);
            }
            table.row([
                kind.name().to_owned(),
                n.to_string(),
                totals.to_string(),
                short(totals.deviation().powi(2) / n as f64),
                short(totals.most() / totals.mean()),
            ]);
        }
    }
    findings.tables.push(table);
    Ok(())
}

/// Theorem 2.6: n points in random order added to a triangulation of m.
fn adding(options: &Options<'_>, findings: &mut Findings) -> Result<(), Error> {
    let orders = ADDED.max(options.trials);
    let title = format!(
        "Edges that appear when n points are added to m, in {orders} random orders; the bound is O(m log n + n) and tight"
    );
    let mut table = options.table(
        "order-adding",
        &title,
        &["m", "n", "two rows", "two rows / (m H(n) + n)", "uniform", "uniform / (m H(n) + n)"],
    );
    for m in sizes(100, options.largest.min(1_000)) {
        for n in sizes(10, options.largest.min(1_000)) {
            let harmonic: f64 = (1..=n).map(|i| 1.0 / i as f64).sum();
            let bound = m as f64 * harmonic + n as f64;
            let mut cells = vec![m.to_string(), n.to_string()];
            for points in [two_rows(m, n), Kind::Uniform.points(m + n, options.seed)] {
                let before = appear::totals(&points, &(0..m).collect::<Vec<_>>())?[1];
                let mut random = Random::new(options.seed);
                let mut added = Trials::default();
                for _ in 0..orders {
                    let mut order: Vec<usize> = (0..m + n).collect();
                    random.shuffle(&mut order[m..]);
                    added.add((appear::totals(&points, &order)?[1] - before) as f64);
                }
                cells.extend([added.to_string(), added.over(bound).to_string()]);
            }
            table.row(cells);
        }
    }
    findings.tables.push(table);
    Ok(())
}

/// §3: numbers are sorted by triangulating (x, x^2), in random order and in sorted order.
fn sorting(options: &Options<'_>, findings: &mut Findings) -> Result<(), Error> {
    let mut table = options.table(
        "order-sorting",
        "Numbers sorted by the triangulation of (x, x^2): tests a number, beside Quicksort's 2 ln n",
        &["numbers", "visited, random order", "/ (2 ln n)", "visited, sorted order", "in n"],
    );
    for n in sizes(100, options.largest.min(100_000)) {
        let mut random = Random::new(options.seed);
        let mut numbers: Vec<usize> = (0..n).collect();
        let mut by_chance = Trials::default();
        let mut sorted = None;
        for trial in 0..options.trials {
            let of = |numbers: &[usize]| -> Result<f64, Refusal> {
                let mut d = Delaunay2::with_strategy(Locate::History)?;
                let mut work = Work::default();
                for &x in numbers {
                    let x = x as f64;
                    d.insert_observed([x, x * x], &mut work)?;
                }
                // The lower hull holds them in their order.
                debug_assert_eq!(d.hull_vertices().count(), n);
                Ok(work.visited as f64 / n as f64)
            };
            if trial == 0 && n <= QUADRATIC {
                sorted = Some(of(&numbers)?);
            }
            random.shuffle(&mut numbers);
            by_chance.add(of(&numbers)?);
        }
        table.row([
            n.to_string(),
            by_chance.to_string(),
            by_chance.over(2.0 * (n as f64).ln()).to_string(),
            sorted.map_or("-".to_owned(), short),
            sorted.map_or("-".to_owned(), |visited| short(visited / n as f64)),
        ]);
    }
    findings.tables.push(table);
    Ok(())
}
