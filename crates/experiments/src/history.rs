//! What ever appears in randomized incremental construction: Guibas, Knuth & Sharir 1992, §2 and §3; and the work of
//! conflict lists.

use std::collections::BTreeMap;

use delone::{Algorithm2, Ask, Counters, Delaunay2, Locate, VertexId, Work};
use delone_generators::{Kind, Random};
use delone_predicates::{in_circle, orient2d};

use super::plot::Plot;
use super::table::{Table, short};
use super::trials::Trials;
use super::{Error, Findings, Options, sizes};

/// Points of the set that is simulated, and the number of random orders.
const SMALL: usize = 24;
const ORDERS: usize = 4_000;
/// Queries in each size.
const QUERIES: usize = 2_000;

pub(crate) fn run(options: &Options<'_>) -> Result<Findings, Error> {
    let (largest, seed) = (options.largest, options.seed);
    let mut findings = Findings::default();
    scopes(seed, &mut findings)?;
    growth(largest, seed, &mut findings)?;
    unlucky(options, &mut findings)?;
    Ok(findings)
}

/// Inserts points in order and reports each finite triangle and edge when it appears: all at the new vertex.
fn follow(
    points: &[[f64; 2]],
    order: &[usize],
    mut triangle: impl FnMut([usize; 3]),
    mut edge: impl FnMut(),
) -> Result<(), Error> {
    let mut d = Delaunay2::new();
    for &i in order {
        let v = d.insert(points[i])?.vertex();
        let mesh = d.mesh();
        for e in mesh.star(v) {
            if !mesh.destination(e).is_ghost() {
                edge();
            }
            if !mesh.is_ghost(e.triangle()) {
                let mut corners = mesh.corners(e.triangle()).map(|w: VertexId| order[w.index()]);
                corners.sort_unstable();
                triangle(corners);
            }
        }
    }
    Ok(())
}

/// On a small set: how often triangles of each scope appear, and how many triangles and edges in all.
fn scopes(seed: u64, findings: &mut Findings) -> Result<(), Error> {
    let points = Kind::Uniform.points(SMALL, seed);
    let mut scope_of = BTreeMap::new();
    for a in 0..SMALL {
        for b in a + 1..SMALL {
            for c in b + 1..SMALL {
                let turn = orient2d(points[a], points[b], points[c]);
                let inside = |&q: &usize| {
                    ![a, b, c].contains(&q)
                        && (in_circle(points[a], points[b], points[c], points[q]) * turn).is_positive()
                };
                scope_of.insert([a, b, c], (0..SMALL).filter(inside).count());
            }
        }
    }
    let mut count = vec![0_usize; SMALL - 2];
    scope_of.values().for_each(|&k| count[k] += 1);
    let mut appeared = [0_u64; SMALL - 2];
    let mut edges = 0_u64;
    let mut random = Random::new(seed);
    let mut order: Vec<usize> = (0..SMALL).collect();
    for _ in 0..ORDERS {
        random.shuffle(&mut order);
        follow(&points, &order, |corners| appeared[scope_of[&corners]] += 1, || edges += 1)?;
    }
    let mut table = Table::new(
        "history-scopes",
        &format!("How often a triangle of scope k appears ({SMALL} points, {ORDERS} random orders)"),
        &["k", "triangles", "appeared", "6/((k+1)(k+2)(k+3))"],
    );
    let mut plot = Plot::new(
        "history-scopes",
        "The probability that a triangle of scope k appears",
        ["k + 1", "probability"],
    );
    let (mut measured, mut expected) = (Vec::new(), Vec::new());
    for (k, &triangles) in count.iter().enumerate().filter(|(_, triangles)| **triangles > 0) {
        let share = appeared[k] as f64 / (triangles * ORDERS) as f64;
        let probability = probability(k);
        table.row([k.to_string(), triangles.to_string(), short_or_tiny(share), short_or_tiny(probability)]);
        measured.push((k as f64 + 1.0, share));
        expected.push((k as f64 + 1.0, probability));
    }
    plot.curve("simulated", measured);
    plot.curve("6 / ((k+1)(k+2)(k+3))", expected);
    let mut totals = Table::new(
        "history-means",
        "What ever appears, on average over the orders",
        &["", "simulated", "computed from the scopes"],
    );
    let mean = |total: u64| total as f64 / ORDERS as f64;
    let [triangle_mean, edge_mean] = means(&count);
    totals.row(["triangles".to_owned(), short(mean(appeared.iter().sum())), short(triangle_mean)]);
    totals.row(["edges".to_owned(), short(mean(edges)), short(edge_mean)]);
    findings.tables.extend([table, totals]);
    findings.plots.push(plot);
    Ok(())
}

