//! `delone-lab experiment jump-and-walk`: the theorem of Devroye, Mücke & Zhu 1998 and its remarks, in figures.
//!
//! Edges crossed by segments (the lemma); triangles visited from the nearest of 32 vertices (remark 6), the sample size of least
//! cost and the growth of that cost (the theorem); other densities (remark 1), queries near the border (remark 2), changes and
//! constructions (remarks 3 and 4), space (remark 7).

use std::f64::consts::PI;

use delone::{Ask, Change, Delaunay2, Delaunay3, JumpAndWalk, Locate, Work};
use delone_generators::{Kind, Kind3, Random};
use delone_predicates::{Sign, orient2d};

use super::plot::Plot;
use super::table::short;
use super::trials::Trials;
use super::{Error, Findings, Options, sizes, timed};

const QUERIES: usize = 20_000;
/// Segments of each length, in sides of the square. They end 3 sqrt(ln n / n) from the border or further, as the lemma asks.
const SEGMENTS: usize = 200;
/// The largest set of which all edges are tested.
const CROSSED: usize = 100_000;
const LENGTHS: [f64; 3] = [0.05, 0.1, 0.2];
/// Vertices drawn by all queries of a large sample, or little more.
const DRAWN: usize = 2_000_000;
/// The largest set in space, and the largest of curves, where walks are long.
const LARGEST_SPECIAL: usize = 300_000;

pub(crate) fn run(options: &Options<'_>) -> Result<Findings, Error> {
    let mut findings = Findings::default();
    segments(options, &mut findings)?;
    fixed(options, &mut findings)?;
    by_sample(options, &mut findings)?;
    growth(options, &mut findings)?;
    densities(options, &mut findings)?;
    changes(options, &mut findings)?;
    space(options, &mut findings)?;
    Ok(findings)
}

/// Mean work of queries, and the nanoseconds of one.
struct Cost {
    visited: f64,
    compared: f64,
    ns: f64,
}

fn measure<A: Ask>(d: &A, queries: &[A::Point]) -> Result<Cost, Error> {
    let mut work = Work::default();
    queries.iter().try_for_each(|&q| d.find_observed(q, &mut work).map(drop))?;
    let (outcome, seconds) =
        timed(|| queries.iter().try_for_each(|&q| d.find_observed(q, &mut ()).map(drop)));
    outcome?;
    let mean = |total: u64| total as f64 / queries.len() as f64;
    Ok(Cost {
        visited: mean(work.visited),
        compared: mean(work.compared),
        ns: seconds * 1e9 / queries.len() as f64,
    })
}

/// A uniform set whose queries start at one of `sample` vertices, or of n^(1/3).
fn uniform(n: usize, sample: Option<usize>, seed: u64) -> Result<Delaunay2, Error> {
    let mut d = Delaunay2::from_points(&Kind::Uniform.points(n, seed))?;
    d.set_strategy(Locate::JumpAndWalk(JumpAndWalk::default().sample(sample).seed(seed)))?;
    Ok(d)
}

/// At least a tenth of the side away from the border. The theorem wants 2 sqrt(ln n / m), which for a sample of n^(1/3) leaves
/// nothing of the square up to a million points and more; what it guards against is seen at the border alone.
fn inside(seed: u64) -> Vec<[f64; 2]> {
    let mut random = Random::new(seed + 1000);
    (0..QUERIES).map(|_| [random.between(0.1, 0.9), random.between(0.1, 0.9)]).collect()
}

/// At the border, a hundredth of the side away at most.
fn at_border(seed: u64) -> Vec<[f64; 2]> {
    let mut random = Random::new(seed + 2000);
    let mut at_side = |along: f64| {
        let depth = random.between(0.0, 0.01);
        match random.below(4) {
            0 => [along, depth],
            1 => [along, 1.0 - depth],
            2 => [depth, along],
            _ => [1.0 - depth, along],
        }
    };
    let along = inside(seed + 1);
    along.iter().map(|q| at_side((q[0] - 0.1) / 0.8)).collect()
}

/// The exponent of a power law through points: least squares on logarithms.
fn exponent(points: &[(f64, f64)]) -> String {
    let logs: Vec<[f64; 2]> = points.iter().map(|&(x, y)| [x.ln(), y.ln()]).collect();
    let mean = |axis: usize| logs.iter().map(|p| p[axis]).sum::<f64>() / logs.len() as f64;
    let (x, y) = (mean(0), mean(1));
    let [over, under] = logs
        .iter()
        .fold([0.0, 0.0], |[over, under], p| [over + (p[0] - x) * (p[1] - y), under + (p[0] - x).powi(2)]);
    short(over / under)
}

