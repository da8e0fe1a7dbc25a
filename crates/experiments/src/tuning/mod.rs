//! `delone-lab experiment tuning`: what a level of the Delaunay hierarchy costs, and which ratio between levels is best.
//!
//! Source: Devillers 1998: bounds of the analysis (§3), phases (§4.1 to §4.3), operations and memory by the ratio (§4.4,
//! Theorem 7), crossovers with walking and sampling (§4.5, Figures 3 and 4), the counterexample of the appendix (Figure 6).

mod counterexample;
mod crossovers;
mod disks;
mod lemmas;
mod theorem;

use std::f64::consts::PI;

use delone::{Ask, Delaunay2, Hierarchy, Locate, Nearest};
use delone_generators::Kind;

use super::phases::{Phases, operations};
use super::plot::Plot;
use super::table::short;
use super::trials::Trials;
use super::{Error, Findings, Options, timed};
use crossovers::Edges;

const QUERIES: usize = 10_000;
/// The five sets of §5.5.1, for which bounds hold as for any.
const SETS: [(Kind, &str); 5] = [
    (Kind::Uniform, "random"),
    (Kind::Ellipse2, "ellipse2"),
    (Kind::Ellipse, "ellipse"),
    (Kind::Parabola, "parabola"),
    (Kind::Circle, "circle"),
];
const RATIOS: [f64; 8] = [2.0, 4.0, 8.0, 18.0, 30.0, 40.0, 60.0, 90.0];
/// The set of the figures that the paper's formulas are compared with.
const POINTS: usize = 300_000;

pub(crate) fn run(options: &Options<'_>) -> Result<Findings, Error> {
    let mut findings = Findings::default();
    lemmas::run(options, &mut findings)?;
    disks::run(options, &mut findings)?;
    theorem::run(options, &mut findings)?;
    phases(options, &mut findings)?;
    ratios(options, &mut findings)?;
    crossovers::run(options, &mut findings)?;
    counterexample::run(options, &mut findings)?;
    Ok(findings)
}

/// The work of queries, by phases.
fn count(d: &Delaunay2, queries: &[[f64; 2]]) -> Result<Phases, Error> {
    let mut phases = Phases::default();
    for &q in queries {
        d.find_observed(q, &mut phases)?;
    }
    Ok(phases)
}

/// The same, and the nanoseconds of one.
fn ask(d: &Delaunay2, queries: &[[f64; 2]]) -> Result<(Phases, f64), Error> {
    let phases = count(d, queries)?;
    let (outcome, seconds) =
        timed(|| queries.iter().try_for_each(|&q| d.find_observed(q, &mut ()).map(drop)));
    outcome?;
    Ok((phases, seconds * 1e9 / queries.len() as f64))
}

/// A uniform set with a hierarchy, made by insertion in random order.
fn uniform(n: usize, hierarchy: Hierarchy, seed: u64) -> Result<(Delaunay2, f64), Error> {
    let points = Kind::Uniform.points(n, seed);
    let mut d = Delaunay2::with_strategy(Locate::Hierarchy(hierarchy))?;
    let (outcome, seconds) = timed(|| points.iter().try_for_each(|&p| d.insert(p).map(drop)));
    outcome?;
    Ok((d, seconds * 1e9 / n as f64))
}

/// §4.1 to §4.3: what each phase does on a level, beside what the paper expects.
fn phases(options: &Options<'_>, findings: &mut Findings) -> Result<(), Error> {
    let mut table = options.table(
        "tuning-phases",
        "A level of a hierarchy over points in a square, by phase (Devillers 1998, 4.1 to 4.3)",
        &[
            "points",
            "ratio",
            "phase 3",
            "turn: orientations",
            "paper's turn",
            "walk: edges crossed",
            "paper's walk",
            "phase 3: triangles",
            "paper's phase 3",
            "phase 3: distances",
            "phase 3: in-circle tests",
        ],
    );
    for (n, ratio) in options.ends(1_000, POINTS).flat_map(|n| [8.0, 30.0].map(|ratio| (n, ratio))) {
        for (name, nearest) in
            [("corner", Nearest::Corner), ("exact", Nearest::Exact), ("in-circle", Nearest::InCircle)]
        {
            let mut trials: [Trials; 5] = Default::default();
            for seed in options.seeds() {
                let hierarchy = Hierarchy::only_levels().ratio(ratio).nearest(nearest).seed(seed);
                let mut d = Delaunay2::from_points(&Kind::Uniform.points(n, seed))?;
                d.set_strategy(Locate::Hierarchy(hierarchy))?;
                let phases = count(&d, &Kind::Uniform.points(QUERIES, seed + 1000))?;
                // Neither the highest level, where the search starts anywhere, nor phase 3 of the lowest, which has none.
                let top = phases.levels() - 1;
                let per_level = |levels: std::ops::Range<usize>, of: &dyn Fn([delone::Work; 4]) -> u64| {
                    let count = (levels.len().max(1) * QUERIES) as f64;
                    levels.map(|level| of(phases.on(level))).sum::<u64>() as f64 / count
                };
                let values = [
                    per_level(0..top, &|work| work[1].orientations),
                    // One test more than twice the edges.
                    (per_level(0..top, &|work| work[2].orientations) - 1.0) / 2.0,
                    per_level(1..top + 1, &|work| work[3].visited),
                    per_level(1..top + 1, &|work| work[3].compared),
                    per_level(1..top + 1, &|work| work[3].in_circles),
                ];
                trials.iter_mut().zip(values).for_each(|(trial, value)| trial.add(value));
            }
            let [turn, walk, triangles, distances, circles] = trials.map(|trial| trial.to_string());
            let crossed = short(2.0 * ratio.sqrt() / PI.sqrt());
            let paper = if nearest == Nearest::Corner { "0" } else { "below 8" };
            table.row([
                n.to_string(),
                ratio.to_string(),
                name.to_owned(),
                turn,
                "3".to_owned(),
                walk,
                crossed,
                triangles,
                paper.to_owned(),
                distances,
                circles,
            ]);
        }
    }
    findings.tables.push(table);
    Ok(())
}

