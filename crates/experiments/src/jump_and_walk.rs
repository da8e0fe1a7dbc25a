//! Jump-and-walk: Devroye, Mücke & Zhu 1998.

use delone::{Ask, Delaunay2, JumpAndWalk, Locate, Work};
use delone_generators::{Kind, Random};

use super::plot::Plot;
use super::table::{Table, short};
use super::{Error, Findings, Options, timed};

const QUERIES: usize = 20_000;

/// Mean work of random queries, and the nanoseconds of one.
fn measure(d: &Delaunay2, queries: &[[f64; 2]]) -> Result<([f64; 2], f64), Error> {
    let mut work = Work::default();
    let (outcome, seconds) =
        timed(|| queries.iter().try_for_each(|&q| d.find_observed(q, &mut work).map(drop)));
    outcome?;
    let mean = |total: u64| total as f64 / queries.len() as f64;
    Ok(([mean(work.visited), mean(work.compared)], seconds * 1e9 / queries.len() as f64))
}

pub(crate) fn run(options: &Options<'_>) -> Result<Findings, Error> {
    let (largest, seed) = (options.largest, options.seed);
    let queries: Vec<[f64; 2]> = {
        // Away from the border, as the theorem asks.
        let mut random = Random::new(seed + 1);
        (0..QUERIES).map(|_| [random.between(0.1, 0.9), random.between(0.1, 0.9)]).collect()
    };
    let set = |n: usize, sample: Option<usize>| {
        let mut d = Delaunay2::from_points(&Kind::Uniform.points(n, seed))?;
        d.set_strategy(Locate::JumpAndWalk(JumpAndWalk { sample, seed, ..JumpAndWalk::default() }))?;
        Ok::<_, Error>(d)
    };

    let mut fixed = Table::new(
        "jump-and-walk-visited",
        "Triangles visited from the nearest of 32 sampled vertices",
        &["points", "visited", "visited + 32", "expected crossings", "paper"],
    );
    for (n, paper) in [(3_200, 36.0), (32_000, 50.0)] {
        let ([visited, _], _) = measure(&set(n, Some(32))?, &queries)?;
        // Crossings of a segment per length are 2.16 sqrt(n); the nearest of m is at 1 / (2 sqrt(m + 1)).
        let expected = 2.16 * (n as f64).sqrt() / (2.0 * 33f64.sqrt());
        let row = [visited, visited + 32.0, expected].map(short);
        fixed.row([vec![n.to_string()], row.to_vec(), vec![format!("about {paper}")]].concat());
    }

    let n = largest.min(100_000);
    let mut by_sample = Table::new(
        "jump-and-walk-sample",
        &format!("Cost against the sample size m, {n} points (n^(1/3) is {:.0})", (n as f64).cbrt()),
        &["m", "visited", "visited + m", "ns per query"],
    );
    let mut plot = Plot::new(
        "jump-and-walk-sample",
        &format!("Jump-and-walk: cost against the sample size, {n} points"),
        ["sampled vertices m", "triangles visited, or both"],
    );
    let mut d = set(n, None)?;
    let (mut walks, mut totals) = (Vec::new(), Vec::new());
    for power in (0..=24).filter(|power| *power != 1) {
        let m = 2f64.powf(f64::from(power) / 2.0).round() as usize;
        if m > n {
            break;
        }
        d.set_strategy(Locate::JumpAndWalk(JumpAndWalk { sample: Some(m), seed, ..JumpAndWalk::default() }))?;
        let ([visited, compared], ns) = measure(&d, &queries)?;
        by_sample.row([m.to_string(), short(visited), short(visited + compared), short(ns)]);
        walks.push((m as f64, visited));
        totals.push((m as f64, visited + compared));
    }
    plot.curve("triangles visited", walks);
    plot.curve("visited + m", totals);

    let mut growth = Table::new(
        "jump-and-walk-growth",
        "Cost with m = n^(1/3)",
        &["points", "m", "visited", "visited + m", "(visited + m) / n^(1/3)", "ns per query"],
    );
    let mut growth_plot = Plot::new(
        "jump-and-walk-growth",
        "Jump-and-walk: cost against the number of points, m = n^(1/3)",
        ["points", "triangles visited + m"],
    );
    let mut measured = Vec::new();
    let mut n = 1_000;
    while n <= largest {
        let ([visited, compared], ns) = measure(&set(n, None)?, &queries)?;
        let (cost, root) = (visited + compared, (n as f64).cbrt());
        growth.row([
            n.to_string(),
            short(compared),
            short(visited),
            short(cost),
            short(cost / root),
            short(ns),
        ]);
        measured.push((n as f64, cost));
        n = if n.to_string().starts_with('1') { n * 3 } else { n / 3 * 10 };
    }
    let (first_n, first_cost) = measured[0];
    let ideal: Vec<_> = measured.iter().map(|&(n, _)| (n, first_cost * (n / first_n).cbrt())).collect();
    growth_plot.curve("measured", measured);
    growth_plot.curve("proportional to n^(1/3)", ideal);
    Ok(Findings { tables: vec![fixed, by_sample, growth], plots: vec![plot, growth_plot] })
}
