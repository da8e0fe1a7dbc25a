//! `delone-lab experiment hierarchy`: constructions by the modes of the Delaunay hierarchy and other ways, and the hierarchy in space.
//!
//! Source: Devillers 1998, §5.5.2 and §6.

use delone::{Algorithm2, Ask, Counters, Delaunay2, Delaunay3, Hierarchy, Locate, Work};
use delone_generators::{Kind, Kind3, Random};

use super::plot::Plot;
use super::table::{Table, short};
use super::trials::Trials;
use super::{Error, Findings, Options, sizes, timed};

const SIZES: [usize; 3] = [5_000, 50_000, 500_000];

/// The paper's seconds (Sun Ultra 1, 200 MHz) for walk, MSZ, hierarchy, hierarchy + MSZ; NaN is "long".
const PAPER: [(Kind, &str, [[f64; 4]; 3]); 5] = [
    (Kind::Uniform, "random", [[0.3, 0.17, 0.15, 0.14], [12.0, 3.8, 2.7, 2.3], [460.0, 72.0, 36.0, 31.0]]),
    (
        Kind::Ellipse2,
        "ellipse2",
        [[0.53, 0.34, 0.21, 0.20], [49.0, 21.0, 3.9, 3.5], [930.0, 760.0, 57.0, 49.0]],
    ),
    (
        Kind::Ellipse,
        "ellipse",
        [[2.2, 0.46, 0.31, 0.21], [187.0, 21.0, 3.9, 3.7], [f64::NAN, 270.0, 54.0, 55.0]],
    ),
    (
        Kind::Parabola,
        "parabola",
        [[2.5, 0.31, 0.21, 0.16], [87.0, 5.9, 3.2, 3.0], [f64::NAN, 74.0, 69.0, 45.0]],
    ),
    (Kind::Circle, "circle", [[0.15, 0.13, 0.13, 0.14], [2.4, 2.6, 2.4, 2.4], [39.0, 44.0, 36.0, 36.0]]),
];

/// A mode that is expected to visit more triangles is not run, and called long as in the paper.
const LONG: f64 = 1e10;
/// Visits, above which an expected run is made once.
const ONCE: f64 = 5e8;
const WAYS: [&str; 8] =
    ["walk", "MSZ", "hierarchy", "hierarchy+MSZ", "tree", "history", "conflict lists", "divide&conquer"];
/// Queries in space.
const QUERIES: usize = 10_000;

fn ways(seed: u64) -> [Algorithm2; WAYS.len()] {
    let located = |locate| Algorithm2::Located { locate, seed };
    let hierarchy = |options: Hierarchy| located(Locate::Hierarchy(options.seed(seed)));
    [
        hierarchy(Hierarchy::only_walk()),
        hierarchy(Hierarchy::only_sample()),
        hierarchy(Hierarchy::only_levels()),
        hierarchy(Hierarchy::default()),
        located(Locate::Tree),
        located(Locate::History),
        Algorithm2::ConflictLists { seed },
        Algorithm2::DivideAndConquer,
    ]
}