/// §4.4: operations, time and memory by the ratio.
fn ratios(options: &Options<'_>, findings: &mut Findings) -> Result<(), Error> {
    let mut table = options.table(
        "tuning-ratio",
        "Cost of a query among points in a square by the ratio between levels (Devillers 1998, 4.4)",
        &[
            "points",
            "ratio",
            "operations",
            "paper's formula",
            "with the edges of 4.2",
            "visited",
            "with sample: operations",
            "with sample: visited",
            "ns per query",
            "ns per insertion",
            "memory",
            "ratio / (ratio - 1)",
        ],
    );
    let mut curves: [Vec<(f64, f64)>; 4] = Default::default();
    let mut shown = 0;
    for (n, ratio) in options.ends(1_000, POINTS).flat_map(|n| RATIOS.map(|ratio| (n, ratio))) {
        if ratio == RATIOS[0] {
            (curves, shown) = (Default::default(), n);
        }
        let mut trials: [Trials; 7] = Default::default();
        for seed in options.seeds() {
            let queries = Kind::Uniform.points(QUERIES, seed + 1000);
            let each = |count: u64| count as f64 / QUERIES as f64;
            let hierarchy = Hierarchy::default().ratio(ratio).seed(seed);
            // Built in bulk, without room for more.
            let mut d = Delaunay2::from_points(&Kind::Uniform.points(n, seed))?;
            d.set_strategy(Locate::Hierarchy(hierarchy))?;
            let footprint = d.footprint();
            let (mut d, insertion) = uniform(n, hierarchy, seed)?;
            let (sampled, ns) = ask(&d, &queries)?;
            d.set_strategy(Locate::Hierarchy(Hierarchy::only_levels().ratio(ratio).seed(seed)))?;
            let levels = count(&d, &queries)?;
            let values = [
                operations(&levels, QUERIES),
                each(levels.total().visited),
                operations(&sampled, QUERIES),
                each(sampled.total().visited),
                ns,
                insertion,
                (footprint.base + footprint.strategy) as f64 / footprint.base as f64,
            ];
            trials.iter_mut().zip(values).for_each(|(trial, value)| trial.add(value));
        }
        let [printed, derived] = [Edges::AsPrinted, Edges::AsDerived]
            .map(|edges| crossovers::levels((n as f64).log2(), ratio, edges));
        curves[0].push((ratio, trials[0].mean()));
        curves[1].push((ratio, trials[2].mean()));
        curves[2].push((ratio, printed));
        curves[3].push((ratio, derived));
        let [count, visited, with_sample, visited_with, ns, insertion, memory] =
            trials.map(|t| t.to_string());
        table.row([
            n.to_string(),
            ratio.to_string(),
            count,
            short(printed),
            short(derived),
            visited,
            with_sample,
            visited_with,
            ns,
            insertion,
            memory,
            short(ratio / (ratio - 1.0)),
        ]);
    }
    let mut plot = Plot::new(
        "tuning-ratio",
        &format!("Operations of a query among {shown} points by the ratio between levels"),
        ["ratio", "floating-point operations"],
    );
    let names = ["levels", "levels and sample", "the paper's formula", "the same with the edges of 4.2"];
    for (name, curve) in names.into_iter().zip(curves) {
        plot.curve(name, curve);
    }
    findings.tables.push(table);
    findings.plots.push(plot);
    Ok(())
}