/// The lemma: a fixed segment away from the border crosses c3 + c4 L sqrt(n) edges. Of random points c4 is 64 / (3 pi^2) = 2.16,
/// from the mean length of an edge. All edges are tested, so that nothing of a walk is counted.
fn segments(options: &Options<'_>, findings: &mut Findings) -> Result<(), Error> {
    let title = "Edges that a segment of length L crosses among points in a square (Devroye, Mücke & Zhu 1998, the lemma; theory: 2.16)";
    let mut table =
        options.table("jump-and-walk-segments", title, &["points", "L", "edges crossed", "/ (L sqrt n)"]);
    for n in sizes(1_000, options.largest.min(CROSSED)) {
        let mut trials: [Trials; LENGTHS.len()] = Default::default();
        for seed in options.seeds() {
            let d = Delaunay2::from_points(&Kind::Uniform.points(n, seed))?;
            let edges: Vec<[[f64; 2]; 2]> = d.edges().map(|edge| edge.map(|v| d.point(v))).collect();
            let mut random = Random::new(seed + 1000);
            for (&length, trials) in LENGTHS.iter().zip(&mut trials) {
                let mut crossed = 0;
                for _ in 0..SEGMENTS {
                    let middle = [(); 2].map(|()| random.between(0.45, 0.55));
                    let angle = random.between(0.0, PI);
                    let half = [angle.cos(), angle.sin()].map(|x| x * length / 2.0);
                    let [p, q] = [-1.0, 1.0].map(|side| [0, 1].map(|k| middle[k] + side * half[k]));
                    let parts =
                        |u, v, [a, b]: [[f64; 2]; 2]| orient2d(u, v, a) * orient2d(u, v, b) == Sign::Negative;
                    let is_crossed = |&&[a, b]: &&[[f64; 2]; 2]| parts(p, q, [a, b]) && parts(a, b, [p, q]);
                    crossed += edges.iter().filter(is_crossed).count();
                }
                trials.add(crossed as f64 / SEGMENTS as f64);
            }
        }
        for (length, trials) in LENGTHS.into_iter().zip(trials) {
            let per_length = trials.over(length * (n as f64).sqrt()).to_string();
            table.row([n.to_string(), length.to_string(), trials.to_string(), per_length]);
        }
    }
    findings.tables.push(table);
    Ok(())
}

/// Remark 6. A segment crosses 2.16 sqrt(n) edges per unit of length (Bose & Devroye), and the nearest of m vertices is at
/// 1 / (2 sqrt(m + 1)) on average.
fn fixed(options: &Options<'_>, findings: &mut Findings) -> Result<(), Error> {
    let heads = ["points", "visited", "expected crossings", "visited, at the border", "paper"];
    let title =
        "Triangles visited from the nearest of 32 sampled vertices (Devroye, Mücke & Zhu 1998, remark 6)";
    let mut table = options.table("jump-and-walk-visited", title, &heads);
    for (n, paper) in [(3_200, 36), (32_000, 50)] {
        let (mut visited, mut border) = (Trials::default(), Trials::default());
        for seed in options.seeds() {
            let d = uniform(n, Some(32), seed)?;
            visited.add(measure(&d, &inside(seed))?.visited);
            border.add(measure(&d, &at_border(seed))?.visited);
        }
        let expected = 2.16 * (n as f64).sqrt() / (2.0 * 33f64.sqrt());
        table.row([
            n.to_string(),
            visited.to_string(),
            short(expected),
            border.to_string(),
            format!("about {paper}"),
        ]);
    }
    findings.tables.push(table);
    Ok(())
}

fn by_sample(options: &Options<'_>, findings: &mut Findings) -> Result<(), Error> {
    let mut table = options.table(
        "jump-and-walk-sample",
        "Cost against the sample size m",
        &["points", "m", "visited", "visited + m", "with replacement: visited", "ns per query"],
    );
    let mut curves: [Vec<(f64, f64)>; 2] = Default::default();
    let mut shown = 0;
    for n in options.ends(1_000, 100_000) {
        (curves, shown) = (Default::default(), n);
        let mut sets = Vec::new();
        for seed in options.seeds() {
            sets.push((uniform(n, None, seed)?, inside(seed), seed));
        }
        for power in (0..=24).filter(|power| *power != 1) {
            let m = 2f64.powf(f64::from(power) / 2.0).round() as usize;
            if m > n {
                break;
            }
            let mut trials: [Trials; 4] = Default::default();
            for (d, queries, seed) in &mut sets {
                let queries = &queries[..(DRAWN / m).clamp(1_000, QUERIES)];
                let mut costs = Vec::new();
                for with_replacement in [false, true] {
                    let way = JumpAndWalk::default()
                        .sample(m)
                        .seed(*seed)
                        .with_replacement(with_replacement)
                        .rho(1.0);
                    d.set_strategy(Locate::JumpAndWalk(way))?;
                    costs.push(measure(d, queries)?);
                }
                let [without, with] = [&costs[0], &costs[1]];
                let values = [without.visited, without.visited + without.compared, with.visited, without.ns];
                trials.iter_mut().zip(values).for_each(|(trial, value)| trial.add(value));
            }
            for (curve, trial) in curves.iter_mut().zip(&trials) {
                curve.push((m as f64, trial.mean()));
            }
            table
                .row([n.to_string(), m.to_string()].into_iter().chain(trials.map(|trial| trial.to_string())));
        }
    }
    let mut plot = Plot::new(
        "jump-and-walk-sample",
        &format!("Jump-and-walk: cost against the sample size, {shown} points"),
        ["sampled vertices m", "triangles visited, or both"],
    );
    for (name, curve) in ["triangles visited", "visited + m"].into_iter().zip(curves) {
        plot.curve(name, curve);
    }
    findings.tables.push(table);
    findings.plots.push(plot);
    Ok(())
}

