//! Theorems 6 and 7: what a location costs and what a construction costs, whatever the set (Devillers 1998, §3).
//!
//! By levels alone, and with the phase 3 by circles (§5.2), for which the theorem holds. Queries are random points of the set, left
//! out of it, as the theorem has them.

use delone::{Ask, Change, Delaunay2, Hierarchy, Locate, Nearest, Tally, Work};
use delone_generators::{Kind, Random};

use super::{QUERIES, SETS};
use crate::trials::Trials;
use crate::{Error, Findings, Options, sizes, timed};

/// The largest set, in points.
const LARGEST_SET: usize = 100_000;

pub(super) fn run(options: &Options<'_>, findings: &mut Findings) -> Result<(), Error> {
    let title = "Locations and constructions by levels alone, phase 3 by circles, ratio 30 (Devillers 1998, Theorems 6 and 7): \
                 triangles, and tests of all kinds";
    let heads = [
        "set",
        "points",
        "visited",
        "visited / ln n",
        "tests",
        "tests / ln n",
        "to build: tests a point / ln n",
        "to build: ns a point / ln n",
    ];
    let mut table = options.table("tuning-theorem", title, &heads);
    for (kind, name) in SETS {
        for n in sizes(1_000, options.largest.min(LARGEST_SET)) {
            let mut trials: [Trials; 4] = Default::default();
            for seed in options.seeds() {
                trials.iter_mut().zip(measure(kind, n, seed)?).for_each(|(trial, value)| trial.add(value));
            }
            let log = (n as f64).ln();
            let [visited, tests, built, ns] = &trials;
            table.row([
                name.to_owned(),
                n.to_string(),
                visited.to_string(),
                visited.over(log).to_string(),
                tests.to_string(),
                tests.over(log).to_string(),
                built.over(log).to_string(),
                ns.over(log).to_string(),
            ]);
        }
    }
    findings.tables.push(table);
    Ok(())
}

/// Triangles visited and tests of a location; tests, and nanoseconds, of a construction, a point.
fn measure(kind: Kind, n: usize, seed: u64) -> Result<[f64; 4], Error> {
    let asked = QUERIES.min(n / 2);
    let mut points = kind.points(n + asked, seed);
    Random::new(seed).shuffle(&mut points);
    let queries = points.split_off(n);
    let hierarchy = Hierarchy::only_levels().nearest(Nearest::InCircle).seed(seed);
    let mut built = Work::default();
    let d = build(&points, hierarchy, &mut built)?;
    let (plain, seconds) = timed(|| build(&points, hierarchy, &mut ()));
    plain?;
    let mut work = Work::default();
    queries.iter().try_for_each(|&q| d.find_observed(q, &mut work).map(drop))?;
    let tests = |work: Work| (work.orientations + work.in_circles + work.compared) as f64;
    let count = queries.len() as f64;
    Ok([work.visited as f64 / count, tests(work) / count, tests(built) / n as f64, seconds * 1e9 / n as f64])
}

/// Points inserted in their order.
fn build<T: Tally>(points: &[[f64; 2]], hierarchy: Hierarchy, tally: &mut T) -> Result<Delaunay2, Error> {
    let mut d = Delaunay2::with_strategy(Locate::Hierarchy(hierarchy))?;
    points.iter().try_for_each(|&p| d.insert_observed(p, tally).map(drop))?;
    Ok(d)
}
