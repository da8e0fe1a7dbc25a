//! From how many points on sampling and levels pay: Figures 3 and 4, by the paper's formulas and by what is counted.

use delone::Hierarchy;
use delone_generators::Kind;

use super::{count, uniform};
use crate::phases::operations;
use crate::plot::Plot;
use crate::table::short;
use crate::trials::Trials;
use crate::{Error, Findings, Options};

/// The paper's ratio in the figures.
const RATIO: f64 = 40.0;
/// Queries among few points, in as many sets.
const QUERIES: usize = 400;
const SETS: u64 = 25;

/// The number of edges crossed on a walk in the formulas of the paper. §4.2 derives 2 sqrt(n) / sqrt(pi) of them, but §4.4 and
/// §4.5 count half as many.
#[derive(Clone, Copy)]
pub(super) enum Edges {
    AsPrinted,
    AsDerived,
}

impl Edges {
    /// Operations on a walk among n points, per sqrt(n): eleven for each edge.
    fn slope(self) -> f64 {
        match self {
            Self::AsPrinted => 6.2,
            Self::AsDerived => 12.4,
        }
    }
}

/// A walk from a random one of n points (§4.5).
fn walk(n: f64, edges: Edges) -> f64 {
    17.0 + edges.slope() * n.sqrt()
}

/// The cost of a walk from the nearest of n^(1/3) samples.
fn sample(n: f64, edges: Edges) -> f64 {
    17.0 + n.cbrt() * (edges.slope() + 5.0)
}

/// Levels without number, the cost of each the same (§4.4). The paper prints 29 where the sum above it is 32.
pub(super) fn levels(log2: f64, ratio: f64, edges: Edges) -> f64 {
    (32.0 + edges.slope() * ratio.sqrt()) * log2 / ratio.log2()
}

/// Two levels.
fn two_levels(n: f64, edges: Edges) -> f64 {
    walk(n / RATIO, edges) + 15.0 + walk(RATIO, edges)
}

/// A way to compare: by formula, and as a mode of the hierarchy.
type Way = (&'static str, fn(f64, Edges) -> f64, Hierarchy);

pub(super) fn run(options: &Options<'_>, findings: &mut Findings) -> Result<(), Error> {
    let two = Hierarchy::only_levels().ratio(RATIO).levels(2).smallest_level(1);
    let ways: [Way; 3] = [
        ("walk", walk, Hierarchy::only_walk()),
        ("sample", sample, Hierarchy::only_sample().smallest_sampled(1)),
        ("two levels", two_levels, two),
    ];
    let sizes: Vec<usize> = (0..21)
        .map(|k| (10.0 * 1.4f64.powi(k)).round() as usize)
        .take_while(|&n| n <= options.largest)
        .collect();
    let heads = [
        "points",
        "walk",
        "walk: formula",
        "walk: edges of 4.2",
        "sample",
        "sample: formula",
        "sample: edges of 4.2",
        "two levels",
        "two levels: formula",
        "two levels: edges of 4.2",
    ];
    let title = "Operations of a query among few points (Devillers 1998, 4.5, Figure 4)";
    let mut counted = options.table("tuning-operations", title, &heads);
    let mut curves: Vec<Vec<(f64, f64)>> = vec![Vec::new(); ways.len()];
    for &n in &sizes {
        let mut cells = vec![n.to_string()];
        for (way, curve) in ways.iter().zip(&mut curves) {
            let mut trials = Trials::default();
            for set in 0..SETS {
                let seed = options.seed + 100 * set;
                // One by one: a walk begins at the last of random points.
                let (d, _) = uniform(n, way.2.seed(seed), seed)?;
                let phases = count(&d, &Kind::Uniform.points(QUERIES, seed + 1))?;
                trials.add(operations(&phases, QUERIES));
            }
            cells.push(trials.to_string());
            cells.extend([Edges::AsPrinted, Edges::AsDerived].map(|edges| short(way.1(n as f64, edges))));
            curve.push((n as f64, trials.mean()));
        }
        counted.row(cells);
    }
    let mut table = options.table(
        "tuning-crossovers",
        "From how many points on one way takes fewer operations than another (Devillers 1998, 4.5, Figure 4)",
        &["better", "than", "paper", "its formulas", "with the edges of 4.2", "measured crossover"],
    );
    for (better, worse, paper) in [(1, 0, 40), (2, 0, 180), (2, 1, 600)] {
        let [printed, derived] = [Edges::AsPrinted, Edges::AsDerived].map(|edges| {
            let cost = |way: usize, n: u32| ways[way].1(f64::from(n), edges);
            let least = (1..1_000_000).find(|&n| cost(better, n) < cost(worse, n));
            least.map_or("never".to_owned(), |n| n.to_string())
        });
        table.row([
            ways[better].0.to_owned(),
            ways[worse].0.to_owned(),
            paper.to_string(),
            printed,
            derived,
            crossing(&curves[better], &curves[worse]),
        ]);
    }
    let mut plot = Plot::new(
        "tuning-crossovers",
        "Operations of a query by the number of points, counted and by formulas with the edges of 4.2",
        ["points", "floating-point operations"],
    );
    for ((name, formula, _), curve) in ways.iter().zip(curves) {
        plot.curve(
            &format!("{name}, formula"),
            curve.iter().map(|&(n, _)| (n, formula(n, Edges::AsDerived))).collect::<Vec<_>>(),
        );
        plot.curve(name, curve);
    }
    let mut large = Plot::new(
        "tuning-formulas",
        "Figures 3 and 4: floating-point operations of a query by the paper's formulas",
        ["points", "floating-point operations"],
    );
    let n = || (4..=40).map(|k| 10f64.powf(f64::from(k) / 8.0));
    for (name, edges) in [("", Edges::AsPrinted), (", edges of 4.2", Edges::AsDerived)] {
        large.curve(&format!("walk{name}"), n().map(|n| (n, walk(n, edges))));
        large.curve(&format!("sample{name}"), n().map(|n| (n, sample(n, edges))));
        large.curve(&format!("two levels{name}"), n().map(|n| (n, two_levels(n, edges))));
        large
            .curve(&format!("levels without number{name}"), n().map(|n| (n, levels(n.log2(), RATIO, edges))));
    }
    findings.tables.extend([counted, table]);
    findings.plots.extend([plot, large]);
    Ok(())
}

/// Where a curve falls below another one for good, between measured sizes by their logarithms.
fn crossing(better: &[(f64, f64)], worse: &[(f64, f64)]) -> String {
    let gain: Vec<(f64, f64)> = better.iter().zip(worse).map(|(b, w)| (b.0.ln(), w.1 - b.1)).collect();
    match gain.iter().rposition(|&(_, gain)| gain <= 0.0) {
        None => format!("below {}", short(better[0].0)),
        Some(last) if last + 1 == gain.len() => format!("above {}", short(better[last].0)),
        Some(last) => {
            let [(x, low), (y, high)] = [gain[last], gain[last + 1]];
            short((x + (y - x) * -low / (high - low)).exp())
        }
    }
}