/// The theorem, and remark 2.
fn growth(options: &Options<'_>, findings: &mut Findings) -> Result<(), Error> {
    let mut table = options.table(
        "jump-and-walk-growth",
        "Cost with m = n^(1/3); the last row is the exponent of n",
        &["points", "m", "visited", "visited + m", "in n^(1/3)", "visited, at the border", "ns per query"],
    );
    let mut curves: [Vec<(f64, f64)>; 2] = Default::default();
    for n in sizes(1_000, options.largest) {
        let mut trials: [Trials; 6] = Default::default();
        for seed in options.seeds() {
            let d = uniform(n, None, seed)?;
            let cost = measure(&d, &inside(seed))?;
            let border = measure(&d, &at_border(seed))?.visited;
            let both = cost.visited + cost.compared;
            let values = [cost.compared, cost.visited, both, both / (n as f64).cbrt(), border, cost.ns];
            trials.iter_mut().zip(values).for_each(|(trial, value)| trial.add(value));
        }
        curves[0].push((n as f64, trials[2].mean()));
        curves[1].push((n as f64, trials[4].mean()));
        table.row([n.to_string()].into_iter().chain(trials.map(|trial| trial.to_string())));
    }
    let [cost, border] = curves;
    if cost.len() > 1 {
        let none = || "-".to_owned();
        let fitted = [none(), none(), exponent(&cost), none(), exponent(&border), none()];
        table.row(["exponent".to_owned()].into_iter().chain(fitted));
    }
    let ideal: Vec<_> = cost.iter().map(|&(n, _)| (n, cost[0].1 * (n / cost[0].0).cbrt())).collect();
    let mut plot = Plot::new(
        "jump-and-walk-growth",
        "Jump-and-walk: cost against the number of points, m = n^(1/3)",
        ["points", "triangles visited + m"],
    );
    plot.curve("visited + m", cost);
    plot.curve("proportional to n^(1/3)", ideal);
    plot.curve("visited, at the border", border);
    findings.tables.push(table);
    findings.plots.push(plot);
    Ok(())
}

/// Remark 1: densities bounded away from nothing and infinity are as good; these are not.
fn densities(options: &Options<'_>, findings: &mut Findings) -> Result<(), Error> {
    const KINDS: [(Kind, &str); 5] = [
        (Kind::Uniform, "uniform"),
        (Kind::Clusters, "clusters"),
        (Kind::LogNormal, "log-normal"),
        (Kind::Circle, "circle"),
        (Kind::Ellipse2, "ellipse2"),
    ];
    let mut table = options.table(
        "jump-and-walk-densities",
        "Visited + m in units of n^(1/3), points and queries of other densities; the last row is the exponent of n",
        &["points", KINDS[0].1, KINDS[1].1, KINDS[2].1, KINDS[3].1, KINDS[4].1],
    );
    let mut curves: [Vec<(f64, f64)>; KINDS.len()] = Default::default();
    for n in sizes(1_000, options.largest.min(LARGEST_SPECIAL)) {
        let mut cells = vec![n.to_string()];
        for ((kind, _), curve) in KINDS.into_iter().zip(&mut curves) {
            let mut trials = Trials::default();
            for seed in options.seeds() {
                let mut d = Delaunay2::from_points(&kind.points(n, seed))?;
                d.set_strategy(Locate::JumpAndWalk(JumpAndWalk::default().seed(seed)))?;
                let cost = measure(&d, &kind.points(QUERIES / 4, seed + 1000))?;
                trials.add((cost.visited + cost.compared) / (n as f64).cbrt());
            }
            curve.push((n as f64, trials.mean() * (n as f64).cbrt()));
            cells.push(trials.to_string());
        }
        table.row(cells);
    }
    if curves[0].len() > 1 {
        table.row(["exponent".to_owned()].into_iter().chain(curves.iter().map(|curve| exponent(curve))));
    }
    let title = "Jump-and-walk among points of other densities, m = n^(1/3)";
    let mut plot = Plot::new("jump-and-walk-densities", title, ["points", "triangles visited + m"]);
    for ((_, name), curve) in KINDS.into_iter().zip(curves) {
        plot.curve(name, curve);
    }
    findings.tables.push(table);
    findings.plots.push(plot);
    Ok(())
}