/// The probability that a triangle of scope k ever appears (Lemma 2.1).
fn probability(k: usize) -> f64 {
    6.0 / ((k + 1) * (k + 2) * (k + 3)) as f64
}

/// The expected numbers of triangles and of edges that ever appear, from the number of triangles of each scope.
///
/// The r-th point is a random one of the first r; it brings the edges at it, on average 2 / r times those of the
/// triangulation of r random points, which has as many edges as triangles and r - 1 more.
fn means(count: &[usize]) -> [f64; 2] {
    let n = count.len() + 2;
    let triangles = count.iter().enumerate().map(|(k, &c)| c as f64 * probability(k)).sum();
    let mut edges = 0.0;
    for r in 2..=n {
        let of_sample: f64 = count.iter().enumerate().map(|(k, &c)| c as f64 * chosen(n, k, r)).sum();
        edges += 2.0 / r as f64 * (of_sample + (r - 1) as f64);
    }
    [triangles, edges]
}

/// The probability that of n points r random ones hold three given ones and none of k others.
fn chosen(n: usize, k: usize, r: usize) -> f64 {
    if r < 3 || n - k < r {
        return 0.0;
    }
    // binomial(n - k - 3, r - 3) / binomial(n, r)
    let corners: f64 = (0..3).map(|i| (r - i) as f64 / (n - i) as f64).product();
    let others: f64 = (0..k).map(|i| (n - r - i) as f64 / (n - 3 - i) as f64).product();
    corners * others
}

/// How the totals grow.
fn growth(largest: usize, seed: u64, findings: &mut Findings) -> Result<(), Error> {
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
        ["points", "per point"],
    );
    let mut curves = [const { Vec::new() }; 4];
    for n in sizes(100, largest.min(200_000)) {
        let points = Kind::Uniform.points(n, seed);
        let order: Vec<usize> = (0..n).collect(); // the generator's order is random
        let (mut triangles, mut edges) = (0_u64, 0_u64);
        follow(&points, &order, |_| triangles += 1, || edges += 1)?;
        let history =
            Delaunay2::with_algorithm(&points, Algorithm2::Located { locate: Locate::History, seed })?;
        let work = history.counters().work().unwrap_or_default();
        let traced = work.visited;
        let stars = {
            let mut d = Delaunay2::from_points(&points)?;
            d.set_strategy(Locate::Stars)?;
            let mut work = Work::default();
            // Queries, not sites: what is located is as far from what is there.
            let queries = Kind::Uniform.points(QUERIES, seed + 1);
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
    findings.tables.push(table);
    findings.plots.push(plot);
    Ok(())
}

/// The unlucky site of §3: n sites on a line in random order, one high above them before, one after; then a site in between,
/// close to those two, is located.
fn unlucky(options: &Options<'_>, findings: &mut Findings) -> Result<(), Error> {
    let mut table = Table::new(
        "history-unlucky",
        "Steps and tests to locate the unlucky site of §3 (the paper: a trace linear in n; by binary search in the versions not, \
         as it hopes)",
        &[
            "points",
            "traced",
            "traced / n",
            "with orientations",
            "stars searched",
            "with orientations",
            "by circles",
            "with tests",
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

fn short_or_tiny(value: f64) -> String {
    if value != 0.0 && value < 0.001 { format!("{value:.2e}") } else { short(value) }
}

#[cfg(test)]
mod tests {
    use super::{chosen, means};

    #[test]
    fn means_of_a_triangle() {
        // Three points: one triangle of scope 0, three edges, each certain.
        let [triangles, edges] = means(&[1]);
        assert!((triangles - 1.0).abs() < 1e-12);
        assert!((edges - 3.0).abs() < 1e-12);
        assert!((chosen(5, 0, 5) - 1.0).abs() < 1e-12);
        assert!(chosen(5, 1, 5).abs() < 1e-12);
    }
}
