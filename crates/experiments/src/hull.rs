//! Hulls in space by random order: Guibas, Knuth & Sharir 1992, §4.1. Theorem 4.1: O(n) facets ever; 4.2: O(n log n) time.
//!
//! Where all points are corners, a new one brings 6 - 12 / r facets to a hull of r points on average, whatever the points; the
//! harmonic sum of that is beside. In a ball most points are inside when they come. Queries whether a point is inside take
//! O(log^2 n) by the structure of §5, of which the paper says that it generalizes; ours ask the history of the caps.

use delone::{Counters, Hull3, HullHistory3, Work};
use delone_generators::{Kind3, Random};

use super::table::short;
use super::trials::Trials;
use super::{Error, Findings, Options, sizes};

/// Points of which it is asked whether they are inside.
const QUERIES: usize = 2_000;

pub(crate) fn run(options: &Options<'_>) -> Result<Findings, Error> {
    let mut table = options.table(
        "hull",
        "Facets that ever were, and what locating a point takes, by caps with a history of all that is seen and by flips with \
         a traced ray (the paper: O(n) facets, O(log n) steps a point)",
        &[
            "set",
            "points",
            "corners / n",
            "caps: facets / n",
            "6 - 12 H_n / n",
            "visited",
            "visited / ln n",
            "planes asked / ln n",
            "flips: facets / n",
            "traced",
            "traced / ln n",
            "orientations / ln n",
            "query: planes asked",
            "query / ln^2 n",
        ],
    );
    for (set, make) in
        [("ball", ball as fn(usize, u64) -> Vec<[f64; 3]>), ("sphere", sphere), ("moment curve", moment)]
    {
        for n in sizes(100, options.largest.min(300_000)) {
            let mut trials: [Trials; 8] = Default::default();
            for seed in options.seeds() {
                let points = make(n, seed);
                let history = HullHistory3::from_points(&points, seed)?;
                let (_, flips) = Hull3::by_flips(&points, seed)?;
                let per = |total: u64| total as f64 / n as f64;
                let of = |counters: Counters| {
                    let work = counters.work().unwrap_or_default();
                    [work.created, work.visited, work.orientations].map(per)
                };
                let corners = history.hull().corners().len() as f64 / n as f64;
                let [caps, visited, asked] = of(history.counters());
                let [flipped, traced, sides] = of(flips);
                // Inside, near the surface and outside.
                let mut work = Work::default();
                for q in ball(QUERIES, seed + 1000) {
                    history.contains_observed(q.map(|x| 1.5 * x), &mut work)?;
                }
                let query = work.orientations as f64 / QUERIES as f64;
                let values = [corners, caps, visited, asked, flipped, traced, sides, query];
                trials.iter_mut().zip(values).for_each(|(trials, value)| trials.add(value));
            }
            let log = (n as f64).ln();
            let harmonic: f64 = (1..=n).map(|i| 1.0 / i as f64).sum();
            let [corners, caps, visited, asked, flipped, traced, sides, query] = &trials;
            table.row([
                set.to_owned(),
                n.to_string(),
                corners.to_string(),
                caps.to_string(),
                short(6.0 - 12.0 * harmonic / n as f64),
                visited.to_string(),
                visited.over(log).to_string(),
                asked.over(log).to_string(),
                flipped.to_string(),
                traced.to_string(),
                traced.over(log).to_string(),
                sides.over(log).to_string(),
                query.to_string(),
                query.over(log * log).to_string(),
            ]);
        }
    }
    Ok(Findings { tables: vec![table], plots: Vec::new() })
}

fn ball(n: usize, seed: u64) -> Vec<[f64; 3]> {
    Kind3::Ball.points(n, seed)
}

fn sphere(n: usize, seed: u64) -> Vec<[f64; 3]> {
    Kind3::Sphere.points(n, seed)
}

/// Points (t, t^2, t^3): all are corners, and the hull has edges from the ends to all others.
fn moment(n: usize, seed: u64) -> Vec<[f64; 3]> {
    let mut random = Random::new(seed);
    let mut point = |_| {
        let t = random.between(-1.0, 1.0);
        [t, t * t, t * t * t]
    };
    (0..n).map(&mut point).collect()
}
