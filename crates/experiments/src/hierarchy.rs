//! Construction time by mode of the Delaunay hierarchy: Devillers 1998, §5.5.2.

use delone::{Algorithm2, Counters, Delaunay2, Hierarchy, Locate};
use delone_generators::{Kind, Random};

use super::plot::Plot;
use super::table::{Table, short};
use super::{Error, Findings, Options, timed};

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

/// A mode that is expected to take longer is not run, and called long as in the paper.
const PATIENCE: f64 = 60.0;

fn ways() -> [(&'static str, Algorithm2); 8] {
    let located = |locate| Algorithm2::Located { locate, seed: 1 };
    let hierarchy = |options| located(Locate::Hierarchy(options));
    [
        ("walk", hierarchy(Hierarchy::only_walk())),
        ("MSZ", hierarchy(Hierarchy::only_sample())),
        ("hierarchy", hierarchy(Hierarchy::only_levels())),
        ("hierarchy+MSZ", hierarchy(Hierarchy::default())),
        ("tree", located(Locate::Tree)),
        ("history", located(Locate::History)),
        ("conflict lists", Algorithm2::ConflictLists { seed: 1 }),
        ("divide&conquer", Algorithm2::DivideAndConquer),
    ]
}

pub(crate) fn run(options: &Options<'_>) -> Result<Findings, Error> {
    let (largest, seed) = (options.largest, options.seed);
    let ways = ways();
    let heads = |extra: &[&'static str]| -> Vec<&'static str> {
        let mut heads = vec!["set", "size"];
        heads.extend(ways.iter().map(|way| way.0));
        heads.extend(extra);
        heads
    };
    let beside = ["paper walk", "paper MSZ", "paper hier.", "paper hier.+MSZ"];
    let mut seconds = Table::new(
        "hierarchy-seconds",
        "Seconds to build, points in random order (paper: Devillers 1998, 5.5.2, Sun Ultra 1)",
        &heads(&beside),
    );
    let mut visited = Table::new("hierarchy-visited", "Triangles visited per point", &heads(&[]));
    let mut findings = Findings::default();
    for (kind, name, paper) in PAPER {
        let title = format!("{name}: nanoseconds per point");
        let mut plot = Plot::new(&format!("hierarchy-{name}"), &title, ["points", "ns per point"]);
        let mut curves = vec![Vec::new(); ways.len()];
        for (size, paper) in SIZES.into_iter().zip(paper).filter(|(size, _)| *size <= largest) {
            let mut points = kind.points(size, seed);
            Random::new(seed).shuffle(&mut points);
            let mut cells =
                [vec![name.to_owned(), size.to_string()], vec![name.to_owned(), size.to_string()]];
            for (i, (_, algorithm)) in ways.iter().enumerate() {
                let before: &Vec<(f64, f64)> = &curves[i];
                // From one size to the next the time of a bad mode grows at most with the square.
                let last = before.last().map_or(0.0, |&(n, ns)| n * ns * 1e-9);
                let skipped = before.len() < SIZES.iter().filter(|&&s| s < size).count();
                if skipped || last * 40.0 > PATIENCE {
                    cells.iter_mut().for_each(|cells| cells.push("long".to_owned()));
                    continue;
                }
                let (d, time) = timed(|| Delaunay2::with_algorithm(&points, *algorithm));
                curves[i].push((size as f64, time * 1e9 / size as f64));
                cells[0].push(short(time));
                cells[1].push(match d?.counters() {
                    Counters::Incremental(work) => short(work.visited as f64 / size as f64),
                    _ => "-".to_owned(),
                });
            }
            let [mut times, visits] = cells;
            times.extend(paper.map(|s| if s.is_nan() { "long".to_owned() } else { short(s) }));
            seconds.row(times);
            visited.row(visits);
        }
        for ((name, _), curve) in ways.iter().zip(curves) {
            plot.curve(name, curve);
        }
        findings.plots.push(plot);
    }
    findings.tables = vec![seconds, visited];
    Ok(findings)
}