pub(crate) fn run(options: &Options<'_>) -> Result<Findings, Error> {
    let heads = |extra: &[&'static str]| [&["set", "size"], &WAYS[..], extra].concat();
    let beside = ["paper walk", "paper MSZ", "paper hier.", "paper hier.+MSZ"];
    let mut seconds = options.table(
        "hierarchy-seconds",
        "Seconds to build, points in random order (paper: Devillers 1998, 5.5.2, Sun Ultra 1)",
        &heads(&beside),
    );
    let mut visited = options.table("hierarchy-visited", "Triangles visited per point", &heads(&[]));
    let mut findings = Findings::default();
    for (kind, name, paper) in PAPER {
        let title = format!("{name}: nanoseconds per point");
        let mut plot = Plot::new(&format!("hierarchy-{name}"), &title, ["points", "ns per point"]);
        let mut curves = vec![Vec::new(); WAYS.len()];
        // Visits a point, by size.
        let mut counts: Vec<Vec<(usize, f64)>> = vec![Vec::new(); WAYS.len()];
        for (size, paper) in SIZES.into_iter().zip(paper).filter(|(size, _)| *size <= options.largest) {
            let mut cells = [(); 2].map(|()| vec![name.to_owned(), size.to_string()]);
            for (way, (curve, counts)) in curves.iter_mut().zip(&mut counts).enumerate() {
                // The visits of all points grow at most with the square of their number.
                let square = (size as f64).powi(2);
                let expected = counts.last().map_or(0.0, |&(n, visits)| visits / n as f64 * square);
                if expected > LONG {
                    cells.iter_mut().for_each(|cells| cells.push("long".to_owned()));
                    continue;
                }
                let seeds = options.seeds().take(if expected > ONCE { 1 } else { options.trials });
                let [times, visits] = build(kind, size, way, seeds)?;
                curve.push((size as f64, times.mean() * 1e9 / size as f64));
                counts.push((size, visits.mean()));
                cells
                    .iter_mut()
                    .zip([times, visits])
                    .for_each(|(cells, trials)| cells.push(trials.to_string()));
            }
            let [mut times, visits] = cells;
            times.extend(paper.map(|s| if s.is_nan() { "long".to_owned() } else { short(s) }));
            seconds.row(times);
            visited.row(visits);
        }
        for (name, curve) in WAYS.iter().zip(curves) {
            plot.curve(name, curve);
        }
        findings.plots.push(plot);
    }
    findings.tables = vec![seconds, visited, in_space(options)?];
    Ok(findings)
}

/// Seconds of a construction, and triangles visited a point, each time from other points in another order.
fn build(
    kind: Kind,
    size: usize,
    way: usize,
    seeds: impl Iterator<Item = u64>,
) -> Result<[Trials; 2], Error> {
    let mut trials: [Trials; 2] = Default::default();
    for seed in seeds {
        let mut points = kind.points(size, seed);
        Random::new(seed).shuffle(&mut points);
        let (d, time) = timed(|| Delaunay2::with_algorithm(&points, ways(seed)[way]));
        trials[0].add(time);
        if let Counters::Incremental(work) = d?.counters() {
            trials[1].add(work.visited as f64 / size as f64);
        }
    }
    Ok(trials)
}

/// The hierarchy in space, to which the paper says that it generalizes (§6).
fn in_space(options: &Options<'_>) -> Result<Table, Error> {
    let title =
        "Tetrahedra visited per query in a cube, and vertices compared by the hierarchy (Devillers 1998, 6)";
    let heads = ["points", "walk", "MSZ", "hierarchy", "hierarchy+MSZ", "compared", "ratio 8+MSZ"];
    let mut table = options.table("hierarchy-space", title, &heads);
    for n in sizes(1_000, options.largest.min(300_000)) {
        let mut trials: [Trials; 6] = Default::default();
        for seed in options.seeds() {
            let mut d = Delaunay3::from_points(&Kind3::Cube.points(n, seed))?;
            let queries = Kind3::Cube.points(QUERIES, seed + 1000);
            let mut visited = |hierarchy: Hierarchy| -> Result<Work, Error> {
                d.set_strategy(Locate::Hierarchy(hierarchy.seed(seed)))?;
                let mut work = Work::default();
                queries.iter().try_for_each(|&q| d.find_observed(q, &mut work).map(drop))?;
                Ok(work)
            };
            let both = visited(Hierarchy::default())?;
            let counts = [
                visited(Hierarchy::only_walk())?.visited,
                visited(Hierarchy::only_sample())?.visited,
                visited(Hierarchy::only_levels())?.visited,
                both.visited,
                both.compared,
                visited(Hierarchy::default().ratio(8.0))?.visited,
            ];
            trials.iter_mut().zip(counts).for_each(|(trial, x)| trial.add(x as f64 / QUERIES as f64));
        }
        table.row([n.to_string()].into_iter().chain(trials.map(|trial| trial.to_string())));
    }
    Ok(table)
}