/// Remarks 3 and 4: insertion one by one, and removal and insertion in turn.
fn changes(options: &Options<'_>, findings: &mut Findings) -> Result<(), Error> {
    let mut table = options.table(
        "jump-and-walk-changes",
        "A set in a square built point by point, then as many changes; visited + m, and seconds. The last row is the exponent of n",
        &["points", "to build", "in n^(4/3)", "seconds", "a change", "in n^(1/3)", "ns a change"],
    );
    let mut curves: [Vec<(f64, f64)>; 2] = Default::default();
    for n in sizes(1_000, options.largest.min(LARGEST_SPECIAL)) {
        let mut trials: [Trials; 6] = Default::default();
        for seed in options.seeds() {
            let points = Kind::Uniform.points(2 * n, seed);
            let (first, others) = points.split_at(n);
            let strategy = JumpAndWalk::default().seed(seed);
            let mut d = Delaunay2::with_strategy(Locate::JumpAndWalk(strategy))?;
            let mut built = Work::default();
            let (outcome, seconds) =
                timed(|| first.iter().try_for_each(|&p| d.insert_observed(p, &mut built).map(drop)));
            outcome?;
            let vertices: Vec<_> = d.vertices().collect();
            let mut changed = Work::default();
            let (outcome, later) = timed(|| {
                vertices.iter().zip(others).try_for_each(|(&v, &p)| {
                    d.remove_observed(v, &mut changed)?;
                    d.insert_observed(p, &mut changed).map(drop)
                })
            });
            outcome?;
            let cost = |work: Work| (work.visited + work.compared) as f64;
            let (n, root) = (n as f64, (n as f64).cbrt());
            let each = cost(changed) / n;
            let values = [cost(built), cost(built) / (n * root), seconds, each, each / root, later * 1e9 / n];
            trials.iter_mut().zip(values).for_each(|(trial, value)| trial.add(value));
        }
        curves[0].push((n as f64, trials[0].mean()));
        curves[1].push((n as f64, trials[3].mean()));
        table.row([n.to_string()].into_iter().chain(trials.map(|trial| trial.to_string())));
    }
    if curves[0].len() > 1 {
        let none = || "-".to_owned();
        let fitted = [exponent(&curves[0]), none(), none(), exponent(&curves[1]), none(), none()];
        table.row(["exponent".to_owned()].into_iter().chain(fitted));
    }
    findings.tables.push(table);
    Ok(())
}

/// Remark 7.
fn space(options: &Options<'_>, findings: &mut Findings) -> Result<(), Error> {
    let mut table = options.table(
        "jump-and-walk-space",
        "Points in a cube, m = n^(1/4); the last row is the exponent of n",
        &["points", "m", "visited", "visited + m", "in n^(1/4)", "ns per query"],
    );
    let mut curve = Vec::new();
    for n in sizes(1_000, options.largest.min(LARGEST_SPECIAL)) {
        let mut trials: [Trials; 5] = Default::default();
        for seed in options.seeds() {
            let mut d = Delaunay3::from_points(&Kind3::Cube.points(n, seed))?;
            d.set_strategy(Locate::JumpAndWalk(JumpAndWalk::default().seed(seed)))?;
            let mut random = Random::new(seed + 1000);
            let mut between = || random.between(0.1, 0.9);
            let queries: Vec<_> = (0..QUERIES / 2).map(|_| [between(), between(), between()]).collect();
            let cost = measure(&d, &queries)?;
            let both = cost.visited + cost.compared;
            let root = (n as f64).powf(0.25);
            let values = [cost.compared, cost.visited, both, both / root, cost.ns];
            trials.iter_mut().zip(values).for_each(|(trial, value)| trial.add(value));
        }
        curve.push((n as f64, trials[2].mean()));
        table.row([n.to_string()].into_iter().chain(trials.map(|trial| trial.to_string())));
    }
    if curve.len() > 1 {
        let none = || "-".to_owned();
        table.row(["exponent".to_owned(), none(), none(), exponent(&curve), none(), none()]);
    }
    findings.tables.push(table);
    Ok(())
}
